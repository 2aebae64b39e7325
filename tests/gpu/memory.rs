//! Refusal of what does not fit, before anything is allocated.

use std::time::{Duration, Instant};

use tyndall_gpu::wgpu::{BufferUsages, TextureFormat, TextureUsages};
use tyndall_gpu::{AdapterChoice, Gpu, GpuError, GpuOptions, TextureDesc};
use tyndall_tests::{gpu, own_gpu};

/// A refusal that takes longer has touched memory.
const AT_ONCE: Duration = Duration::from_secs(1);

pub(crate) fn with_budget(max_memory_bytes: u64) -> Gpu {
    let name = gpu().adapter().name.clone();
    let options = GpuOptions { adapter: AdapterChoice::Name(name), max_memory_bytes: Some(max_memory_bytes) };
    Gpu::open(&options).expect("the adapter of the other tests")
}

fn target(label: &str, size_px: [u32; 2]) -> TextureDesc<'_> {
    TextureDesc::new_2d(label, size_px, TextureFormat::Rgba16Float, TextureUsages::RENDER_ATTACHMENT)
}

#[test]
fn a_texture_over_the_budget_is_refused_at_once_with_needed_and_allowed_bytes() {
    let gpu = with_budget(1 << 20);
    let start = Instant::now();
    let error = gpu.texture(&target("hdr", [1024, 512])).expect_err("4 MiB of 1 MiB").to_string();
    assert!(start.elapsed() < AT_ONCE, "{:?}", start.elapsed());
    assert_eq!(
        error,
        "texture `hdr` of 1024 x 512 px needs 4.00 MiB (4194304 bytes), but of the memory budget of 1.00 MiB \
         (1048576 bytes) only 1.00 MiB (1048576 bytes) are free",
        "the sentence"
    );
    assert_eq!(gpu.used_memory_bytes(), 0, "nothing is counted");
}

#[test]
fn a_picture_of_60000_px_is_refused_at_once_with_the_range() {
    let gpu = gpu();
    let start = Instant::now();
    let error = gpu.texture(&target("hdr", [60000, 60000])).expect_err("no device has it").to_string();
    assert!(start.elapsed() < AT_ONCE, "{:?}", start.elapsed());
    let high = gpu.limits().max_texture_dimension_2d;
    let sentence = format!("the width of texture `hdr` is 60000 px, outside 1 to {high} px, the range of this device");
    assert_eq!(error, sentence, "the sentence");
}

#[test]
fn empty_and_too_large_sizes_are_named_by_side() {
    let limits = gpu().limits();
    let volume = |size_px| TextureDesc::new_3d("v", size_px, TextureFormat::R32Float, TextureUsages::TEXTURE_BINDING);
    let layers = |count| TextureDesc { size_px: [4, 4, count], ..target("t", [4, 4]) };
    for (desc, side) in [
        (target("t", [0, 4]), "width"),
        (target("t", [4, 0]), "height"),
        (layers(limits.max_texture_array_layers + 1), "number of layers"),
        (volume([4, 4, limits.max_texture_dimension_3d + 1]), "depth"),
    ] {
        let error = gpu().texture(&desc).expect_err("outside the limits").to_string();
        assert!(error.starts_with(&format!("the {side} of texture")), "{error}");
    }
}

#[test]
fn a_buffer_beyond_the_device_or_empty_is_refused() {
    let gpu = gpu();
    for bytes in [0, gpu.limits().max_buffer_size.saturating_add(1)] {
        let result = gpu.buffer("b", bytes, BufferUsages::STORAGE);
        let error = result.map(|_| ()).expect_err("outside the limits");
        assert!(matches!(error, GpuError::OverLimit { value, .. } if value == bytes), "{error}");
    }
}

#[test]
fn dropped_textures_and_buffers_give_their_bytes_back() {
    let gpu = with_budget(1 << 20);
    let texture = gpu.texture(&target("t", [64, 64])).expect("32 KiB");
    let buffer = gpu.buffer("b", 1001, BufferUsages::STORAGE).expect("1 KiB");
    assert_eq!(gpu.used_memory_bytes(), 64 * 64 * 8 + 1004, "texture and buffer, rounded up to 4 bytes");
    drop((texture, buffer));
    assert_eq!(gpu.used_memory_bytes(), 0, "all of it");
    for _ in 0..100 {
        gpu.texture(&target("t", [256, 256])).expect("512 KiB at a time, 50 MiB in all");
    }
}

#[test]
fn a_read_back_counts_its_staging_buffer() {
    let gpu = with_budget(3 * 64 * 1024);
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
    let texture = gpu
        .texture(&TextureDesc::new_2d("t", [128, 128], TextureFormat::Rgba16Float, usage))
        .expect("128 KiB of 192 KiB");
    let error = gpu.read_texture(&texture).expect_err("another 128 KiB do not fit");
    assert!(matches!(error, GpuError::OverBudget { needed_bytes: 131_072, free_bytes: 65_536, .. }), "{error}");
}

#[test]
fn a_texture_with_an_impossible_usage_is_an_error_and_no_panic() {
    let usage = TextureUsages::STORAGE_BINDING;
    let desc = TextureDesc::new_2d("depth", [4, 4], TextureFormat::Depth32Float, usage);
    let error = own_gpu().texture(&desc).expect_err("depth is no storage format");
    assert!(matches!(error, GpuError::Validation { .. }), "{error}");
    assert!(error.to_string().starts_with("texture `depth` of 4 x 4 px: "), "{error}");
}
