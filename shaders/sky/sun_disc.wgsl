// The sun's disc, by area: a pixel gets the mean over a grid of samples, each with its solid angle, so that the disc's
// energy is right at any size and in any projection.
// Distances on the disc are chords, because acos is off by 3 % of the sun's radius on some adapters.
// Formulas: tyndall_scattering::sun_disc.
// @import frame/frame.wgsl
// @import sky/refraction.wgsl
// @import sky/sun_columns.wgsl
// @import sky/view.wgsl

const SUN_SAMPLES_MAX: u32 = 64u;
const SUN_SAMPLES_ACROSS_DISC: f32 = 136.0;

/// Relative radiance of the disc at a squared chord over the squared radius, 0 outside.
fn sun_limb(share_squared: f32) -> Spectrum {
    if (share_squared >= 1.0) {
        return Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    }
    // mu^a with mu^2 = 1 - share^2.
    let half_log = 0.5 * log2(max(1.0 - share_squared, 1e-12));
    return Spectrum(exp2(half_log * sky_view.limb_exponents.lo), exp2(half_log * sky_view.limb_exponents.hi));
}

/// Radiance [cd/m^2] of the disc in a pixel whose centre has the image-plane coordinates `plane`.
fn sun_disc_radiance(plane: vec2<f32>) -> vec3<f32> {
    let centre = frame_direction(plane);
    let pixel = frame_pixel_angle(plane);
    let radius = sky_view.sun_angular_radius;
    // The air flattens the disc but widens nothing; a pixel's corners are lifted by about as much as its centre.
    let reach = 2.0 * sin(0.5 * radius) + 1.5 * pixel;
    if (sky_view.sun_visible == 0u || distance(refraction_true(centre), sky_view.sun_direction) > reach) {
        return vec3<f32>(0.0);
    }
    // Pixels at the poles of a panorama are narrow: fewer samples across.
    let across = SUN_SAMPLES_ACROSS_DISC * frame_pixel_extent(plane) / (2.0 * radius);
    let samples = clamp(vec2<u32>(ceil(across)), vec2<u32>(4u), vec2<u32>(SUN_SAMPLES_MAX));
    let chord = 2.0 * sin(0.5 * radius);
    var sum = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    var weights = 0.0;
    // Weight of the samples on the disc, and their zenith cosines: where in the pixel the air is to be looked through.
    var on_disc = vec2<f32>(1e-20, 1e-20 * centre.z);
    for (var y = 0u; y < samples.y; y++) { // loops: SUN_SAMPLES_MAX
        for (var x = 0u; x < samples.x; x++) { // loops: SUN_SAMPLES_MAX
            // Each column lies a little higher than the one before, or a limb along the rows would count whole rows.
            let column = (f32(x) + 0.5) / f32(samples.x);
            let offset = vec2<f32>(column, (f32(y) + column) / f32(samples.y)) - 0.5;
            let point = plane + offset * frame_pixel_size();
            let direction = frame_direction(point);
            let apart = refraction_true(direction) - sky_view.sun_direction;
            let above = direction.z >= sin(sky_view.horizon_elevation);
            let share_squared = select(1.0, dot(apart, apart) / (chord * chord), above);
            let weight = frame_solid_angle(point);
            sum = spectrum_add(sum, spectrum_scale(sun_limb(share_squared), weight));
            weights += weight;
            on_disc += select(vec2<f32>(0.0), weight * vec2<f32>(1.0, direction.z), share_squared < 1.0);
        }
    }
    // Irradiance to central radiance: (a + 2) / (2 pi sin^2 r).
    let normal = spectrum_add(sky_view.limb_exponents, Spectrum(vec4<f32>(2.0), vec4<f32>(2.0)));
    let sine = sin(radius);
    let scale = 1.0 / (2.0 * SKY_PI * sine * sine * weights);
    let transmittance = atmosphere_transmittance(sun_columns(on_disc.y / on_disc.x));
    let light = spectrum_mul(spectrum_mul(sum, normal), spectrum_mul(atmosphere.solar_irradiance, transmittance));
    return atmosphere_rec709(spectrum_scale(light, scale));
}
