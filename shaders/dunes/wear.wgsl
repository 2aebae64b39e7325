// Bare rock in the wind wears and turns to sand; the height of the bed stays. Twin: tyndall_dunes::slab::rock.
// Cost: four reads a cell.
// @import common/grain.wgsl
// @import dunes/dunes.wgsl

@group(1) @binding(1) var<storage, read> dunes_sites: array<u32>;
@group(1) @binding(2) var<storage, read> dunes_ground: array<u32>;
@group(1) @binding(3) var<storage, read> dunes_heights: array<i32>;
@group(1) @binding(4) var<storage, read_write> dunes_rock: array<i32>;
@group(1) @binding(5) var<storage, read_write> dunes_counts: array<atomic<u32>>;  // 64-bit numbers, low word first

// Place of worn quanta in the counts.
const DUNES_WORN: u32 = 4u;

// Wears the rock of a cell.
fn dunes_blast(cell: vec2<i32>) {
    let index = sand_index(cell);
    let rock = dunes_rock[index];
    let ground = dunes_ground[index];
    let softness = 255u - ((ground >> 8u) & 255u);
    let chance = (((dunes.wear_65536 * softness) / 255u) * (255u - dunes_cover(ground))) / 255u;
    let is_sheltered = (dunes_sites[index] & 3u) != 0u || dunes_heights[index] < rock;
    if (is_sheltered || (grain_cell_word(sand.keys.w, index) >> 16u) >= chance) { return; }
    dunes_rock[index] = rock - 1;
    let before = atomicAdd(&dunes_counts[DUNES_WORN], 1u);
    if (before == 0xFFFFFFFFu) {
        atomicAdd(&dunes_counts[DUNES_WORN + 1u], 1u);
    }
}

@compute @workgroup_size(32, 4, 1)
fn dunes_wear(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        dunes_blast(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}
