//! A panorama from the six faces of a cube: for what only rasterization draws.
//!
//! The faces have twice as many pixels as the panorama. Sky and ground are gathered, four bilinear samples a pixel. The
//! sun's disc, a million times brighter, is the difference of two frames, with it and without; each of its pixels is dealt
//! out to the pixels of the panorama by solid angle, so that no light is lost.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use rayon::prelude::*;
use tyndall_gpu::Gpu;
use tyndall_scene::Scene;

use super::{GroundLight, read_light};
use crate::{CubeFace, FrameTarget, RenderError, Renderer, View};

/// Samples across a pixel of the panorama, and parts across a pixel of the sun.
const SAMPLES: u32 = 2;
const PARTS: u32 = 4;

/// Direction (east, north, up) of a point of a panorama of this size, in pixels from its upper left corner.
#[must_use]
pub fn panorama_direction([x_px, y_px]: [f64; 2], size_px: [u32; 2]) -> DVec3 {
    let turn = 2.0 * PI * (x_px / f64::from(size_px[0]) - 0.5);
    let elevation = PI * (0.5 - y_px / f64::from(size_px[1]));
    DVec3::new(turn.cos() * elevation.cos(), -turn.sin() * elevation.cos(), elevation.sin())
}

/// Point of a panorama, in pixels from its upper left corner, in which a direction is seen; the inverse of
/// [`panorama_direction`].
#[must_use]
pub fn panorama_point_px(direction: DVec3, size_px: [u32; 2]) -> [f64; 2] {
    let turn = (-direction.y).atan2(direction.x);
    let elevation = direction.z.atan2(direction.x.hypot(direction.y));
    [f64::from(size_px[0]) * (0.5 + turn / (2.0 * PI)), f64::from(size_px[1]) * (0.5 - elevation / PI)]
}

/// Solid angle (sr) of a pixel in a row of a panorama.
#[must_use]
pub fn panorama_solid_angle(row: u32, size_px: [u32; 2]) -> f64 {
    let sine = |row: u32| (FRAC_PI_2 - PI * f64::from(row) / f64::from(size_px[1])).sin();
    2.0 * PI / f64::from(size_px[0]) * (sine(row) - sine(row + 1))
}

/// Draws a panorama by way of a cube.
pub(super) fn panorama(
    renderer: &mut Renderer,
    gpu: &Gpu,
    scene: &Scene,
    size_px: [u32; 2],
    ground: GroundLight,
) -> Result<Vec<[f32; 4]>, RenderError> {
    let side_px = (size_px[0] / 4 * SAMPLES).max(2);
    let mut target = FrameTarget::new(gpu, [side_px; 2], renderer.config())?;
    let mut discless = scene.clone();
    discless.sun.disc = false;
    let mut rgba = vec![[0.0; 4]; size_px[0] as usize * size_px[1] as usize];
    for side in CubeFace::ALL {
        renderer.render_view(gpu, &discless, View::CubeFace(side), &mut target)?;
        let sky = Face { side, side_px, rgba: read_light(gpu, &target, ground)? };
        gather(&sky, &mut rgba, size_px);
        if scene.sun.disc {
            renderer.render_view(gpu, scene, View::CubeFace(side), &mut target)?;
            let with_disc = Face { side, side_px, rgba: read_light(gpu, &target, ground)? };
            deal(&with_disc, &sky, &mut rgba, size_px);
        }
    }
    Ok(rgba)
}

/// Pixels of a face.
struct Face {
    side: CubeFace,
    side_px: u32,
    rgba: Vec<[f32; 4]>,
}

impl Face {
    /// Light between the pixels around a point of the face, -1 to 1 to the right and upwards.
    #[expect(clippy::cast_possible_truncation, reason = "pixels of the face")]
    fn at(&self, [x, y]: [f64; 2]) -> [f32; 4] {
        let side = f64::from(self.side_px);
        let place = |share: f64| {
            let position = (share * side - 0.5).clamp(0.0, side - 1.0);
            let first = (position as usize).min(self.side_px as usize - 2);
            (first, (position - first as f64) as f32)
        };
        let ((column, right), (row, down)) = (place(0.5 + 0.5 * x), place(0.5 - 0.5 * y));
        let pixel = |row: usize, column: usize| self.rgba[row * self.side_px as usize + column];
        let [a, b] = [row, row + 1].map(|row| {
            let (left_pixel, right_pixel) = (pixel(row, column), pixel(row, column + 1));
            std::array::from_fn::<f32, 4, _>(|c| left_pixel[c] * (1.0 - right) + right_pixel[c] * right)
        });
        std::array::from_fn(|c| a[c] * (1.0 - down) + b[c] * down)
    }
}

/// Adds what the face shows of the panorama.
fn gather(face: &Face, rgba: &mut [[f32; 4]], size_px: [u32; 2]) {
    let share = 1.0 / (SAMPLES * SAMPLES) as f32;
    rgba.par_chunks_mut(size_px[0] as usize).enumerate().for_each(|(row, pixels)| {
        for (column, pixel) in pixels.iter_mut().enumerate() {
            for [x, y] in parts(SAMPLES) {
                let direction = panorama_direction([column as f64 + x, row as f64 + y], size_px);
                let (side, at) = CubeFace::of_direction(direction);
                if side == face.side {
                    let light = face.at(at);
                    *pixel = std::array::from_fn(|c| pixel[c] + share * light[c]);
                }
            }
        }
    });
}

