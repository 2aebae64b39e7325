// Wind shadow: the height of the highest line that falls downwind from any upwind cell, as a scan of maximum and sum in
// passes of four taps; each pass covers four times the distance of the last. Werner 1995. Twin: tyndall_dunes::shadow.
// Cost: four reads and a write a cell and pass.
// @import dunes/sand.wgsl

@group(1) @binding(0) var<storage, read> sand_source: array<i32>;      // the bed, or the last pass's lines (quanta)
@group(1) @binding(1) var<storage, read_write> sand_line: array<i32>;  // this pass's lines (quanta)
@group(2) @binding(0) var<uniform> sand_pass: SandPass;

// Casts the lines onto a cell.
fn sand_cast(cell: vec2<i32>) {
    var line = SAND_NO_LINE;
    for (var tap = 0; tap < 4; tap++) { // loops: 4
        let far = min(tap + sand_pass.first, sand_pass.last) * sand_pass.stride;
        let origin = cell - sand_offset(far);
        let height = sand_source[sand_index(origin)] - far * sand.fall;
        line = max(line, select(height, SAND_NO_LINE, sand_is_beyond(origin)));
    }
    sand_line[sand_index(cell)] = line;
}

@compute @workgroup_size(32, 4, 1)
fn sand_shadow(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        sand_cast(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}
