// Plants grow: fully at the best burial since the last look, not at the tolerance away from it, and die back beyond. Nield
// and Baas 2008. Twin: tyndall_dunes::slab::plants. Cost: three reads and two writes a cell, every 16 steps.
// @import dunes/dunes.wgsl

@group(1) @binding(1) var<storage, read> dunes_heights: array<i32>;
@group(1) @binding(2) var<storage, read_write> dunes_then: array<i32>;    // heights at the last look
@group(1) @binding(3) var<storage, read_write> dunes_ground: array<u32>;

// Grows the plants of a cell.
fn dunes_plant(cell: vec2<i32>) {
    let index = sand_index(cell);
    let now = dunes_heights[index];
    let ground = dunes_ground[index];
    let cover = i32(dunes_cover(ground));
    let off = min(abs(now - dunes_then[index] - dunes.best_burial), 2 * dunes.tolerance);
    let change = (dunes.growth * (dunes.tolerance - off)) / dunes.tolerance;
    let grown = select(0, clamp(cover + change, 0, 255), cover > 0);
    dunes_ground[index] = (ground & ~255u) | u32(grown);
    dunes_then[index] = now;
}

@compute @workgroup_size(32, 4, 1)
fn dunes_grow(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        dunes_plant(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}
