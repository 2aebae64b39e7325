//! A lost device is noticed: wgpu's calls report nothing afterwards.

use tyndall_gpu::wgpu::{TextureFormat, TextureUsages};
use tyndall_gpu::{GpuError, TextureDesc};
use tyndall_tests::own_gpu;

fn picture() -> TextureDesc<'static> {
    let usage = TextureUsages::COPY_SRC | TextureUsages::RENDER_ATTACHMENT;
    TextureDesc::new_2d("picture", [8, 8], TextureFormat::Rgba8Unorm, usage)
}

#[test]
fn a_destroyed_device_fails_the_check_and_every_read_back() {
    let gpu = own_gpu();
    let texture = gpu.texture(&picture()).expect("small");
    gpu.check().expect("the device is well");
    gpu.device.destroy();
    let lost = |result: Result<(), GpuError>| matches!(result, Err(GpuError::DeviceLost { .. }));
    assert!(lost(gpu.read_texture(&texture).map(|_| ())), "no bytes of a lost device");
    assert!(lost(gpu.check()), "the loss is reported");
    assert!(lost(gpu.check()), "and again, for it stays");
    assert!(lost(gpu.texture(&picture()).map(|_| ())), "nothing is made on a lost device");
}

#[test]
fn a_loss_is_noticed_while_waiting() {
    let gpu = own_gpu();
    let submission = gpu.queue.submit([]);
    gpu.device.destroy();
    let waited = gpu.wait(submission);
    assert!(matches!(waited, Err(GpuError::DeviceLost { .. })), "{waited:?}");
}

#[test]
fn an_error_outside_of_any_scope_fails_the_next_check_once() {
    let gpu = own_gpu();
    let descriptor = wgpu::BufferDescriptor {
        label: Some("wrong"),
        size: 4,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::MAP_WRITE,
        mapped_at_creation: false,
    };
    drop(gpu.device.create_buffer(&descriptor));
    let error = gpu.check().expect_err("the buffer's usage is not allowed").to_string();
    assert!(error.starts_with("GPU commands: ") && error.contains("wrong"), "{error}");
    gpu.check().expect("it is reported once");
}
