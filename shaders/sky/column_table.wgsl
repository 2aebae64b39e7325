// Fills the column table: paper eq. (2) without the wavelength. One texel per invocation, 2 x 24 panels of four Gauss
// nodes. Stored are ln(column / density at the observer) for air and aerosol, and the column of ozone [m].
// Haze has a closed form. Exact integral and table in f64: tyndall_scattering::{optical_length, column_table}.
// @import sky/column_map.wgsl
// @import sky/quadrature.wgsl

@group(0) @binding(1) var column_texels: texture_storage_2d<rgba32float, write>;

const COLUMN_PANELS: u32 = 24u;
const COLUMN_PANELS_MIN: u32 = 4u;

/// Densities at distance t along a ray, those of air and aerosol relative to the ones at its lowest altitude: seen from space,
/// those at the observer are too small for f32.
fn column_density(h: f32, mu: f32, t: f32, lowest_m: f32) -> vec3<f32> {
    let h_t = altitude_along(atmosphere.planet_radius_m, h, mu, t);
    let scale_heights = vec2<f32>(atmosphere.air_scale_height_m, atmosphere.aerosol_scale_height_m);
    return vec3<f32>(exp((lowest_m - h_t) / scale_heights), atmosphere_density(h_t).z);
}

/// Columns from distance `from_m` over a signed `span_m`, between the squared shares x0 and x1 of the span.
fn column_piece(h: f32, mu: f32, from_m: f32, span_m: f32, x0: f32, x1: f32, lowest_m: f32) -> vec3<f32> {
    let panels = clamp(u32(ceil((x1 - x0) * f32(COLUMN_PANELS))), COLUMN_PANELS_MIN, COLUMN_PANELS);
    let width = (x1 - x0) / f32(panels);
    var sum = vec3<f32>(0.0);
    for (var panel = 0u; panel < panels; panel++) { // loops: COLUMN_PANELS
        for (var node = 0u; node < 4u; node++) { // loops: 4
            let x = x0 + (f32(panel) + QUADRATURE_NODES[node]) * width;
            sum += column_density(h, mu, from_m + span_m * x * x, lowest_m) * (QUADRATURE_WEIGHTS[node] * 2.0 * x * width);
        }
    }
    return sum * abs(span_m);
}

/// Columns from distance `from_m` over a signed `span_m`, nodes quadratically dense at `from_m`. No panel crosses a corner
/// of the ozone's tent.
fn column_side(h: f32, mu: f32, from_m: f32, span_m: f32, lowest_m: f32) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    var x = 0.0;
    for (var corner = 0u; corner < 4u; corner++) { // loops: 4
        var to = 1.0;
        if (corner < 3u) {
            let altitude = atmosphere.ozone_altitude_m + (f32(corner) - 1.0) * atmosphere.ozone_half_width_m;
            let crossings = altitude_crossings(atmosphere.planet_radius_m, h, mu, altitude);
            let share = (select(crossings.y, crossings.x, span_m < 0.0) - from_m) / span_m;
            // A corner below the lowest point is passed nowhere.
            to = select(x, clamp(sqrt(max(share, 0.0)), x, 1.0), crossings.y > SPHERE_NEVER);
        }
        if (to > x) {
            sum += column_piece(h, mu, from_m, span_m, x, to, lowest_m);
            x = to;
        }
    }
    return sum;
}

@compute @workgroup_size(8, 8, 1)
fn column_table(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= COLUMN_TABLE_SIZE)) { return; }
    let place = column_map_inverse(vec2<f32>(id.xy) / vec2<f32>(COLUMN_TABLE_SIZE - 1u));
    let radius = atmosphere.planet_radius_m;
    let length = distance_to_top(radius, atmosphere.top_altitude_m, place.x, place.y);
    let lowest = clamp(-(radius + place.x) * place.y, 0.0, length);
    let lowest_m = altitude_along(radius, place.x, place.y, lowest);
    let columns = column_side(place.x, place.y, lowest, -lowest, lowest_m) + column_side(place.x, place.y, lowest, length - lowest, lowest_m);
    // The floor of 1e-6 m is what a texel at the very top holds.
    let scale_heights = vec2<f32>(atmosphere.air_scale_height_m, atmosphere.aerosol_scale_height_m);
    let relative = log(max(columns.xy, vec2<f32>(1e-6))) + (place.x - lowest_m) / scale_heights;
    textureStore(column_texels, id.xy, vec4<f32>(relative, columns.z, 0.0));
}
