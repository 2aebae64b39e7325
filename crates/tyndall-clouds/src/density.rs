//! Density between the steps of an automaton, moving evenly with the wind.
//!
//! Cloud moves by whole cells and changes by whole steps; a picture must show neither. The last steps are kept and moved
//! along with every later wind, so that smoothing over time does not smear what the wind carries. Between two steps density
//! is interpolated linearly, as the paper does, and each height is drawn at the place where the wind's exact displacement
//! has it, a fraction of a cell from where its bits stand. Density lags behind the automaton by the window's reach in time.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use std::collections::VecDeque;

use rayon::prelude::*;
use tyndall_core::grid::Grid3;

use crate::automaton::Automaton;
use crate::bit_field::BitField;
use crate::edges::Edges;
use crate::error::{CloudError, in_range, same_size};
use crate::shift::shift_field;
use crate::smoothing::{SmoothingWindow, TAPS, smooth};
use crate::wind::ShiftPlan;

/// Steps that are kept: a window, and the one before it.
const KEPT: usize = TAPS + 1;

/// The last states of cld, and the density made of them.
#[derive(Clone, Debug)]
pub struct CloudDensity {
    window: SmoothingWindow,
    edges: Edges,
    /// cld of the last steps in the present place of their air, newest first.
    history: VecDeque<BitField>,
    sums: Grid3<u16>,
}

impl CloudDensity {
    /// Begins with the automaton's present clouds, as if they had stood still so far.
    #[must_use]
    pub fn new(automaton: &Automaton, window: SmoothingWindow) -> Self {
        let history = (0..KEPT).map(|_| automaton.fields().cld.clone()).collect();
        Self { window, edges: automaton.edges(), history, sums: Grid3::filled(automaton.size(), 0) }
    }

    /// The window of the smoothing.
    #[must_use]
    pub fn window(&self) -> SmoothingWindow {
        self.window
    }

    /// cld of the last steps, newest first, for files.
    #[must_use]
    pub fn history(&self) -> &VecDeque<BitField> {
        &self.history
    }

    /// Puts back what [`CloudDensity::history`] gave.
    ///
    /// # Errors
    /// When there are not as many fields of the same size.
    pub fn set_history(&mut self, history: VecDeque<BitField>) -> Result<(), CloudError> {
        if history.len() != KEPT {
            let what = "the history of cloud cells".to_owned();
            return Err(CloudError::WrongLength { what, found: history.len(), expected: KEPT });
        }
        if let Some(other) = history.iter().find(|field| field.size() != self.size()) {
            let (found, expected) = (other.size().to_vec(), self.size().to_vec());
            return Err(CloudError::OtherSize { what: "the history of cloud cells".to_owned(), found, expected });
        }
        self.history = history;
        Ok(())
    }

    /// Takes up the automaton's new clouds; `plan` is what [`Automaton::step`] gave.
    pub fn observe(&mut self, automaton: &Automaton, plan: &ShiftPlan) {
        let Some(mut oldest) = self.history.pop_back() else { return };
        if !plan.is_still() {
            for field in &mut self.history {
                shift_field(field, &mut oldest, plan, self.edges, None);
                std::mem::swap(field, &mut oldest);
            }
        }
        oldest.clone_from(&automaton.fields().cld);
        self.history.push_front(oldest);
    }

    /// Share of cloud (0 to 1) in every cell at a moment between the last two steps: `fraction` 0 is the step before the last,
    /// 1 the last.
    ///
    /// # Errors
    /// When the fraction is outside 0 to 1.
    pub fn at(&mut self, automaton: &Automaton, fraction: f32) -> Result<Grid3<f32>, CloudError> {
        let mut density = Grid3::filled(self.size(), 0.0);
        self.at_into(automaton, fraction, &mut density)?;
        Ok(density)
    }

    /// [`CloudDensity::at`] into a grid that is there already: fresh memory costs as much as the work.
    ///
    /// # Errors
    /// Also when `density` has another size.
    pub fn at_into(
        &mut self,
        automaton: &Automaton,
        fraction: f32,
        density: &mut Grid3<f32>,
    ) -> Result<(), CloudError> {
        in_range("moment between two steps", f64::from(fraction), (0.0, 1.0), "")?;
        same_size("the density", density, self.size())?;
        let (full, wind) = (1.0 / f32::from(self.window.full()), automaton.wind());
        density.cells_mut().fill(0.0);
        for (first_tap, share) in [(0, fraction), (1, 1.0 - fraction)] {
            if share <= 0.0 {
                continue;
            }
            let taps = [0, 1, 2, 3, 4].map(|tap| &self.history[first_tap + tap]);
            smooth(&taps, self.window, self.edges, &mut self.sums);
            let place = |height: usize| {
                let (hidden, speed) = (wind.hidden_cells(height), wind.speed_cells(height));
                [0, 1].map(|axis| hidden[axis] - f64::from(1.0 - fraction) * speed[axis])
            };
            add_moved(&self.sums, share * full, self.edges, place, density);
        }
        Ok(())
    }

