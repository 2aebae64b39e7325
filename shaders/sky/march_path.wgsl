// Rays, and the nodes of the quadrature along them. Twin: tyndall_scattering::march.
//
// Panels of four Gauss nodes in a variable x with t = lowest + x |x| side, so that nodes are dense at the lowest point.
// @import common/sphere.wgsl
// @import sky/atmosphere.wgsl
// @import sky/quadrature.wgsl

const MARCH_PANELS_MAX: u32 = 16u;

/// A ray inside the atmosphere: altitude, cosines to zenith, of the sun to the zenith, and between ray and sun.
struct Ray {
    h: f32,
    mu: f32,
    mu_sun: f32,
    nu: f32,
}

/// Light scattered towards the observer before the phase functions [W/m^2/nm].
struct Scattered {
    air: Spectrum,
    aerosol: Spectrum,
    haze: Spectrum,
}

/// No light.
fn scattered_nothing() -> Scattered {
    let zero = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    return Scattered(zero, zero, zero);
}

/// Distance [m] at x, and its derivative [m].
fn march_position(x: f32, lowest: f32, length: f32) -> vec2<f32> {
    let side = select(length - lowest, lowest, x < 0.0);
    return vec2<f32>(lowest + x * abs(x) * side, 2.0 * abs(x) * side);
}

/// x at a distance [m].
fn march_variable(t: f32, lowest: f32, length: f32) -> f32 {
    let from_lowest = t - lowest;
    let side = max(select(length - lowest, lowest, from_lowest < 0.0), 1e-6);
    return sign(from_lowest) * sqrt(min(abs(from_lowest) / side, 1.0));
}

/// The four nodes of a panel: distance and altitude (m), and density times step of the four media (m).
struct MarchNodes {
    t: vec4<f32>,
    h: vec4<f32>,
    air: vec4<f32>,
    aerosol: vec4<f32>,
    ozone: vec4<f32>,
    haze: vec4<f32>,
}

/// Nodes of the panel from x0 of a width in x; `ends` = lowest point and length (m).
fn march_nodes(ray: Ray, ends: vec2<f32>, x0: f32, width: f32) -> MarchNodes {
    var nodes: MarchNodes;
    for (var i = 0u; i < 4u; i++) { // loops: 4
        let position = march_position(x0 + QUADRATURE_NODES[i] * width, ends.x, ends.y);
        let h = min(altitude_along(atmosphere.planet_radius_m, ray.h, ray.mu, position.x), atmosphere.top_altitude_m);
        let step = atmosphere_density(h) * position.y * width;
        nodes.t[i] = position.x;
        nodes.h[i] = h;
        nodes.air[i] = step.x;
        nodes.aerosol[i] = step.y;
        nodes.ozone[i] = step.z;
        nodes.haze[i] = step.w;
    }
    return nodes;
}

/// Columns (m) of a panel.
fn march_columns(nodes: MarchNodes) -> vec4<f32> {
    let weights = QUADRATURE_WEIGHTS;
    return vec4<f32>(dot(nodes.air, weights), dot(nodes.aerosol, weights), dot(nodes.ozone, weights), dot(nodes.haze, weights));
}

/// Columns (m) from the start of a panel to each of its nodes, a column of the matrix per medium.
fn march_running(nodes: MarchNodes) -> mat4x4<f32> {
    return mat4x4<f32>(quadrature_running(nodes.air), quadrature_running(nodes.aerosol), quadrature_running(nodes.ozone), quadrature_running(nodes.haze));
}
