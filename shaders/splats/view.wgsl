// Lays splats over the frame: their shares of light take the place of what a march gathers.
// @import clouds/view.wgsl

@group(2) @binding(20) var splat_once: texture_2d<f32>;  // direct sunlight, distance (m), 0, transmittance
@group(2) @binding(21) var splat_often: texture_2d<f32>; // scattered forward, often (1/sr), of the sky, transmittance

/// Mean number of scatterings of light that was scattered forward alone.
const SPLAT_ORDERS: f32 = 6.0;

/// The light that reaches a pixel from the splats.
fn splat_light(direction: vec3<f32>, pixel: vec2<u32>) -> CloudLight {
    let once = textureLoad(splat_once, pixel, 0);
    let often = f32(clouds.all_orders) * (textureLoad(splat_often, pixel, 0) - vec4<f32>(0.0, 0.0, 0.0, 1.0));
    let nu = cloud_shade_cosine(direction);
    let straight = phase_double_henyey_greenstein(nu, clouds.asymmetry, clouds.forward_weight);
    let wide = phase_of_orders(nu, SPLAT_ORDERS, clouds.asymmetry, clouds.forward_weight);
    let sun = once.x * straight + often.x * wide + often.y;
    let distance_m = once.y / max(1.0 - once.w, 1e-6);
    let behind = f32(clouds.all_orders) * (1.0 - once.w) + often.w;
    return CloudLight(sun, often.z, -often.w - often.z, once.w, distance_m, behind);
}

@fragment
fn splat_over(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<u32>(position.xy);
    let direction = frame_direction(frame_plane(position));
    cloud_eye_m = vec3<f32>(frame.position_m.xy, sky_view.observer_altitude_m) + frame_eye(frame_plane(position));
    return cloud_laid_over(cloud_shown(splat_light(direction, pixel), direction, pixel), pixel);
}
