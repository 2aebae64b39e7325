// Draws sand in the air over the frame, up to the depth of what it shows: light scattered once, of the lamp where it shines and
// of sky and sand from all sides. Costs a march of at most BLOWING_STEPS steps a pixel.
// @import aerial/lookup.wgsl
// @import clouds/shadow.wgsl
// @import desert/blowing.wgsl
// @import desert/moonlight.wgsl
// @import landscape/place.wgsl
// @import sky/light_lookup.wgsl

@group(2) @binding(16) var blowing_behind: texture_2d<f32>; // the frame without it
@group(2) @binding(17) var blowing_depth: texture_2d<f32>;  // reversed, 0 where the sky is

@vertex
fn blowing_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return frame_triangle(index);
}

/// Distance (m) along a ray of what the frame shows at a pixel; very far for the sky.
fn blowing_limit(direction: vec3<f32>, pixel: vec2<u32>) -> f32 {
    let planar = frame.near_m / max(textureLoad(blowing_depth, pixel, 0).x, 1e-12);
    return planar / select(max(dot(direction, frame.forward), 1e-6), 1.0, frame.projection == FRAME_EQUIRECTANGULAR);
}

/// Radiance (cd/m^2) of all that is taken from a ray, scattered once.
fn blowing_radiance(direction: vec3<f32>, light: BlownLight, place: vec2<f32>, altitude: f32) -> vec3<f32> {
    let sun = sky_view.sun_direction;
    let shade = cloud_shade_at(place, altitude);
    let sunlight = sky_light_sun(altitude, sun.z);
    let level = max(sun.z, 0.0);
    let from_sky = sky_light_level(altitude, sun.z).up * shade.sky + sunlight * level * shade.diffuse;
    let from_sand = desert.albedo * (sunlight * level * shade.direct + from_sky);
    let around = (from_sky + from_sand) / (2.0 * SKY_PI);
    let taken = 1.0 - light.transmittance;
    let lamp = light.direct * shade.direct;
    var radiance = sunlight * (lamp * blowing_phase(dot(direction, sun))) + around * taken;
    // A loop, as lavapipe 22.3 fails in shaders that branch on several uniform buffers.
    for (var nights = moon.skylight; nights > 0u; nights--) { // loops: 1
        radiance += moonlight_on_sand(lamp * blowing_phase(dot(direction, moon.direction)), 0.5 / SKY_PI * taken);
    }
    return blowing.albedo * radiance;
}

@fragment
fn blowing_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<u32>(position.xy);
    let plane = frame_plane(position);
    let direction = frame_direction(plane);
    let eye = frame.position_m + frame_eye(plane);
    let light = blowing_march(eye, direction, blowing_limit(direction, pixel));
    if (light.transmittance > 0.9995) {
        discard;
    }
    let at = eye + light.distance_m * direction;
    let air = aerial_seen(plane, light.distance_m, sky_sun_cosine(direction));
    let radiance = blowing_radiance(direction, light, at.xy, max(at.z, 0.0));
    let over = air.transmittance * radiance + air.light * (1.0 - light.transmittance);
    let behind = textureLoad(blowing_behind, pixel, 0).xyz;
    return vec4<f32>(min(behind * light.transmittance + over * frame.pre_exposure, vec3<f32>(frame.largest)), 1.0);
}
