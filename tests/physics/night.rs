//! Stars, the floor of the night, twilight in the frame, and views from space.

use tyndall_render::{FrameFormat, FrameTarget, Renderer, RendererConfig};
use tyndall_scene::astronomy::{MAGNITUDE_ZERO_LUX, bright_stars};

use crate::render::{Studio, luminance, scene};

const NO_AIR: [(&str, &str); 5] = [
    ("atmosphere.air_density", "0"),
    ("atmosphere.aerosol_optical_depth", "0"),
    ("atmosphere.ozone_du", "0"),
    ("stars.airglow_cd_m2", "0"),
    ("stars.milky_way_cd_m2", "0"),
];
const NIGHT: (&str, &str) = ("sun.elevation_deg", "-40");

#[test]
fn sirius_gives_its_light_to_a_picture_of_any_size() {
    let mut studio = Studio::new();
    // Sirius culminates at 6.7525 h, 45 + 16.716 degrees below the pole: at 28.28 degrees in the south.
    let sky = [("stars.sidereal_h", "6.7525"), ("stars.latitude_deg", "45"), NIGHT];
    let camera = [("camera.heading_deg", "180"), ("camera.pitch_deg", "28.284"), ("camera.field_of_view_deg", "3")];
    for side in [24_u32, 60, 240] {
        let pixels = studio.radiance(&scene("noon", &[&NO_AIR[..], &sky, &camera].concat()), [side, side]);
        let solid_angle = (2.0 * 1.5_f64.to_radians().tan() / f64::from(side)).powi(2);
        let lux: f64 = pixels.into_iter().map(luminance).sum::<f64>() * solid_angle;
        let magnitude = -2.5 * (lux / MAGNITUDE_ZERO_LUX).log10();
        println!("Sirius in {side} px: {lux:.3e} lux, magnitude {magnitude:.3}");
        // Its neighbours within 1.5 degrees have a three-hundredth of its light.
        assert!((lux / bright_stars()[0].illuminance_lux - 1.0).abs() < 0.02, "{side} px: {lux}");
    }
}

#[test]
fn the_darkest_night_is_the_airglow_and_nowhere_black() {
    let mut studio = Studio::new();
    for altitude in ["2", "30000", "400000"] {
        for pitch in ["90", "20", "0", "-30"] {
            let at = [NIGHT, ("stars.visible", "false"), ("camera.altitude_m", altitude), ("camera.pitch_deg", pitch)];
            let pixels = studio.radiance(&scene("noon", &at), [16, 12]);
            let lights: Vec<f64> = pixels.into_iter().map(luminance).collect();
            assert!(lights.iter().all(|l| l.is_finite() && *l < 0.02), "from {altitude} m at {pitch}: {lights:?}");
            // Above the shell there is space.
            let darkest = if altitude == "400000" { 0.0 } else { 1e-6 };
            assert!(lights.iter().all(|l| *l >= darkest), "from {altitude} m at {pitch}: {lights:?}");
            if (altitude, pitch) == ("2", "90") {
                // A seventh of the shell's light is lost, a part of it comes back scattered.
                assert!((lights[6 * 16 + 8] / 1.7e-4 - 0.95).abs() < 0.08, "zenith {}", lights[6 * 16 + 8]);
            }
        }
    }
}

#[test]
fn half_floats_keep_the_falling_light_of_twilight_at_any_exposure() {
    let studio = Studio::new();
    let config = RendererConfig { frame: FrameFormat::Half, ..RendererConfig::default() };
    let mut renderer = Renderer::new(studio.gpu, config).expect("a renderer");
    let mut target = FrameTarget::new(studio.gpu, [2, 2], config).expect("a target");
    for ev100 in ["15", "-6"] {
        let mut before = f64::INFINITY;
        for step in 0..60 {
            let sun = format!("{}", -0.3 * f64::from(step));
            let look = [("camera.pitch_deg", "90"), ("sun.elevation_deg", sun.as_str()), ("stars.visible", "false")];
            let film = [("film.exposure", "manual"), ("film.ev100", ev100)];
            renderer
                .render(studio.gpu, &scene("twilight", &[&look[..], &film].concat()), &mut target)
                .expect("a frame");
            let here = luminance(target.read_radiance(studio.gpu).expect("radiance")[0]);
            // A half float keeps 1/1024 of a value; at the end the airglow is left.
            assert!(here > 1e-5 && here < 1.001 * before, "{ev100} EV, sun {sun}: {before} {here}");
            assert!(before.is_infinite() || here > 0.6 * before, "{ev100} EV, sun {sun}: {before} {here}");
            before = here;
        }
    }
}

