//! From light to the picture's numbers.

use tyndall_core::{choices, params};

choices! {
    /// How the exposure is found.
    pub enum ExposureMode {
        /// From the picture itself.
        Auto = "auto",
        /// As `ev100` says.
        Manual = "manual",
    }
}

choices! {
    /// Curve from scene light to display light.
    pub enum ToneMap {
        /// AgX: keeps hues and fades to white gently.
        AgX = "agx",
        /// ACES: more contrast, strong colours.
        Aces = "aces",
        /// None: clipped at white; for measuring.
        None = "none",
    }
}

params! {
    /// Exposure and display of the picture. EXR files keep the light of the scene and are not tone mapped.
    pub struct FilmParams {
        /// Whether the exposure follows the picture or is set by hand.
        exposure: ExposureMode = ExposureMode::Auto, "Lagarde and de Rousiers 2014";
        /// Exposure value at ISO 100: 15 suits a sunlit scene, 9 sunset, 2 deep twilight. Used when exposure is manual.
        ev100: f64 = 15.0, ["EV", -10.0..=25.0, Linear], "ISO 2720:1974";
        /// Correction on top of either exposure; +1 doubles the brightness of the picture.
        compensation_ev: f64 = 0.0, ["EV", -10.0..=10.0, Linear], "ISO 2720:1974";
        /// Curve from scene light to display light.
        tone_map: ToneMap = ToneMap::AgX, "Sobotka 2022; Academy Color Encoding System";
        /// Exponent on the display values after the curve; above 1 darkens shadows.
        contrast: f64 = 1.0, ["1", 0.5..=2.0, Linear], "ASC colour decision list, power";
        /// Strength of colours after the curve; 0 is grey.
        saturation: f64 = 1.0, ["1", 0.0..=2.0, Linear], "ASC colour decision list, saturation";
        /// Noise of half a level that keeps smooth skies from showing bands in 8-bit pictures.
        dither: bool = true, "Roberts 1962";
    }
}
