// The bed that ripples and dunes share: its size, the wind and the keys of a step, and where its cells are. Integers only;
// lengths in cells, directions in units of 2^-14, x runs fastest. Twins: tyndall_dunes::{lattice, direction}.

struct Sand {
    size: vec2<u32>,  // cells along x and y, powers of two
    wind: vec2<i32>,  // where it blows to, 2^-14
    keys: vec4<u32>,  // of the step's random words; each automaton says of which
    fall: i32,        // of shadow lines, quanta per cell; 0 for no shadow
    open: u32,        // 1 when nothing lies beyond the edges, 0 when the bed begins again
    stamp: u32,       // number of the step's first pass, counted over all steps
    padding: u32,
}

// One of several dispatches that differ in a few numbers.
struct SandPass {
    axis: vec2<i32>,  // direction of the taps, where it is not the wind's
    first: i32,       // number of the first tap
    last: i32,        // number of the last one; those behind it repeat it
    stride: i32,      // cells from one tap to the next
    number: u32,      // of the pass in its step
    padding0: u32,
    padding1: u32,
}

@group(0) @binding(0) var<uniform> sand: Sand;

// Cells that an invocation does, one above the other: on an adapter that is a processor the start of an invocation costs
// more than the work on a cell. A power of two, so that they lie in one tile.
override SAND_ROWS: u32 = 1u; // 1..=16

// Height of a shadow line where nothing upwind casts one.
const SAND_NO_LINE: i32 = -1073741824;

// Index of a cell, both coordinates wrapped.
fn sand_index(cell: vec2<i32>) -> u32 {
    let inside = vec2<u32>(cell) & (sand.size - 1u);
    return inside.y * sand.size.x + inside.x;
}

// Whether a cell is beyond an open edge.
fn sand_is_beyond(cell: vec2<i32>) -> bool {
    return sand.open != 0u && any(vec2<u32>(cell) >= sand.size);
}

// A cell, wrapped, or the nearest one inside an open edge.
fn sand_cell(cell: vec2<i32>) -> vec2<u32> {
    let last = vec2<i32>(sand.size) - 1;
    return vec2<u32>(select(cell & last, clamp(cell, vec2<i32>(0), last), sand.open != 0u));
}

// Index of that cell.
fn sand_nearest(cell: vec2<i32>) -> u32 {
    let inside = sand_cell(cell);
    return inside.y * sand.size.x + inside.x;
}

// Where a cell and its neighbours are: columns x - 1, x, x + 1, and the starts of rows y - 1, y, y + 1. The index of a
// neighbour is the sum of one of each; across an open edge it is the nearest inside.
struct SandAround {
    columns: vec3<u32>,
    rows: vec3<u32>,
}

fn sand_around(cell: vec2<i32>) -> SandAround {
    let low = sand_cell(cell - 1);
    let high = sand_cell(cell + 1);
    let here = vec2<u32>(cell);
    return SandAround(vec3<u32>(low.x, here.x, high.x), vec3<u32>(low.y, here.y, high.y) * sand.size.x);
}

// The cell so many cells downwind of the origin, rounded to the nearest, the same for opposite winds.
fn sand_offset(cells: i32) -> vec2<i32> {
    return sign(sand.wind) * ((abs(sand.wind) * cells + 8192) >> vec2<u32>(14u));
}

// Displacement of a hop of a length (1/256 cell), each part rounded down after adding its dither (0 to 255).
fn sand_hop(length_256: i32, dither: vec2<i32>) -> vec2<i32> {
    let stride = (abs(sand.wind) * length_256) >> vec2<u32>(14u);
    return sign(sand.wind) * ((stride + dither) >> vec2<u32>(8u));
}
