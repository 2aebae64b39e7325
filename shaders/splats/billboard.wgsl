// Metaballs as billboards, section 3.3 of the paper: C = C att + col (1 - att) from back to front, att by the closed form of the
// column. Two targets: shares of light scattered once, and often; alpha is what is left of the light from behind.
// @import splats/column.wgsl
// @import splats/splats.wgsl

struct SplatCorner {
    @builtin(position) position: vec4<f32>,
    @location(0) plane: vec2<f32>,
    @location(1) @interpolate(flat) ball: u32,
}

struct SplatShares {
    @location(0) once: vec4<f32>,  // direct sunlight, distance, 0; blended by 1 - att in alpha
    @location(1) often: vec4<f32>, // scattered forward, often (1/sr), light of the sky
}

@vertex
fn splat_vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) ball: u32) -> SplatCorner {
    let extent = splat_balls[ball].extent;
    let place = vec2<f32>(select(extent.x, extent.z, (corner & 1u) == 1u), select(extent.y, extent.w, corner >= 2u));
    return SplatCorner(vec4<f32>(place, 0.0, 1.0), place * splat_camera.half, ball);
}

/// Distance (m) along a line of sight of what the scene shows at a pixel, `steepness` being its length over the planar one.
fn splat_limit(pixel: vec2<u32>, steepness: f32) -> f32 {
    return splat_camera.near_m / max(textureLoad(splat_depth, pixel, 0).x, 1e-12) * steepness;
}

/// Optical depth of a ball on the line of sight through a place of the picture's plane.
fn splat_optical_depth(ball: SplatBall, plane: vec2<f32>, pixel: vec2<u32>) -> f32 {
    let c = ball.centre_m;
    let length2 = 1.0 + splat_camera.perspective * dot(plane, plane);
    let from_point = vec3<f32>(c.y - c.z * plane.y, c.z * plane.x - c.x, c.x * plane.y - c.y * plane.x);
    let parallel = vec3<f32>(c.xy - plane, 0.0);
    let across = select(parallel, from_point, splat_camera.perspective > 0.5);
    let along = (c.z + splat_camera.perspective * dot(c.xy, plane)) * inverseSqrt(length2);
    let u = 1.0 - dot(across, across) / (length2 * ball.radius_m * ball.radius_m);
    let limit = splat_limit(pixel, sqrt(length2));
    return ball.peak * splat_column(u, -along / ball.radius_m, (limit - along) / ball.radius_m);
}

/// Share of sunlight at a place of the picture's plane.
fn splat_direct(ball: SplatBall, plane: vec2<f32>) -> f32 {
    let far = mix(1.0, max(ball.centre_m.z, 1e-6), splat_camera.perspective);
    return exp(-max(ball.sun_depth + dot(ball.slope, plane - ball.centre_m.xy / far), 0.0));
}

@fragment
fn splat_fragment(corner: SplatCorner) -> SplatShares {
    let ball = splat_balls[corner.ball];
    let depth = splat_optical_depth(ball, corner.plane, vec2<u32>(corner.position.xy));
    let seen = 1.0 - exp(-depth);
    let seen_thin = 1.0 - exp(-splat_camera.transport * depth);
    return SplatShares(
        vec4<f32>(seen * splat_direct(ball, corner.plane), seen * ball.distance_m, 0.0, seen),
        vec4<f32>(seen_thin * ball.forward, seen_thin * ball.diffuse, seen_thin * ball.sky, seen_thin),
    );
}
