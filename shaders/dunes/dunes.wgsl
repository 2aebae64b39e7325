// The dune rule in integers; heights in quanta of 1/256 cell. Twins: tyndall_dunes::slab::{DuneRule, PlantRule, Rock}.
// @import dunes/cells.wgsl

struct Dunes {
    repose: vec2<i32>,        // largest stable difference to a side and to a corner, quanta
    rest: vec2<i32>,          // differences at which sliding ends, quanta
    plant_repose: vec2<i32>,  // as repose, under full cover
    slab: i32,                // thickness of a slab, quanta
    lift_256: u32,            // chance to lift, 1/256
    hop_256: i32,             // hop at mean height, 1/256 cell
    speed_up_256: i32,        // hop length for a cell of height over the surroundings, 1/256
    drop_on_sand_4096: u32,   // chance to stick on sand, 1/4096
    drop_on_bare_4096: u32,   // chance to stick on bare ground, 1/4096
    inflow_65536: u32,        // chance that an open upwind edge cell lets a slab in, 1/65536
    wear_65536: u32,          // chance that bare soft rock loses a quantum, 1/65536
    growth: i32,              // of cover between two looks, at best
    best_burial: i32,         // between two looks, quanta
    tolerance: i32,           // burial away from the best at which plants neither grow nor die, quanta
    padding: u32,
}

@group(1) @binding(0) var<uniform> dunes: Dunes;
