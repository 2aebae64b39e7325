//! The clouds of a scene by random walks: what their picture should look like. Before a black sky here, in air in
//! [`crate::reference`].
//!
//! Delta tracking through the cells that the frame draws ([`tyndall_clouds::reference`]), with every order of scattering that
//! the scene counts, free of bias; lines of sight are those of the camera. Approximated: before a black sky lines of sight
//! are straight, where the frame's follow the curved Earth (8 cm over a kilometre). Not done: turbulence finer than a cell and grids that repeat; [`left_out`] names what of that a scene has. Costs some 40 thousand walks a second and core.

use glam::{DVec2, DVec3, UVec2};
use rayon::prelude::*;
use tyndall_clouds::reference::{
    Light, Medium, PathResult, PathSample, PathSettings, Ray, TabulatedPhase, path_radiance, path_sample,
};
use tyndall_clouds::{CloudError, CloudMatter, Edges};
use tyndall_scene::camera::CameraFrame;
use tyndall_scene::{CloudsParams, Orders, Scene};

use super::source::{CloudSource, CloudSourceRequest};
use crate::RenderError;
use crate::flip::mean_flip;

/// Scatterings after which a walk ends: light of more is none that a picture shows.
const MOST_ORDERS: u32 = 10_000;

/// The clouds of a scene and what shines on them.
#[derive(Debug)]
pub struct CloudReference {
    medium: Medium,
    phase: TabulatedPhase,
    light: Light,
    camera: CameraFrame,
    low_corner: DVec3,
    size: UVec2,
    max_orders: u32,
}

/// What a scene's clouds have that the walks leave out, for people.
#[must_use]
pub fn left_out(scene: &Scene) -> Vec<&'static str> {
    let Some(_clouds) = CloudSourceRequest::of(scene) else { return Vec::new() };
    let parts = [
        ("turbulence finer than a cell (clouds.detail)", scene.clouds.detail > 0.0),
        ("the repetition of the clouds' grid (cloud_grid.edges)", scene.cloud_grid.edges == Edges::Wrap),
    ];
    parts.into_iter().filter_map(|(name, present)| present.then_some(name)).collect()
}

impl CloudReference {
    /// Of a scene, whose clouds are made or read for it; `None` without clouds.
    ///
    /// # Errors
    /// When the clouds cannot be made, or the scene has no sun position.
    pub fn new(scene: &Scene) -> Result<Option<Self>, RenderError> {
        let Some(request) = CloudSourceRequest::of(scene) else { return Ok(None) };
        let matter = CloudSource::default().matter(&request)?;
        let scene = scene.grounded();
        let CloudMatter { extinction_per_m, cell_m, low_corner_m, .. } = &*matter;
        Ok(Some(Self {
            medium: Medium::new(extinction_per_m.clone(), *cell_m)?,
            phase: phase_of(&scene.clouds)?,
            light: Light { to_sun: scene.sun_direction()?.unit().to_array(), sun_irradiance: 1.0, sky_radiance: 0.0 },
            camera: CameraFrame::new(&scene.camera),
            low_corner: DVec3::from_array(*low_corner_m),
            size: UVec2::new(scene.image.width_px, scene.image.height_px),
            max_orders: if scene.clouds.orders == Orders::Single { 1 } else { MOST_ORDERS },
        }))
    }

    /// Radiance (1/sr, under a sun of irradiance 1) of the pixels of a row, by walks through the whole pixel; the same on any
    /// number of threads.
    #[must_use]
    pub fn row(&self, y: u32, (paths, seed): (u32, u64)) -> Vec<PathResult> {
        let settings = PathSettings { albedo: 1.0, max_orders: self.max_orders, samples: paths, seed };
        let pixel = |x: u32| {
            let corner = DVec2::new(f64::from(x), f64::from(y));
            let ray = |place: [f64; 2]| self.ray(corner + DVec2::from_array(place));
            let index = u64::from(y) * u64::from(self.size.x) + u64::from(x);
            path_radiance(&self.medium, &self.phase, &self.light, &settings, index, ray)
        };
        (0..self.size.x).into_par_iter().map(pixel).collect()
    }

