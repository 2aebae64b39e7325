// A pass of sliding, second half: every cell loses what it sends and gains what its neighbours send to it. Twin:
// tyndall_dunes::slab::avalanche. Cost: ten reads and a write a cell of a tile with moves.
// @import dunes/slide.wgsl

@group(1) @binding(1) var<storage, read> dunes_moves: array<u32>;
@group(1) @binding(2) var<storage, read> dunes_active: array<u32>;
@group(1) @binding(3) var<storage, read_write> dunes_heights: array<i32>;
@group(2) @binding(0) var<uniform> sand_pass: SandPass;

// Moves what a cell sends and receives.
fn dunes_slide(cell: vec2<i32>) {
    let around = sand_around(cell);
    let index = around.columns.y + around.rows.y;
    let below = around.columns + around.rows.x;
    let level = around.columns + around.rows.y;
    let above = around.columns + around.rows.z;
    // By number of the neighbour: at the sides, at the corners.
    let sides = vec4<u32>(dunes_moves[level.z], dunes_moves[level.x], dunes_moves[above.y], dunes_moves[below.y]);
    let corners = vec4<u32>(dunes_moves[above.z], dunes_moves[below.x], dunes_moves[below.z], dunes_moves[above.x]);
    let own = dunes_moves[index];
    if (all((sides | corners | vec4<u32>(own)) == vec4<u32>(0u))) { return; }
    var change = -dunes_move_amount(own);
    for (var neighbour = 0u; neighbour < 8u; neighbour++) { // loops: 8
        let origin = cell + dunes_neighbour(neighbour);
        let sent = select(sides[neighbour & 3u], corners[neighbour & 3u], neighbour > 3u);
        let is_mine = sent != 0u && !sand_is_beyond(origin) && dunes_move_target(sent, origin) == index;
        change += select(0, dunes_move_amount(sent), is_mine);
    }
    dunes_heights[index] += change;
}

@compute @workgroup_size(16, 16, 1)
fn dunes_slide_apply(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    let first = vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS));
    if (dunes_active[dunes_tile(first)] != sand.stamp + sand_pass.number) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        dunes_slide(first + vec2<i32>(0, i32(row)));
    }
}
