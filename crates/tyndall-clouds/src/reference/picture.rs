//! Pictures of many pixels.

use rayon::prelude::*;

use super::medium::Medium;
use super::monte_carlo::{Light, PathResult, PathSettings, path_radiance};
use super::phase::TabulatedPhase;
use super::ray::Ray;

/// What to draw: pixels, and the ray of each place of the picture.
#[derive(Clone, Copy, Debug)]
pub struct PathPicture<'a, F> {
    /// Columns and rows.
    pub size_px: [usize; 2],
    /// The ray of a place: columns from the left, rows from the top, in pixels.
    pub ray: &'a F,
}

/// The pixels of a picture, row by row from the top; the same on any number of threads.
#[must_use]
pub fn path_picture<F: Fn([f64; 2]) -> Ray + Sync>(
    medium: &Medium,
    phase: &TabulatedPhase,
    light: &Light,
    settings: &PathSettings,
    picture: &PathPicture<'_, F>,
) -> Vec<PathResult> {
    let [width, height] = picture.size_px;
    let pixel = |index: usize| {
        let corner = [index % width, index / width].map(|place| place as f64);
        let ray = |[x, y]: [f64; 2]| (picture.ray)([corner[0] + x, corner[1] + y]);
        path_radiance(medium, phase, light, settings, index as u64, ray)
    };
    (0..width * height).into_par_iter().map(pixel).collect()
}
