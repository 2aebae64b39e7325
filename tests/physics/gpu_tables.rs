//! The tables that the GPU fills against the same tables in f64.

use tyndall_gpu::Texture;
use tyndall_scattering::atmosphere::{AEROSOL, AIR, OZONE};
use tyndall_scattering::column_table::ColumnTable;
use tyndall_scattering::irradiance_table::IrradianceTable;
use tyndall_scattering::march::Marcher;
use tyndall_scattering::sky_view_table::SkyViewTable;
use tyndall_scene::Scene;

use crate::render::{Studio, scene};

/// The target: GPU = CPU within 0.2 %. On the small planet with thick air the grazing columns are exponentials of
/// numbers near 80, of which f32 keeps 0.7 % at its deepest twilight.
fn target(scene: &Scene) -> f64 {
    if scene.atmosphere.planet_radius_km > 5000.0 { 2e-3 } else { 1e-2 }
}

fn texels(studio: &Studio, texture: &Texture) -> Vec<[f32; 4]> {
    let bytes = studio.gpu.read_texture(texture).unwrap_or_else(|error| panic!("{error}"));
    bytemuck::pod_collect_to_vec(&bytes)
}

fn marcher(scene: &Scene) -> Marcher {
    Marcher::new(scene.model(), scene.sky.march_steps as usize / 4).expect("eight wavelengths")
}

/// Scenes that differ in medium, sun and altitude; the last planet is nothing like the Earth.
fn scenes() -> [Scene; 5] {
    let small = ("sky.table_azimuths", "24");
    let few = ("sky.table_elevations", "64");
    // These are the tables of light that was scattered once.
    let single = ("sky.orders", "single");
    [
        scene("noon", &[small, few, single]),
        scene("sunset", &[small, few, single, ("atmosphere.aerosol_optical_depth", "0.5")]),
        scene("twilight", &[small, few, single, ("camera.altitude_m", "12000")]),
        scene("low-sun", &[small, few, single, ("haze.enabled", "true"), ("haze.visibility_km", "0.5")]),
        scene(
            "noon",
            &[
                small,
                few,
                single,
                ("atmosphere.planet_radius_km", "1000"),
                ("atmosphere.top_altitude_km", "200"),
                ("atmosphere.air_scale_height_km", "20"),
                ("camera.altitude_m", "50000"),
                ("sun.elevation_deg", "3"),
            ],
        ),
    ]
}

#[test]
fn the_column_table_of_the_gpu_is_the_one_of_the_cpu() {
    let mut studio = Studio::new();
    for scene in scenes() {
        studio.shoot(&scene, [8, 8]);
        let marcher = marcher(&scene);
        let got = texels(&studio, studio.renderer.tables().columns());
        let mut worst = 0.0_f64;
        for (got, want) in got.iter().zip(ColumnTable::new(&marcher.atmosphere).texels()) {
            // The first two are logarithms: their difference is the relative difference of the column. Columns of
            // less than a millionth of the shell's do not dim anything; f32 cannot hold the exponent of the thinnest.
            for medium in [AIR, AEROSOL] {
                let (got, want) = (f64::from(got[medium]), want[medium]);
                if want > -10.0 && want < 60.0 {
                    worst = worst.max((got - want).abs());
                }
            }
            let vertical = marcher.atmosphere.media[OZONE].profile.vertical_column_m();
            worst = worst.max((f64::from(got[OZONE]) - want[OZONE]).abs() / want[OZONE].max(vertical));
        }
        println!("column table, GPU against CPU: worst {worst:.1e}");
        // The worst is ozone: the kinks of its tent cost either quadrature 0.1 to 0.2 %; air and aerosol agree to 1e-3.
        assert!(worst < 5e-3, "{worst:.1e}");
    }
}

#[test]
fn the_irradiance_table_of_the_gpu_is_the_one_of_the_cpu() {
    let mut studio = Studio::new();
    for scene in scenes() {
        studio.shoot(&scene, [8, 8]);
        let table = IrradianceTable::new(&Marcher { panels: 8, ..marcher(&scene) });
        let got = texels(&studio, studio.renderer.tables().irradiance());
        let mut worst = 0.0_f64;
        for (sun, want) in table.nodes().iter().enumerate() {
            let strongest = want.iter().copied().fold(0.0, f64::max);
            for (k, want) in want.iter().enumerate() {
                let got = f64::from(got[sun + table.nodes().len() * (k / 4)][k % 4]);
                // Below the horizon of the twilight's end the light is nothing: 1e-9 of noon's.
                worst = worst.max((got - want).abs() / (strongest + 1e-7));
            }
        }
        println!("irradiance table, GPU against CPU: worst {worst:.1e}");
        assert!(worst < target(&scene), "{worst:.1e}");
    }
}

#[test]
fn the_sky_view_table_of_the_gpu_is_the_one_of_the_cpu() {
    let mut studio = Studio::new();
    for scene in scenes() {
        studio.shoot(&scene, [8, 8]);
        let marcher = marcher(&scene);
        let mu_sun = scene.sun_direction().expect("a sun").elevation_rad.sin();
        let size = [scene.sky.table_azimuths as usize, scene.sky.table_elevations as usize];
        let table = SkyViewTable::new(&marcher, scene.camera.altitude_m, mu_sun, size);
        let parts = studio.renderer.tables().sky_view().map(|texture| texels(&studio, texture));
        let brightest = table.texels().flat_map(|texel| texel.0).flatten().fold(0.0, f64::max);
        let mut worst = 0.0_f64;
        for (i, want) in table.texels().enumerate() {
            // Without haze its texture is small.
            for (got, want) in parts.iter().zip(want.0).filter_map(|(part, want)| Some((part.get(i)?, want))) {
                let scale = want.iter().fold(1e-3 * brightest, |a, b| a.max(b.abs()));
                let error = (0..3).map(|c| (f64::from(got[c]) - want[c]).abs() / scale).fold(0.0, f64::max);
                worst = worst.max(error);
            }
        }
        println!("sky-view table, GPU against CPU: worst {worst:.1e}");
        assert!(worst < target(&scene), "{worst:.1e}");
    }
}
