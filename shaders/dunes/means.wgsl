// Mean heights along one axis: over rows, then over columns of that, they are those of the square around each cell.
// Each invocation slides a sum along a stretch of cells. Twin: tyndall_dunes::slab::surroundings.
// Cost: six reads and a write a cell and axis, every 16 steps.
// @import dunes/sand.wgsl

@group(1) @binding(1) var<storage, read> dunes_values: array<i32>;
@group(1) @binding(2) var<storage, read_write> dunes_means: array<i32>;
@group(2) @binding(0) var<uniform> sand_pass: SandPass;

// x of an invocation is the row or column, y the stretch of it.
@compute @workgroup_size(32, 4, 1)
fn dunes_mean(@builtin(global_invocation_id) id: vec3<u32>) {
    let sides = select(sand.size, sand.size.yx, sand_pass.axis.x != 0);
    if (any(id.xy * vec2<u32>(1u, u32(sand_pass.stride)) >= sides)) { return; }
    let first = sand_pass.axis * i32(id.y) * sand_pass.stride + sand_pass.axis.yx * i32(id.x);
    var sum = 0;
    for (var tap = sand_pass.first; tap <= sand_pass.last; tap++) { // loops: 64
        sum += dunes_values[sand_nearest(first + tap * sand_pass.axis)];
    }
    // The number of taps is a power of two; the mean is rounded down.
    let shift = firstTrailingBit(u32(sand_pass.last - sand_pass.first + 1));
    for (var index = 0; index < sand_pass.stride; index++) { // loops: 16
        let cell = first + index * sand_pass.axis;
        dunes_means[sand_index(cell)] = sum >> shift;
        let next = dunes_values[sand_nearest(cell + (sand_pass.last + 1) * sand_pass.axis)];
        sum += next - dunes_values[sand_nearest(cell + sand_pass.first * sand_pass.axis)];
    }
}
