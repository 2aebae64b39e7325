//! A scene's sky, ground and clouds by Monte-Carlo, pixel by pixel on the CPU: what the tables' picture should look like.

use glam::{DVec2, UVec2};
use rayon::prelude::*;
use tyndall_core::spectrum::rec709_from_spectrum;
use tyndall_scattering::geometry::{Ray, distance_to_ground};
use tyndall_scattering::monte_carlo::PictureWalks;
use tyndall_scattering::params::GroundPattern;
use tyndall_scene::camera::CameraFrame;
use tyndall_scene::{CloudKind, LandscapeKind, MoonPosition, Scene, SkyKind};

use crate::clouds::in_air::CloudsInAir;
use crate::clouds::reference::{self as clouds, CloudReference};
use crate::environment::sun_above_air;
use crate::{RenderError, SKY_DEPTH_M};

/// Elevation of the sun (rad) below which stars are seen.
const STARS_BELOW: f64 = -0.07;

/// A picture in linear Rec.709 (cd/m^2), row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferencePicture {
    /// Width and height (px).
    pub size_px: [u32; 2],
    /// Radiance; alpha is 1.
    pub rgba: Vec<[f32; 4]>,
    /// Planar distance (m); [`SKY_DEPTH_M`] where the sky is.
    pub depth_m: Vec<f32>,
}

/// What a scene has that a reference picture leaves out, for people.
#[must_use]
pub fn left_out(scene: &Scene) -> Vec<&'static str> {
    // By day nobody misses the stars.
    let dark = scene.sun_direction().is_ok_and(|sun| sun.elevation_rad < STARS_BELOW);
    let parts = [
        ("the sun's disc", scene.sun.disc && scene.sky.kind == SkyKind::Air),
        ("the moon and its light", scene.moon.position != MoonPosition::None && scene.sky.kind == SkyKind::Air),
        ("stars and airglow", scene.stars.visible && dark),
        ("the landscape", scene.landscape.kind != LandscapeKind::None),
        ("the clouds' shade on ground and air", scene.clouds.kind != CloudKind::None && scene.sky.kind == SkyKind::Air),
        ("the ground's pattern", scene.ground.pattern != GroundPattern::Plain),
    ];
    parts.into_iter().filter_map(|(name, present)| present.then_some(name)).chain(clouds::left_out(scene)).collect()
}

