//! Which parameters have no effect at present, and why: the app shows those disabled.

use tyndall_scene::{
    AerosolInput, CameraProjection, CloudFileHolds, CloudKind, CloudMethod, DesertKind, DuneModel, Edges, ExposureMode,
    LandscapeKind, MoonPhase, MoonPosition, Orders, RippleLook, Scene, SkyMode, SunPosition,
};

/// Why a parameter changes nothing in this scene; `None` when it does.
pub(crate) fn no_effect(scene: &Scene, group: &str, name: &str) -> Option<&'static str> {
    match (group, name) {
        ("sun", name) => sun(scene, name),
        ("moon", name) => moon(scene, name),
        ("stars", name) => stars(scene, name),
        ("atmosphere", name) => atmosphere(scene, name),
        ("haze", name) if name != "enabled" && !scene.haze.enabled => Some("There is no haze; switch Enabled on."),
        ("film", "ev100") if scene.film.exposure == ExposureMode::Auto => {
            Some("The exposure follows the picture; set Exposure to manual.")
        }
        ("camera", "field_of_view_deg") if scene.camera.projection == CameraProjection::Orthographic => {
            Some("An orthographic picture has a width; set Projection to perspective.")
        }
        ("camera", "width_m") if scene.camera.projection == CameraProjection::Perspective => {
            Some("A perspective has a field of view; set Projection to orthographic.")
        }
        ("ground", "tile_m") if scene.ground.pattern.name() == "plain" => {
            Some("The ground is plain; set Pattern to checker.")
        }
        ("landscape", name) => landscape(scene.landscape.kind, name),
        ("desert" | "clouds", "kind") => None,
        ("desert" | "dunes" | "dune_classic" | "dune_wind" | "dune_plants" | "dune_rock" | "ripples" | "sand", _)
            if scene.desert.kind == DesertKind::None =>
        {
            Some("There is no desert; set Kind of the desert to dunes.")
        }
        ("sand", "relief") if scene.sand.ripples != RippleLook::Best => {
            Some("Ripples are absent or normals alone; set Ripples to best.")
        }
        ("sand", "wind_time_s") if scene.sand.wind_m_s <= 0.0 => Some("No wind blows sand; raise Wind."),
        ("desert", name) => desert(scene, group, name),
        ("dune_wind", name) => desert(scene, group, name).or_else(|| dunes(scene, group, name)),
        ("dunes" | "dune_classic" | "dune_plants" | "dune_rock", name) => dunes(scene, group, name),
        ("clouds" | "cloud_grid" | "cloud_vapour" | "cloud_wind" | "cloud_matter", _)
            if scene.clouds.kind == CloudKind::None =>
        {
            Some("There are no clouds; set Kind of clouds to one.")
        }
        ("clouds" | "cloud_grid" | "cloud_vapour" | "cloud_wind" | "cloud_matter", name) => clouds(scene, group, name),
        ("ground", "red" | "green" | "blue") if scene.ground.material.name() != "colour" => {
            Some("The ground has the spectrum of a material; set Material to colour.")
        }
        ("sky", "aerial_columns" | "aerial_rows" | "aerial_distance_km")
            if scene.landscape.kind == LandscapeKind::None && scene.desert.kind == DesertKind::None =>
        {
            Some("Nothing stands in the air; set Kind of the landscape or the desert.")
        }
        ("sky", "orders_detail") if scene.sky.orders == Orders::Single => {
            Some("Light counts that was scattered once; set Orders to all.")
        }
        ("sky", "orders_detail") if scene.sky.orders == Orders::Nishita1996 => {
            Some("The second order by eight directions has one detail; set Orders to all.")
        }
        ("sky", "dome_rings" | "dome_segments") if scene.sky.mode != SkyMode::VertexDome => {
            Some("The sky is computed at every pixel; set Mode to vertex-dome.")
        }
        _ => None,
    }
}

fn landscape(kind: LandscapeKind, name: &str) -> Option<&'static str> {
    match (kind, name) {
        (_, "kind") => None,
        (LandscapeKind::None, _) => Some("There is no landscape; set Kind to one."),
        _ => None,
    }
}

/// Of what a desert takes from files.
fn desert(scene: &Scene, group: &str, name: &str) -> Option<&'static str> {
    if scene.desert.kind == DesertKind::None {
        return None;
    }
    let has_table = !scene.desert.wind_table.is_empty();
    match (group, name) {
        ("desert", "terrain_low_m" | "terrain_high_m") if scene.desert.terrain.is_empty() => {
            Some("The ground is level; name a height map in Terrain.")
        }
        ("desert", "grain_um" | "wind_sectors") if !has_table => {
            Some("The winds are those of dune wind; name a table in Wind table.")
        }
        ("desert", "winds") if has_table => Some("The winds come from a table; leave Wind table empty."),
        ("dune_wind", name) if name != "period_steps" && !scene.desert.winds.is_empty() && !has_table => {
            Some("The winds are by hand; leave Winds of the desert empty.")
        }
        ("dune_wind", name) if name != "period_steps" && has_table => {
            Some("The winds come from a table; leave Wind table empty.")
        }
        _ => None,
    }
}

