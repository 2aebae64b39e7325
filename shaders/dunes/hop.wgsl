// Slabs that the wind lifts, and where each of them comes down: Werner 1995, with a lee that catches hops over its edge.
// Nothing that decides changes in this pass, so the atomic sums may come in any order. Twin: tyndall_dunes::slab::transport.
// Cost: two reads a cell, and for a lifted slab two reads a hop and two sums.
// @import common/grain.wgsl
// @import dunes/dunes.wgsl

@group(1) @binding(1) var<storage, read> dunes_sites: array<u32>;
@group(1) @binding(2) var<storage, read> dunes_ground: array<u32>;
@group(1) @binding(3) var<storage, read_write> dunes_bed: array<atomic<i32>>;
@group(1) @binding(4) var<storage, read_write> dunes_counts: array<atomic<u32>>;  // 64-bit numbers, low word first

// A slab sticks after that many hops wherever it is.
const DUNES_MAX_HOPS: u32 = 64u;
// Places in the counts: slabs that came in over open edges, and slabs that left.
const DUNES_ENTERED: u32 = 0u;
const DUNES_LEFT: u32 = 2u;

// Counts one more.
fn dunes_count(place: u32) {
    let before = atomicAdd(&dunes_counts[place], 1u);
    if (before == 0xFFFFFFFFu) {
        atomicAdd(&dunes_counts[place + 1u], 1u);
    }
}

// Chance to stick, 1/4096, more under plants.
fn dunes_drop_chance(site: u32, ground: u32) -> u32 {
    let bare = select(dunes.drop_on_bare_4096, dunes.drop_on_sand_4096, (site & DUNES_SAND) != 0u);
    let chance = bare + (((4096u - bare) * dunes_cover(ground)) >> 8u);
    return select(chance, 4096u, (site & DUNES_LEE) != 0u);
}

// Lets a slab hop from a cell until it sticks or leaves.
fn dunes_land(start: vec2<i32>, first_word: u32) {
    var cell = start;
    var index = sand_index(start);
    var site = dunes_sites[index];
    var word = first_word;
    let length_256 = i32(site >> 8u);
    for (var hop = 1u; hop < DUNES_MAX_HOPS + 1u; hop++) { // loops: DUNES_MAX_HOPS
        word = grain_next_word(word);
        let dither = vec2<i32>(vec2<u32>(word, word >> 8u) & vec2<u32>(255u));
        let to_lee = dunes_to_lee(site);
        let is_caught = to_lee != DUNES_NO_LEE && i32(to_lee << 8u) <= length_256 + dither.x;
        cell += select(sand_hop(length_256, dither), sand_offset(i32(to_lee)), is_caught);
        if (sand_is_beyond(cell)) {
            dunes_count(DUNES_LEFT);
            return;
        }
        let next = sand_index(cell);
        let ground = dunes_ground[next];
        if ((ground >> 16u) != 0u) { break; }
        index = next;
        site = dunes_sites[next];
        if (hop == DUNES_MAX_HOPS || (word >> 20u) < dunes_drop_chance(site, ground)) { break; }
    }
    atomicAdd(&dunes_bed[index], dunes.slab);
}

// Lifts a slab from a cell, if a gust does, and lands it.
fn dunes_gust(cell: vec2<i32>) {
    let index = sand_index(cell);
    let word = grain_cell_word(sand.keys.x, index);
    let chance = (dunes.lift_256 * (256u - dunes_cover(dunes_ground[index]))) >> 8u;
    if ((dunes_sites[index] & 3u) != DUNES_SAND || (word & 255u) >= chance) { return; }
    atomicAdd(&dunes_bed[index], -dunes.slab);
    dunes_land(cell, word);
}

@compute @workgroup_size(32, 4, 1)
fn dunes_lift(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        dunes_gust(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}

// The cells of the upwind row, then those of the upwind column.
@compute @workgroup_size(64, 1, 1)
fn dunes_let_in(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= sand.size.x + sand.size.y) { return; }
    let last = vec2<i32>(sand.size) - 1;
    let upwind = select(last, vec2<i32>(0), sand.wind > vec2<i32>(0));
    let in_row = id.x < sand.size.x;
    let y = i32(id.x) - last.x - 1;
    let is_edge = select(sand.wind.x != 0 && !(sand.wind.y != 0 && y == upwind.y), sand.wind.y != 0, in_row);
    let cell = select(vec2<i32>(upwind.x, y), vec2<i32>(i32(id.x), upwind.y), in_row);
    let word = grain_cell_word(sand.keys.y, sand_index(cell));
    if (!is_edge || (word & 0xFFFFu) >= dunes.inflow_65536) { return; }
    dunes_count(DUNES_ENTERED);
    dunes_land(cell, word);
}
