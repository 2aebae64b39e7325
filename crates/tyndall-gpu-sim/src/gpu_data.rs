//! Uniforms of the automata and how they follow from the rules.

use tyndall_dunes::direction::Direction;
use tyndall_dunes::ripples::RippleRule;
use tyndall_dunes::slab::{DuneField, DuneKeys};
use tyndall_dunes::{Edges, Lattice};

/// Twin of `Sand` in `shaders/dunes/sand.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Sand {
    pub size: [u32; 2],
    pub wind: [i32; 2],
    pub keys: [u32; 4],
    pub fall: i32,
    pub open: u32,
    pub stamp: u32,
    pub padding: u32,
}

impl Sand {
    /// A periodic bed without shadows.
    #[must_use]
    pub fn new(lattice: Lattice, wind: Direction, keys: [u32; 4]) -> Self {
        let size = lattice.size().map(narrow);
        Self { size, wind: [wind.x, wind.y], keys, fall: 0, open: 0, stamp: 0, padding: 0 }
    }

    /// A step of a field of dunes.
    #[must_use]
    pub fn of_dunes(field: &DuneField, lattice: Lattice, step: u32) -> Self {
        let DuneKeys { lift, inflow, slide, abrasion } = field.keys(step);
        let rule = field.rule();
        Self {
            // A line that does not fall has no reach; the CPU lets it fall by a quantum, too.
            fall: rule.shadow_fall.max(1),
            open: u32::from(field.edges() == Edges::Open),
            // Passes are counted from 1, as tiles that never moved say 0.
            stamp: step.wrapping_mul(rule.slide_passes).wrapping_add(1),
            ..Self::new(lattice, field.winds().direction(step), [lift, inflow, slide, abrasion])
        }
    }
}

/// Cells along which an invocation slides a sum; at most the shortest side of a bed.
const MEAN_STRETCH_CELLS: i32 = 16;

/// Twin of `SandPass` in `shaders/dunes/sand.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct SandPass {
    pub axis: [i32; 2],
    pub first: i32,
    pub last: i32,
    pub stride: i32,
    pub number: u32,
    pub padding0: u32,
    pub padding1: u32,
}

impl SandPass {
    /// Pass of a number.
    #[must_use]
    pub fn numbered(number: u32) -> Self {
        Self { number, ..Self::default() }
    }

    /// The passes of a shadow that reaches `reach_cells` far, a power of two: four taps each, the last maybe two.
    #[must_use]
    pub fn of_shadow(reach_cells: i32) -> Vec<Self> {
        let mut passes = vec![Self { first: 1, last: reach_cells.min(4), stride: 1, ..Self::default() }];
        let mut covered = 4;
        while covered < reach_cells {
            let taps = (reach_cells / covered).min(4);
            passes.push(Self { first: 0, last: taps - 1, stride: covered, ..Self::default() });
            covered *= taps;
        }
        passes
    }

    /// Invocations that average a whole bed along the pass's axis: each line of it in stretches.
    #[must_use]
    pub fn stretches(&self, lattice: Lattice) -> [u32; 2] {
        let [nx, ny] = lattice.size().map(narrow);
        let stride = self.stride.unsigned_abs().max(1);
        if self.axis[0] == 0 { [nx, ny / stride] } else { [ny, nx / stride] }
    }

    /// Averages over `taps` cells around each, along rows and along columns.
    #[must_use]
    pub fn of_means(lattice: Lattice, square_cells: usize) -> [Self; 2] {
        let [nx, ny] = lattice.size();
        [([1, 0], nx), ([0, 1], ny)].map(|(axis, side)| {
            let half = narrow(square_cells.min(side) / 2).cast_signed();
            Self { axis, first: -half, last: half - 1, stride: MEAN_STRETCH_CELLS, ..Self::default() }
        })
    }
}

/// Twin of `Ripples` in `shaders/dunes/ripples.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Ripples {
    pub hop_256: i32,
    pub hop_per_height_256: i32,
    pub layer: i32,
    pub creep_side: i32,
    pub creep_corner: i32,
    pub creep_limit: i32,
    pub dither: i32,
    pub bedrock: i32,
}

impl From<&RippleRule> for Ripples {
    fn from(rule: &RippleRule) -> Self {
        Self {
            hop_256: rule.hop_256,
            hop_per_height_256: rule.hop_per_height_256,
            layer: rule.layer,
            creep_side: rule.creep_side,
            creep_corner: rule.creep_corner,
            creep_limit: rule.creep_limit,
            dither: rule.dither,
            bedrock: rule.bedrock,
        }
    }
}

/// Twin of `Dunes` in `shaders/dunes/dunes.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Dunes {
    pub repose: [i32; 2],
    pub rest: [i32; 2],
    pub plant_repose: [i32; 2],
    pub slab: i32,
    pub lift_256: u32,
    pub hop_256: i32,
    pub speed_up_256: i32,
    pub drop_on_sand_4096: u32,
    pub drop_on_bare_4096: u32,
    pub inflow_65536: u32,
    pub wear_65536: u32,
    pub growth: i32,
    pub best_burial: i32,
    pub tolerance: i32,
    pub padding: u32,
}

impl From<&DuneField> for Dunes {
    fn from(field: &DuneField) -> Self {
        let (rule, plants) = (field.rule(), field.plant_rule());
        Self {
            repose: rule.repose,
            rest: rule.rest,
            // Without plants there is no cover, and these count for nothing.
            plant_repose: plants.map_or([0, 0], |plants| plants.repose),
            slab: rule.slab,
            lift_256: rule.lift_256,
            hop_256: rule.hop_256,
            speed_up_256: rule.speed_up_256,
            drop_on_sand_4096: rule.drop_on_sand_4096,
            drop_on_bare_4096: rule.drop_on_bare_4096,
            inflow_65536: rule.inflow_65536,
            wear_65536: field.rock().map_or(0, |rock| rock.rate_65536),
            growth: plants.map_or(0, |plants| plants.growth),
            best_burial: plants.map_or(0, |plants| plants.best_burial),
            tolerance: plants.map_or(1, |plants| plants.tolerance),
            padding: 0,
        }
    }
}

/// Sides and counts of a bed fit into 32 bits.
pub(crate) fn narrow(cells: usize) -> u32 {
    u32::try_from(cells).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Farthest cell that some chain of taps, one of each pass, reaches.
    fn reach(passes: &[SandPass]) -> i32 {
        passes.iter().map(|pass| pass.last * pass.stride).sum()
    }

    #[test]
    fn shadow_passes_reach_every_cell_up_to_the_last() {
        for reach_cells in [4, 8, 16, 32, 64, 128, 256] {
            let passes = SandPass::of_shadow(reach_cells);
            assert_eq!(reach(&passes), reach_cells, "{passes:?}");
            let mut covered = 4;
            for pass in &passes[1..] {
                assert_eq!(pass.stride, covered, "a pass goes on where the last ended: {passes:?}");
                covered *= pass.last + 1;
            }
        }
    }

    #[test]
    fn means_of_a_small_bed_go_around_it_once() {
        let lattice = Lattice::new([16, 128]).unwrap();
        let [rows, columns] = SandPass::of_means(lattice, 64);
        assert_eq!((rows.axis, rows.first, rows.last), ([1, 0], -8, 7), "16 cells along x");
        assert_eq!((columns.axis, columns.first, columns.last), ([0, 1], -32, 31), "64 along y");
        let invocations = [rows, columns].map(|pass| pass.stretches(lattice));
        assert_eq!(invocations, [[128, 1], [16, 8]], "every line in stretches of 16 cells");
    }
}