/// Of a desert that there is.
fn dunes(scene: &Scene, group: &str, name: &str) -> Option<&'static str> {
    let is_classic = scene.dunes.model == DuneModel::Classic;
    match (group, name) {
        ("dunes", "slab_cells" | "lift" | "hop_cells" | "speed_up" | "drop_on_sand" | "drop_on_bare") if is_classic => {
            Some("The sand moves in layers; set Model to slab.")
        }
        ("dunes", "inflow") if is_classic || scene.dunes.edges == Edges::Periodic => {
            Some("No slab comes in over an edge; set Model to slab and Edges to open.")
        }
        ("dune_classic", _) if !is_classic => Some("The sand moves in slabs; set Model of dunes to classic."),
        ("dune_wind", "divergence_deg" | "ratio" | "period_steps")
            if scene.dune_wind.winds == 1 && scene.desert.wind_table.is_empty() =>
        {
            Some("There is one wind all the time; raise Winds.")
        }
        ("dune_plants", name) if name != "enabled" && !scene.dune_plants.enabled => {
            Some("There are no plants; switch Enabled on.")
        }
        ("dune_rock", name) if name != "enabled" && !scene.dune_rock.enabled => {
            Some("The rock does not wear; switch Enabled on.")
        }
        _ => None,
    }
}

/// Of clouds that there are.
fn clouds(scene: &Scene, group: &str, name: &str) -> Option<&'static str> {
    let clouds = &scene.clouds;
    let from_file = clouds.kind == CloudKind::File;
    let holds_balls = clouds.file_holds == CloudFileHolds::Balls;
    match (group, name) {
        ("clouds", "file" | "array" | "file_holds" | "file_ball_place" | "file_samples") if !from_file => {
            Some("The clouds come from the automaton; set Kind to file.")
        }
        ("clouds", "file_ball_place" | "file_samples") if !holds_balls => {
            Some("The file holds the cloud itself; set File holds to balls.")
        }
        ("clouds", "detail") if clouds.method == CloudMethod::Splats => {
            Some("Metaballs are smooth; set Method to volume.")
        }
        ("clouds", "time_s") | ("cloud_vapour" | "cloud_wind", _) if from_file => Some(STILL),
        ("cloud_grid", "cells_east" | "cells_north" | "cells_up" | "seed" | "warm_up_steps" | "step_s")
        | ("cloud_matter", "smooth_cells" | "smooth_steps" | "threshold")
            if from_file =>
        {
            Some(STILL)
        }
        ("cloud_wind", "middle_share" | "middle_speed_m_s" | "middle_from_deg") if !scene.cloud_wind.middle => {
            Some("The wind goes straight from floor to ceiling; switch Middle on.")
        }
        _ => None,
    }
}

/// Why the automaton's parameters are idle.
const STILL: &str = "The clouds come from a file; set Kind to automaton.";

fn sun(scene: &Scene, name: &str) -> Option<&'static str> {
    let by_date = scene.sun.position == SunPosition::Date;
    let date_counts = by_date || scene.moon.position == MoonPosition::Date;
    match name {
        "elevation_deg" | "azimuth_deg" if by_date => {
            Some("Date, time and place say where the sun stands; set Position to angles.")
        }
        "year" | "month" | "day" | "time_h" | "utc_offset_h" | "latitude_deg" | "longitude_deg" if !date_counts => {
            Some("The angles say where the sun stands; set Position to date.")
        }
        "pressure_hpa" | "temperature_c" if !scene.sun.refraction => Some("Light goes straight; switch Refraction on."),
        "limb_darkening" if !scene.sun.disc => Some("The disc is not drawn; switch Disc on."),
        _ => None,
    }
}

fn moon(scene: &Scene, name: &str) -> Option<&'static str> {
    let moon = &scene.moon;
    match name {
        "position" => None,
        _ if moon.position == MoonPosition::None => Some("There is no moon; set Position to angles or date."),
        "elevation_deg" | "azimuth_deg" if moon.position == MoonPosition::Date => {
            Some("Date, time and place say where the moon stands; set Position to angles.")
        }
        "phase_deg" if moon.phase == MoonPhase::Sun => {
            Some("Where sun and moon stand says what is lit; set Phase to angle.")
        }
        "angular_radius_deg" | "maria" if !moon.disc => Some("The disc is not drawn; switch Disc on."),
        _ => None,
    }
}

