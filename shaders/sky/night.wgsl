// All light of the sky that is not the sun's: moon, moonlit air, stars, Milky Way and airglow. It adds to the day's and is
// lost in it.
// @import sky/airglow.wgsl
// @import sky/milky_way.wgsl
// @import sky/moon_disc.wgsl
// @import sky/moon_sky.wgsl
// @import sky/stars.wgsl

/// Light of stars and Milky Way (cd/m^2) in a pixel, through the air.
fn night_stars(plane: vec2<f32>, direction: vec3<f32>) -> vec3<f32> {
    let centre = stars_direction(refraction_true(direction));
    let size = frame_pixel_size();
    let right = stars_direction(frame_direction(plane + vec2<f32>(0.5 * size.x, 0.0)) - frame_direction(plane - vec2<f32>(0.5 * size.x, 0.0)));
    let down = stars_direction(frame_direction(plane + vec2<f32>(0.0, 0.5 * size.y)) - frame_direction(plane - vec2<f32>(0.0, 0.5 * size.y)));
    let light = stars_points(centre, right, down) + milky_way_radiance(centre);
    // White light through the air, in the three channels.
    let transmitted = atmosphere_rec709(spectrum_mul(stars.white, atmosphere_transmittance(sun_columns(direction.z))));
    return light * max(transmitted, vec3<f32>(0.0));
}

/// Radiance (cd/m^2) of the night in a pixel that shows the sky.
fn night_radiance(plane: vec2<f32>, direction: vec3<f32>) -> vec3<f32> {
    if (!NIGHT) {
        return vec3<f32>(0.0);
    }
    var light = moon_sky_radiance(direction) + airglow_radiance(direction);
    let disc = moon_disc_radiance(plane);
    light += disc.xyz;
    if (stars.grid > 0u && disc.w < 1.0) {
        light += night_stars(plane, direction) * (1.0 - disc.w);
    }
    return light;
}
