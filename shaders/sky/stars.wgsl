// The stars: points whose light a pixel gets by a bell of half a pixel's width, so that a star's illuminance is the same at any
// size of the picture and in any projection. The catalogue lies in lists, one for each cell of a cube around the observer; a star
// stands in the lists of all cells that its bell may touch.
// Uniform twin: tyndall_render::sky::night::gpu_data::Stars.
// @import sky/view.wgsl

struct Stars {
    from_world_x: vec4<f32>,   // 1, rows of the rotation to the axes of the catalogue
    from_world_y: vec4<f32>,
    from_world_z: vec4<f32>,
    white: Spectrum,           // W/m^2/sr/nm, white of luminance 1 in Rec.709
    grid: u32,                 // cells along an edge of the cube, 0 without stars
    factor: f32,               // 1, on the light of the stars
    milky_way_cd_m2: f32,      // of the brightest part
    padding: u32,
}
@group(0) @binding(24) var<uniform> stars: Stars;
// Where the list of each cell begins; one more at the end.
@group(0) @binding(25) var<storage, read> stars_cells: array<u32>;
// Two vectors a star: direction and illuminance (lux); linear Rec.709 of luminance 1.
@group(0) @binding(26) var<storage, read> stars_list: array<vec4<f32>>;

const STARS_IN_CELL_MAX: u32 = 384u;
// Width of the bell and where it ends, in pixels.
const STARS_SIGMA_PX: f32 = 0.6;
const STARS_REACH_PX: f32 = 2.0;

/// A world direction in the axes of the catalogue.
fn stars_direction(direction: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(stars.from_world_x.xyz, direction), dot(stars.from_world_y.xyz, direction), dot(stars.from_world_z.xyz, direction));
}

/// The cell of a direction: face by the largest axis (+x, -x, +y, ..), then the two others in order.
fn stars_cell(direction: vec3<f32>) -> u32 {
    let size = abs(direction);
    var axis = 2u;
    if (size.x >= size.y && size.x >= size.z) {
        axis = 0u;
    } else if (size.y >= size.z) {
        axis = 1u;
    }
    let along = direction[axis];
    let across = vec2<f32>(direction[(axis + 1u) % 3u], direction[(axis + 2u) % 3u]) / abs(along);
    let cell = min(vec2<u32>((across * 0.5 + 0.5) * f32(stars.grid)), vec2<u32>(stars.grid - 1u));
    let face = 2u * axis + select(0u, 1u, along < 0.0);
    return (face * stars.grid + cell.y) * stars.grid + cell.x;
}

/// Light of the stars in a pixel, above the atmosphere (cd/m^2): `right` and `down` are the pixel's edges as differences of
/// directions.
fn stars_points(centre: vec3<f32>, right: vec3<f32>, down: vec3<f32>) -> vec3<f32> {
    let metric = vec3<f32>(dot(right, right), dot(right, down), dot(down, down));
    let area_squared = max(metric.x * metric.z - metric.y * metric.y, 1e-30);
    let cell = stars_cell(centre);
    let first = stars_cells[cell];
    let count = min(stars_cells[cell + 1u] - first, STARS_IN_CELL_MAX);
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < count; i++) { // loops: STARS_IN_CELL_MAX
        let star = stars_list[2u * (first + i)];
        let apart = star.xyz - centre;
        let on_edges = vec2<f32>(dot(apart, right), dot(apart, down));
        let pixels = vec2<f32>(metric.z * on_edges.x - metric.y * on_edges.y, metric.x * on_edges.y - metric.y * on_edges.x) / area_squared;
        let squared = dot(pixels, pixels);
        if (squared < STARS_REACH_PX * STARS_REACH_PX) {
            sum += stars_list[2u * (first + i) + 1u].xyz * (star.w * exp(-0.5 * squared / (STARS_SIGMA_PX * STARS_SIGMA_PX)));
        }
    }
    let bell = 2.0 * SKY_PI * STARS_SIGMA_PX * STARS_SIGMA_PX * (1.0 - exp(-0.5 * STARS_REACH_PX * STARS_REACH_PX / (STARS_SIGMA_PX * STARS_SIGMA_PX)));
    return sum * (stars.factor / (bell * sqrt(area_squared)));
}
