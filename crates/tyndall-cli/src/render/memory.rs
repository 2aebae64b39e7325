//! How much memory a picture takes, asked before any of it is allocated.

use tyndall_gpu::wgpu::DeviceType;
use tyndall_gpu::{AdapterReport, Gpu, GpuError};
use tyndall_render::{FrameTarget, RendererConfig};

use super::format::{Bits, OutputFormat};

/// Refuses a picture that does not fit into the memory budget.
pub(crate) fn check_budget(
    gpu: &Gpu,
    size_px: [u32; 2],
    format: OutputFormat,
    config: RendererConfig,
) -> Result<(), GpuError> {
    let pixels = u64::from(size_px[0]) * u64::from(size_px[1]);
    let read_back = pixels.saturating_mul(read_back_bytes_per_px(format) * copies(gpu.adapter()));
    let needed_bytes = FrameTarget::bytes(size_px, config).saturating_add(read_back);
    let budget_bytes = gpu.max_memory_bytes();
    let free_bytes = budget_bytes.saturating_sub(gpu.used_memory_bytes());
    if needed_bytes <= free_bytes {
        return Ok(());
    }
    let what = format!("a picture of {} x {} pixels", size_px[0], size_px[1]);
    Err(GpuError::OverBudget { what, needed_bytes, free_bytes, budget_bytes })
}

/// Bytes of a pixel of the texture that is read back.
fn read_back_bytes_per_px(format: OutputFormat) -> u64 {
    match format {
        OutputFormat::Png(Bits::Eight) | OutputFormat::Jpeg => 4,
        OutputFormat::Png(Bits::Sixteen) | OutputFormat::Exr(..) | OutputFormat::Npy => 16,
    }
}

/// How many copies of the read-back live at once in the budget's memory: the staging buffer, and where the GPU's memory is
/// the system's, the bytes with and without padding too.
fn copies(adapter: &AdapterReport) -> u64 {
    match adapter.device_type {
        DeviceType::Cpu | DeviceType::IntegratedGpu => 3,
        DeviceType::DiscreteGpu | DeviceType::VirtualGpu | DeviceType::Other => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_beyond_the_budget_is_refused_with_both_numbers() {
        let gpu = Gpu::noop().unwrap();
        let (config, format) = (RendererConfig::default(), OutputFormat::Png(Bits::Eight));
        assert!(check_budget(&gpu, [64, 64], format, config).is_ok(), "small");
        let error = check_budget(&gpu, [1_000_000, 1_000_000], format, config).expect_err("huge").to_string();
        assert!(error.contains("1000000 x 1000000 pixels") && error.contains("memory budget of"), "{error}");
    }
}
