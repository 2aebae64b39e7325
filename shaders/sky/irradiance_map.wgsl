// Place of a sun in the irradiance table, quadratically dense at the horizon; 0 and 1 are the first and last node.
// Twins: tyndall_scattering::irradiance_table.

const IRRADIANCE_TABLE_SIZE: u32 = 64u;
const IRRADIANCE_LOWEST_MU_SUN: f32 = -0.3;
const IRRADIANCE_TWILIGHT_SHARE: f32 = 0.25;

/// Place of the sun's zenith cosine.
fn irradiance_map(mu_sun: f32) -> f32 {
    let night = IRRADIANCE_TWILIGHT_SHARE * (1.0 - sqrt(clamp(mu_sun / IRRADIANCE_LOWEST_MU_SUN, 0.0, 1.0)));
    let day = IRRADIANCE_TWILIGHT_SHARE + (1.0 - IRRADIANCE_TWILIGHT_SHARE) * sqrt(clamp(mu_sun, 0.0, 1.0));
    return select(day, night, mu_sun < 0.0);
}

/// Zenith cosine of the sun at a place.
fn irradiance_map_inverse(unit: f32) -> f32 {
    let night = 1.0 - unit / IRRADIANCE_TWILIGHT_SHARE;
    let day = (unit - IRRADIANCE_TWILIGHT_SHARE) / (1.0 - IRRADIANCE_TWILIGHT_SHARE);
    return select(day * day, IRRADIANCE_LOWEST_MU_SUN * night * night, unit < IRRADIANCE_TWILIGHT_SHARE);
}
