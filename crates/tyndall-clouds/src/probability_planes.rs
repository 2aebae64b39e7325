//! Probabilities as bit planes, and the draws against them.
//!
//! A draw is "16 random bits < p", for 32 heights of 16 columns at once: from the most significant bit down, a cell whose
//! random bit differs from the bit of p is decided, less when p has the 1. Undecided cells halve with each plane, so that
//! about eleven of the sixteen random words are ever made for 512 cells, and only for cells that a draw can change; a
//! number is a hash of its place, so that those left out are missed by nobody. p is exact to 2^-17; 0 is never and 1 always.
//!
//! Groups of columns in which p is 0 have no planes, and a group equal to the one before shares its planes.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use rayon::prelude::*;
use tyndall_core::rng::{CellRng, WordHash};

use crate::bit_field::{HEIGHTS_PER_LAYER, LANES, Lanes};
use crate::probability::{ProbabilityLayer, ProbabilityRow};

/// Bits of a probability.
pub(crate) const PRECISION_BITS: usize = 16;
/// The probability 1 as an integer.
const ALWAYS: u32 = 1 << PRECISION_BITS;
/// Plane of cells that are always drawn; then those that are sometimes, then the bits from the most significant down.
const PLANES: usize = PRECISION_BITS + 2;
/// Offset of a group without planes.
const NONE: u32 = u32::MAX;

/// The planes of one group of columns.
type Group = [Lanes; PLANES];

/// Bit planes of one probability in one row of one layer.
#[derive(Clone, Debug, Default)]
pub(crate) struct PlaneRow {
    groups: Vec<u32>,
    planes: Vec<Group>,
}

/// Bit planes of extinction, humidity and activation for the whole grid.
#[derive(Clone, Debug)]
pub(crate) struct ProbabilityPlanes {
    /// Row y of layer l at l * ny + y.
    rows: Vec<[PlaneRow; 3]>,
    ny: usize,
    /// How far the planes have moved east and north since they were made, in a grid that repeats (cells).
    moved: [usize; 2],
}

/// The hashes of one field's random bits in one step.
pub(crate) type DrawHashes = [WordHash; PRECISION_BITS];

/// The hashes for draws of stream `stream`.
pub(crate) fn draw_hashes(rng: CellRng, step: u32, stream: u32) -> DrawHashes {
    let mut plane = 0;
    [(); PRECISION_BITS].map(|()| {
        plane += 1;
        rng.word_hash(step, stream, plane - 1)
    })
}

/// A probability as a whole number of 2^-16.
#[expect(clippy::cast_possible_truncation, reason = "clamped to 0..=65536 before the cast; NaN gives 0")]
pub(crate) fn quantise(probability: f32) -> u32 {
    // Adding a half and cutting off rounds; `round` is a call on processors without SSE 4.1.
    (probability.clamp(0.0, 1.0) * ALWAYS as f32 + 0.5) as u32
}

impl ProbabilityPlanes {
    /// The planes of a stack of layers over a grid of [nx, ny, nz] cells.
    pub(crate) fn new(size: [usize; 3], stack: &[Box<dyn ProbabilityLayer>]) -> Self {
        let [_, ny, nz] = size;
        let rows = (0..nz.div_ceil(HEIGHTS_PER_LAYER) * ny)
            .into_par_iter()
            .map(|index| plane_rows(size, stack, index / ny, index % ny))
            .collect();
        Self { rows, ny, moved: [0; 2] }
    }

    /// Moves everything by whole cells in a grid that repeats.
    pub(crate) fn shift(&mut self, size: [usize; 3], cells: [i64; 2]) {
        for axis in [0, 1] {
            let side = i64::try_from(size[axis]).unwrap_or(i64::MAX);
            let moved = i64::try_from(self.moved[axis]).unwrap_or(0) + cells[axis];
            self.moved[axis] = usize::try_from(moved.rem_euclid(side)).unwrap_or(0);
        }
    }

    /// How far east the columns of [`ProbabilityPlanes::row`] have to be moved (cells).
    pub(crate) fn east(&self) -> usize {
        self.moved[0]
    }

    /// Extinction, humidity and activation of a row.
    pub(crate) fn row(&self, layer: usize, y: usize) -> &[PlaneRow; 3] {
        &self.rows[layer * self.ny + (y + self.ny - self.moved[1]) % self.ny]
    }
}

