//! The transition rule of Nagel and Raschke 1992 (Physica A 182, 519), 32 heights at a time.
//!
//! With all right sides at time t, hum' = hum & !act, cld' = cld | act, act' = !act & hum & f, where f is the OR of act over
//! eleven neighbours: (+-1,0,0), (+-2,0,0), (0,+-1,0), (0,+-2,0), (0,0,+-1) and (0,0,-2). Two cells above is no neighbour,
//! so cloud grows two cells a step sideways and upwards and one downwards.
//!
//! 18 logic operations, 12 loads and 3 stores for 32 cells.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use crate::bit_field::{BitField, GUARD};

/// What the rule reads for one row of one layer of act.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbourhood<'a> {
    /// The row itself and the rows 2 before, 1 before, 1 after, 2 after, with guards.
    here: &'a [u32],
    across: [&'a [u32]; 4],
    /// The same row in the layers below and above, with guards; zeros where there is none.
    below: &'a [u32],
    above: &'a [u32],
}

impl<'a> Neighbourhood<'a> {
    /// Of row `y` in a layer of act; `zeros` is a guarded row of zeros.
    pub(crate) fn new(act: &'a BitField, layer: usize, y: usize, zeros: &'a [u32]) -> Self {
        let row = |dy: isize| act.guarded_row(layer, y, dy);
        Self {
            here: row(0),
            across: [row(-2), row(-1), row(1), row(2)],
            below: if layer > 0 { act.guarded_row(layer - 1, y, 0) } else { zeros },
            above: if layer + 1 < act.layer_count() { act.guarded_row(layer + 1, y, 0) } else { zeros },
        }
    }
}

/// Makes one step of one row; all slices of the state have the row's nx words, `next` takes act'.
#[inline(always)]
pub(crate) fn transition_row(n: &Neighbourhood<'_>, hum: &mut [u32], cld: &mut [u32], next: &mut [u32]) {
    let nx = hum.len();
    let (cld, next) = (&mut cld[..nx], &mut next[..nx]);
    let [x0, x1, here, x3, x4] = [0, 1, 2, 3, 4].map(|offset| &n.here[offset..offset + nx]);
    let [y0, y1, y3, y4] = n.across.map(|row| &row[GUARD..GUARD + nx]);
    let (below, above) = (&n.below[GUARD..GUARD + nx], &n.above[GUARD..GUARD + nx]);
    for i in 0..nx {
        let act = here[i];
        let sideways = x0[i] | x1[i] | x3[i] | x4[i] | y0[i] | y1[i] | y3[i] | y4[i];
        let upwards = (act << 1) | (act << 2) | (below[i] >> 31) | (below[i] >> 30);
        let downwards = (act >> 1) | (above[i] << 31);
        let left = hum[i] & !act;
        next[i] = left & (sideways | upwards | downwards);
        hum[i] = left;
        cld[i] |= act;
    }
}
