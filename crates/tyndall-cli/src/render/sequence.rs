//! `--frames`: the frames of an animation, one file each.
//!
//! Every frame is that of a still scene, whichever frames were drawn before it. With `--resume` those are left alone that are there
//! already, whole and of the same scene; the rest of an interrupted command is what is missing.

use std::path::PathBuf;
use std::time::Instant;

use serde_json::json;
use tyndall_core::array::NamedArrays;
use tyndall_gpu::GpuOptions;
use tyndall_io::atomic::check_writable;
use tyndall_io::is_finished;
use tyndall_scene::{CloudKind, Scene};

use super::format::OutputFormat;
use super::frame::{Frame, twice};
use super::frames::{FrameRange, Pace, frame_path, scene_of_frame};
use super::session::{Session, Studio};
use super::{RenderArguments, header, write};
use crate::Failure;
use crate::interrupt::Interrupt;
use crate::progress::Progress;

/// Steps of the wind in a second of the animation where sand alone moves.
const SAND_SPEED: f64 = 30.0;

/// One frame of the list.
#[derive(Debug)]
struct Shot {
    number: u32,
    scene: Scene,
    path: PathBuf,
}

/// Everything that the frames have in common.
struct Sequence<'a> {
    arguments: &'a RenderArguments,
    options: GpuOptions,
    format: OutputFormat,
    state: Option<&'a NamedArrays>,
    interrupt: &'a Interrupt,
    progress: &'a Progress,
}

/// Draws the frames that are wanted.
pub(super) fn run(
    arguments: &RenderArguments,
    (range, scene): (FrameRange, &Scene),
    format: OutputFormat,
    progress: &mut Progress,
) -> Result<(), Failure> {
    let state = arguments.start.load(scene, None, progress)?;
    let scene = &arguments.start.advanced(scene, state.as_ref())?;
    arguments.start.check(scene, state.as_ref())?;
    let shots: Result<Vec<Shot>, Failure> = range.frames().map(|number| shot(arguments, scene, number)).collect();
    let shots = shots?;
    if let Some(first) = shots.first() {
        check_writable(&first.path)?;
    }
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let count = shots.len();
    let (options, state) = (arguments.device.options(), state.as_ref());
    let drawn = Sequence { arguments, options, format, state, interrupt: &interrupt, progress }.draw(&shots)?;
    let (skipped, seconds) = (count - drawn, progress.seconds());
    let files = arguments.output.display().to_string();
    let sentence = format!("{files}: {drawn} frames in {seconds:.1} s, {skipped} were there already");
    progress.finish(&sentence, json!({ "files": files, "frames": drawn, "skipped": skipped, "seconds": seconds }))
}

fn shot(arguments: &RenderArguments, scene: &Scene, number: u32) -> Result<Shot, Failure> {
    let path = frame_path(&arguments.output, number)?;
    let calm = if scene.clouds.kind == CloudKind::None { SAND_SPEED } else { 0.0 };
    let sand_speed = arguments.sand_speed.unwrap_or(calm);
    let pace = Pace { fps: arguments.fps, speed: arguments.speed, sand_speed };
    Ok(Shot { number, scene: scene_of_frame(scene, number, pace)?, path })
}

impl Sequence<'_> {
    /// Draws all shots, and says how many there were to draw.
    fn draw(&self, shots: &[Shot]) -> Result<usize, Failure> {
        let mut session = None;
        let mut drawn = 0;
        for (index, shot) in shots.iter().enumerate() {
            self.interrupt.check()?;
            self.progress.share("rendering frames", index as f64 / shots.len() as f64)?;
            if self.arguments.resume && self.is_done(shot) {
                continue;
            }
            let started = Instant::now();
            let frame = self.frame(shot, &mut session).map_err(|failure| self.arguments.start.blame(failure))?;
            self.save(shot, &frame)?;
            drawn += 1;
            self.progress.item(
                "frame",
                json!({
                    "frame": shot.number,
                    "file": shot.path.display().to_string(),
                    "scene_hash": shot.scene.hash().to_string(),
                    "exposure_ev100": frame.ev100,
                    "seconds": started.elapsed().as_secs_f64(),
                }),
            )?;
        }
        Ok(drawn)
    }

    /// Whether the file is the whole picture of this scene already.
    fn is_done(&self, shot: &Shot) -> bool {
        let size_px = [shot.scene.image.width_px, shot.scene.image.height_px];
        is_finished(&shot.path, size_px, &header::identity(&shot.scene, self.state))
    }

    /// Draws on the device that is open, opens one first, or another one when it was lost.
    fn frame<'a>(&'a self, shot: &Shot, session: &mut Option<Session<'a>>) -> Result<Frame, Failure> {
        let studio = Studio {
            size_px: [shot.scene.image.width_px, shot.scene.image.height_px],
            format: self.format,
            options: &self.options,
            cache: self.arguments.device.cache,
            state: self.state,
            interrupt: self.interrupt,
            stages: None,
        };
        let attempt = || {
            let mut open = match session.take() {
                Some(open) => open,
                None => studio.open()?,
            };
            let frame = open.draw(&shot.scene)?;
            *session = Some(open);
            Ok(frame)
        };
        twice(attempt, |failure| self.progress.warn(&format!("{failure}; trying once more")))
    }

    fn save(&self, shot: &Shot, frame: &Frame) -> Result<(), Failure> {
        self.interrupt.check()?;
        let metadata = header::metadata(&shot.scene, self.state, frame);
        write::write(&shot.path, frame, self.format, &metadata, self.interrupt).map(drop)
    }
}
