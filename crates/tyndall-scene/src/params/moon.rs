//! The moon: where it stands and how it shines.

use tyndall_core::{choices, params};

choices! {
    /// What says where the moon stands.
    pub enum MoonPosition {
        /// There is no moon.
        None = "none",
        /// `elevation_deg` and `azimuth_deg`.
        Angles = "angles",
        /// Date, time and place of the sun's group.
        Date = "date",
    }
}

choices! {
    /// What says how much of the moon is lit.
    pub enum MoonPhase {
        /// The angle between sun and moon in the sky.
        Sun = "sun",
        /// `phase_deg`.
        Angle = "angle",
    }
}

params! {
    /// The moon, a second light beside the sun. Angles are geometric, as the sun's.
    pub struct MoonParams {
        /// Whether there is a moon, and what says where it stands: the angles, or date, time and place of the sun's group.
        position: MoonPosition = MoonPosition::None, "Meeus 1998, chapter 47";
        /// Height of the moon above the horizon. Used when position is angles.
        elevation_deg: f64 = 30.0, ["deg", -90.0..=90.0, Linear], "horizontal coordinates";
        /// Direction of the moon: 0 is north, 90 east. Used when position is angles.
        azimuth_deg: f64 = 180.0, ["deg", -360.0..=360.0, Linear], "horizontal coordinates, clockwise from north";
        /// Whether the phase follows from where sun and moon stand, or is set.
        phase: MoonPhase = MoonPhase::Sun, "Meeus 1998, chapter 48";
        /// Phase angle: 0 is full moon, 90 half moon, 180 new moon. Used when phase is angle.
        phase_deg: f64 = 0.0, ["deg", 0.0..=180.0, Linear], "Meeus 1998, chapter 48";
        /// Angle from the centre of the disc to its edge. The moon's light does not depend on it.
        angular_radius_deg: f64 = 0.259, ["deg", 0.05..=5.0, Log], "Astronomical Almanac, mean";
        /// Factor on the light of moon and sky; 1 is our moon, 0.25 lux when full and high.
        brightness: f64 = 1.0, ["1", 0.0..=100.0, Linear], "Krisciunas and Schaefer 1991";
        /// Whether the disc is drawn. The sky does not depend on it.
        disc: bool = true, "scene convention";
        /// Whether the disc has its dark plains and bright craters.
        maria: bool = true, "positions of the plains: IAU gazetteer";
    }
}
