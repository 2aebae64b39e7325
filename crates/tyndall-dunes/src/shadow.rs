//! Wind shadow: for each cell the height of the highest line that falls downwind from any upwind cell.
//!
//! A line starts at the bed of an upwind cell and falls at the shadow's angle; a cell whose bed lies below one is in the
//! lee. The greatest of all lines is a scan of maximum and sum, taken in passes of up to four taps: each pass covers four
//! times the distance of the last, in any direction, at the price of rounding taps to whole cells. The same passes over
//! heights without a fall date the horizon.

use rayon::prelude::*;

use crate::direction::Direction;
use crate::edges::Edges;
use crate::lattice::Lattice;

/// Taps of a pass.
const RADIX: i32 = 4;
/// Height of a line where nothing upwind casts one.
const NO_LINE: i32 = i32::MIN / 2;

/// Heights of the shadow lines, in the quanta of the bed.
#[derive(Clone, Debug)]
pub struct ShadowLine {
    lattice: Lattice,
    heights: Vec<i32>,
    copy: Vec<i32>,
}

/// One of the taps of a pass.
#[derive(Clone, Copy, Debug)]
struct Tap {
    offset: [i32; 2],
    fall: i32,
}

impl ShadowLine {
    /// Lines over a bed of this size.
    #[must_use]
    pub fn new(lattice: Lattice) -> Self {
        let heights = vec![NO_LINE; lattice.cells()];
        Self { lattice, copy: heights.clone(), heights }
    }

    /// Casts the lines of `bed` that fall by `fall` quanta a cell along `wind`, up to `reach` cells far: a power of two.
    /// Reaches beyond the bed's relief over `fall` change nothing that is compared with the bed.
    pub fn cast(&mut self, bed: &[i32], wind: Direction, fall: i32, reach: i32, edges: Edges) {
        let mut covered = RADIX.min(reach);
        let taps: Vec<_> = (1..=covered).map(|far| Tap { offset: wind.offset(far), fall: far * fall }).collect();
        pass(self.lattice, edges, &taps, bed, &mut self.heights);
        while covered < reach {
            let radix = RADIX.min(reach / covered);
            let far = (0..radix).map(|tap| tap * covered);
            let taps: Vec<_> = far.map(|far| Tap { offset: wind.offset(far), fall: far * fall }).collect();
            pass(self.lattice, edges, &taps, &self.heights, &mut self.copy);
            std::mem::swap(&mut self.heights, &mut self.copy);
            covered *= radix;
        }
    }

    /// Heights of the lines (quanta), far below any bed where there is none.
    #[must_use]
    pub fn heights(&self) -> &[i32] {
        &self.heights
    }

    /// The heights alone.
    #[must_use]
    pub fn into_heights(self) -> Vec<i32> {
        self.heights
    }
}

/// For each cell of `out` the greatest of the taps' sources less their falls.
fn pass(lattice: Lattice, edges: Edges, taps: &[Tap], source: &[i32], out: &mut [i32]) {
    let (nx, ny) = (lattice.nx(), lattice.ny());
    let rows = (ny / 32).max(8).min(ny);
    out.par_chunks_mut(rows * nx).enumerate().for_each(|(band, out)| {
        pulp::Arch::new().dispatch(Band { lattice, edges, taps, source, first_row: band * rows, out });
    });
}

/// A band of rows of a pass, for the widest vector instructions that this computer has.
struct Band<'a> {
    lattice: Lattice,
    edges: Edges,
    taps: &'a [Tap],
    source: &'a [i32],
    first_row: usize,
    out: &'a mut [i32],
}

impl pulp::NullaryFnOnce for Band<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (nx, ny) = (self.lattice.nx(), self.lattice.ny());
        let periodic = self.edges == Edges::Periodic;
        for (row, out) in self.out.chunks_exact_mut(nx).enumerate() {
            out.fill(NO_LINE);
            for tap in self.taps {
                let from = (self.first_row + row) as i32 - tap.offset[1];
                let past_rows = tap.offset[0].unsigned_abs() as usize >= nx;
                if !periodic && (past_rows || !(0..ny as i32).contains(&from)) {
                    continue;
                }
                let source = &self.source[self.lattice.index(0, from)..][..nx];
                raise_row(out, source, tap, periodic);
            }
        }
    }
}

