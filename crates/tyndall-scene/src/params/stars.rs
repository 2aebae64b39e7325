//! The stars and the light of the night sky.

use tyndall_core::params;

params! {
    /// The stars, turned by the sun's date and place when it has them, and the glow of the moonless night. Their light adds to that
    /// of the sky, so that they fade in twilight and are lost by day.
    pub struct StarsParams {
        /// Whether the stars of the Bright Star Catalogue are drawn, all that an eye sees.
        visible: bool = true, "Hoffleit and Warren 1991";
        /// Factor on the light of the stars; 1 is nature, a picture on a screen bears 3 to 10.
        brightness: f64 = 1.0, ["1", 0.0..=100.0, Linear], "2.54e-6 lux at magnitude 0, Allen 1973";
        /// Sidereal time, the right ascension that stands due south. Used when the sun's position is angles.
        sidereal_h: f64 = 20.0, ["h", 0.0..=24.0, Linear], "Meeus 1998, chapter 12";
        /// Latitude, the height of the celestial pole above the northern horizon. Used when the sun's position is angles.
        latitude_deg: f64 = 45.0, ["deg", -90.0..=90.0, Linear], "WGS 84";
        /// Luminance of the Milky Way in its brightest part, all stars too faint for the catalogue together.
        milky_way_cd_m2: f64 = 0.0003, ["cd/m2", 0.0..=0.01, Linear], "Leinert et al. 1998, table 36";
        /// Luminance of the airglow in the zenith, the faint light of the upper air that ends the twilight.
        airglow_cd_m2: f64 = 0.00017, ["cd/m2", 0.0..=0.01, Linear], "Leinert et al. 1998; Falchi et al. 2016";
    }
}