#[test]
fn the_sky_has_no_step_along_a_scan_of_the_horizon() {
    let mut studio = Studio::new();
    for altitude in ["2", "1000", "10000", "100000"] {
        let horizon = tyndall_scattering::sky_view_map::horizon_elevation(6.36e6, altitude.parse().expect("a number"));
        for sun in ["40", "3", "-4"] {
            let pitch = format!("{}", horizon.to_degrees() + 1.01);
            let look = [
                ("camera.altitude_m", altitude),
                ("camera.pitch_deg", pitch.as_str()),
                ("camera.field_of_view_deg", "2"),
            ];
            let sky = [("sun.elevation_deg", sun), ("sun.disc", "false"), ("stars.visible", "false")];
            let pixels = studio.radiance(&scene("noon", &[&look[..], &sky].concat()), [1, 100]);
            let scan: Vec<f64> = pixels.into_iter().map(luminance).collect();
            let bend = |three: &[f64]| (three[0] - 2.0 * three[1] + three[2]).abs() / three[1];
            let worst = scan.windows(3).map(bend).fold(0.0, f64::max);
            println!("from {altitude} m, sun {sun}: second difference {:.2} %", 100.0 * worst);
            assert!(worst <= 0.02, "from {altitude} m, sun {sun}: {worst}");
        }
    }
}

#[test]
fn from_the_ground_to_ten_radii_every_sun_gives_light_and_no_direction_is_not_a_number() {
    let mut studio = Studio::new();
    for altitude in ["1", "2", "1000", "20000", "99999", "100001", "400000", "6000000", "63600000"] {
        for sun in ["90", "20", "0", "-6", "-25", "-90"] {
            let look =
                [("camera.altitude_m", altitude), ("camera.pitch_deg", "-90"), ("camera.field_of_view_deg", "150")];
            let pixels =
                studio.radiance(&scene("noon", &[&look[..], &[("sun.elevation_deg", sun)]].concat()), [24, 24]);
            let lights: Vec<f64> = pixels.into_iter().map(luminance).collect();
            assert!(lights.iter().all(|l| l.is_finite() && *l >= 0.0), "from {altitude} m, sun {sun}: {lights:?}");
            assert!(lights[12 * 24 + 12] > 0.0, "the ground is black from {altitude} m, sun {sun}");
        }
    }
}

#[test]
fn the_terminator_stays_where_it_is_when_the_camera_rolls() {
    let mut studio = Studio::new();
    let side = 48_usize;
    let shot = |studio: &mut Studio, roll: &str| {
        let look = [("camera.altitude_m", "20000000"), ("camera.pitch_deg", "-90"), ("camera.field_of_view_deg", "40")];
        let sun = [
            ("sun.elevation_deg", "5"),
            ("sun.azimuth_deg", "90"),
            ("camera.roll_deg", roll),
            ("stars.visible", "false"),
        ];
        studio
            .radiance(&scene("noon", &[&look[..], &sun].concat()), [48, 48])
            .into_iter()
            .map(luminance)
            .collect::<Vec<_>>()
    };
    let level = shot(&mut studio, "0");
    let quarter = shot(&mut studio, "90");
    let scale = level.iter().copied().fold(0.0, f64::max);
    for (i, rolled) in quarter.iter().enumerate() {
        let (x, y) = (i % side, i / side);
        // A quarter turn of the camera clockwise turns the picture back by one.
        let same = level[x * side + (side - 1 - y)];
        assert!((same - rolled).abs() <= 0.02 * scale, "pixel {x} {y}: {rolled}, level {same}");
    }
    let [day, night] = [level[24 * side + 40], level[24 * side + 8]].map(|l| l / scale);
    assert!((day > 0.1 && night < 1e-3) || (night > 0.1 && day < 1e-3), "one side is dark: {day} {night}");
}
