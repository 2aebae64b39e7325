// A pass of sliding, first half: every cell that stands too high over a neighbour decides how much it sends to the steepest
// one. Only tiles around a move of the last pass are looked at; in others nothing has changed. Twin:
// tyndall_dunes::slab::avalanche. Cost: nine reads and a write a cell of such a tile.
// @import common/grain.wgsl
// @import dunes/dunes.wgsl
// @import dunes/slide.wgsl

@group(1) @binding(1) var<storage, read> dunes_heights: array<i32>;
@group(1) @binding(2) var<storage, read> dunes_bedrock: array<i32>;
@group(1) @binding(3) var<storage, read> dunes_ground: array<u32>;
@group(1) @binding(4) var<storage, read_write> dunes_moves: array<u32>;
@group(1) @binding(5) var<storage, read_write> dunes_active: array<atomic<u32>>;  // by tile, number of the last pass with a move near
@group(2) @binding(0) var<uniform> sand_pass: SandPass;

// How much higher a cell stands than its neighbours, by number: to the sides and to the corners.
struct DunesSteps {
    sides: vec4<i32>,
    corners: vec4<i32>,
}

fn dunes_steps(cell: vec2<i32>, height: i32) -> DunesSteps {
    let around = sand_around(cell);
    let below = around.columns + around.rows.x;
    let level = around.columns + around.rows.y;
    let above = around.columns + around.rows.z;
    let sides = vec4<i32>(dunes_heights[level.z], dunes_heights[level.x], dunes_heights[above.y], dunes_heights[below.y]);
    let corners = vec4<i32>(dunes_heights[above.z], dunes_heights[below.x], dunes_heights[below.z], dunes_heights[above.x]);
    return DunesSteps(height - sides, height - corners);
}

// A stable difference, raised by plants.
fn dunes_limit(bare: i32, planted: i32, cover: u32) -> i32 {
    return bare + ((max(planted - bare, 0) * i32(cover)) >> 8u);
}

// What a cell sends, and where: to the steepest of the neighbours that it stands too high over, the first found from a
// random one on. 181 and 128 weigh a difference to a side and to a corner.
fn dunes_decide(index: u32, height: i32, steps: DunesSteps) -> u32 {
    let loose = height - dunes_bedrock[index];
    if (loose <= 0) { return 0u; }
    let cover = dunes_cover(dunes_ground[index]);
    let turn = grain_cell_word(sand.keys.z + sand_pass.number, index);
    let limits = vec2<i32>(
        dunes_limit(dunes.repose.x, dunes.plant_repose.x, cover),
        dunes_limit(dunes.repose.y, dunes.plant_repose.y, cover),
    );
    var steepest = 0;
    var best = 0u;
    var excess = 0;
    for (var k = 0u; k < 8u; k++) { // loops: 8
        let neighbour = (k + turn) & 7u;
        let is_corner = neighbour > 3u;
        let difference = select(steps.sides[neighbour & 3u], steps.corners[neighbour & 3u], is_corner);
        let steepness = difference * select(181, 128, is_corner);
        if (steepness > steepest && difference > select(limits.x, limits.y, is_corner)) {
            steepest = steepness;
            best = neighbour;
            let bare = select(dunes.rest.x, dunes.rest.y, is_corner);
            excess = difference - dunes_limit(bare, select(dunes.plant_repose.x, dunes.plant_repose.y, is_corner), cover);
        }
    }
    // Half of the excess would make the pair rest; less leaves room for what other cells send there.
    return select(0u, dunes_move(clamp((3 * excess + 7) >> 3u, 1, loose), best), steepest > 0);
}

// Notes what a cell sends, and where cells have to look again.
fn dunes_look_over(cell: vec2<i32>, stamp: u32) {
    let index = sand_index(cell);
    let height = dunes_heights[index];
    let steps = dunes_steps(cell, height);
    let is_over = any(steps.sides > vec4<i32>(dunes.repose.x)) || any(steps.corners > vec4<i32>(dunes.repose.y));
    var sent = 0u;
    if (is_over) {
        sent = dunes_decide(index, height, steps);
    }
    dunes_moves[index] = sent;
    if (sent == 0u) { return; }
    // The move changes cells up to one cell away; cells up to two away may have to look again.
    atomicStore(&dunes_active[dunes_tile(cell + vec2<i32>(-2, -2))], stamp);
    atomicStore(&dunes_active[dunes_tile(cell + vec2<i32>(2, -2))], stamp);
    atomicStore(&dunes_active[dunes_tile(cell + vec2<i32>(-2, 2))], stamp);
    atomicStore(&dunes_active[dunes_tile(cell + vec2<i32>(2, 2))], stamp);
}

@compute @workgroup_size(16, 16, 1)
fn dunes_slide_decide(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy * vec2<u32>(1u, SAND_ROWS) >= sand.size)) { return; }
    let first = vec2<i32>(vec2<u32>(id.x, id.y * SAND_ROWS));
    let stamp = sand.stamp + sand_pass.number;
    if (sand_pass.number != 0u && stamp - atomicLoad(&dunes_active[dunes_tile(first)]) > 1u) { return; }
    for (var row = 0u; row < SAND_ROWS; row++) { // loops: SAND_ROWS
        dunes_look_over(first + vec2<i32>(0, i32(row)), stamp);
    }
}
