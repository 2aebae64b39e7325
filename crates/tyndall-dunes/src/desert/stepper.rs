//! Who makes the steps of a desert: the processor, or a device that gives the same bits.

use std::error::Error;
use std::fmt;

use super::simulation::DesertSimulation;
use crate::slab::DuneField;

/// Steps that a device makes between two looks at whether somebody still waits for them.
const STEPS_AT_ONCE: u32 = 32;

/// Makes steps of dunes in place of the processor, bit for bit the same.
pub trait DuneStepper: fmt::Debug + Send {
    /// The field so many steps later.
    ///
    /// # Errors
    /// When the device cannot do what this field does, or fails; the message says why.
    fn advance(&mut self, field: &DuneField, steps: u32) -> Result<DuneField, Box<dyn Error + Send + Sync>>;
}

/// Who made the last steps of a desert.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SteppedBy {
    /// The processor.
    #[default]
    Processor,
    /// The device that was chosen.
    Device,
    /// The processor, as the device could not: why.
    ProcessorInstead(String),
}

/// A device, if one was chosen, and how it does.
#[derive(Debug, Default)]
pub(super) struct Stepping {
    device: Option<Box<dyn DuneStepper>>,
    by: SteppedBy,
}

impl Stepping {
    /// With this device, or the processor.
    pub(super) fn new(device: Option<Box<dyn DuneStepper>>) -> Self {
        let by = if device.is_some() { SteppedBy::Device } else { SteppedBy::Processor };
        Self { device, by }
    }

    /// Who makes steps.
    pub(super) fn by(&self) -> &SteppedBy {
        &self.by
    }

    /// Lets a device that has failed try again, for another desert.
    pub(super) fn try_again(&mut self) {
        *self = Self::new(self.device.take());
    }

    /// Makes some of the next `steps` steps, at least one.
    pub(super) fn advance(&mut self, desert: &mut DesertSimulation, steps: u32) {
        match self.device.as_mut().filter(|_| self.by == SteppedBy::Device) {
            Some(device) => {
                if let Err(error) = desert.advance_by(device.as_mut(), steps.min(STEPS_AT_ONCE)) {
                    self.by = SteppedBy::ProcessorInstead(error.to_string());
                    desert.advance(1);
                }
            }
            None => desert.advance(1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::by_hand::{parse_strokes, touches};
    use crate::desert::{DesertInputs, DesertParams, DesertSource};
    use crate::side::Side;
    use crate::simulation::SandSimulation as _;

    /// A device that makes steps by the processor, and fails after some.
    #[derive(Debug)]
    struct Tired(u32);

    impl DuneStepper for Tired {
        fn advance(&mut self, field: &DuneField, steps: u32) -> Result<DuneField, Box<dyn Error + Send + Sync>> {
            self.0 = self.0.checked_sub(steps).ok_or("it is tired")?;
            let mut field = field.clone();
            field.run(steps);
            Ok(field)
        }
    }

    #[test]
    fn a_device_that_fails_is_replaced_by_the_processor_without_a_trace_in_the_sand() {
        let mut params = DesertParams::default();
        params.dunes.side = Side::Cells64;
        let strokes = parse_strokes("20 dig 6 2 0 0 10 0; 45 add 5 1 -9 3").unwrap();
        let touches = touches(&strokes, 1.0, [64, 64]).unwrap();
        let inputs = DesertInputs { touches, ..DesertInputs::default() };
        let made = |stepper: Option<Box<dyn DuneStepper>>| {
            let mut source = DesertSource::default();
            source.set_stepper(stepper);
            let hash = source.at_unless(&params, &inputs, 60, &|_| false).unwrap().unwrap().hash();
            (hash, source.stepped_by().clone())
        };
        let (plain, by) = made(None);
        assert_eq!(by, SteppedBy::Processor, "without a device");
        assert_eq!(
            made(Some(Box::new(Tired(100)))),
            (plain, SteppedBy::Device),
            "with one, hands laid on at their steps"
        );
        let instead = SteppedBy::ProcessorInstead("it is tired".to_owned());
        assert_eq!(made(Some(Box::new(Tired(25)))), (plain, instead), "with one that fails on the way");
    }
}
