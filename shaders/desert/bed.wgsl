// Heights of the field between its cells: cubic B-splines, twice smooth. Twin: tyndall_render::desert::bed.
// @import desert/desert.wgsl

// In a buffer, for software adapters read one mip level for four pixels at a time.
@group(2) @binding(2) var<storage, read> bed_heights: array<f32>; // m, mip level after mip level

/// Weights of the four cells around a place between the two in the middle.
fn bed_weights(t: f32) -> vec4<f32> {
    let u = 1.0 - t;
    return vec4<f32>(u * u * u, 4.0 + t * t * (3.0 * t - 6.0), 4.0 + u * u * (3.0 * u - 6.0), t * t * t) / 6.0;
}

/// Derivatives of the weights.
fn bed_slopes(t: f32) -> vec4<f32> {
    let u = 1.0 - t;
    return vec4<f32>(-0.5 * u * u, t * (1.5 * t - 2.0), u * (2.0 - 1.5 * u), 0.5 * t * t);
}

/// Height (m) of a cell of the level that begins at `first`: of that at the edge, where the field does not repeat.
fn bed_cell(first: i32, cell: vec2<i32>, size: vec2<i32>) -> f32 {
    let wrapped = cell & (size - 1);
    let at = select(clamp(cell, vec2<i32>(0), size - 1), wrapped, vec2<bool>(desert.wraps == 1u));
    return bed_heights[first + at.y * size.x + at.x];
}

/// Height (m) and slopes to the east and the north by one mip level.
fn bed_of_level(place: vec2<f32>, level: i32) -> vec3<f32> {
    let finest = vec2<i32>(desert.size);
    let size = finest >> vec2<u32>(u32(level));
    let first = (4 * finest.x * finest.y - 4 * size.x * size.y) / 3;
    let cell_m = desert.cell_m * desert.size.x / f32(size.x);
    let at = place / cell_m + 0.5 * vec2<f32>(size) - 0.5;
    let cell = floor(at);
    let corner = vec2<i32>(cell) - 1;
    let along = bed_weights(at.x - cell.x);
    let along_slope = bed_slopes(at.x - cell.x);
    let across = bed_weights(at.y - cell.y);
    let across_slope = bed_slopes(at.y - cell.y);
    var sum = vec3<f32>(0.0);
    for (var row = 0; row < 4; row++) { // loops: 4
        var cells = vec4<f32>(0.0);
        for (var column = 0; column < 4; column++) { // loops: 4
            cells[column] = bed_cell(first, corner + vec2<i32>(column, row), size);
        }
        let here = dot(along, cells);
        sum += vec3<f32>(across[row] * here, across[row] * dot(along_slope, cells), across_slope[row] * here);
    }
    return vec3<f32>(sum.x, sum.yz / cell_m);
}

/// Height (m) and slopes to the east and the north, without what is smaller than the footprint.
fn bed_at(place: vec2<f32>, footprint_m: f32) -> vec3<f32> {
    let finest = log2(max(footprint_m / desert.cell_m, 1.0));
    let level = min(finest, log2(min(desert.size.x, desert.size.y)) - 2.0);
    let first = i32(level);
    var bed = bed_of_level(place, first);
    if (level - f32(first) > 0.01) {
        bed = mix(bed, bed_of_level(place, first + 1), level - f32(first));
    }
    return bed * desert_inside(place);
}
