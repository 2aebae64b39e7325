//! The tables of all orders that the GPU fills against the same tables on the CPU.

use tyndall_render::sky::OrdersTable;
use tyndall_scattering::Atmosphere;
use tyndall_scattering::march::Marcher;
use tyndall_scattering::orders::basis::harmonic_count;
use tyndall_scattering::orders::{OrdersQuality, SourceTable};
use tyndall_scattering::sky_diffuse_table::SkyDiffuseTable;
use tyndall_scene::Scene;

use crate::render::{Studio, scene};

/// The target: GPU = CPU within 0.5 %.
const TARGET: f64 = 5e-3;

/// Sizes at which the software adapter takes part of a second.
pub(crate) fn small() -> OrdersQuality {
    OrdersQuality {
        altitudes: 8,
        suns_above: 6,
        suns_below: 7,
        zeniths: 5,
        azimuths: 7,
        panels: 4,
        orders: 4,
        ..OrdersQuality::preview()
    }
}

fn model(scene: &Scene) -> Atmosphere {
    scene.model()
}

/// Scenes that differ in medium; the last planet is not the Earth.
fn scenes() -> [Scene; 4] {
    [
        scene("noon", &[]),
        scene("noon", &[("haze.enabled", "true"), ("haze.visibility_km", "1"), ("haze.angstrom", "0.5")]),
        scene("noon", &[("atmosphere.aerosol_optical_depth", "0.5"), ("ground.red", "0.9"), ("ground.green", "0.8")]),
        scene(
            "noon",
            &[
                ("atmosphere.planet_radius_km", "3390"),
                ("atmosphere.top_altitude_km", "120"),
                ("atmosphere.air_scale_height_km", "11"),
                ("atmosphere.aerosol_phase", "henyey-greenstein"),
                ("atmosphere.ozone_du", "0"),
            ],
        ),
    ]
}

/// The table that the shaders make, one spectrum a row.
fn table_of_the_gpu(studio: &mut Studio, scene: &Scene, quality: &OrdersQuality) -> Vec<[f32; 8]> {
    studio.shoot(scene, [8, 8]);
    let mut orders = OrdersTable::new(studio.gpu).unwrap_or_else(|error| panic!("{error}"));
    let model = model(scene);
    let columns = studio.renderer.tables().columns();
    orders.upload(studio.gpu, &model, quality, 1.0);
    orders.fill_on_gpu(studio.gpu, columns, &model, quality).unwrap_or_else(|error| panic!("{error}"));
    let bytes = studio.gpu.read_buffer(orders.table()).unwrap_or_else(|error| panic!("{error}"));
    bytemuck::pod_collect_to_vec(&bytes)
}

#[test]
fn the_orders_table_of_the_gpu_is_the_one_of_the_cpu() {
    let mut studio = Studio::new();
    let quality = small();
    for scene in scenes() {
        let got = table_of_the_gpu(&mut studio, &scene, &quality);
        let marcher = Marcher::new(model(&scene), 8).expect("eight wavelengths");
        let source = SourceTable::new(&marcher, &quality);
        let harmonics = source.field().harmonics.iter().copied();
        let want: Vec<[f32; 8]> = harmonics.chain(source.irradiance_beyond_first_nodes()).collect();
        assert_eq!(got.len(), want.len(), "harmonics and irradiances");
        let count = harmonic_count(quality.degree);
        let nodes = quality.suns() * quality.for_haze_of(&marcher.atmosphere).altitudes;
        let brightest = want.iter().flatten().copied().fold(0.0, f32::max);
        // Below this share of noon's light the last sunbeams have crossed many optical depths of grazing air, whose
        // columns the GPU's quadrature holds to half a per cent.
        let darkest = if scene.atmosphere.planet_radius_km > 5000.0 { 1e-6 } else { 1e-4 };
        let mut worst = 0.0_f64;
        for (i, (got, want_here)) in got.iter().zip(&want).enumerate() {
            // The mean light of the node in its strongest wavelength sets the scale of its harmonics.
            let mean = if i < nodes * count { want[i - i % count] } else { *want_here };
            let scale = mean.iter().copied().fold(darkest * brightest, f32::max);
            for (got, want) in got.iter().zip(want_here) {
                worst = worst.max(f64::from((got - want).abs() / scale));
            }
        }
        println!("orders table, GPU against CPU: worst {worst:.1e}");
        assert!(worst < TARGET, "{worst:.1e}");
    }
}

/// Largest difference of the diffuse sky of the last frame from the one of a table, as a share.
fn worst_of_diffuse_sky(studio: &Studio, scene: &Scene, marcher: &Marcher, source: &SourceTable) -> f64 {
    let mu_sun = scene.sun_direction().expect("a sun").elevation_rad.sin();
    let texture = studio.renderer.tables().sky_view_diffuse();
    let size = texture.size_px().map(|side| side as usize);
    let want = SkyDiffuseTable::new(marcher, source, (scene.camera.altitude_m, mu_sun), size);
    let bytes = studio.gpu.read_texture(texture).unwrap_or_else(|error| panic!("{error}"));
    let got: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    let brightest = want.texels().flatten().fold(0.0, f64::max);
    assert!(brightest > 0.0, "the sky is not black");
    let mut worst = 0.0_f64;
    for (got, want) in got.iter().zip(want.texels()) {
        let scale = want.iter().copied().fold(1e-3 * brightest, f64::max);
        worst = (0..3).map(|c| (f64::from(got[c]) - want[c]).abs() / scale).fold(worst, f64::max);
    }
    worst
}

