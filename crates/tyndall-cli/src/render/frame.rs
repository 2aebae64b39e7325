//! A frame in memory: waiting for it and fetching its pixels.

use std::time::Duration;

use tyndall_gpu::wgpu::{PollError, PollType, SubmissionIndex};
use tyndall_gpu::{Gpu, PassTiming};
use tyndall_io::Picture;
use tyndall_render::{FrameFormat, FrameTarget, PictureFormat, RendererConfig};

use super::format::{Bits, OutputFormat};
use crate::Failure;
use crate::interrupt::Interrupt;

/// How soon a signal is noticed while the GPU works.
const WAIT_SLICE: Duration = Duration::from_millis(100);

/// A frame in the computer's own memory.
#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) size_px: [u32; 2],
    pub(crate) pixels: Pixels,
    pub(crate) adapter: String,
    pub(crate) ev100: f64,
    pub(crate) passes: Vec<PassTiming>,
}

/// Pixels as the file wants them, row 0 on top.
#[derive(Debug)]
pub(crate) enum Pixels {
    /// Developed, 8 bits.
    Eight(Vec<[u8; 4]>),
    /// Developed, 16 bits.
    Sixteen(Vec<[u16; 4]>),
    /// Light of the scene, and depth.
    Light(Picture),
}

/// Waits for the GPU, and for a signal.
pub(crate) fn wait(gpu: &Gpu, submission: &SubmissionIndex, interrupt: &Interrupt) -> Result<(), Failure> {
    let slice = || PollType::Wait { submission_index: Some(submission.clone()), timeout: Some(WAIT_SLICE) };
    while let Err(PollError::Timeout) = gpu.device.poll(slice()) {
        gpu.check()?;
        interrupt.check()?;
    }
    Ok(gpu.check()?)
}

/// The pixels of a target as the format wants them.
pub(crate) fn read(gpu: &Gpu, target: &FrameTarget, format: OutputFormat) -> Result<Pixels, Failure> {
    Ok(match format {
        OutputFormat::Png(Bits::Eight) | OutputFormat::Jpeg => Pixels::Eight(target.read_picture8(gpu)?),
        OutputFormat::Png(Bits::Sixteen) => Pixels::Sixteen(target.read_picture16(gpu)?),
        OutputFormat::Exr(..) | OutputFormat::Npy => Pixels::Light(Picture {
            size_px: target.size_px(),
            rgba: target.read_radiance(gpu)?,
            depth_m: Some(target.read_depth_m(gpu)?),
        }),
    })
}

/// Tries again after a lost device, which may have been a moment's trouble of the driver, but not a third time.
pub(crate) fn twice<T>(
    mut attempt: impl FnMut() -> Result<T, Failure>,
    warn: impl FnOnce(&Failure),
) -> Result<T, Failure> {
    match attempt() {
        Err(failure) if failure.is_lost_device() => {
            warn(&failure);
            attempt()
        }
        other => other,
    }
}

/// Precision of the frame: the app's own for its picture, more where the file keeps more.
pub(crate) fn config(format: OutputFormat) -> RendererConfig {
    match format {
        OutputFormat::Png(Bits::Eight) | OutputFormat::Jpeg => {
            RendererConfig { frame: FrameFormat::Half, picture: PictureFormat::Eight }
        }
        OutputFormat::Png(Bits::Sixteen) => {
            RendererConfig { frame: FrameFormat::Float, picture: PictureFormat::Sixteen }
        }
        OutputFormat::Exr(..) | OutputFormat::Npy => {
            RendererConfig { frame: FrameFormat::Float, picture: PictureFormat::Eight }
        }
    }
}

#[cfg(test)]
mod tests {
    use tyndall_gpu::GpuError;

    use super::*;
    use crate::Exit;

    fn lost() -> Failure {
        GpuError::DeviceLost { reason: "test".to_owned() }.into()
    }

    /// The outcome of two prepared attempts, and how many were made.
    fn outcome(attempts: [Result<(), Failure>; 2]) -> (Result<(), Failure>, usize) {
        let mut left = attempts.into_iter();
        let result = twice(|| left.next().expect("no third attempt"), |_| {});
        (result, 2 - left.len())
    }

    #[test]
    fn a_lost_device_is_tried_once_more() {
        let (result, made) = outcome([Err(lost()), Ok(())]);
        assert!(result.is_ok() && made == 2, "{result:?} after {made}");
    }

    #[test]
    fn a_device_lost_twice_ends_with_its_own_exit_code() {
        let (result, _) = outcome([Err(lost()), Err(lost())]);
        assert_eq!(result.expect_err("lost").exit(), Exit::DeviceLost, "both were lost");
    }

    #[test]
    fn other_failures_and_success_are_final() {
        let (result, made) = outcome([Err(GpuError::EmptyAdapterChoice.into()), Ok(())]);
        assert!(result.is_err() && made == 1, "{result:?} after {made}");
        let (result, made) = outcome([Ok(()), Err(lost())]);
        assert!(result.is_ok() && made == 1, "{result:?} after {made}");
    }
}
