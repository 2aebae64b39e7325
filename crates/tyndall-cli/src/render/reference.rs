//! `--reference`: the frame by Monte-Carlo, without a graphics device.

use tyndall_io::Picture;
use tyndall_render::exposure::expected_ev100;
use tyndall_render::film::ExposedFilm;
use tyndall_render::reference::{ReferencePicture, left_out, render_reference};
use tyndall_scene::Scene;

use super::format::{Bits, OutputFormat};
use super::frame::{Frame, Pixels};
use crate::Failure;
use crate::interrupt::Interrupt;
use crate::progress::Progress;

/// What stands for the adapter in headers and reports.
const NO_ADAPTER: &str = "Monte-Carlo on the CPU";

/// Computes the frame with `paths` walks a pixel.
pub(super) fn frame(
    scene: &Scene,
    format: OutputFormat,
    (paths, seed): (u32, u64),
    interrupt: &Interrupt,
    progress: &Progress,
) -> Result<Frame, Failure> {
    let missing = left_out(scene);
    if !missing.is_empty() {
        progress.warn(&format!("a reference picture leaves out {}", missing.join(", ")));
    }
    let mut go_on = |done: f64| progress.share("walking at random", done).is_ok() && interrupt.check().is_ok();
    let Some(picture) = render_reference(scene, (paths, seed), &mut go_on)? else {
        // Nothing but a signal says no.
        return Err(interrupt.check().err().unwrap_or_else(|| Failure::Usage("the picture was stopped".to_owned())));
    };
    let size_px = picture.size_px;
    let guess = expected_ev100(scene.sun_direction()?.elevation_rad);
    let film = ExposedFilm::new(&scene.film, guess, &picture.rgba, size_px);
    let (ev100, adapter) = (film.ev100(), format!("{NO_ADAPTER}, {paths} paths, seed {seed}"));
    Ok(Frame { size_px, pixels: pixels(picture, &film, format), adapter, ev100, passes: Vec::new() })
}

fn pixels(picture: ReferencePicture, film: &ExposedFilm<'_>, format: OutputFormat) -> Pixels {
    let ReferencePicture { size_px, rgba, depth_m } = picture;
    match format {
        OutputFormat::Exr(..) | OutputFormat::Npy => Pixels::Light(Picture { size_px, rgba, depth_m: Some(depth_m) }),
        OutputFormat::Png(Bits::Sixteen) => Pixels::Sixteen(developed(&rgba, size_px, film, f64::from(u16::MAX), word)),
        OutputFormat::Png(Bits::Eight) | OutputFormat::Jpeg => {
            Pixels::Eight(developed(&rgba, size_px, film, f64::from(u8::MAX), byte))
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the value is 0 to 1")]
fn byte(value: f64) -> u8 {
    (value * f64::from(u8::MAX)).round() as u8
}

#[expect(clippy::cast_possible_truncation, reason = "the value is 0 to 1")]
fn word(value: f64) -> u16 {
    (value * f64::from(u16::MAX)).round() as u16
}

fn developed<T: Copy>(
    rgba: &[[f32; 4]],
    [width_px, _]: [u32; 2],
    film: &ExposedFilm<'_>,
    levels: f64,
    pack: impl Fn(f64) -> T,
) -> Vec<[T; 4]> {
    let pixel = |(index, light): (u32, &[f32; 4])| {
        let [r, g, b] = film.develop(*light, [index % width_px, index / width_px], levels);
        [pack(r), pack(g), pack(b), pack(1.0)]
    };
    (0..).zip(rgba).map(pixel).collect()
}