#[test]
fn the_diffuse_sky_of_the_gpu_is_the_one_of_the_cpu() {
    let mut studio = Studio::new();
    let small = [("sky.table_azimuths", "64"), ("sky.table_elevations", "64"), ("sky.orders_detail", "preview")];
    let hazy = ("atmosphere.aerosol_optical_depth", "0.5");
    for (preset, more) in [("noon", hazy), ("sunset", hazy), ("twilight", ("camera.altitude_m", "12000"))] {
        let mut scene = scene(preset, &small);
        scene.set_text(more.0, more.1).expect("a valid change");
        studio.shoot(&scene, [8, 8]);
        let marcher = Marcher::new(model(&scene), scene.sky.march_steps as usize / 4).expect("eight wavelengths");
        let source = SourceTable::new(&marcher, &OrdersQuality::preview());
        let worst = worst_of_diffuse_sky(&studio, &scene, &marcher, &source);
        println!("diffuse sky of {preset}, GPU against CPU: worst {worst:.1e}");
        assert!(worst < TARGET, "{preset}: {worst:.1e}");
    }
}

/// The table of light on level ground of a scene.
fn light_on_ground(studio: &mut Studio, scene: &Scene) -> Vec<f32> {
    studio.shoot(scene, [8, 8]);
    let texture = studio.renderer.tables().irradiance();
    let bytes = studio.gpu.read_texture(texture).unwrap_or_else(|error| panic!("{error}"));
    bytemuck::pod_collect_to_vec(&bytes)
}

#[test]
fn the_second_order_by_eight_directions_is_in_the_sky_of_the_gpu_and_not_on_the_ground() {
    let mut studio = Studio::new();
    let small = [("sky.table_azimuths", "64"), ("sky.table_elevations", "64"), ("sky.orders", "nishita-1996")];
    for preset in ["noon", "sunset"] {
        let scene = scene(preset, &small);
        studio.shoot(&scene, [8, 8]);
        let marcher = Marcher::new(model(&scene), scene.sky.march_steps as usize / 4).expect("eight wavelengths");
        let source = SourceTable::new(&marcher, &OrdersQuality::nishita1996());
        let worst = worst_of_diffuse_sky(&studio, &scene, &marcher, &source);
        println!("sky of {preset} by eight directions, GPU against CPU: worst {worst:.1e}");
        assert!(worst < TARGET, "{preset}: {worst:.1e}");
    }
    let mut scene = scene("noon", &small);
    let eight = light_on_ground(&mut studio, &scene);
    scene.set_text("sky.orders", "single").expect("a valid change");
    assert_eq!(eight, light_on_ground(&mut studio, &scene), "the ground is lit as by one order");
}

#[test]
fn the_irradiance_of_higher_orders_on_the_gpu_is_the_one_of_the_cpu() {
    let mut studio = Studio::new();
    let scene = scene("noon", &[("sky.orders_detail", "preview")]);
    studio.shoot(&scene, [8, 8]);
    let marcher = Marcher::new(model(&scene), 8).expect("eight wavelengths");
    let source = SourceTable::new(&marcher, &OrdersQuality::preview());
    let bytes =
        studio.gpu.read_texture(studio.renderer.tables().irradiance()).unwrap_or_else(|error| panic!("{error}"));
    let got: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    let suns = tyndall_scattering::irradiance_table::IRRADIANCE_TABLE_SIZE;
    for sun in 0..suns {
        let mu_sun = tyndall_scattering::irradiance_table::irradiance_map_inverse(sun as f64 / (suns - 1) as f64);
        let want = source.irradiance_beyond_first(mu_sun);
        let strongest = want.iter().copied().fold(0.0, f64::max);
        for (k, want) in want.iter().enumerate() {
            let got = f64::from(got[sun + suns * (2 + k / 4)][k % 4]);
            assert!((got - want).abs() <= TARGET * strongest, "sun {mu_sun}, wavelength {k}: {got} {want}");
        }
    }
}

#[test]
fn a_new_sun_keeps_the_orders_and_a_new_ground_does_not() {
    let mut studio = Studio::new();
    let mut scene = scene("noon", &[("sky.orders_detail", "preview")]);
    let mut irradiance = |scene: &Scene| {
        studio.shoot(scene, [8, 8]);
        let tables = studio.renderer.tables();
        let bytes = studio.gpu.read_buffer(tables.orders().table()).unwrap_or_else(|error| panic!("{error}"));
        bytemuck::pod_collect_to_vec::<u8, f32>(&bytes)
    };
    let before = irradiance(&scene);
    scene.sun.elevation_deg = 3.0;
    scene.sun.brightness = 2.0;
    assert_eq!(irradiance(&scene), before, "the table covers every sun, and holds the light of ours");
    scene.ground.red = 1.0;
    let red = irradiance(&scene);
    assert!(red != before, "a red ground reddens the sky");
    scene.atmosphere.air_scale_height_km = 6.0;
    let thin = irradiance(&scene);
    scene.atmosphere.air_scale_height_km = 8.0;
    assert!(thin != red && irradiance(&scene) == red, "columns are those of the scene's profiles");
}

#[test]
fn single_scattering_leaves_out_all_light_of_higher_orders() {
    let mut studio = Studio::new();
    let scene = scene("noon", &[("sky.orders", "single")]);
    studio.shoot(&scene, [8, 8]);
    let bytes =
        studio.gpu.read_texture(studio.renderer.tables().sky_view_diffuse()).unwrap_or_else(|error| panic!("{error}"));
    assert!(bytes.iter().all(|byte| *byte == 0), "no diffuse light in the paper's mode");
}
