//! The ripple rule under a wind in any direction: slower, and bit for bit the fused step when the wind is along +x.

use super::nishimori_ouchi1993::creep;
use super::rule::{LEE_REACH_CELLS, RippleRule};
use crate::deposits::Bands;
use crate::direction::Direction;
use crate::edges::Edges;
use crate::hash::cell_word;
use crate::lattice::Lattice;
use crate::shadow;

/// One step from `heights` to `out`; `keys` are those of the dithering along x and along y.
pub(super) fn step(
    rule: &RippleRule,
    keys: [u32; 2],
    wind: Direction,
    lattice: Lattice,
    heights: &[i32],
    out: &mut [i32],
) {
    let mut change = vec![0; heights.len()];
    if rule.saltates != 0 {
        let line = lee_line(rule, wind, lattice, heights);
        Bands::new(lattice).collect(&mut change, |rows, sink| {
            for index in rows.start * lattice.nx()..rows.end * lattice.nx() {
                let height = heights[index];
                let in_lee = line.as_ref().is_some_and(|line| line[index] > height);
                if !in_lee && height - rule.bedrock >= rule.layer {
                    sink.add(index, -rule.layer);
                    sink.add(landing(rule, keys, wind, lattice, index, height), rule.layer);
                }
            }
        });
    }
    for (change, height) in change.iter_mut().zip(heights) {
        *change += height;
    }
    creep_all(rule, lattice, &change, out);
}

fn lee_line(rule: &RippleRule, wind: Direction, lattice: Lattice, heights: &[i32]) -> Option<Vec<i32>> {
    (rule.lee_fall != 0).then(|| {
        let mut line = shadow::ShadowLine::new(lattice);
        line.cast(heights, wind, rule.lee_fall, LEE_REACH_CELLS, Edges::Periodic);
        line.into_heights()
    })
}

/// Index of the cell where the layer of cell `index` lands.
fn landing(rule: &RippleRule, keys: [u32; 2], wind: Direction, lattice: Lattice, index: usize, height: i32) -> usize {
    let byte = |key: u32| i32::from(cell_word(key, (index / 4) as u32).to_le_bytes()[index % 4]);
    let dither = keys.map(|key| if rule.dither == 0 { 0 } else { byte(key) });
    let [dx, dy] = wind.hop(rule.hop_length_256(height), dither);
    let [x, y] = lattice.position(index);
    lattice.index(x as i32 + dx, y as i32 + dy)
}

/// Creep of the whole bed, each flux computed at both of its ends.
fn creep_all(rule: &RippleRule, lattice: Lattice, heights: &[i32], out: &mut [i32]) {
    for (index, out) in out.iter_mut().enumerate() {
        let [x, y] = lattice.position(index).map(|part| part as i32);
        let from = |dx: i32, dy: i32, share: i32| {
            creep(heights[lattice.index(x + dx, y + dy)] - heights[index], share, rule.creep_limit)
        };
        let sides: i32 = [(1, 0), (-1, 0), (0, 1), (0, -1)].map(|(dx, dy)| from(dx, dy, rule.creep_side)).iter().sum();
        let corners: i32 =
            [(1, 1), (-1, 1), (1, -1), (-1, -1)].map(|(dx, dy)| from(dx, dy, rule.creep_corner)).iter().sum();
        *out = heights[index] + sides + corners;
    }
}
