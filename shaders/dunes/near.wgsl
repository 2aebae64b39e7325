// Sorts the cells by what the wind meets there and by the length of a hop from there, and looks for a lee up to four cells
// downwind. Twin: tyndall_dunes::slab::surface. Cost: twelve reads and a write a cell.
// @import dunes/dunes.wgsl

@group(1) @binding(1) var<storage, read> dunes_heights: array<i32>;
@group(1) @binding(2) var<storage, read> dunes_bedrock: array<i32>;
@group(1) @binding(3) var<storage, read> dunes_means: array<i32>;
@group(1) @binding(4) var<storage, read> dunes_line: array<i32>;        // shadow lines
@group(1) @binding(5) var<storage, read_write> dunes_near: array<u32>;  // sites that look four cells far

// Length of a hop that starts so many quanta over its surroundings, 1/256 cell: half to three times that at mean height.
fn dunes_hop_length(over_mean: i32) -> i32 {
    let over = clamp(over_mean, -32768, 32768);
    return clamp(dunes.hop_256 + ((dunes.speed_up_256 * over) >> 8u), dunes.hop_256 >> 1u, 3 * dunes.hop_256);
}

// Sorts a cell.
fn dunes_sort(cell: vec2<i32>) {
    let index = sand_index(cell);
    let height = dunes_heights[index];
    let has_sand = select(0u, DUNES_SAND, height - dunes_bedrock[index] >= dunes.slab);
    let kind = has_sand | select(0u, DUNES_LEE, dunes_line[index] > height);
    var to_lee = DUNES_NO_LEE;
    for (var tap = 0; tap < 4; tap++) { // loops: 4
        let far = tap + 1;
        let ahead = cell + sand_offset(far);
        let there = sand_index(ahead);
        let is_lee = dunes_line[there] > dunes_heights[there] && !sand_is_beyond(ahead);
        to_lee = min(to_lee, select(DUNES_NO_LEE, u32(far), is_lee));
    }
    dunes_near[index] = dunes_site(kind, to_lee, u32(dunes_hop_length(height - dunes_means[index])));
}

@compute @workgroup_size(32, 4, 1)
fn dunes_classify(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        dunes_sort(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}