fn stars(scene: &Scene, name: &str) -> Option<&'static str> {
    match name {
        "sidereal_h" | "latitude_deg" if scene.sun.position == SunPosition::Date => {
            Some("Date, time and place of the sun turn the sky; set its Position to angles.")
        }
        "brightness" | "sidereal_h" | "latitude_deg" | "milky_way_cd_m2" if !scene.stars.visible => {
            Some("There are no stars; switch Visible on.")
        }
        _ => None,
    }
}

fn atmosphere(scene: &Scene, name: &str) -> Option<&'static str> {
    let air = &scene.atmosphere;
    let none = |amount: f64| amount <= 0.0;
    match name {
        "aerosol_optical_depth" if air.aerosol_input != AerosolInput::OpticalDepth => {
            Some("Another number says how much aerosol there is; set Aerosol input to optical-depth.")
        }
        "aerosol_visibility_km" if air.aerosol_input != AerosolInput::Visibility => {
            Some("Another number says how much aerosol there is; set Aerosol input to visibility.")
        }
        "aerosol_turbidity" if air.aerosol_input != AerosolInput::Turbidity => {
            Some("Another number says how much aerosol there is; set Aerosol input to turbidity.")
        }
        "air_scale_height_km" | "air_model" if none(air.air_density) => Some("There is no air; raise Air density."),
        "aerosol_angstrom"
        | "aerosol_albedo"
        | "aerosol_blue_loss"
        | "aerosol_asymmetry"
        | "aerosol_scale_height_km"
        | "aerosol_phase"
            if air.aerosol_input == AerosolInput::OpticalDepth && none(air.aerosol_optical_depth) =>
        {
            Some("There is no aerosol; raise Aerosol optical depth.")
        }
        "ozone_altitude_km" | "ozone_half_width_km" if none(air.ozone_du) => Some("There is no ozone; raise Ozone."),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn either_the_angles_or_the_date_place_the_sun() {
        let mut scene = Scene::default();
        assert!(no_effect(&scene, "sun", "elevation_deg").is_none(), "by angles");
        assert!(no_effect(&scene, "sun", "latitude_deg").is_some(), "by angles");
        scene.sun.position = SunPosition::Date;
        assert!(no_effect(&scene, "sun", "elevation_deg").is_some(), "by date");
        assert!(no_effect(&scene, "sun", "latitude_deg").is_none(), "by date");
    }

    #[test]
    fn what_switches_others_is_never_switched_off_itself() {
        let mut scene = Scene::default();
        scene.atmosphere.air_density = 0.0;
        scene.atmosphere.aerosol_optical_depth = 0.0;
        scene.atmosphere.ozone_du = 0.0;
        scene.sun.disc = false;
        for (group, name) in [
            ("sun", "position"),
            ("sun", "disc"),
            ("sun", "refraction"),
            ("moon", "position"),
            ("stars", "visible"),
            ("atmosphere", "air_density"),
            ("atmosphere", "aerosol_optical_depth"),
            ("atmosphere", "ozone_du"),
            ("film", "exposure"),
            ("film", "compensation_ev"),
            ("ground", "pattern"),
            ("landscape", "kind"),
            ("clouds", "kind"),
            ("desert", "kind"),
            ("sky", "mode"),
            ("haze", "enabled"),
        ] {
            assert_eq!(no_effect(&scene, group, name), None, "{group}.{name}");
        }
    }

    #[test]
    fn every_named_parameter_exists() {
        let scene = Scene::default();
        let named = [
            "film.ev100",
            "ground.tile_m",
            "landscape.size_km",
            "dunes.hop_cells",
            "dune_wind.ratio",
            "ripples.creep",
            "sky.aerial_rows",
            "moon.elevation_deg",
            "moon.phase_deg",
            "moon.maria",
            "haze.visibility_km",
            "atmosphere.aerosol_visibility_km",
            "atmosphere.aerosol_turbidity",
            "haze.forward_weight",
            "sky.dome_rings",
            "sky.dome_segments",
            "sun.year",
            "sun.month",
            "sun.day",
            "sun.time_h",
            "sun.utc_offset_h",
            "sun.latitude_deg",
            "sun.longitude_deg",
        ];
        for path in named {
            let (group, name) = path.split_once('.').unwrap();
            assert!(scene.get(path).is_ok(), "{path} is not a parameter");
            assert!(no_effect(&scene, group, name).is_some(), "{path} has an effect in a new scene");
        }
    }
}