/// Deals out what a face has more than the one without the disc.
fn deal(with_disc: &Face, without: &Face, rgba: &mut [[f32; 4]], size_px: [u32; 2]) {
    let axes = with_disc.side.frame(DVec3::ZERO);
    let side_px = with_disc.side_px as usize;
    let step = 2.0 / side_px as f64;
    for (index, (on, off)) in with_disc.rgba.iter().zip(&without.rgba).enumerate() {
        // A hundred times brighter than the sky: rounding is not the sun.
        if on[1] <= 1.01 * off[1] {
            continue;
        }
        for [x, y] in parts(PARTS) {
            let (x, y) = ((index % side_px) as f64 + x, (index / side_px) as f64 + y);
            let seen = axes.forward + (step * x - 1.0) * axes.right + (1.0 - step * y) * axes.up;
            let solid_angle = step * step / f64::from(PARTS * PARTS) / seen.length().powi(3);
            let (pixel, row) = pixel_of(seen.normalize(), size_px);
            let share = solid_angle / panorama_solid_angle(row, size_px);
            for c in 0..3 {
                #[expect(clippy::cast_possible_truncation, reason = "pixels are f32")]
                let light = (f64::from(on[c] - off[c]) * share) as f32;
                rgba[pixel][c] += light;
            }
        }
    }
}

/// Index and row of the pixel of a panorama that shows a direction.
#[expect(clippy::cast_possible_truncation, reason = "pixels of the panorama")]
fn pixel_of(direction: DVec3, size_px: [u32; 2]) -> (usize, u32) {
    let [x, y] = panorama_point_px(direction, size_px);
    let (column, row) = ((x as u32).min(size_px[0] - 1), (y as u32).min(size_px[1] - 1));
    (row as usize * size_px[0] as usize + column as usize, row)
}

/// Centres of the parts of a pixel, from its corner.
fn parts(across: u32) -> impl Iterator<Item = [f64; 2]> {
    let centre = move |index: u32| (f64::from(index) + 0.5) / f64::from(across);
    (0..across * across).map(move |index| [centre(index % across), centre(index / across)])
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE_PX: [u32; 2] = [64, 32];

    #[test]
    fn the_pixels_of_a_panorama_cover_the_sphere() {
        let sum: f64 = (0..SIZE_PX[1]).map(|row| f64::from(SIZE_PX[0]) * panorama_solid_angle(row, SIZE_PX)).sum();
        assert!((sum - 4.0 * PI).abs() < 1e-12, "{sum}");
    }

    #[test]
    fn points_and_directions_are_inverse() {
        for point in [[0.5, 0.5], [32.0, 16.0], [63.9, 31.5], [10.25, 20.75]] {
            let back = panorama_point_px(panorama_direction(point, SIZE_PX), SIZE_PX);
            assert!((back[0] - point[0]).abs() + (back[1] - point[1]).abs() < 1e-9, "{point:?} {back:?}");
        }
        assert!((panorama_direction([32.0, 16.0], SIZE_PX) - DVec3::X).length() < 1e-12, "east in the centre");
        assert!((panorama_direction([48.0, 16.0], SIZE_PX) - DVec3::NEG_Y).length() < 1e-12, "south to the right");
        assert!((panorama_direction([7.0, 0.0], SIZE_PX) - DVec3::Z).length() < 1e-12, "the zenith on top");
    }

    #[test]
    fn a_cube_of_one_light_becomes_a_panorama_of_that_light() {
        let mut rgba = vec![[0.0; 4]; 64 * 32];
        for side in CubeFace::ALL {
            gather(&Face { side, side_px: 32, rgba: vec![[3.0, 2.0, 1.0, 1.0]; 32 * 32] }, &mut rgba, SIZE_PX);
        }
        for pixel in rgba {
            assert!(pixel.iter().zip([3.0, 2.0, 1.0, 1.0]).all(|(a, b)| (a - b).abs() < 1e-5), "{pixel:?}");
        }
    }

    #[test]
    fn a_bright_pixel_is_dealt_out_without_loss() {
        let dark = |side| Face { side, side_px: 32, rgba: vec![[0.5, 0.5, 0.5, 1.0]; 32 * 32] };
        for (side, index) in [(CubeFace::PosX, 100), (CubeFace::PosY, 16 * 32 + 15), (CubeFace::NegZ, 1023)] {
            let mut bright = dark(side);
            bright.rgba[index] = [1e6, 1e6, 1e6, 1.0];
            let mut rgba = vec![[0.0; 4]; 64 * 32];
            deal(&bright, &dark(side), &mut rgba, SIZE_PX);
            let dealt: f64 = (0..32)
                .map(|row| {
                    let sum: f64 = rgba[row as usize * 64..][..64].iter().map(|pixel| f64::from(pixel[0])).sum();
                    sum * panorama_solid_angle(row, SIZE_PX)
                })
                .sum();
            let [x, y] = [index % 32, index / 32].map(|i| (i as f64 + 0.5) / 16.0 - 1.0);
            let expected = (1e6 - 0.5) / 256.0 * (1.0 + x * x + y * y).powf(-1.5);
            assert!((dealt / expected - 1.0).abs() < 1e-3, "{side:?}: {dealt} {expected}");
        }
    }
}
