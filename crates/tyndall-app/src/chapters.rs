//! In which chapter of the gallery a scene stands. It follows from the scene itself, so that a new preset needs no entry
//! anywhere.

use tyndall_scene::Scene;

/// A chapter of the gallery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Chapter {
    Day,
    Twilight,
    Night,
    Fog,
    High,
    Planets,
}

/// Elevation (deg) below which the sun is setting, and below which it is night.
const LOW_SUN_DEG: f64 = 4.0;
const NIGHT_DEG: f64 = -12.0;

/// Altitude (km) from which a view is one from high up.
const HIGH_KM: f64 = 8.0;

/// Radii (km) of planets that pass for the Earth.
const EARTH_RADIUS_KM: std::ops::RangeInclusive<f64> = 6300.0..=6450.0;

/// Aerosol optical depth from which, and visibility (km) in haze up to which air is thick.
const HAZY_DEPTH: f64 = 0.45;
const HAZY_KM: f64 = 20.0;

impl Chapter {
    /// All, in the order in which they are shown.
    pub(crate) const ALL: [Self; 6] = [Self::Day, Self::Twilight, Self::Night, Self::Fog, Self::High, Self::Planets];

    /// Heading.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Day => "Day",
            Self::Twilight => "Sunset and twilight",
            Self::Night => "Night",
            Self::Fog => "Fog and haze",
            Self::High => "From high up",
            Self::Planets => "Other planets",
        }
    }

    /// The chapter of a scene.
    pub(crate) fn of(scene: &Scene) -> Self {
        let elevation_deg = scene.sun_direction().map_or(90.0, |sun| sun.elevation_rad.to_degrees());
        if !EARTH_RADIUS_KM.contains(&scene.atmosphere.planet_radius_km) {
            Self::Planets
        } else if scene.camera.altitude_m > HIGH_KM * 1e3 {
            Self::High
        } else if is_foggy(scene) {
            Self::Fog
        } else if elevation_deg < NIGHT_DEG {
            Self::Night
        } else if elevation_deg < LOW_SUN_DEG {
            Self::Twilight
        } else {
            Self::Day
        }
    }
}

fn is_foggy(scene: &Scene) -> bool {
    let is_thick = scene.haze.enabled && scene.haze.visibility_km <= HAZY_KM;
    is_thick || scene.atmosphere.aerosol_optical_depth >= HAZY_DEPTH
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_stand_where_a_reader_looks_for_them() {
        let mut scene = Scene::default();
        assert_eq!(Chapter::of(&scene), Chapter::Day, "a new scene");
        scene.haze.enabled = true;
        assert_eq!(Chapter::of(&scene), Chapter::Fog, "haze");
        scene.haze.enabled = false;
        scene.sun.elevation_deg = 1.0;
        assert_eq!(Chapter::of(&scene), Chapter::Twilight, "a low sun");
        scene.sun.elevation_deg = -30.0;
        assert_eq!(Chapter::of(&scene), Chapter::Night, "no sun");
        scene.camera.altitude_m = 12e3;
        assert_eq!(Chapter::of(&scene), Chapter::High, "an airliner");
        scene.atmosphere.planet_radius_km = 3390.0;
        assert_eq!(Chapter::of(&scene), Chapter::Planets, "Mars");
    }

    #[test]
    fn every_chapter_has_a_title_of_its_own() {
        let titles: std::collections::HashSet<_> = Chapter::ALL.into_iter().map(Chapter::title).collect();
        assert_eq!(titles.len(), Chapter::ALL.len(), "{titles:?}");
    }
}
