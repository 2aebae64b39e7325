//! `tyndall doctor`: what this computer has for Tyndall, and what to install where something is missing.

use std::env;
use std::fmt::Write as _;

use serde_json::{Value, json};
use tyndall_gpu::{AdapterReport, Gpu, GpuError, GpuOptions};

use crate::values::format_bytes;
use crate::{Failure, output};

mod libraries;

/// What `tyndall doctor` takes.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct DoctorArguments {
    /// As a JSON object, for programs
    #[arg(long)]
    pub json: bool,
}

/// Looks and prints.
///
/// # Errors
/// When there is no adapter, or the chosen one gives no device; the findings are printed before.
pub fn run(arguments: DoctorArguments) -> Result<(), Failure> {
    let findings = Findings::look();
    let text = if arguments.json { format!("{:#}\n", findings.to_json()) } else { findings.to_text() };
    output::print(&text)?;
    findings.device.map(|_| ()).map_err(Failure::from)
}

/// The device that `--adapter auto` would use.
#[derive(Clone, Debug)]
struct Device {
    adapter: AdapterReport,
    max_memory_bytes: u64,
    has_timestamps: bool,
    /// Names as in the WebGPU specification.
    limits: Vec<(&'static str, u64)>,
}

/// Everything that was found.
#[derive(Debug)]
struct Findings {
    adapters: Vec<AdapterReport>,
    device: Result<Device, GpuError>,
    /// Packages that are missing.
    missing_packages: Vec<&'static str>,
    has_runtime_folder: bool,
}

impl Findings {
    fn look() -> Self {
        let adapters = Gpu::adapters();
        Self {
            missing_packages: libraries::missing_packages(!adapters.is_empty()),
            adapters,
            device: Gpu::open(&GpuOptions::default()).map(|gpu| Device::of(&gpu)),
            has_runtime_folder: !cfg!(target_os = "linux") || env::var_os("XDG_RUNTIME_DIR").is_some(),
        }
    }

    fn to_text(&self) -> String {
        let mut text = format!("tyndall {}\n\nAdapters (--adapter takes index or name):\n", env!("CARGO_PKG_VERSION"));
        // Writing to a String cannot fail.
        for (index, adapter) in self.adapters.iter().enumerate() {
            let _ = writeln!(text, "  {index}: {adapter}");
        }
        if self.adapters.is_empty() {
            text += "  none\n";
        }
        if let Ok(device) = &self.device {
            text += &device.to_text();
        }
        match libraries::install_command(&self.missing_packages) {
            Some(command) => {
                let _ = writeln!(text, "\nMissing packages, and how to install them:\n  {command}");
            }
            None => text += "\nNo package is missing.\n",
        }
        if !self.has_runtime_folder {
            text += "\nNote: XDG_RUNTIME_DIR is not set; the graphics driver complains about it, which is harmless.\n";
        }
        text
    }

    fn to_json(&self) -> Value {
        let adapters = self.adapters.iter().enumerate().map(|(index, adapter)| {
            json!({
                "index": index,
                "name": adapter.name,
                "backend": adapter.backend.to_string(),
                "driver": adapter.driver,
                "type": format!("{:?}", adapter.device_type),
                "is_software": adapter.is_software,
            })
        });
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "adapters": adapters.collect::<Value>(),
            "device": self.device.as_ref().ok().map(Device::to_json),
            "problem": self.device.as_ref().err().map(ToString::to_string),
            "missing_packages": self.missing_packages,
            "install_command": libraries::install_command(&self.missing_packages),
            "xdg_runtime_dir": self.has_runtime_folder,
        })
    }
}

impl Device {
    fn of(gpu: &Gpu) -> Self {
        let limits = gpu.limits();
        Self {
            adapter: gpu.adapter().clone(),
            max_memory_bytes: gpu.max_memory_bytes(),
            has_timestamps: gpu.has_timestamps(),
            limits: vec![
                ("maxTextureDimension2D", limits.max_texture_dimension_2d.into()),
                ("maxTextureDimension3D", limits.max_texture_dimension_3d.into()),
                ("maxBufferSize", limits.max_buffer_size),
                ("maxStorageBufferBindingSize", limits.max_storage_buffer_binding_size),
                ("maxComputeInvocationsPerWorkgroup", limits.max_compute_invocations_per_workgroup.into()),
            ],
        }
    }

    fn to_text(&self) -> String {
        let timestamps = if self.has_timestamps { "yes" } else { "no" };
        let mut text = format!("\nUsed by default: {}\n", self.adapter.name);
        let memory = format_bytes(self.max_memory_bytes);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {:<34} {memory} (--max-memory changes it)", "memory budget");
        let _ = writeln!(text, "  {:<34} {timestamps}", "GPU time of each pass");
        for (name, value) in &self.limits {
            let _ = writeln!(text, "  {name:<34} {value}");
        }
        text
    }

    fn to_json(&self) -> Value {
        let limits: serde_json::Map<_, _> =
            self.limits.iter().map(|(name, value)| ((*name).to_owned(), json!(value))).collect();
        json!({
            "name": self.adapter.name,
            "max_memory_bytes": self.max_memory_bytes,
            "has_timestamps": self.has_timestamps,
            "limits": limits,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn findings(device: Result<Device, GpuError>) -> Findings {
        Findings { adapters: Vec::new(), device, missing_packages: vec!["libxi6"], has_runtime_folder: false }
    }

    #[test]
    fn a_computer_with_nothing_is_told_what_to_install() {
        let findings = findings(Err(GpuError::NoAdapter { advice: "install one" }));
        let text = findings.to_text();
        assert!(text.contains("  none\n") && text.contains("libxi6") && text.contains("harmless"), "{text}");
        let json = findings.to_json();
        assert_eq!(json["problem"], "no graphics driver was found; install one", "{json}");
        assert_eq!(json["device"], Value::Null, "{json}");
    }

    #[test]
    fn an_open_device_is_shown_with_its_limits() {
        let device = Device::of(&Gpu::noop().unwrap());
        let text = findings(Ok(device)).to_text();
        assert!(text.contains("memory budget") && text.contains("maxTextureDimension2D"), "{text}");
    }
}
