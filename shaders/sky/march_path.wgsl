// Rays, and the nodes of the quadrature along them. Twin: tyndall_scattering::march.
//
// Panels of four Gauss nodes in a variable x with t = lowest + x |x| side, so that nodes are dense at the lowest point. They
// break there, at the edges of the earth's shadow, and in haze.
// @import common/sphere.wgsl
// @import sky/atmosphere.wgsl
// @import sky/haze_breaks.wgsl
// @import sky/quadrature.wgsl

/// Panels of a ray at most: sixteen, one more for each break.
const MARCH_PANELS: u32 = 64u;
/// Breaks closer than this in x are one.
const MARCH_CLOSEST: f32 = 1e-7;

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

/// A ray cut into panels.
struct MarchPath {
    ends: vec2<f32>,   // m, lowest point and length
    limits: vec2<f32>, // x of start and end
    shadow: vec2<f32>, // x where the ray enters and leaves the earth's shadow; far ahead without shadow
    roots: vec2<f32>,  // of the lengths before and behind the lowest point
    haze: HazeBreaks,
}

/// Panels of a path, one after the other.
struct MarchPanels {
    piece: vec2<f32>, // x of two breaks, one after the other
    count: f32,       // panels in between
    index: f32,       // of the next panel
}

/// The path of a ray; `mu_sun` and `nu` say how fast its light fades below the top of a layer of haze.
fn march_path(h: f32, mu: f32, mu_sun: f32, nu: f32, length: f32) -> MarchPath {
    var path: MarchPath;
    let lowest = clamp(-(atmosphere.planet_radius_m + h) * mu, 0.0, length);
    path.ends = vec2<f32>(lowest, length);
    path.limits = vec2<f32>(select(0.0, -1.0, lowest > 0.0), select(0.0, 1.0, length > lowest));
    path.shadow = vec2<f32>(2.0);
    path.roots = sqrt(vec2<f32>(lowest, length - lowest));
    if (atmosphere_hazy()) {
        path.haze = haze_breaks(h, mu, mu_sun, nu, lowest);
    }
    return path;
}

/// The path of a ray in sunlight.
fn march_path_lit(ray: Ray, length: f32) -> MarchPath {
    var path = march_path(ray.h, ray.mu, ray.mu_sun, ray.nu, length);
    let shadow = shadow_interval(atmosphere.planet_radius_m, ray.h, ray.mu, ray.mu_sun, ray.nu, length);
    if (shadow.y > shadow.x) {
        path.shadow = vec2<f32>(march_variable(shadow.x, path.ends.x, length), march_variable(shadow.y, path.ends.x, length));
    }
    return path;
}

/// The nearest break behind x; the end of the ray at last.
fn march_next_break(path: MarchPath, ray: Ray, x: f32) -> f32 {
    let behind = x + MARCH_CLOSEST;
    var next = path.limits.y;
    next = haze_nearer(next, path.shadow.x, behind);
    next = haze_nearer(next, path.shadow.y, behind);
    next = haze_nearer(next, 0.0, behind);
    if (atmosphere_hazy()) {
        let t = march_position(x, path.ends.x, path.ends.y).x;
        let place = haze_next_break(path.haze, ray.h, ray.mu, t);
        next = haze_nearer(next, march_variable(place, path.ends.x, path.ends.y), behind);
    }
    return next;
}

/// The panels from x on, about `panels` on the whole ray.
fn march_piece(path: MarchPath, ray: Ray, panels: u32, x: f32) -> MarchPanels {
    let to = march_next_break(path, ray, x);
    let share = (to - x) * select(path.roots.y, path.roots.x, to <= 0.0) / (path.roots.x + path.roots.y);
    return MarchPanels(vec2<f32>(x, to), max(ceil(f32(panels) * share), 1.0), 0.0);
}

/// The panel behind one, of the same piece or of the next.
fn march_next_panel(path: MarchPath, ray: Ray, panels: u32, now: MarchPanels) -> MarchPanels {
    if (now.index + 1.0 < now.count) {
        return MarchPanels(now.piece, now.count, now.index + 1.0);
    }
    return march_piece(path, ray, panels, now.piece.y);
}

/// Start and width in x of a panel.
fn march_panel_place(now: MarchPanels) -> vec2<f32> {
    let width = (now.piece.y - now.piece.x) / now.count;
    return vec2<f32>(now.piece.x + now.index * width, width);
}

/// Whether a piece lies in sunlight.
fn march_is_lit(path: MarchPath, now: MarchPanels) -> bool {
    let middle = 0.5 * (now.piece.x + now.piece.y);
    return middle <= path.shadow.x || middle >= path.shadow.y;
}
