//! What users choose of an atmosphere.

use tyndall_core::{choices, params};

choices! {
    /// Where the scattering coefficients of air come from.
    pub enum AirModel {
        /// Fit of Bodhaine et al. 1999, with the depolarisation of air (King factor).
        Bodhaine1999 = "bodhaine1999",
        /// Equation (1) of the paper with one refractive index and no King factor: 4.8 % too little at 550 nm.
        Paper = "paper",
    }
}

choices! {
    /// Phase function of the aerosol.
    pub enum AerosolPhase {
        /// Cornette and Shanks 1992, the aerosol phase function of Nishita et al. 1993.
        CornetteShanks = "cornette-shanks",
        /// Henyey and Greenstein 1941.
        HenyeyGreenstein = "henyey-greenstein",
    }
}

choices! {
    /// Which number says how much aerosol there is.
    pub enum AerosolInput {
        /// The vertical optical depth at 550 nm.
        OpticalDepth = "optical-depth",
        /// The distance at which 2 per cent of contrast is left at the ground, by air and aerosol together.
        Visibility = "visibility",
        /// The turbidity of Preetham et al. 1999.
        Turbidity = "turbidity",
    }
}

params! {
    /// The atmosphere: air, aerosol and ozone over a spherical planet.
    pub struct AtmosphereParams {
        /// Radius of the planet at sea level.
        planet_radius_km: f64 = 6360.0, ["km", 100.0..=100000.0, Log], "Nishita et al. 1993";
        /// Altitude above which there is nothing.
        top_altitude_km: f64 = 100.0, ["km", 10.0..=1000.0, Log], "Bruneton 2017";
        /// Density of air relative to the standard atmosphere's.
        air_density: f64 = 1.0, ["1", 0.0..=10.0, Linear], "paper eq. (1), rho";
        /// Height over which the density of air falls by a factor e.
        air_scale_height_km: f64 = 8.0, ["km", 0.5..=50.0, Log], "paper eq. (2), H_0";
        /// Where the scattering coefficients of air come from.
        air_model: AirModel = AirModel::Bodhaine1999, "Bodhaine et al. 1999, eq. 30; paper eq. (1)";
        /// Which of the next three says how much aerosol there is.
        aerosol_input: AerosolInput = AerosolInput::OpticalDepth, "design";
        /// Vertical optical depth of the aerosol at 550 nm, all extinction together. Used when aerosol input is optical-depth.
        aerosol_optical_depth: f64 = 0.1, ["1", 0.0..=5.0, Linear], "Angstrom 1929";
        /// Distance at which things vanish at the ground (2 per cent of contrast), by air and aerosol together. Used when aerosol input is visibility.
        aerosol_visibility_km: f64 = 40.0, ["km", 1.0..=300.0, Log], "Koschmieder 1924";
        /// Optical thickness of air and haze over that of air: 2 is very clear, 3 clear, 6 warm and moist, 10 hazy. Used when aerosol input is turbidity.
        aerosol_turbidity: f64 = 2.5, ["1", 1.0..=20.0, Linear], "Preetham et al. 1999";
        /// How fast the aerosol's optical depth falls with wavelength; 0 is grey, 1.3 fine dust, 4 molecules.
        aerosol_angstrom: f64 = 1.3, ["1", -0.5..=4.0, Linear], "Angstrom 1929";
        /// Share of the aerosol's extinction that is scattering; the rest is absorbed.
        aerosol_albedo: f64 = 0.92, ["1", 0.0..=1.0, Linear], "Dubovik et al. 2002, table 1";
        /// By how much less of violet and blue light it scatters; dust that contains iron absorbs blue.
        aerosol_blue_loss: f64 = 0.0, ["1", 0.0..=1.0, Linear], "Dubovik et al. 2002, table 1";
        /// Mean cosine of the angle by which the aerosol scatters; 0 is even, 1 straight ahead.
        aerosol_asymmetry: f64 = 0.76, ["1", -0.95..=0.95, Linear], "Cornette and Shanks 1992";
        /// Height over which the aerosol's density falls by a factor e.
        aerosol_scale_height_km: f64 = 1.2, ["km", 0.1..=50.0, Log], "Nishita et al. 1993";
        /// Phase function of the aerosol.
        aerosol_phase: AerosolPhase = AerosolPhase::CornetteShanks, "Nishita et al. 1993";
        /// Amount of ozone.
        ozone_du: f64 = 300.0, ["DU", 0.0..=1000.0, Linear], "Serdyuchenko et al. 2014";
        /// Altitude at which ozone is densest.
        ozone_altitude_km: f64 = 25.0, ["km", 0.0..=100.0, Linear], "Bruneton 2017";
        /// Distance above and below that altitude at which the ozone ends.
        ozone_half_width_km: f64 = 15.0, ["km", 0.5..=50.0, Linear], "Bruneton 2017";
    }
}

choices! {
    /// Where the ground's reflectance comes from.
    pub enum GroundMaterial {
        /// From the three shares of red, green and blue.
        Colour = "colour",
        /// Grass: dark, a little green, bright in the far red.
        Grass = "grass",
        /// Fresh snow: nearly white.
        Snow = "snow",
        /// The sea under a whole sky: dark and grey.
        Water = "water",
    }
}

choices! {
    /// What lies on the ground.
    pub enum GroundPattern {
        /// One colour everywhere.
        Plain = "plain",
        /// Squares of two shades, to judge distance and movement.
        Checker = "checker",
    }
}

params! {
    /// The ground of the planet, a Lambertian reflector.
    pub struct GroundParams {
        /// Whether the ground reflects the shares below, or the measured spectrum of a material.
        material: GroundMaterial = GroundMaterial::Colour, "design";
        /// Share of red light that the ground reflects.
        red: f64 = 0.16, ["1", 0.0..=1.0, Linear], "Lambert 1760";
        /// Share of green light that the ground reflects.
        green: f64 = 0.15, ["1", 0.0..=1.0, Linear], "Lambert 1760";
        /// Share of blue light that the ground reflects.
        blue: f64 = 0.12, ["1", 0.0..=1.0, Linear], "Lambert 1760";
        /// What lies on the ground; the mean reflection stays the same.
        pattern: GroundPattern = GroundPattern::Plain, "design";
        /// Side of a square of the checker.
        tile_m: f64 = 50.0, ["m", 0.1..=100000.0, Log], "design";
    }
}