    fn size(&self) -> [usize; 3] {
        self.history.front().map_or([0; 3], BitField::size)
    }
}

/// Adds `weight` times the sums, each height moved east and north by `place` cells, linearly interpolated.
fn add_moved(
    sums: &Grid3<u16>,
    weight: f32,
    edges: Edges,
    place: impl Fn(usize) -> [f64; 2] + Sync,
    density: &mut Grid3<f32>,
) {
    let [nx, ny, _] = sums.size();
    let arch = pulp::Arch::new();
    density.cells_mut().par_chunks_exact_mut(nx * ny).enumerate().for_each(|(z, cells)| {
        let sums = &sums.cells()[z * nx * ny..][..nx * ny];
        let [east, north] = place(z).map(Lerp::new);
        arch.dispatch(MovedPlane { sums, size: [nx, ny], weight, edges, east, north, cells });
    });
}

/// One height whose sums are added at another place.
struct MovedPlane<'a> {
    sums: &'a [u16],
    /// [nx, ny].
    size: [usize; 2],
    weight: f32,
    edges: Edges,
    east: Lerp,
    north: Lerp,
    cells: &'a mut [f32],
}

impl pulp::WithSimd for MovedPlane<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        if self.east.is_still() && self.north.is_still() {
            let pairs = self.cells.iter_mut().zip(self.sums);
            return pairs.for_each(|(density, &sum)| *density += self.weight * f32::from(sum));
        }
        let [nx, ny] = self.size;
        // Two rows become one, and that one is moved: each number is read once.
        let (mut line, mut moved) = (vec![0.0; nx], vec![0.0; nx + 1]);
        for (y, row) in self.cells.chunks_exact_mut(nx).enumerate() {
            line.fill(0.0);
            for (tap, share) in self.north.taps() {
                let Some(from) = east_or_north(y, tap, ny, self.edges) else { continue };
                let weight = self.weight * share;
                for (value, &sum) in line.iter_mut().zip(&self.sums[from * nx..][..nx]) {
                    *value += weight * f32::from(sum);
                }
            }
            move_line(&line, self.east.whole, self.edges, &mut moved);
            let [(_, here), (_, before)] = self.east.taps();
            for (x, density) in row.iter_mut().enumerate() {
                *density += here * moved[x + 1] + before * moved[x];
            }
        }
    }
}

/// The cell that is `shift` cells before `index`, if there is one.
fn east_or_north(index: usize, shift: i64, count: usize, edges: Edges) -> Option<usize> {
    let (place, cells) = (i64::try_from(index).ok()? - shift, i64::try_from(count).ok()?);
    let place = if edges == Edges::Wrap { place.rem_euclid(cells) } else { place };
    usize::try_from(place).ok().filter(|&place| place < count)
}

/// A row moved by whole cells, with the cell before its first in front; 0 where an open grid has none.
#[inline(always)]
fn move_line(line: &[f32], whole: i64, edges: Edges, moved: &mut [f32]) {
    let count = i64::try_from(line.len()).unwrap_or(i64::MAX);
    let first = -1 - whole;
    if edges == Edges::Wrap {
        let mut from = usize::try_from(first.rem_euclid(count)).unwrap_or(0);
        let mut rest = moved;
        while !rest.is_empty() {
            let copied = rest.len().min(line.len() - from);
            rest[..copied].copy_from_slice(&line[from..from + copied]);
            (rest, from) = (&mut rest[copied..], 0);
        }
        return;
    }
    moved.fill(0.0);
    // Cells `first..first + moved.len()` of the row, as far as there are such.
    let [from, end] = [first, first + count + 1].map(|place| usize::try_from(place.clamp(0, count)).unwrap_or(0));
    let target = usize::try_from((-first).clamp(0, count + 1)).unwrap_or(0);
    moved[target..target + (end - from)].copy_from_slice(&line[from..end]);
}

/// A shift by a fraction of cells as two shifts by whole cells.
#[derive(Clone, Copy, Debug)]
struct Lerp {
    whole: i64,
    fraction: f32,
}

impl Lerp {
    #[expect(clippy::cast_possible_truncation, reason = "winds are limited to 64 cells a step")]
    fn new(cells: f64) -> Self {
        Self { whole: cells.floor() as i64, fraction: (cells - cells.floor()) as f32 }
    }

    fn is_still(self) -> bool {
        self.whole == 0 && self.fraction <= 0.0
    }

