// Light of the moon on sand: of its disc, and from the sky that it lights.
// @import sky/ground_light.wgsl
// @import sky/moon.wgsl

/// Light (lx, linear Rec.709) that sand reflects like a white even slope in it, from the moon and its sky: `facing` times
/// that of the disc on a surface which faces it, and the share `sky` of the sky's; as at sea level.
fn moonlight_on_sand(facing: f32, sky: f32) -> vec3<f32> {
    if (!NIGHT) {
        return vec3<f32>(0.0);
    }
    let mu = moon.direction.z;
    let from_disc = spectrum_scale(ground_sun_irradiance(mu), facing / max(mu, 0.01));
    let from_sky = spectrum_scale(ground_sky_irradiance(mu), sky);
    return atmosphere_rec709(spectrum_mul(moon.light, spectrum_add(from_disc, from_sky)));
}