    /// Paths that met a cloud, of those through a pixel, whose lines of sight bend with a planet of this radius.
    pub(super) fn samples(&self, [x, y]: [u32; 2], (paths, seed): (u32, u64), radius_m: f64) -> Vec<PathSample> {
        let settings = PathSettings { albedo: 1.0, max_orders: self.max_orders, samples: paths, seed };
        let corner = DVec2::new(f64::from(x), f64::from(y));
        let ray = |place: [f64; 2]| self.bent(self.ray(corner + DVec2::from_array(place)), radius_m);
        let number = u64::from(self.number([x, y]));
        let path = |sample| path_sample(&self.medium, &self.phase, &self.light, &settings, (number, sample), ray);
        (0..paths).filter_map(path).collect()
    }

    /// Number of a pixel in its picture.
    pub(super) fn number(&self, [x, y]: [u32; 2]) -> u32 {
        y.wrapping_mul(self.size.x).wrapping_add(x)
    }

    /// The straight line that touches, in the middle of the cells, the parabola in which the ground falls away from a ray.
    fn bent(&self, ray: Ray, radius_m: f64) -> Ray {
        let Some([near, far]) = self.medium.crossing(ray.origin, ray.direction) else { return ray };
        let middle_m = 0.5 * (near + far);
        let ([x, y, z], [dx, dy, dz]) = (ray.origin, ray.direction);
        let level = 1.0 - dz * dz;
        let fall = level * middle_m / radius_m;
        Ray { origin: [x, y, z - 0.5 * fall * middle_m], direction: [dx, dy, dz + fall] }
    }

    fn ray(&self, point_px: DVec2) -> Ray {
        let origin = self.camera.eye(point_px, self.size) - self.low_corner;
        Ray { origin: origin.to_array(), direction: self.camera.ray(point_px, self.size).to_array() }
    }
}

/// The double Henyey-Greenstein function that clouds are drawn with.
fn phase_of(drawn: &CloudsParams) -> Result<TabulatedPhase, CloudError> {
    let lobe = |g: f64, cosine: f64| (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine).powf(1.5);
    let CloudsParams { forward_weight, forward_asymmetry, backward_asymmetry, .. } = *drawn;
    TabulatedPhase::new(|cosine| {
        forward_weight * lobe(forward_asymmetry, cosine) + (1.0 - forward_weight) * lobe(backward_asymmetry, cosine)
    })
}

/// How far a picture of clouds is from its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudAccuracy {
    /// Mean of the picture over that of the reference.
    pub mean_ratio: f64,
    /// Mean of `(I - S)^2 / (S^2 + 1e-3 s^2)` over bins with cloud, with s = 1/sr.
    pub relative_square: f64,
    /// Pearson's correlation over the same bins.
    pub correlation: f64,
    /// Peak signal to noise ratio (dB) over pixels with cloud; the peak is the largest of the reference.
    pub psnr_db: f64,
    /// Mean difference that is seen ([`crate::flip`]) between the two as greys, both divided by the largest radiance of the
    /// reference and shown without a tone map.
    pub flip: f64,
    /// Standard error of the reference's mean over the mean: noise of the walks.
    pub noise: f64,
}

impl CloudAccuracy {
    /// Opacity of a bin from which it counts.
    const OPACITY: f64 = 0.02;
    /// Radiance (1/sr) below which errors count as absolute: 1/sr^2 in `S^2 + 1e-3`.
    const SQUARE_FLOOR: f64 = 1e-3;

