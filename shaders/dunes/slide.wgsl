// Sand that slides: neighbours, moves and tiles. Twin: tyndall_dunes::slab::avalanche.
// @import dunes/sand.wgsl

// Side of a tile (cells); a bed has a whole number of tiles.
const DUNES_TILE: u32 = 16u;

// The neighbours by number: 0 to 3 at the sides, 4 to 7 at the corners. Two bits of a word a neighbour, part plus 1.
fn dunes_neighbour(number: u32) -> vec2<i32> {
    let parts = (vec2<u32>(0x2252u, 0x8225u) >> vec2<u32>(2u * number)) & vec2<u32>(3u);
    return vec2<i32>(parts) - 1;
}

// A move of so many quanta to a neighbour; 0 is none.
fn dunes_move(amount: i32, neighbour: u32) -> u32 {
    return (u32(amount) << 3u) | neighbour;
}

// Quanta of a move.
fn dunes_move_amount(packed: u32) -> i32 {
    return i32(packed >> 3u);
}

// Cell that a move goes to.
fn dunes_move_target(packed: u32, origin: vec2<i32>) -> u32 {
    return sand_nearest(origin + dunes_neighbour(packed & 7u));
}

// Tile of a cell, coordinates wrapped.
fn dunes_tile(cell: vec2<i32>) -> u32 {
    let inside = (vec2<u32>(cell) & (sand.size - 1u)) / DUNES_TILE;
    return inside.y * (sand.size.x / DUNES_TILE) + inside.x;
}