    fn taps(self) -> [(i64, f32); 2] {
        [(self.whole, 1.0 - self.fraction), (self.whole + 1, self.fraction)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AutomatonConfig, CloudFields, WindProfile};

    /// A ball of cloud in dry air, which no rule changes, and its centre of mass east and north.
    fn drifting(edges: Edges, cells_per_step: [f64; 2]) -> (Automaton, CloudDensity) {
        let size = [40, 36, 9];
        let wind = WindProfile::uniform(cells_per_step).unwrap();
        let mut automaton =
            Automaton::new(&AutomatonConfig { size, edges, wind, ..AutomatonConfig::default() }).unwrap();
        let mut fields = CloudFields::new(size).unwrap();
        let distance2 = |x: usize, y: usize, z: usize| {
            (x as f64 - 12.0).powi(2) + (y as f64 - 20.0).powi(2) + (z as f64 - 4.0).powi(2)
        };
        fields.cld.fill_with(|[x, y, z]| distance2(x, y, z) < 10.0);
        automaton.restore(fields, 0).unwrap();
        let density = CloudDensity::new(&automaton, SmoothingWindow::default());
        (automaton, density)
    }

    fn centre(density: &Grid3<f32>) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for [x, y, z] in crate::grid_size::cells(density.size()) {
            let q = f64::from(density[[x, y, z]]);
            sums = [sums[0] + q * x as f64, sums[1] + q * y as f64, sums[2] + q];
        }
        [sums[0] / sums[2], sums[1] / sums[2], sums[2]]
    }

    #[test]
    fn clouds_drift_evenly_at_the_winds_speed_between_and_across_steps() {
        let speed = [0.37, -0.61];
        for edges in [Edges::Open, Edges::Wrap] {
            let (mut automaton, mut density) = drifting(edges, speed);
            let [x0, y0, mass] = centre(&density.at(&automaton, 1.0).unwrap());
            for step in 0..12_u8 {
                let plan = automaton.step();
                density.observe(&automaton, &plan);
                for fraction in [0.0, 0.25, 0.8, 1.0] {
                    let [x, y, now] = centre(&density.at(&automaton, fraction).unwrap());
                    let time = f64::from(step) + f64::from(fraction);
                    assert!((x - x0 - time * speed[0]).abs() < 1e-3, "{edges:?} x at {time}: {}", x - x0);
                    assert!((y - y0 - time * speed[1]).abs() < 1e-3, "{edges:?} y at {time}: {}", y - y0);
                    assert!((now / mass - 1.0).abs() < 1e-4, "{edges:?} mass at {time}: {now} {mass}");
                }
            }
        }
    }

    #[test]
    fn density_is_continuous_across_a_step_while_clouds_form() {
        let size = [32, 32, 16];
        let config =
            AutomatonConfig { size, wind: WindProfile::uniform([0.3, 0.1]).unwrap(), ..AutomatonConfig::default() };
        let mut automaton = Automaton::new(&config).unwrap();
        let probabilities = crate::Probabilities { extinction: 0.1, humidity: 0.1, activation: 0.002 };
        automaton.set_probabilities(vec![Box::new(probabilities)]);
        let mut density = CloudDensity::new(&automaton, SmoothingWindow::default());
        let mut last = None;
        for step in 0..30 {
            let plan = automaton.step();
            density.observe(&automaton, &plan);
            let (begin, end) = (density.at(&automaton, 0.0).unwrap(), density.at(&automaton, 1.0).unwrap());
            if let Some(last) = last.replace(end) {
                // Only the sides, where bits leave the grid, may differ.
                let inner = crate::grid_size::cells(size).filter(|c| c[..2].iter().all(|&i| (4..28).contains(&i)));
                let jump = inner.map(|c| (begin[c] - f32::max(last[c], 0.0)).abs()).fold(0.0, f32::max);
                assert!(jump < 1e-5, "jump of {jump} before step {step}");
            }
        }
    }

    #[test]
    fn a_line_is_moved_by_any_number_of_cells_in_open_and_in_wrapped_grids() {
        let line: Vec<f32> = (1_u8..=5).map(f32::from).collect();
        let wrap = |place: i64, edges| if edges == Edges::Wrap { place.rem_euclid(5) } else { place };
        for whole in -13..=13_i64 {
            for edges in [Edges::Open, Edges::Wrap] {
                let mut moved = vec![9.0; 6];
                move_line(&line, whole, edges, &mut moved);
                for (place, found) in (-1..5_i64).zip(&moved) {
                    let from = wrap(place - whole, edges);
                    let expected = usize::try_from(from).ok().and_then(|from| line.get(from)).copied().unwrap_or(0.0);
                    assert!((found - expected).abs() < 1e-9, "{whole} cells, {edges:?}, cell {place}: {found}");
                }
            }
        }
    }

    #[test]
    fn moments_outside_the_last_step_are_refused() {
        let (automaton, mut density) = drifting(Edges::Open, [0.0; 2]);
        let text = density.at(&automaton, 1.5).unwrap_err().to_string();
        assert_eq!(text, "moment between two steps = 1.5 is outside 0 to 1");
    }
}
