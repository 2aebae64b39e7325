//! For each parameter a scene in which it matters.
//!
//! Exposure is manual, because the automatic one evens out what brightness does. Light counts that was scattered once,
//! except where all orders matter: the tables of the others take seconds on a software adapter.

use tyndall_scene::{
    AerosolInput, CameraProjection, CloudFileHolds, CloudKind, DesertKind, DuneModel, Edges, ExposureMode,
    LandscapeKind, MoonPhase, MoonPosition, Orders, OrdersDetail, Scene, Side, SkyMode, SunPosition,
};

/// A scene and the parameters that are tried in it.
pub(crate) struct Precondition {
    /// What makes the parameters matter.
    pub(crate) name: &'static str,
    /// Prepares a new scene.
    pub(crate) prepare: fn(&mut Scene),
    /// Paths, with a value where the usual step would not show.
    pub(crate) parameters: &'static [(&'static str, Option<f64>)],
}

/// All preconditions. A parameter that stands in none of them fails the test.
pub(crate) const ALL: &[Precondition] = &[
    Precondition {
        name: "a clear day above a checkered ground",
        prepare: |scene| {
            manual(scene);
            checker(scene);
        },
        parameters: &[
            ("camera.x_m", None),
            ("camera.y_m", None),
            ("camera.altitude_m", None),
            ("camera.heading_deg", None),
            ("camera.pitch_deg", None),
            ("camera.roll_deg", None),
            ("camera.field_of_view_deg", None),
            ("camera.projection", None),
            ("sun.elevation_deg", None),
            ("sun.azimuth_deg", None),
            ("sun.position", None),
            ("sun.brightness", None),
            ("ground.material", None),
            ("ground.red", None),
            ("ground.green", None),
            ("ground.blue", None),
            ("ground.pattern", None),
            ("ground.tile_m", None),
            ("film.exposure", None),
            ("film.ev100", None),
            ("film.contrast", None),
            ("film.saturation", None),
            ("film.tone_map", None),
            ("film.dither", None),
        ],
    },
    Precondition {
        name: "a low sun in view",
        prepare: |scene| {
            manual(scene);
            scene.film.ev100 = 11.0;
            scene.sun.elevation_deg = 3.0;
            scene.sun.azimuth_deg = 20.0;
            scene.camera.pitch_deg = 8.0;
        },
        parameters: &[
            ("atmosphere.planet_radius_km", Some(2000.0)),
            // Above 100 km there is too little air to be seen.
            ("atmosphere.top_altitude_km", Some(41.0)),
            ("atmosphere.air_density", None),
            ("atmosphere.air_scale_height_km", None),
            ("atmosphere.air_model", None),
            ("atmosphere.aerosol_optical_depth", None),
            ("atmosphere.aerosol_input", None),
            ("atmosphere.aerosol_angstrom", None),
            ("atmosphere.aerosol_blue_loss", None),
            ("atmosphere.aerosol_albedo", None),
            ("atmosphere.aerosol_asymmetry", None),
            ("atmosphere.aerosol_scale_height_km", None),
            ("atmosphere.aerosol_phase", None),
            ("atmosphere.ozone_du", None),
            ("atmosphere.ozone_altitude_km", None),
            ("atmosphere.ozone_half_width_km", None),
            ("sky.kind", None),
            ("sky.mode", None),
            ("sky.table_elevations", Some(40.0)),
            ("sky.table_azimuths", Some(16.0)),
            ("sky.march_steps", Some(8.0)),
        ],
    },
    Precondition {
        name: "haze in front of a low sun, some air left above it",
        prepare: |scene| {
            manual(scene);
            scene.film.ev100 = 12.0;
            scene.sun.elevation_deg = 25.0;
            scene.camera.pitch_deg = 8.0;
            scene.haze.enabled = true;
        },
        parameters: &[
            ("haze.enabled", None),
            ("haze.visibility_km", None),
            ("haze.contrast", None),
            ("haze.top_m", None),
            ("haze.scale_height_m", None),
            ("haze.angstrom", None),
            ("haze.albedo_red", None),
            ("haze.albedo_green", None),
            ("haze.albedo_blue", None),
            ("haze.forward_asymmetry", None),
            ("haze.backward_asymmetry", None),
            ("haze.forward_weight", None),
        ],
    },
    Precondition {
        name: "aerosol by visibility",
        prepare: |scene| {
            manual(scene);
            scene.atmosphere.aerosol_input = AerosolInput::Visibility;
        },
        parameters: &[("atmosphere.aerosol_visibility_km", None)],
    },
    Precondition {
        name: "aerosol by turbidity",
        prepare: |scene| {
            manual(scene);
            scene.atmosphere.aerosol_input = AerosolInput::Turbidity;
        },
        parameters: &[("atmosphere.aerosol_turbidity", None)],
    },
    Precondition {
        name: "the sun's disc, large and dark enough not to be clipped",
        prepare: |scene| {
            manual(scene);
            scene.film.ev100 = 25.0;
            scene.film.compensation_ev = -8.0;
            scene.sun.elevation_deg = 10.0;
            scene.sun.angular_radius_deg = 4.0;
        },
        parameters: &[
            ("sun.disc", None),
            ("sun.angular_radius_deg", None),
            ("sun.limb_darkening", None),
            ("sun.refraction", None),
            ("sun.pressure_hpa", None),
            ("sun.temperature_c", Some(-50.0)),
        ],
    },
    Precondition {
        name: "the sun by date",
        prepare: |scene| {
            manual(scene);
            scene.sun.position = SunPosition::Date;
        },
        parameters: &[
            ("sun.year", None),
            ("sun.month", None),
            ("sun.day", None),
            ("sun.time_h", None),
            ("sun.utc_offset_h", None),
            ("sun.latitude_deg", None),
            ("sun.longitude_deg", None),
        ],
    },
    Precondition {
        name: "a moonlit night",
        prepare: |scene| {
            night(scene);
            scene.moon.position = MoonPosition::Angles;
            scene.moon.azimuth_deg = 15.0;
        },
        parameters: &[
            ("moon.position", None),
            ("moon.elevation_deg", None),
            ("moon.azimuth_deg", None),
            ("moon.phase", None),
            ("moon.brightness", None),
        ],
    },
    Precondition {
        name: "the moon's disc, large and dark enough not to be clipped",
        prepare: |scene| {
            night(scene);
            scene.film.ev100 = 8.0;
            scene.moon.position = MoonPosition::Angles;
            scene.moon.phase = MoonPhase::Angle;
            scene.moon.azimuth_deg = 0.0;
            scene.moon.elevation_deg = 12.0;
            scene.moon.angular_radius_deg = 4.0;
        },
        parameters: &[
            ("moon.phase_deg", Some(60.0)),
            ("moon.angular_radius_deg", None),
            ("moon.disc", None),
            ("moon.maria", None),
        ],
    },
    Precondition {
        name: "a night of stars",
        prepare: |scene| {
            night(scene);
            scene.stars.milky_way_cd_m2 = 0.001;
        },
        parameters: &[
            ("stars.visible", None),
            ("stars.brightness", None),
            ("stars.sidereal_h", None),
            ("stars.latitude_deg", None),
            ("stars.milky_way_cd_m2", None),
            ("stars.airglow_cd_m2", None),
        ],
    },
    Precondition {
        name: "the paper's dome",
        prepare: |scene| {
            manual(scene);
            scene.sky.mode = SkyMode::VertexDome;
        },
        parameters: &[("sky.dome_rings", Some(8.0)), ("sky.dome_segments", Some(12.0))],
    },
    Precondition {
        name: "all orders of scattering, coarsely",
        prepare: |scene| {
            scene.film.exposure = ExposureMode::Manual;
            scene.sky.orders_detail = OrdersDetail::Preview;
        },
        parameters: &[("sky.orders", None), ("sky.orders_detail", None)],
    },
    Precondition {
        name: "a valley with snow",
        prepare: |scene| {
            valley(scene);
            scene.landscape.snow_line_m = 500.0;
        },
        parameters: &[
            ("landscape.kind", None),
            ("landscape.seed", None),
            ("landscape.size_km", None),
            ("landscape.height_m", None),
            ("landscape.feature_km", None),
            ("landscape.snow_line_m", Some(900.0)),
            ("sky.aerial_columns", Some(5.0)),
            ("sky.aerial_rows", Some(5.0)),
            ("sky.aerial_distance_km", Some(2.0)),
        ],
    },
    Precondition {
        name: "a few clouds of a small grid",
        prepare: cloudy,
        parameters: &[
            ("clouds.kind", Some(0.0)),
            ("clouds.method", None),
            ("clouds.time_s", Some(400.0)),
            ("clouds.reach_km", Some(2.0)),
            ("clouds.orders", None),
            ("clouds.forward_asymmetry", Some(0.5)),
            ("clouds.backward_asymmetry", Some(-0.2)),
            ("clouds.forward_weight", Some(0.6)),
            ("clouds.detail", Some(0.0)),
            ("clouds.resolution", None),
            ("cloud_grid.cells_east", Some(48.0)),
            ("cloud_grid.cells_north", Some(48.0)),
            ("cloud_grid.cells_up", Some(24.0)),
            ("cloud_grid.cell_m", Some(70.0)),
            ("cloud_grid.floor_m", Some(1400.0)),
            ("cloud_grid.edges", None),
            ("cloud_grid.seed", Some(7.0)),
            ("cloud_grid.warm_up_steps", Some(33.0)),
            ("cloud_grid.step_s", Some(60.0)),
            ("cloud_vapour.pattern", None),
            ("cloud_vapour.cover", Some(0.9)),
            ("cloud_vapour.bubble_radius_m", Some(300.0)),
            ("cloud_vapour.bubble_height_m", Some(300.0)),
            ("cloud_vapour.bubble_spread", Some(0.1)),
            ("cloud_vapour.base_m", Some(350.0)),
            ("cloud_vapour.start_humidity", Some(0.2)),
            ("cloud_vapour.humidity", Some(0.5)),
            ("cloud_vapour.activation", Some(0.1)),
            ("cloud_vapour.extinction", Some(0.3)),
            ("cloud_vapour.extinction_outside", Some(0.05)),
            ("cloud_vapour.supply_interval", Some(5.0)),
            ("cloud_wind.floor_speed_m_s", Some(20.0)),
            ("cloud_wind.floor_from_deg", Some(90.0)),
            ("cloud_wind.ceiling_speed_m_s", Some(20.0)),
            ("cloud_wind.ceiling_from_deg", Some(90.0)),
            ("cloud_wind.middle", None),
            ("cloud_matter.extinction_per_m", Some(0.01)),
            ("cloud_matter.ball_radius_cells", Some(3.0)),
            ("cloud_matter.smooth_cells", Some(0.0)),
            ("cloud_matter.smooth_steps", Some(0.0)),
            ("cloud_matter.threshold", Some(0.3)),
        ],
    },
    Precondition {
        name: "clouds of a file with balls",
        prepare: balls_of_a_file,
        parameters: &[
            ("clouds.file_holds", None),
            ("clouds.file_ball_place", Some(0.1)),
            ("clouds.file_samples", Some(3.0)),
        ],
    },
    Precondition {
        name: "clouds in a wind given at three heights",
        prepare: |scene| {
            cloudy(scene);
            scene.cloud_wind.middle = true;
        },
        parameters: &[
            ("cloud_wind.middle_share", Some(0.8)),
            ("cloud_wind.middle_speed_m_s", Some(20.0)),
            ("cloud_wind.middle_from_deg", Some(90.0)),
        ],
    },
    Precondition {
        name: "sand at one's feet under a low sun",
        prepare: |scene| {
            dunes(scene);
            (scene.camera.altitude_m, scene.camera.pitch_deg, scene.camera.heading_deg) = (1.0, -30.0, 120.0);
            (scene.sun.elevation_deg, scene.sun.azimuth_deg) = (25.0, 120.0);
        },
        parameters: &[("sand.glints", Some(0.0))],
    },
    Precondition {
        name: "long ripples seen from above",
        prepare: |scene| {
            dunes(scene);
            (scene.camera.pitch_deg, scene.sand.ripple_length_m) = (-40.0, 2.0);
        },
        parameters: &[("sand.relief", None)],
    },
    Precondition {
        name: "a storm over dunes",
        prepare: |scene| {
            dunes(scene);
            scene.sand.wind_m_s = 16.0;
        },
        parameters: &[("sand.wind_m_s", Some(8.0)), ("sand.wind_time_s", Some(3.0))],
    },
    Precondition {
        name: "a small field of dunes",
        prepare: dunes,
        parameters: &[
            ("desert.kind", Some(0.0)),
            ("desert.steps", Some(90.0)),
            ("desert.ripple_steps", Some(30.0)),
            ("dunes.model", None),
            ("dunes.side", Some(1.0)),
            ("dunes.edges", None),
            ("dunes.cell_m", Some(0.6)),
            ("dunes.sand_cells", Some(6.0)),
            ("dunes.noise_cells", Some(4.0)),
            ("dunes.slab_cells", Some(0.3)),
            ("dunes.lift", Some(0.6)),
            ("dunes.hop_cells", Some(9.0)),
            ("dunes.speed_up", Some(2.0)),
            ("dunes.drop_on_sand", Some(0.2)),
            ("dunes.shadow_deg", Some(6.0)),
            ("dunes.repose_deg", Some(20.0)),
            ("dunes.repose_drop_deg", Some(5.0)),
            ("dunes.slide_passes", Some(1.0)),
            ("dunes.seed", Some(7.0)),
            ("dune_wind.direction_deg", Some(60.0)),
            ("dune_wind.winds", Some(3.0)),
            ("dune_plants.enabled", None),
            ("ripples.side", Some(1.0)),
            ("ripples.hop_cells", Some(5.0)),
            ("ripples.hop_per_height", Some(1.0)),
            ("ripples.layer_cells", Some(0.3)),
            ("ripples.creep", Some(0.6)),
            ("ripples.lee_slope", Some(2.0)),
            ("ripples.dither", None),
            ("ripples.planed_above_cells", Some(5.0)),
            ("ripples.depth_cells", Some(0.1)),
            ("ripples.noise_cells", Some(1.0)),
            ("ripples.seed", Some(7.0)),
            ("sand.red", Some(0.1)),
            ("sand.green", Some(0.1)),
            ("sand.blue", Some(0.6)),
            ("sand.roughness_deg", Some(45.0)),
            ("sand.shine", Some(4.0)),
            ("sand.ripples", None),
            ("sand.ripple_length_m", Some(1.0)),
            ("sand.ripple_index", Some(5.0)),
            ("sand.bounce", Some(0.0)),
        ],
    },
    Precondition {
        name: "dunes on bare rock between open edges, under two winds",
        prepare: |scene| {
            dunes(scene);
            scene.dunes.sand_cells = 0.3;
            scene.dunes.edges = Edges::Open;
            (scene.dunes.inflow, scene.dune_wind.winds) = (0.1, 2);
            (scene.dune_rock.enabled, scene.dune_rock.rate) = (true, 1.0);
        },
        parameters: &[
            ("dunes.drop_on_bare", Some(0.9)),
            ("dunes.inflow", Some(0.9)),
            ("dune_wind.divergence_deg", Some(50.0)),
            ("dune_wind.ratio", Some(3.0)),
            ("dune_wind.period_steps", Some(20.0)),
            ("dune_rock.enabled", None),
            ("dune_rock.hardness", Some(0.0)),
            ("dune_rock.rate", Some(0.3)),
        ],
    },
    Precondition {
        name: "dunes on the terrain of a file, under the winds of a file",
        prepare: |scene| {
            dunes(scene);
            scene.dunes.sand_cells = 0.3;
            scene.desert.terrain_high_m = 6.0;
            concat!(env!("CARGO_MANIFEST_DIR"), "/data/small_hills.r16").clone_into(&mut scene.desert.terrain);
            concat!(env!("CARGO_MANIFEST_DIR"), "/data/two_winds.csv").clone_into(&mut scene.desert.wind_table);
        },
        parameters: &[
            ("desert.terrain_low_m", Some(-20.0)),
            ("desert.terrain_high_m", Some(12.0)),
            ("desert.grain_um", Some(500.0)),
            ("desert.wind_sectors", Some(1.0)),
        ],
    },
    Precondition {
        name: "dunes under plants",
        prepare: |scene| {
            dunes(scene);
            (scene.dune_plants.enabled, scene.dune_plants.cover) = (true, 0.2);
        },
        parameters: &[
            ("dune_plants.cover", Some(0.5)),
            ("dune_plants.clump_cells", Some(6.0)),
            ("dune_plants.growth", Some(0.4)),
            ("dune_plants.best_burial_cells", Some(0.4)),
            ("dune_plants.tolerance_cells", Some(0.1)),
            ("dune_plants.repose_deg", Some(15.0)),
        ],
    },
    Precondition {
        name: "dunes by the rule of Onoue and Nishita",
        prepare: |scene| {
            dunes(scene);
            scene.dunes.model = DuneModel::Classic;
        },
        parameters: &[
            ("dune_classic.hop_cells", Some(9.0)),
            ("dune_classic.hop_gain", Some(0.5)),
            ("dune_classic.layer_cells", Some(0.2)),
            ("dune_classic.layer_excess", Some(0.9)),
            ("dune_classic.layer_gain", Some(-0.5)),
            ("dune_classic.creep", Some(0.4)),
        ],
    },
    Precondition {
        name: "an orthographic camera over squares",
        prepare: |scene| {
            manual(scene);
            checker(scene);
            scene.camera.projection = CameraProjection::Orthographic;
            scene.camera.pitch_deg = -40.0;
            scene.camera.width_m = 20.0;
        },
        parameters: &[("camera.width_m", Some(31.0))],
    },
    Precondition {
        name: "the automatic exposure",
        prepare: |scene| {
            single(scene);
            scene.film.exposure = ExposureMode::Auto;
        },
        parameters: &[("film.compensation_ev", None)],
    },
    Precondition {
        name: "any scene",
        prepare: single,
        parameters: &[("image.width_px", None), ("image.height_px", None)],
    },
];

