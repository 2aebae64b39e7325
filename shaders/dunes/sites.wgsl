// Looks for the next lee up to sixteen cells downwind, over what each cell sees in four. Twin: tyndall_dunes::slab::surface.
// Cost: four reads and a write a cell.
// @import dunes/cells.wgsl

@group(1) @binding(1) var<storage, read> dunes_near: array<u32>;
@group(1) @binding(2) var<storage, read_write> dunes_sites: array<u32>;

// Looks ahead from a cell.
fn dunes_look(cell: vec2<i32>) {
    let index = sand_index(cell);
    let site = dunes_near[index];
    var to_lee = dunes_to_lee(site);
    for (var tap = 0; tap < 3; tap++) { // loops: 3
        let far = 4 * tap + 4;
        let ahead = cell + sand_offset(far);
        let there = dunes_to_lee(dunes_near[sand_index(ahead)]);
        let is_known = there != DUNES_NO_LEE && !sand_is_beyond(ahead);
        to_lee = min(to_lee, select(DUNES_NO_LEE, there + u32(far), is_known));
    }
    dunes_sites[index] = dunes_site(site & 3u, to_lee, site >> 8u);
}

@compute @workgroup_size(32, 4, 1)
fn dunes_look_ahead(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        dunes_look(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}