/// Evaluates a stack in one row of one layer.
fn plane_rows(size: [usize; 3], stack: &[Box<dyn ProbabilityLayer>], layer: usize, y: usize) -> [PlaneRow; 3] {
    let [nx, _, nz] = size;
    let padded = nx.next_multiple_of(LANES);
    let heights = HEIGHTS_PER_LAYER.min(nz - layer * HEIGHTS_PER_LAYER);
    let mut row = ProbabilityRow::zeros(nx);
    let mut quantised = [(); 3].map(|()| vec![0_u32; padded * HEIGHTS_PER_LAYER]);
    for height in 0..heights {
        row.fill(crate::Probabilities::default());
        for part in stack {
            part.apply(y, layer * HEIGHTS_PER_LAYER + height, &mut row);
        }
        for (values, target) in row.fields().into_iter().zip(&mut quantised) {
            let target = &mut target[height * padded..][..nx];
            target.iter_mut().zip(values).for_each(|(target, &value)| *target = quantise(value));
        }
    }
    let arch = pulp::Arch::new();
    quantised.map(|values| arch.dispatch(Transpose { values: &values, padded }))
}

/// Turns the numbers of a row into planes.
struct Transpose<'a> {
    values: &'a [u32],
    padded: usize,
}

impl pulp::WithSimd for Transpose<'_> {
    type Output = PlaneRow;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) -> PlaneRow {
        let mut row = PlaneRow::default();
        let mut before = [[0; LANES]; HEIGHTS_PER_LAYER];
        row.groups.reserve(self.padded / LANES);
        for first in (0..self.padded).step_by(LANES) {
            let mut numbers = [[0; LANES]; HEIGHTS_PER_LAYER];
            for (numbers, row) in numbers.iter_mut().zip(self.values.chunks_exact(self.padded)) {
                numbers.copy_from_slice(&row[first..first + LANES]);
            }
            if numbers == [[0; LANES]; HEIGHTS_PER_LAYER] {
                row.groups.push(NONE);
                continue;
            }
            if row.planes.is_empty() || numbers != before {
                row.planes.push(group_planes(numbers));
                before = numbers;
            }
            row.groups.push(u32::try_from(row.planes.len() - 1).unwrap_or(NONE));
        }
        row
    }
}

/// The planes of one group from its numbers, height by height.
#[inline(always)]
fn group_planes(mut numbers: [Lanes; HEIGHTS_PER_LAYER]) -> Group {
    transpose(&mut numbers);
    let mut group = [[0; LANES]; PLANES];
    group[0] = numbers[PRECISION_BITS];
    for bit in 0..PRECISION_BITS {
        let plane = numbers[PRECISION_BITS - 1 - bit];
        for lane in 0..LANES {
            group[1][lane] |= plane[lane];
        }
        group[2 + bit] = plane;
    }
    group
}

/// Bit b of number h becomes bit h of number b, in each lane: blocks of 16, 8, 4, 2 and 1 bits change places.
#[inline(always)]
fn transpose(numbers: &mut [Lanes; HEIGHTS_PER_LAYER]) {
    for (width, mask) in [(16, 0x0000_FFFF), (8, 0x00FF_00FF), (4, 0x0F0F_0F0F), (2, 0x3333_3333), (1, 0x5555_5555)] {
        for first in (0..HEIGHTS_PER_LAYER).filter(|first| first & width == 0) {
            let (mut low, mut high) = (numbers[first], numbers[first + width]);
            for (low, high) in low.iter_mut().zip(&mut high) {
                let changed: u32 = ((*low >> width) ^ *high) & mask;
                *low ^= changed << width;
                *high ^= changed;
            }
            numbers[first] = low;
            numbers[first + width] = high;
        }
    }
}

impl PlaneRow {
    /// The planes of a group of columns; none where p is 0.
    #[inline(always)]
    fn group(&self, group: usize) -> Option<&Group> {
        self.planes.get(self.groups[group] as usize)
    }
}

/// What a draw does to the bits of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effect {
    /// Drawn cells become 0; only those at 1 need a draw.
    Clear,
    /// Drawn cells become 1; only those at 0 need a draw.
    Set,
}

/// Draws for one row of one layer: `bits` are its padded words, `first` the number of its first column.
#[inline(always)]
pub(crate) fn draw_row(planes: &PlaneRow, (hashes, first): (&DrawHashes, u32), effect: Effect, bits: &mut [u32]) {
    let mut column = first;
    for (index, words) in bits.chunks_exact_mut(LANES).enumerate() {
        if let (Some(group), Ok(words)) = (planes.group(index), <&mut Lanes>::try_from(words)) {
            draw_words(group, (hashes, columns_from(column)), effect, words);
        }
        column = column.wrapping_add(16);
    }
}