    /// Compares a picture (1/sr) with a reference of the same size, in bins of `bin` by `bin` pixels; `None` when nothing
    /// of it is cloud.
    #[must_use]
    pub fn of(picture: &[f64], reference: &[PathResult], width_px: usize, bin: usize) -> Option<Self> {
        let bins = binned(picture, reference, width_px, bin);
        let [mut count, mut i, mut s, mut ii, mut ss, mut is, mut relative] = [0.0; 7];
        for [image, truth, _] in bins.iter().filter(|bin| bin[2] > Self::OPACITY) {
            relative += (image - truth).powi(2) / (truth * truth + Self::SQUARE_FLOOR);
            count += 1.0;
            (i, s) = (i + image, s + truth);
            (ii, ss, is) = (ii + image * image, ss + truth * truth, is + image * truth);
        }
        if count < 1.0 || s <= 0.0 {
            return None;
        }
        let cloudy = picture.iter().zip(reference).filter(|(_, truth)| truth.opacity > Self::OPACITY);
        let (squares, pixels) = cloudy
            .fold((0.0, 0.0), |(sum, count), (image, truth)| (sum + (image - truth.radiance).powi(2), count + 1.0));
        let peak = reference.iter().map(|truth| truth.radiance).fold(0.0, f64::max);
        let error = reference.iter().map(|truth| truth.error.powi(2)).sum::<f64>().sqrt();
        Some(Self {
            mean_ratio: i / s,
            relative_square: relative / count,
            correlation: (is - i * s / count) / ((ii - i * i / count) * (ss - s * s / count)).sqrt(),
            psnr_db: 10.0 * (peak * peak * pixels / squares).log10(),
            flip: mean_flip(
                &greys(reference.iter().map(|truth| truth.radiance), peak),
                &greys(picture.iter().copied(), peak),
                width_px,
            ),
            noise: error / reference.iter().map(|truth| truth.radiance).sum::<f64>(),
        })
    }
}

/// A picture of radiance as linear greys of which the brightest is white.
fn greys(radiance: impl Iterator<Item = f64>, white: f64) -> Vec<[f64; 3]> {
    radiance.map(|value| [value / white; 3]).collect()
}

/// Means of picture, reference and opacity over bins; the rest at the edges is left out.
fn binned(picture: &[f64], reference: &[PathResult], width: usize, bin: usize) -> Vec<[f64; 3]> {
    let (columns, rows) = (width / bin, picture.len() / width / bin);
    let mean = |index: usize| {
        let (x0, y0) = (index % columns * bin, index / columns * bin);
        let mut sums = [0.0; 3];
        for pixel in (0..bin * bin).map(|inner| (y0 + inner / bin) * width + x0 + inner % bin) {
            let truth = &reference[pixel];
            sums = [sums[0] + picture[pixel], sums[1] + truth.radiance, sums[2] + truth.opacity];
        }
        sums.map(|sum| sum / (bin * bin) as f64)
    };
    (0..columns * rows).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn truth(values: &[f64]) -> Vec<PathResult> {
        values.iter().map(|&radiance| PathResult { radiance, error: 0.0, opacity: 1.0 }).collect()
    }

    #[test]
    fn a_picture_is_all_right_beside_itself_and_its_factor_is_found() {
        let reference = truth(&[0.1, 0.2, 0.3, 0.4, 0.3, 0.2, 0.1, 0.05]);
        let values: Vec<f64> = reference.iter().map(|truth| truth.radiance).collect();
        let same = CloudAccuracy::of(&values, &reference, 4, 1).expect("there is a cloud");
        assert!((same.mean_ratio - 1.0).abs() < 1e-12 && same.relative_square < 1e-12, "{same:?}");
        assert!((same.correlation - 1.0).abs() < 1e-12 && same.psnr_db > 200.0, "{same:?}");
        assert!(same.flip.abs() < 1e-12, "{same:?}");
        let brighter: Vec<f64> = values.iter().map(|value| 1.1 * value).collect();
        let found = CloudAccuracy::of(&brighter, &reference, 4, 2).expect("there is a cloud");
        assert!((found.mean_ratio - 1.1).abs() < 1e-12 && (found.correlation - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.relative_square - 0.01).abs() < 3e-3, "a tenth, squared: {found:?}");
        assert!(found.flip > 0.01 && found.flip < 0.3, "a tenth more is seen: {found:?}");
        assert_eq!(CloudAccuracy::of(&values, &truth(&[0.0; 8]), 4, 1), None, "no light, no judgement");
    }
}
