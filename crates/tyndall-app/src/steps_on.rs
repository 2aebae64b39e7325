//! Who makes the steps of dunes: the processor, or the graphics device by the same bits.

use tyndall_dunes::DuneStepper;
use tyndall_gpu::AdapterReport;
use tyndall_gpu_sim::GpuStepper;

/// What the user has chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum StepsOn {
    /// Graphics, unless its adapter is the processor anyway.
    #[default]
    Automatic,
    /// The processor.
    Processor,
    /// The graphics device, even one that the processor plays.
    Graphics,
}

impl StepsOn {
    /// All choices.
    pub(crate) const ALL: [Self; 3] = [Self::Automatic, Self::Processor, Self::Graphics];

    /// Word for people.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Automatic => "Automatic",
            Self::Processor => "Processor",
            Self::Graphics => "Graphics",
        }
    }

    /// The device for the adapter of the window; `None` for the processor. It is one of its own, opened at the first step, so
    /// that frames and steps do not wait for each other.
    pub(crate) fn stepper(self, adapter: &AdapterReport) -> Option<Box<dyn DuneStepper>> {
        let is_wanted = match self {
            Self::Automatic => !adapter.is_software,
            Self::Processor => false,
            Self::Graphics => true,
        };
        is_wanted.then(|| Box::new(GpuStepper::new(adapter.into())) as _)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_gpu::wgpu;

    #[test]
    fn only_real_graphics_are_chosen_by_themselves() {
        let adapter = |is_software| AdapterReport {
            name: "some adapter".to_owned(),
            backend: wgpu::Backend::Vulkan,
            driver: String::new(),
            device_type: wgpu::DeviceType::Other,
            is_software,
        };
        let on = |choice: StepsOn, is_software| choice.stepper(&adapter(is_software)).is_some();
        assert_eq!([false, true].map(|software| on(StepsOn::Automatic, software)), [true, false], "automatic");
        assert_eq!([false, true].map(|software| on(StepsOn::Processor, software)), [false; 2], "processor");
        assert_eq!([false, true].map(|software| on(StepsOn::Graphics, software)), [true; 2], "graphics");
    }
}
