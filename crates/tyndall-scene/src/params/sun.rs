//! The sun: where it stands and what its disc looks like.

use tyndall_core::{choices, params};

choices! {
    /// What says where the sun stands.
    pub enum SunPosition {
        /// `elevation_deg` and `azimuth_deg`.
        Angles = "angles",
        /// Date, time and place on Earth.
        Date = "date",
    }
}

params! {
    /// The sun. Angles are geometric: where the sun would stand without air.
    pub struct SunParams {
        /// Whether the angles say where the sun stands, or the date, the time and the place.
        position: SunPosition = SunPosition::Angles, "scene convention";
        /// Height of the sun above the horizon; negative after sunset. Used when position is angles.
        elevation_deg: f64 = 35.0, ["deg", -90.0..=90.0, Linear], "horizontal coordinates";
        /// Direction of the sun: 0 is north, 90 east. Used when position is angles.
        azimuth_deg: f64 = 0.0, ["deg", -360.0..=360.0, Linear], "horizontal coordinates, clockwise from north";
        /// Year of the local date. Used, as all below down to the longitude, when position is date.
        year: u32 = 2026, ["1", 1600..=2999, Linear], "Reda and Andreas 2004";
        /// Month of the local date.
        month: u32 = 6, ["1", 1..=12, Linear], "Reda and Andreas 2004";
        /// Day of the local date.
        day: u32 = 21, ["1", 1..=31, Linear], "Reda and Andreas 2004";
        /// Local clock time; 18.5 is half past six in the evening.
        time_h: f64 = 12.0, ["h", 0.0..=24.0, Linear], "Reda and Andreas 2004";
        /// How far the local clock is ahead of UTC; 1 is Berlin in winter, -7 Denver.
        utc_offset_h: f64 = 0.0, ["h", -12.0..=14.0, Linear], "UTC";
        /// Latitude of the place; negative in the south.
        latitude_deg: f64 = 51.4779, ["deg", -90.0..=90.0, Linear], "WGS 84";
        /// Longitude of the place; negative in the west.
        longitude_deg: f64 = 0.0, ["deg", -180.0..=180.0, Linear], "WGS 84";
        /// Angle from the centre of the disc to its edge; the mean over a year is 0.2667.
        angular_radius_deg: f64 = 0.2667, ["deg", 0.05..=5.0, Log], "Astronomical Almanac";
        /// Factor on the sun's irradiance; 1 is our sun, 0 puts it out.
        brightness: f64 = 1.0, ["1", 0.0..=10.0, Linear], "ASTM G173-03";
        /// Whether the disc is drawn. The sky does not depend on it.
        disc: bool = true, "scene convention";
        /// Whether the disc darkens towards its edge, blue more than red.
        limb_darkening: bool = true, "Hestroffer and Magnan 1998";
        /// Whether the air lifts and flattens the discs of sun and moon and lifts the stars: by half a degree at the horizon. The
        /// light of the sky is computed along straight rays all the same.
        refraction: bool = true, "ray trace; Bennett 1982";
        /// Pressure of the air at sea level, for refraction.
        pressure_hpa: f64 = 1010.0, ["hPa", 0.0..=2000.0, Linear], "Bennett 1982";
        /// Temperature of the air at sea level, for refraction; cold air lifts the sun more.
        temperature_c: f64 = 10.0, ["C", -90.0..=60.0, Linear], "Bennett 1982";
    }
}
