// Draws the clouds over the frame, up to the depth of what it shows. Costs a march of at most CLOUD_STEPS samples a pixel.
// @import clouds/air.wgsl
// @import clouds/march.wgsl
// @import sky/ground_light.wgsl

@group(2) @binding(4) var cloud_behind: texture_2d<f32>; // the frame without clouds
@group(2) @binding(5) var cloud_depth: texture_2d<f32>;  // reversed, 0 where the sky is

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

/// Radiance (cd/m^2) of a cloud where it is. The sky shines on it as on level ground at sea level, the ground as it is lit there.
fn cloud_radiance(direction: vec3<f32>, light: CloudLight) -> vec3<f32> {
    let radius = atmosphere.planet_radius_m;
    let h0 = sky_view.observer_altitude_m;
    let h = min(altitude_along(radius, h0, direction.z, light.distance_m), atmosphere.top_altitude_m);
    let mu_sun = mu_along(radius, h0, sky_view.sun_direction.z, sky_sun_cosine(direction), light.distance_m, h);
    let horizon = horizon_mu(radius, h);
    let visible = clamp(0.5 + 0.5 * (mu_sun - horizon) / sin(sky_view.sun_angular_radius), 0.0, 1.0);
    let sunlight = spectrum_mul(atmosphere.solar_irradiance, atmosphere_transmittance(columns_to_top(h, max(mu_sun, horizon))));
    let sky = ground_sky_irradiance(mu_sun);
    let ground = spectrum_mul(atmosphere.ground_albedo, spectrum_add(sky, ground_sun_irradiance(mu_sun)));
    let ambient = light.sky / SKY_PI * atmosphere_rec709(sky) + light.ground / SKY_PI * atmosphere_rec709(ground);
    // Light from behind the cloud that was scattered a little: blurred, and as bright as sky or ground there.
    let behind = select(atmosphere_rec709(ground) / SKY_PI, sky_view_radiance(sky_view_angles(direction), sky_sun_cosine(direction)), direction.z > 0.0);
    return light.sun * visible * atmosphere_rec709(sunlight) + ambient + light.forward * behind;
}

@fragment
fn cloud_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<u32>(position.xy);
    let direction = frame_direction(frame_plane(position));
    cloud_eye_m = vec3<f32>(frame.position_m.xy, sky_view.observer_altitude_m) + frame_eye(frame_plane(position));
    let light = cloud_march(direction, cloud_limit(direction, pixel), cloud_jitter(pixel));
    if (light.transmittance > 0.9999) {
        discard;
    }
    let air = cloud_air(direction, light.distance_m);
    let over = air.transmittance * cloud_radiance(direction, light) + air.veil * (1.0 - light.transmittance);
    let behind = textureLoad(cloud_behind, pixel, 0).xyz * light.transmittance;
    return vec4<f32>(min(behind + over * frame.pre_exposure, vec3<f32>(frame.largest)), 1.0);
}