/// Raises a row to a tap's source where that is higher.
#[inline(always)]
fn raise_row(out: &mut [i32], source: &[i32], tap: &Tap, periodic: bool) {
    let nx = out.len();
    let shift = (tap.offset[0] as usize) & (nx - 1);
    let (inside, wrapped) = source.split_at(nx - shift);
    let (out_wrapped, out_inside) = out.split_at_mut(shift);
    let raise = |out: &mut [i32], source: &[i32]| {
        for (out, &source) in out.iter_mut().zip(source) {
            *out = (*out).max(source - tap.fall);
        }
    };
    // A tap to the west (negative offset) shifts by nx - |offset|: then it is the other part that wraps.
    if periodic || tap.offset[0] >= 0 {
        raise(out_inside, inside);
    }
    if periodic || tap.offset[0] < 0 {
        raise(out_wrapped, wrapped);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::cell_word;

    fn rough_bed(lattice: Lattice) -> Vec<i32> {
        (0..).take(lattice.cells()).map(|cell| (cell_word(3, cell) >> 22) as i32).collect()
    }

    #[test]
    fn the_scan_along_a_row_is_the_maximum_over_all_upwind_cells() {
        let lattice = Lattice::new([64, 16]).unwrap();
        let bed = rough_bed(lattice);
        for (edges, wind_deg) in
            [(Edges::Periodic, 0.0), (Edges::Open, 0.0), (Edges::Periodic, 90.0), (Edges::Open, 180.0)]
        {
            let wind = Direction::from_degrees(wind_deg);
            let mut line = ShadowLine::new(lattice);
            line.cast(&bed, wind, 50, 32, edges);
            for (index, &height) in line.heights().iter().enumerate() {
                let [x, y] = lattice.position(index).map(|part| part as i32);
                let upwind = (1..=32).map(|far| ([x, y], wind.offset(far), far));
                let inside = upwind.filter(|([x, y], [dx, dy], _)| {
                    edges == Edges::Periodic || ((0..64).contains(&(x - dx)) && (0..16).contains(&(y - dy)))
                });
                let lines = inside.map(|([x, y], [dx, dy], far)| bed[lattice.index(x - dx, y - dy)] - 50 * far);
                let expected = lines.max().unwrap_or(NO_LINE);
                assert!(
                    height == expected || (height < -1000 && expected == NO_LINE),
                    "({x}, {y}), {wind_deg} deg, {edges:?}: {height} of {expected}"
                );
            }
        }
    }

    #[test]
    fn on_a_narrow_open_bed_no_line_comes_back_over_the_far_edge() {
        let lattice = Lattice::new([16, 256]).unwrap();
        let mut bed = vec![0; lattice.cells()];
        bed[lattice.index(4, 10)] = 100_000;
        let wind = Direction::from_degrees(60.0);
        let mut line = ShadowLine::new(lattice);
        line.cast(&bed, wind, 50, 256, Edges::Open);
        // The line leaves over the right edge, 12 columns on, within 12 tan 60 = 21 rows.
        let dark = (0..lattice.cells()).filter(|&index| line.heights()[index] > bed[index]);
        let rows: Vec<usize> = dark.map(|index| lattice.position(index)[1]).collect();
        assert!(rows.iter().all(|row| (10..=34).contains(row)) && rows.len() >= 12, "rows in the shadow: {rows:?}");
    }

    #[test]
    fn a_post_casts_a_shadow_of_the_right_length_in_any_direction() {
        let lattice = Lattice::new([128, 128]).unwrap();
        let mut bed = vec![0; lattice.cells()];
        bed[lattice.index(64, 64)] = 1000;
        for degree in (0..360).step_by(5) {
            let wind = Direction::from_degrees(f64::from(degree));
            let mut line = ShadowLine::new(lattice);
            line.cast(&bed, wind, 50, 64, Edges::Periodic);
            // 1000 / 50 = 20 cells end exactly at the bed, which is not below the line; taps are rounded to whole cells.
            let dark = (0..lattice.cells()).filter(|&index| line.heights()[index] > 0);
            let lengths: Vec<f64> = dark
                .map(|index| {
                    let [x, y] = lattice.position(index).map(|part| part as f64 - 64.0);
                    let (sin, cos) = f64::from(degree).to_radians().sin_cos();
                    assert!((y * cos - x * sin).abs() < 1.3, "{degree} deg: ({x}, {y}) is beside the shadow");
                    x * cos + y * sin
                })
                .collect();
            let longest = lengths.iter().copied().fold(0.0, f64::max);
            assert!(
                (longest - 19.0).abs() < 1.3 && lengths.len() >= 13,
                "{degree} deg: {longest} cells, {} dark",
                lengths.len()
            );
        }
    }
}
