// How what is known of a cell is packed into a word. Twin of a site's lower byte: tyndall_dunes::slab::surface.
// @import dunes/sand.wgsl

// Kinds of a cell, in the two lowest bits of a site: a slab of sand or more lies here; the wind does not reach the bed.
const DUNES_SAND: u32 = 1u;
const DUNES_LEE: u32 = 2u;
// Distance to the next lee downwind, in bits 2 to 7 of a site, where there is none within reach.
const DUNES_NO_LEE: u32 = 63u;

// A site: kind, distance to the lee (cells), length of a hop from here (1/256 cell).
fn dunes_site(kind: u32, to_lee: u32, length_256: u32) -> u32 {
    return kind | (min(to_lee, DUNES_NO_LEE) << 2u) | (length_256 << 8u);
}

// Distance to the lee of a site (cells).
fn dunes_to_lee(site: u32) -> u32 {
    return (site >> 2u) & 63u;
}

// Ground of a cell: cover by plants in bits 0 to 7, hardness of the rock in bits 8 to 15, wall in bit 16.
fn dunes_cover(ground: u32) -> u32 {
    return ground & 255u;
}