fn single(scene: &mut Scene) {
    scene.sky.orders = Orders::Single;
}

fn manual(scene: &mut Scene) {
    single(scene);
    scene.film.exposure = ExposureMode::Manual;
}

/// Mountains before a camera that stands on one of them.
fn valley(scene: &mut Scene) {
    manual(scene);
    scene.landscape.kind = LandscapeKind::Valley;
    scene.camera.altitude_m = 300.0;
    scene.camera.pitch_deg = 0.0;
    scene.camera.x_m = 2000.0;
}

/// Clouds over a camera that looks up at them.
fn cloudy(scene: &mut Scene) {
    manual(scene);
    scene.clouds.kind = CloudKind::Automaton;
    scene.camera.pitch_deg = 40.0;
    let grid = &mut scene.cloud_grid;
    (grid.cells_east, grid.cells_north, grid.cells_up, grid.warm_up_steps) = (32, 32, 16, 20);
}

/// A small field of dunes before a camera that looks down at it.
fn dunes(scene: &mut Scene) {
    manual(scene);
    scene.desert.kind = DesertKind::Dunes;
    (scene.desert.steps, scene.desert.ripple_steps) = (120, 200);
    (scene.dunes.side, scene.ripples.side) = (Side::Cells64, Side::Cells64);
    (scene.camera.altitude_m, scene.camera.pitch_deg) = (12.0, -12.0);
}

/// A small grid of balls over a camera that looks up at it.
fn balls_of_a_file(scene: &mut Scene) {
    cloudy(scene);
    scene.clouds.kind = CloudKind::File;
    concat!(env!("CARGO_MANIFEST_DIR"), "/data/small_cloud.npy").clone_into(&mut scene.clouds.file);
    scene.clouds.file_holds = CloudFileHolds::Balls;
    scene.cloud_grid.cell_m = 60.0;
}

/// The sun far below the horizon, and a film for starlight.
fn night(scene: &mut Scene) {
    manual(scene);
    scene.sun.elevation_deg = -30.0;
    scene.film.ev100 = -8.0;
}

/// High up and looking down a little, so that the squares are larger than pixels.
fn checker(scene: &mut Scene) {
    scene.set_text("ground.pattern", "checker").expect("a pattern of the ground");
    scene.camera.altitude_m = 30.0;
    scene.camera.pitch_deg = -5.0;
}
