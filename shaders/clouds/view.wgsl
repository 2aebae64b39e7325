// Draws the clouds over the frame, up to the depth of what it shows. Costs a march of at most CLOUD_STEPS samples a pixel.
// @import clouds/air.wgsl
// @import clouds/march.wgsl
// @import sky/ground_light.wgsl
// @import sky/light_lookup.wgsl
// @import sky/moon_sky.wgsl

@group(2) @binding(7) var cloud_behind: texture_2d<f32>; // the frame without clouds
@group(2) @binding(8) var cloud_depth: texture_2d<f32>;  // reversed, 0 where the sky is

/// Pixels along a side of a marched one.
override CLOUD_PIXEL: u32 = 1u; // 1..=4

@vertex
fn cloud_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return frame_triangle(index);
}

/// Distance (m) along a ray of what the frame shows at a pixel; very far for the sky.
fn cloud_limit(direction: vec3<f32>, pixel: vec2<u32>) -> f32 {
    let depth = textureLoad(cloud_depth, pixel, 0).x;
    let planar = frame.near_m / max(depth, 1e-12);
    return planar / select(max(dot(direction, frame.forward), 1e-6), 1.0, frame.projection == FRAME_EQUIRECTANGULAR);
}

/// Place of a pixel's samples in their steps, 0..1: neighbours differ, so that steps do not show as rings (Jimenez 2014).
fn cloud_jitter(pixel: vec2<u32>) -> f32 {
    return fract(52.9829189 * fract(dot(vec2<f32>(pixel), vec2<f32>(0.06711056, 0.00583715))));
}

/// Irradiance (W/m^2/nm) of sun or moon on a surface that faces it, where a cloud is; 0 in the planet's shadow.
fn cloud_lamp_irradiance(direction: vec3<f32>, t: f32, h: f32) -> Spectrum {
    let radius = atmosphere.planet_radius_m;
    let mu = mu_along(radius, sky_view.observer_altitude_m, cloud_shade.lamp.z, cloud_shade_cosine(direction), t, h);
    let horizon = horizon_mu(radius, h);
    let visible = clamp(0.5 + 0.5 * (mu - horizon) / sin(sky_view.sun_angular_radius), 0.0, 1.0);
    let is_moon = cloud_shade.moonlit == 1u;
    let strength = Spectrum(select(vec4<f32>(1.0), moon.light.lo, is_moon), select(vec4<f32>(1.0), moon.light.hi, is_moon));
    let arriving = spectrum_mul(atmosphere.solar_irradiance, atmosphere_transmittance(columns_to_top(h, max(mu, horizon))));
    return spectrum_scale(spectrum_mul(strength, arriving), visible);
}

/// Radiance (cd/m^2) of moonlit sky and ground around a cloud; of moonlight on the ground at sea level.
fn cloud_moonlit(direction: vec3<f32>, t: f32, h: f32, light: CloudLight, below: f32) -> vec3<f32> {
    var radiance = vec3<f32>(0.0);
    if (!NIGHT) {
        return radiance;
    }
    // A loop, as lavapipe 22.3 fails in shaders that branch on several uniform buffers.
    for (var nights = moon.skylight; nights > 0u; nights--) { // loops: 1
        let mu = mu_along(atmosphere.planet_radius_m, sky_view.observer_altitude_m, moon.direction.z, dot(direction, moon.direction), t, h);
        let sky = ground_sky_irradiance(mu);
        let ground = spectrum_mul(atmosphere.ground_albedo, spectrum_add(sky, ground_sun_irradiance(mu)));
        let around = spectrum_add(spectrum_scale(sky, light.sky), spectrum_scale(ground, below * light.ground));
        radiance += atmosphere_rec709(spectrum_mul(moon.light, around)) / SKY_PI;
    }
    return radiance;
}

/// Radiance (cd/m^2) of a cloud where it is: sun or moon, the sky above and the ground in the clouds' shade below.
fn cloud_radiance(direction: vec3<f32>, light: CloudLight, pixel: vec2<u32>) -> vec3<f32> {
    let radius = atmosphere.planet_radius_m;
    let h0 = sky_view.observer_altitude_m;
    let t = light.distance_m;
    let h = min(altitude_along(radius, h0, direction.z, t), atmosphere.top_altitude_m);
    let mu_sun = mu_along(radius, h0, sky_view.sun_direction.z, sky_sun_cosine(direction), t, h);
    let below = cloud_shade_of_ground(frame.position_m.xy + t * direction.xy, h);
    let level = sky_light_level(h, mu_sun);
    let daylit = (light.sky * level.up + below * light.ground * level.down) / SKY_PI;
    let ambient = daylit + cloud_moonlit(direction, t, h, light, below);
    // Light from behind the cloud that was scattered a little: as bright as what is there, of the sky without discs and stars.
    let open = sky_view_radiance(sky_view_angles(direction), sky_sun_cosine(direction)) + moon_sky_radiance(direction);
    let things = textureLoad(cloud_behind, pixel, 0).xyz / frame.pre_exposure;
    let behind = select(open, things, textureLoad(cloud_depth, pixel, 0).x > 0.0);
    return light.sun * atmosphere_rec709(cloud_lamp_irradiance(direction, t, h)) + ambient + light.forward * behind;
}

/// Frame value of a ray's light behind the air before it, and the transmittance of the clouds. Leaves pixels alone where clouds
/// hardly show, which spares whole groups of them what follows.
fn cloud_shown(light: CloudLight, direction: vec3<f32>, pixel: vec2<u32>) -> vec4<f32> {
    if (light.transmittance > 0.9999) {
        discard;
    }
    let air = cloud_air(direction, light.distance_m);
    let over = air.transmittance * cloud_radiance(direction, light, pixel) + air.veil * (1.0 - light.transmittance);
    return vec4<f32>(min(over * frame.pre_exposure, vec3<f32>(frame.largest)), light.transmittance);
}

/// The frame with what clouds show at a pixel laid over it.
fn cloud_laid_over(shown: vec4<f32>, pixel: vec2<u32>) -> vec4<f32> {
    let behind = textureLoad(cloud_behind, pixel, 0).xyz;
    return vec4<f32>(min(behind * shown.w + shown.xyz, vec3<f32>(frame.largest)), 1.0);
}

/// [`cloud_shown`] along the ray of a marched pixel.
fn cloud_seen(marched: vec2<u32>) -> vec4<f32> {
    let plane = frame_plane(vec4<f32>(f32(CLOUD_PIXEL) * (vec2<f32>(marched) + 0.5), 0.0, 1.0));
    let direction = frame_direction(plane);
    let pixel = min(CLOUD_PIXEL * marched + CLOUD_PIXEL / 2u, frame.size_px - 1u);
    cloud_eye_m = vec3<f32>(frame.position_m.xy, sky_view.observer_altitude_m) + frame_eye(plane);
    let light = cloud_march(direction, cloud_limit(direction, pixel), cloud_jitter(marched));
    return cloud_shown(light, direction, pixel);
}

@fragment
fn cloud_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<u32>(position.xy);
    return cloud_laid_over(cloud_seen(pixel), pixel);
}

/// The same at half resolution, for clouds/upsample.wgsl.
@fragment
fn cloud_part_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return cloud_seen(vec2<u32>(position.xy));
}
