// Mean heights along one axis: over rows, then over columns of that, they are those of the square around each cell.
// Twin: tyndall_dunes::slab::surroundings. Cost: as many reads as the square is wide, every 16 steps.
// @import dunes/sand.wgsl

@group(1) @binding(1) var<storage, read> dunes_values: array<i32>;
@group(1) @binding(2) var<storage, read_write> dunes_means: array<i32>;
@group(2) @binding(0) var<uniform> sand_pass: SandPass;

// Averages around a cell.
fn dunes_average(cell: vec2<i32>) {
    var sum = 0;
    for (var tap = sand_pass.first; tap <= sand_pass.last; tap++) { // loops: 64
        sum += dunes_values[sand_nearest(cell + tap * sand_pass.axis)];
    }
    // The number of taps is a power of two; the mean is rounded down.
    let taps = u32(sand_pass.last - sand_pass.first + 1);
    dunes_means[sand_index(cell)] = sum >> firstTrailingBit(taps);
}

@compute @workgroup_size(32, 4, 1)
fn dunes_mean(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        dunes_average(vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS + row)));
    }
}