/// [`draw_row`] with planes that have moved `east` cells in a grid that repeats: `bits` are the row's words without padding.
#[inline(always)]
pub(crate) fn draw_row_shifted(
    planes: &PlaneRow,
    (hashes, first): (&DrawHashes, u32),
    effect: Effect,
    bits: &mut [u32],
    east: usize,
) {
    let nx = bits.len();
    for (index, begin) in (0..nx).step_by(LANES).enumerate() {
        let Some(group) = planes.group(index) else { continue };
        let place = (begin + east) % nx;
        let count = LANES.min(nx - begin);
        if let Some(Ok(words)) =
            bits.get_mut(place..place + LANES).filter(|_| count == LANES).map(<&mut Lanes>::try_from)
        {
            draw_words(group, (hashes, columns_from(number(first, place))), effect, words);
            continue;
        }
        // The group lies across the end of the row, or is its last and not full.
        let (mut words, mut columns) = ([0; LANES], [0; LANES]);
        for lane in 0..count {
            let place = (place + lane) % nx;
            (words[lane], columns[lane]) = (bits[place], number(first, place));
        }
        draw_words(group, (hashes, columns), effect, &mut words);
        for lane in 0..count {
            bits[(place + lane) % nx] = words[lane];
        }
    }
}

/// Number of the column at a place of a row.
#[inline(always)]
fn number(first: u32, place: usize) -> u32 {
    first.wrapping_add(u32::try_from(place).unwrap_or(u32::MAX))
}

/// Numbers of the columns of a group.
#[inline(always)]
fn columns_from(first: u32) -> Lanes {
    let mut columns = [0; LANES];
    let mut index = first;
    for column in &mut columns {
        *column = index;
        index = index.wrapping_add(1);
    }
    columns
}

/// Draws for one group.
#[inline(always)]
fn draw_words(group: &Group, (hashes, columns): (&DrawHashes, Lanes), effect: Effect, words: &mut Lanes) {
    let drawn = draw_group(group, (hashes, columns), effect, words);
    for lane in 0..LANES {
        match effect {
            Effect::Clear => words[lane] &= !drawn[lane],
            Effect::Set => words[lane] |= drawn[lane],
        }
    }
}

/// The cells of a group that are drawn, as far as they matter.
#[inline(always)]
fn draw_group(group: &Group, (hashes, columns): (&DrawHashes, Lanes), effect: Effect, words: &Lanes) -> Lanes {
    let mut drawn = group[0];
    let mut undecided = group[1];
    for lane in 0..LANES {
        undecided[lane] &= if effect == Effect::Clear { words[lane] } else { !words[lane] };
    }
    for (plane, hash) in group[2..].iter().zip(hashes) {
        if is_zero(&undecided) {
            break;
        }
        for lane in 0..LANES {
            let random = hash.word(columns[lane]);
            drawn[lane] |= undecided[lane] & plane[lane] & !random;
            undecided[lane] &= !(plane[lane] ^ random);
        }
    }
    drawn
}

#[inline(always)]
fn is_zero(lanes: &Lanes) -> bool {
    let mut any = 0;
    for lane in lanes {
        any |= lane;
    }
    any == 0
}

/// A draw of the same probability for the 32 heights of one column.
pub(crate) fn draw_word(quantised: u32, hashes: &DrawHashes, column: u32) -> u32 {
    if quantised >= ALWAYS {
        return u32::MAX;
    }
    let (mut drawn, mut undecided) = (0, u32::MAX);
    for (bit, hash) in hashes.iter().enumerate() {
        let plane = if (quantised >> (PRECISION_BITS - 1 - bit)) & 1 == 1 { u32::MAX } else { 0 };
        let random = hash.word(column);
        drawn |= undecided & plane & !random;
        undecided &= !(plane ^ random);
    }
    drawn
}

/// The draw of one cell, bit by bit: what the planes do for 512 cells at once.
pub(crate) fn draw_cell(probability: f32, hashes: &DrawHashes, column: u32, height: usize) -> bool {
    (draw_word(quantise(probability), hashes, column) >> (height % HEIGHTS_PER_LAYER)) & 1 == 1
}
