//! Functions of `shaders/sky` that need the atmosphere's uniform, through the pictures: a pixel against the reference.

use std::f64::consts::FRAC_PI_2;

use tyndall_scattering::march::Marcher;
use tyndall_scattering::orders::{OrdersQuality, SourceTable};
use tyndall_scattering::sky_view_table::SkyViewTable;
use tyndall_scene::camera::CameraFrame;

use crate::render::{Studio, scene};

#[test]
fn a_pixel_of_the_sky_is_the_cpu_tables_radiance_in_its_direction() {
    let mut studio = Studio::new();
    let size = [48, 36];
    for preset in ["noon", "low-sun", "sunset", "high-altitude"] {
        let scene = scene(preset, &[("sun.disc", "false"), ("sky.orders_detail", "preview")]);
        let pixels = studio.radiance(&scene, size);
        let depth = studio.shoot(&scene, size).read_depth_m(studio.gpu).expect("depth");
        let atmosphere = scene.model();
        let marcher = Marcher::new(atmosphere, scene.sky.march_steps as usize / 4).expect("eight wavelengths");
        let sun = scene.sun_direction().expect("a sun");
        let table_size = [scene.sky.table_azimuths as usize, scene.sky.table_elevations as usize];
        let (altitude_m, mu_sun) = (scene.camera.altitude_m, sun.elevation_rad.sin());
        let source = SourceTable::new(&marcher, &OrdersQuality::preview());
        let diffuse_size = studio.renderer.tables().sky_view_diffuse().size_px().map(|side| side as usize);
        let table = SkyViewTable::new(&marcher, altitude_m, mu_sun, table_size);
        let table = table.with_orders((&marcher, &source), (altitude_m, mu_sun), diffuse_size);
        let camera = CameraFrame::new(&scene.camera);
        let (mut worst, mut seen) = (0.0_f64, 0);
        for (i, pixel) in pixels.iter().enumerate().filter(|(i, _)| depth[*i] > 1e9) {
            let point = glam::DVec2::new((i % 48) as f64 + 0.5, (i / 48) as f64 + 0.5);
            let direction = camera.ray(point, glam::UVec2::from_array(size));
            let elevation = FRAC_PI_2 - direction.z.clamp(-1.0, 1.0).acos();
            let azimuth = direction.x.atan2(direction.y) - sun.azimuth_rad;
            let want = table.radiance(&marcher, elevation, azimuth, direction.dot(sun.unit()));
            let scale = want.iter().fold(1e-2, |a: f64, b| a.max(b.abs()));
            worst = (0..3).map(|c| (f64::from(pixel[c]) - want[c]).abs() / scale).fold(worst, f64::max);
            seen += 1;
        }
        println!("pixels against the reference, {preset}: worst {:.3} % of {seen} pixels", worst * 100.0);
        assert!(seen > 400, "{preset}: the picture shows sky");
        assert!(worst < 2e-3, "{preset}: {worst:.1e}");
    }
}
