//! How much sand a wind carries over level sand, and how much of the light behind it that sand hides.

/// Of air at the ground (kg/m^3).
const AIR_KG_PER_M3: f64 = 1.2;
/// Of quartz (kg/m^3).
const QUARTZ_KG_PER_M3: f64 = 2650.0;
/// Of gravity (m/s^2).
const GRAVITY_M_PER_S2: f64 = 9.81;
/// Constant of Kawamura's law.
const KAWAMURA: f64 = 2.78;
/// Roughness length of sand that is moving (m).
const ROUGHNESS_M: f64 = 1e-3;
/// Height at which winds are measured (m).
const MEASURED_AT_M: f64 = 10.0;
/// Of von Karman.
const KARMAN: f64 = 0.4;

/// Friction velocity (m/s) below which grains of a quarter of a millimetre lie still (Bagnold 1941).
pub const THRESHOLD_M_PER_S: f64 = 0.25;

/// Friction velocity (m/s) of a wind (m/s, 10 m over level sand), by the logarithmic law of the wall.
#[must_use]
pub fn friction_m_per_s(wind_m_per_s: f64) -> f64 {
    KARMAN * wind_m_per_s / (MEASURED_AT_M / ROUGHNESS_M).ln()
}

/// Sand (kg/(m s)) that crosses a line of unit length under a friction velocity (m/s), once it is saturated: Kawamura 1951.
#[must_use]
pub fn saturated_flux_kg_per_m_s(friction_m_per_s: f64) -> f64 {
    let over = (friction_m_per_s - THRESHOLD_M_PER_S).max(0.0);
    KAWAMURA * AIR_KG_PER_M3 / GRAVITY_M_PER_S2 * over * (friction_m_per_s + THRESHOLD_M_PER_S).powi(2)
}

/// Area (m^2/kg) that grains of a diameter (m) hide. What they bend by less than half a degree counts as let through, so that
/// it is their outline, not twice as much.
#[must_use]
pub fn extinction_m2_per_kg(diameter_m: f64) -> f64 {
    1.5 / (QUARTZ_KG_PER_M3 * diameter_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sand_lies_still_below_the_threshold_and_moves_with_the_cube_of_strong_winds() {
        assert!(saturated_flux_kg_per_m_s(0.0).abs() < 1e-300, "no wind");
        assert!(saturated_flux_kg_per_m_s(THRESHOLD_M_PER_S).abs() < 1e-300, "at the threshold");
        assert!(saturated_flux_kg_per_m_s(0.26) > 0.0, "above it");
        let power = (saturated_flux_kg_per_m_s(40.0) / saturated_flux_kg_per_m_s(20.0)).log2();
        assert!((power - 3.0).abs() < 0.02, "the power is {power}");
    }

    #[test]
    fn a_fresh_wind_moves_the_sand_that_it_does_on_beaches() {
        // 12 m/s at 10 m: 0.52 m/s, some 0.05 kg/(m s).
        let friction = friction_m_per_s(12.0);
        assert!((friction - 0.521).abs() < 0.001, "{friction} m/s");
        let flux = saturated_flux_kg_per_m_s(friction);
        assert!((0.03..0.08).contains(&flux), "{flux} kg/(m s)");
    }

    #[test]
    fn grains_hide_their_outline() {
        let (diameter, mass) = (2e-4_f64, 2650.0 * std::f64::consts::PI / 6.0 * 2e-4_f64.powi(3));
        let outline = 0.25 * std::f64::consts::PI * diameter * diameter;
        let found = extinction_m2_per_kg(diameter) * mass;
        assert!((found / outline - 1.0).abs() < 1e-12, "{found} m2 of {outline} m2");
    }
}
