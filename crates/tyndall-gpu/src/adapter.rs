//! Which adapter to use, and what to tell a user who has none.

use std::fmt;
use std::str::FromStr;

use crate::GpuError;

/// How the adapter is chosen. As text: `auto`, `software`, an index, or a part of the name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// The fastest kind there is: discrete, integrated, virtual, other, software.
    #[default]
    Auto,
    /// An adapter that computes on the CPU.
    Software,
    /// The adapter of this index in [`Gpu::adapters`](crate::Gpu::adapters).
    Index(usize),
    /// The first adapter whose name contains this text, in any case of letters.
    Name(String),
}

impl FromStr for AdapterChoice {
    type Err = GpuError;

    fn from_str(text: &str) -> Result<Self, GpuError> {
        let text = text.trim();
        Ok(match text {
            "" => return Err(GpuError::EmptyAdapterChoice),
            "auto" => Self::Auto,
            "software" => Self::Software,
            _ => text.parse().map_or_else(|_not_an_index| Self::Name(text.to_owned()), Self::Index),
        })
    }
}

impl fmt::Display for AdapterChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Software => f.write_str("software"),
            Self::Index(index) => write!(f, "{index}"),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// What an adapter says of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterReport {
    /// Name of the GPU or of the software renderer.
    pub name: String,
    /// The graphics interface through which it is used.
    pub backend: wgpu::Backend,
    /// Driver and its version; may be empty.
    pub driver: String,
    /// Discrete, integrated, virtual, CPU or other.
    pub device_type: wgpu::DeviceType,
    /// Whether it computes on the CPU.
    pub is_software: bool,
}

impl AdapterReport {
    pub(crate) fn new(info: wgpu::AdapterInfo) -> Self {
        Self {
            name: info.name,
            backend: info.backend,
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            device_type: info.device_type,
            is_software: info.device_type == wgpu::DeviceType::Cpu,
        }
    }
}

impl fmt::Display for AdapterReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = match self.device_type {
            wgpu::DeviceType::DiscreteGpu => "discrete GPU",
            wgpu::DeviceType::IntegratedGpu => "integrated GPU",
            wgpu::DeviceType::VirtualGpu => "virtual GPU",
            wgpu::DeviceType::Cpu => "software",
            wgpu::DeviceType::Other => "other",
        };
        write!(f, "{} ({}, {kind}", self.name, self.backend)?;
        if self.driver.is_empty() { f.write_str(")") } else { write!(f, ", {})", self.driver) }
    }
}

/// What to install for an adapter that needs no GPU.
pub(crate) const ADVICE: &str = if cfg!(target_os = "linux") {
    "on Debian and Ubuntu `sudo apt-get install mesa-vulkan-drivers` brings drivers and a software renderer that needs no \
     GPU; on Fedora the package is mesa-vulkan-drivers too, on Arch vulkan-swrast, elsewhere install Mesa's lavapipe or \
     your GPU's Vulkan driver; `vulkaninfo --summary` shows what the system has"
} else if cfg!(target_os = "windows") {
    "install the GPU vendor's driver; the software renderer WARP is a part of Windows 10 and later"
} else if cfg!(target_os = "macos") {
    "Tyndall needs a Mac with Metal (macOS 10.14 or later)"
} else {
    "install a Vulkan driver, for instance Mesa's lavapipe, which needs no GPU"
};

/// Index of the adapter to use among `reports`.
///
/// # Errors
/// When there is none, or none as chosen.
pub(crate) fn choose(choice: &AdapterChoice, reports: &[AdapterReport]) -> Result<usize, GpuError> {
    if reports.is_empty() {
        return Err(GpuError::NoAdapter { advice: ADVICE });
    }
    let found = match choice {
        AdapterChoice::Auto => (0..reports.len()).min_by_key(|&index| rank(reports[index].device_type)),
        AdapterChoice::Software => reports.iter().position(|report| report.is_software),
        AdapterChoice::Index(index) => Some(*index).filter(|index| *index < reports.len()),
        AdapterChoice::Name(part) => {
            let part = part.to_lowercase();
            reports.iter().position(|report| report.name.to_lowercase().contains(&part))
        }
    };
    found.ok_or_else(|| GpuError::AdapterNotFound {
        wanted: choice.to_string(),
        available: (0..).zip(reports).map(|(i, report)| format!("{i}: {report}")).collect::<Vec<_>>().join("; "),
        advice: if *choice == AdapterChoice::Software { format!("; {ADVICE}") } else { String::new() },
    })
}

/// Faster kinds first.
fn rank(device_type: wgpu::DeviceType) -> u8 {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(name: &str, device_type: wgpu::DeviceType) -> AdapterReport {
        AdapterReport {
            name: name.to_owned(),
            backend: wgpu::Backend::Vulkan,
            driver: "Mesa 25.0".to_owned(),
            device_type,
            is_software: device_type == wgpu::DeviceType::Cpu,
        }
    }

    fn machine() -> Vec<AdapterReport> {
        vec![
            report("llvmpipe (LLVM 15)", wgpu::DeviceType::Cpu),
            report("Iris Xe", wgpu::DeviceType::IntegratedGpu),
            report("Arc A770", wgpu::DeviceType::DiscreteGpu),
        ]
    }

    fn chosen(text: &str) -> Result<usize, GpuError> {
        choose(&text.parse()?, &machine())
    }

    #[test]
    fn each_way_of_choosing_finds_its_adapter() {
        for (text, index) in [("auto", 2), ("software", 0), ("1", 1), ("iris", 1), ("A770", 2), (" LLVM ", 0)] {
            assert_eq!(chosen(text), Ok(index), "--adapter {text}");
        }
    }

    #[test]
    fn a_choice_that_fits_nothing_lists_what_there_is() {
        for text in ["3", "geforce"] {
            let message = chosen(text).expect_err("no such adapter").to_string();
            assert!(message.contains(&format!("`{text}`")), "{message}");
            assert!(message.contains("1: Iris Xe (vulkan, integrated GPU, Mesa 25.0)"), "{message}");
        }
    }

    #[test]
    fn a_machine_without_drivers_is_told_what_to_install() {
        let message = choose(&AdapterChoice::Auto, &[]).expect_err("no adapters").to_string();
        assert!(message.starts_with("no graphics driver was found"), "{message}");
        assert!(!cfg!(target_os = "linux") || message.contains("mesa-vulkan-drivers"), "{message}");
    }

    #[test]
    fn software_on_a_machine_with_gpus_alone_is_told_what_to_install() {
        let gpus = [report("Arc A770", wgpu::DeviceType::DiscreteGpu)];
        let message = choose(&AdapterChoice::Software, &gpus).expect_err("no software adapter").to_string();
        assert!(message.contains("`software`") && message.contains(ADVICE), "{message}");
    }

    #[test]
    fn an_empty_choice_is_refused_and_every_other_one_survives_printing() {
        assert_eq!("  ".parse::<AdapterChoice>(), Err(GpuError::EmptyAdapterChoice), "nothing chosen");
        for text in ["auto", "software", "7", "Radeon"] {
            let choice: AdapterChoice = text.parse().expect("a choice");
            assert_eq!(choice.to_string(), text, "{choice:?}");
        }
    }
}
