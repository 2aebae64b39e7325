// The ripple rule of Nishimori and Ouchi 1993 (section 5.1 of the paper) in exact integers, under a wind in any direction:
// saltation into a copy of the bed by atomic sums, then creep from the copy into the bed and the next step's copy.
// Twin: tyndall_dunes::ripples, bit for bit. Cost: a sum at both ends of a hop, nine reads and two writes a cell.
// @import common/grain.wgsl
// @import dunes/sand.wgsl

struct Ripples {
    hop_256: i32,             // hop over a flat bed, 1/256 cell
    hop_per_height_256: i32,  // hop length for a cell of height, 1/256
    layer: i32,               // that a cell loses, quanta
    creep_side: i32,          // share of a difference that creeps to a side, 2^-16
    creep_corner: i32,        // and to a corner, 2^-16
    creep_limit: i32,         // difference beyond which creep grows no more, quanta
    dither: i32,              // 1 when the fraction of a hop is a probability
    bedrock: i32,             // height under the mean bed, quanta
}

@group(1) @binding(0) var<uniform> ripples: Ripples;
@group(1) @binding(1) var<storage, read> ripples_before: array<i32>;               // bed before the step
@group(1) @binding(2) var<storage, read> ripples_line: array<i32>;                 // shadow lines of it
@group(1) @binding(3) var<storage, read_write> ripples_landed: array<atomic<i32>>; // its copy; receives the hops
@group(1) @binding(4) var<storage, read> ripples_moved: array<i32>;                // the copy after all hops
@group(1) @binding(5) var<storage, read_write> ripples_after: array<i32>;          // bed after the step
@group(1) @binding(6) var<storage, read_write> ripples_copy: array<i32>;           // and its copy for the next

// Heights beyond this no longer change the hop (quanta).
const RIPPLES_MAX_RELIEF: i32 = 524288;
// Longest hop (1/256 cell): 127 cells.
const RIPPLES_MAX_HOP: i32 = 32512;

// Length of a hop that starts at a height (1/256 cell), before dithering; a cell of height is 2^12 quanta.
fn ripples_hop_length(height: i32) -> i32 {
    let relief = clamp(height, -RIPPLES_MAX_RELIEF, RIPPLES_MAX_RELIEF);
    return clamp(ripples.hop_256 + ((ripples.hop_per_height_256 * relief) >> 12u), 0, RIPPLES_MAX_HOP);
}

// Dither of a cell along x and y (0 to 255): four cells share a word.
fn ripples_dither(index: u32) -> vec2<i32> {
    let words = vec2<u32>(grain_cell_word(sand.keys.x, index / 4u), grain_cell_word(sand.keys.y, index / 4u));
    let bytes = (words >> vec2<u32>(8u * (index & 3u))) & vec2<u32>(255u);
    return vec2<i32>(bytes) * ripples.dither;
}

// Lifts a layer from a cell and lands it.
fn ripples_lift(cell: vec2<i32>) {
    let index = sand_index(cell);
    let height = ripples_before[index];
    let is_in_lee = sand.fall != 0 && ripples_line[index] > height;
    if (is_in_lee || height - ripples.bedrock < ripples.layer) { return; }
    let landing = sand_index(cell + sand_hop(ripples_hop_length(height), ripples_dither(index)));
    atomicAdd(&ripples_landed[index], -ripples.layer);
    atomicAdd(&ripples_landed[landing], ripples.layer);
}

@compute @workgroup_size(32, 4, 1)
fn ripples_hop(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        ripples_lift(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}

// Fluxes to a cell from neighbours that stand higher by these differences; they truncate towards zero, so that both ends
// of a flux agree.
fn ripples_fluxes(differences: vec4<i32>, share: i32) -> i32 {
    let limit = vec4<i32>(ripples.creep_limit);
    let products = clamp(differences, -limit, limit) * share;
    let fluxes = (products + ((products >> vec4<u32>(31u)) & vec4<i32>(65535))) >> vec4<u32>(16u);
    return fluxes.x + fluxes.y + fluxes.z + fluxes.w;
}

// Creep to and from a cell.
fn ripples_settle(cell: vec2<i32>) {
    let around = sand_around(cell);
    let below = around.columns + around.rows.x;
    let level = around.columns + around.rows.y;
    let above = around.columns + around.rows.z;
    let here = ripples_moved[level.y];
    let sides = vec4<i32>(ripples_moved[level.x], ripples_moved[level.z], ripples_moved[below.y], ripples_moved[above.y]);
    let corners = vec4<i32>(ripples_moved[below.x], ripples_moved[below.z], ripples_moved[above.x], ripples_moved[above.z]);
    let crept = ripples_fluxes(sides - here, ripples.creep_side) + ripples_fluxes(corners - here, ripples.creep_corner);
    ripples_after[level.y] = here + crept;
    ripples_copy[level.y] = here + crept;
}

@compute @workgroup_size(32, 4, 1)
fn ripples_creep(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        ripples_settle(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}
