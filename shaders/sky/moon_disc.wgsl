// The moon's disc, by area: lit by the law of Lommel and Seeliger, under which a full moon is evenly bright from edge to
// edge, as ours is; the rest shines by light from the earth. The plains are circles at their places with frayed shores, the
// young craters bright spots: enough for the face that everyone knows, not a map.
// @import common/noise.wgsl
// @import frame/frame.wgsl
// @import sky/moon.wgsl
// @import sky/refraction.wgsl
// @import sky/sun_columns.wgsl

const MOON_SAMPLES_MAX: u32 = 24u;
const MOON_SAMPLES_ACROSS_DISC: f32 = 48.0;
const MOON_SPOTS: u32 = 18u;

/// Longitude and latitude of the middle, radius (all deg), and reflection relative to the highlands less 1.
const MOON_SPOT_LIST = array<vec4<f32>, 18>(
    vec4<f32>(-16.0, 33.0, 18.5, -0.42), vec4<f32>(18.0, 28.0, 11.0, -0.42), vec4<f32>(31.0, 8.0, 13.5, -0.46),
    vec4<f32>(59.0, 17.0, 8.5, -0.42), vec4<f32>(51.0, -7.0, 12.0, -0.38), vec4<f32>(35.0, -15.0, 5.5, -0.34),
    vec4<f32>(-17.0, -21.0, 11.0, -0.34), vec4<f32>(-39.0, -24.0, 6.5, -0.4), vec4<f32>(-56.0, 20.0, 17.0, -0.38),
    vec4<f32>(-48.0, 2.0, 14.0, -0.36), vec4<f32>(-23.0, -9.0, 7.5, -0.36), vec4<f32>(4.0, 13.0, 4.5, -0.32),
    vec4<f32>(-10.0, 57.0, 8.0, -0.26), vec4<f32>(18.0, 56.0, 8.0, -0.24), vec4<f32>(-11.0, -43.0, 4.0, 0.5),
    vec4<f32>(-20.0, 10.0, 3.5, 0.3), vec4<f32>(-47.0, 24.0, 2.2, 0.45), vec4<f32>(-38.0, 8.0, 2.2, 0.25),
);

/// Reflection relative to the mean at a point of the near side: x right (east), y north, z towards the earth.
fn moon_reflection(normal: vec3<f32>) -> f32 {
    let fray = 0.20 * noise_value(normal * 9.0) + 0.14 * noise_value(normal * 24.0) - 0.17;
    var reflection = 0.8 + 0.24 * noise_value(normal * 40.0) + 0.16 * noise_value(normal * 90.0);
    var plains = 1.0;
    for (var i = 0u; i < MOON_SPOTS; i++) { // loops: MOON_SPOTS
        var spots = MOON_SPOT_LIST;
        let spot = spots[i];
        let angles = radians(spot.xy);
        let middle = vec3<f32>(cos(angles.y) * sin(angles.x), sin(angles.y), cos(angles.y) * cos(angles.x));
        let share = distance(normal, middle) / (2.0 * sin(0.5 * radians(spot.z))) + 2.0 * fray;
        let inside = 1.0 - smoothstep(0.75, 1.12, share);
        // Plains that meet do not darken each other.
        plains = min(plains, 1.0 + min(spot.w, 0.0) * inside);
        reflection += max(spot.w, 0.0) * inside;
    }
    // The mean over the disc, so that the moon's light stays what its phase says.
    return reflection * plains / 0.87;
}

/// What one direction adds: x lit and seen, y unlit, z 1 on the disc.
fn moon_sample(seen: vec3<f32>) -> vec3<f32> {
    let right = normalize(cross(moon.direction, moon.north));
    let up = cross(right, moon.direction);
    let chord = 2.0 * sin(0.5 * moon.angular_radius);
    let apart = (seen - moon.direction) / chord;
    let on_disc = vec2<f32>(dot(apart, right), dot(apart, up));
    let squared = dot(on_disc, on_disc);
    if (squared >= 1.0) {
        return vec3<f32>(0.0);
    }
    let normal = vec3<f32>(on_disc, sqrt(1.0 - squared));
    let sun = vec3<f32>(dot(moon.sunlight, right), dot(moon.sunlight, up), -dot(moon.sunlight, moon.direction));
    let lit = max(dot(normal, sun), 0.0);
    var reflection = 1.0;
    if (moon.maria == 1u) {
        reflection = moon_reflection(normal);
    }
    return vec3<f32>(reflection * lit / max(lit + normal.z, 1e-4), reflection, 1.0);
}

/// Radiance (cd/m^2) of the disc in a pixel whose centre has the image-plane coordinates `plane`, and the share of the
/// pixel that it covers.
fn moon_disc_radiance(plane: vec2<f32>) -> vec4<f32> {
    if (moon.disc == 0u) {
        return vec4<f32>(0.0);
    }
    let centre = frame_direction(plane);
    let reach = 2.0 * sin(0.5 * moon.angular_radius) + 1.5 * frame_pixel_angle(plane);
    if (distance(refraction_true(centre), moon.direction) > reach) {
        return vec4<f32>(0.0);
    }
    let across = MOON_SAMPLES_ACROSS_DISC * frame_pixel_extent(plane) / (2.0 * moon.angular_radius);
    let samples = clamp(vec2<u32>(ceil(across)), vec2<u32>(3u), vec2<u32>(MOON_SAMPLES_MAX));
    var sum = vec3<f32>(0.0);
    var weights = 0.0;
    var cosine = 1e-20 * centre.z;
    for (var y = 0u; y < samples.y; y++) { // loops: MOON_SAMPLES_MAX
        for (var x = 0u; x < samples.x; x++) { // loops: MOON_SAMPLES_MAX
            let offset = (vec2<f32>(f32(x), f32(y)) + 0.5) / vec2<f32>(samples) - 0.5;
            let point = plane + offset * frame_pixel_size();
            let direction = frame_direction(point);
            let weight = frame_solid_angle(point);
            weights += weight;
            if (direction.z >= sin(sky_view.horizon_elevation)) {
                let sample = weight * moon_sample(refraction_true(direction));
                sum += sample;
                cosine += sample.z * direction.z;
            }
        }
    }
    let mean = sum / weights;
    let irradiance = spectrum_mul(atmosphere.solar_irradiance, moon.light);
    let transmittance = atmosphere_transmittance(sun_columns(cosine / (sum.z + 1e-20)));
    let share = moon.disc_per_sr * mean.x + moon.earthshine_per_sr * mean.y;
    return vec4<f32>(atmosphere_rec709(spectrum_scale(spectrum_mul(irradiance, transmittance), share)), mean.z);
}