/// Renders with `paths` random walks a pixel, through the pixel's centre. `progress` is told the share that is done and
/// says whether to go on; `None` when it said no.
///
/// # Errors
/// When the scene's values do not fit together.
pub fn render_reference(
    scene: &Scene,
    (paths, seed): (u32, u64),
    progress: &mut dyn FnMut(f64) -> bool,
) -> Result<Option<ReferencePicture>, RenderError> {
    scene.check()?;
    if scene.sky.kind == SkyKind::Black {
        return render_clouds(scene, (paths, seed), progress);
    }
    let clouds = CloudReference::new(scene)?;
    let scene = scene.grounded();
    let mut atmosphere = scene.model();
    for solar in &mut atmosphere.solar_irradiance_w_m2_nm {
        *solar *= scene.sun.brightness;
    }
    let radius_m = atmosphere.planet_radius_m;
    let walks = PictureWalks::new(&atmosphere)?;
    let (camera, sun) = (CameraFrame::new(&scene.camera), scene.sun_direction()?.unit());
    let size_px = [scene.image.width_px, scene.image.height_px];
    let pixels = size_px[0] as usize * size_px[1] as usize;
    let (mut rgba, mut depth_m) = (Vec::with_capacity(pixels), Vec::with_capacity(pixels));
    for y in 0..size_px[1] {
        if !progress(f64::from(y) / f64::from(size_px[1])) {
            return Ok(None);
        }
        let points = (0..size_px[0]).map(|x| DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        let mut rays = Vec::with_capacity(size_px[0] as usize);
        for point in points {
            let direction = camera.ray(point, UVec2::from_array(size_px));
            let h_m = camera.eye(point, UVec2::from_array(size_px)).z.max(0.0);
            rays.push(Ray { h_m, mu: direction.z, mu_sun: sun.z, nu: direction.dot(sun).clamp(-1.0, 1.0) });
            let ground_m = distance_to_ground(radius_m, h_m, direction.z);
            depth_m.push(ground_m.map_or(SKY_DEPTH_M, |t_m| planar_m(t_m * direction.dot(camera.forward))));
        }
        let mut row = walks.radiance(&rays, y * size_px[0], (paths, seed));
        if let Some(clouds) = &clouds {
            let clouds = CloudsInAir { clouds, air: &walks, to_sun: sun.to_array() };
            let pixels = row.par_iter_mut().zip(&rays).enumerate();
            pixels.for_each(|(x, (light, ray))| {
                let pixel = [u32::try_from(x).unwrap_or(u32::MAX), y];
                *light = clouds.pixel(pixel, (ray, *light), (paths, seed));
            });
        }
        rgba.extend(row.iter().map(|spectrum| opaque(rec709_from_spectrum(spectrum))));
    }
    Ok(Some(ReferencePicture { size_px, rgba, depth_m }))
}

/// The clouds alone, lit by the sun above the air.
fn render_clouds(
    scene: &Scene,
    walks: (u32, u64),
    progress: &mut dyn FnMut(f64) -> bool,
) -> Result<Option<ReferencePicture>, RenderError> {
    let size_px = [scene.image.width_px, scene.image.height_px];
    let sun = sun_above_air(scene)?;
    let clouds = CloudReference::new(scene)?;
    let mut rgba = Vec::with_capacity(size_px[0] as usize * size_px[1] as usize);
    for y in 0..size_px[1] {
        if !progress(f64::from(y) / f64::from(size_px[1])) {
            return Ok(None);
        }
        let row = clouds.as_ref().map(|clouds| clouds.row(y, walks));
        let light = |x: u32| row.as_ref().map_or(0.0, |row| row[x as usize].radiance);
        rgba.extend((0..size_px[0]).map(|x| opaque(sun.map(|channel| channel * light(x)))));
    }
    let depth_m = vec![SKY_DEPTH_M; rgba.len()];
    Ok(Some(ReferencePicture { size_px, rgba, depth_m }))
}

#[expect(clippy::cast_possible_truncation, reason = "pictures are f32")]
fn planar_m(distance_m: f64) -> f32 {
    distance_m as f32
}

#[expect(clippy::cast_possible_truncation, reason = "pictures are f32")]
fn opaque([r, g, b]: [f64; 3]) -> [f32; 4] {
    [r as f32, g as f32, b as f32, 1.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small() -> Scene {
        let mut scene = Scene::default();
        (scene.image.width_px, scene.image.height_px) = (8, 6);
        scene
    }

    #[test]
    fn a_reference_picture_has_sky_above_ground_and_the_same_bits_for_one_seed() {
        let render =
            |seed: u64| render_reference(&small(), (4, seed), &mut |_| true).expect("a scene").expect("all of it");
        let picture = render(1);
        assert_eq!((picture.rgba.len(), picture.depth_m.len()), (48, 48), "eight by six");
        assert!(picture.rgba.iter().flatten().all(|value| value.is_finite() && *value > -1e3), "{:?}", picture.rgba);
        assert_eq!(picture, render(1), "the same seed");
        assert_ne!(picture.rgba, render(2).rgba, "another seed");
    }

    #[test]
    fn a_refusal_stops_a_reference_picture() {
        let mut rows = 0;
        let mut twice = |_done: f64| {
            rows += 1;
            rows < 3
        };
        assert_eq!(render_reference(&small(), (1, 1), &mut twice).expect("a scene"), None, "stopped in the third row");
    }

    #[test]
    fn what_is_left_out_is_said() {
        let mut scene = small();
        (scene.sun.disc, scene.landscape.kind) = (false, LandscapeKind::None);
        scene.ground.pattern = GroundPattern::Plain;
        assert!(left_out(&scene).is_empty(), "{:?}", left_out(&scene));
        scene.sun.disc = true;
        scene.ground.pattern = GroundPattern::Checker;
        assert_eq!(left_out(&scene), ["the sun's disc", "the ground's pattern"], "both");
    }
}
