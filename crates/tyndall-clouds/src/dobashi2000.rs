//! The automaton cell by cell, as Dobashi et al. 2000 describe it: "A simple, efficient method for realistic animation of
//! clouds", reference 9 of the paper.
//!
//! Slow and plain on purpose: the bit-parallel [`Automaton`](crate::Automaton) has to give the same bits. Random numbers,
//! order of operations and edges are those of that one; 0.01 Gcell/s.

use tyndall_core::rng::CellRng;

use crate::automaton::{
    AutomatonConfig, STREAM_ACTIVATION, STREAM_EXTINCTION, STREAM_HUMIDITY, STREAM_INFLOW, first_column,
};
use crate::bit_field::HEIGHTS_PER_LAYER;
use crate::edges::Edges;
use crate::error::CloudError;
use crate::fields::CloudFields;
use crate::probability::{Probabilities, ProbabilityLayer, ProbabilityRow};
use crate::probability_planes::{draw_cell, draw_hashes};
use crate::wind::{ShiftPlan, Wind};

/// The eleven neighbours (x, y, height) whose activation spreads to a cell.
pub const NEIGHBOURS: [[i64; 3]; 11] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [-1, 0, 0],
    [0, -1, 0],
    [0, 0, -1],
    [-2, 0, 0],
    [2, 0, 0],
    [0, -2, 0],
    [0, 2, 0],
    [0, 0, -2],
];

/// The automaton with one byte per cell and variable.
#[derive(Debug)]
pub struct ScalarAutomaton {
    config: AutomatonConfig,
    stack: Vec<Box<dyn ProbabilityLayer>>,
    wind: Wind,
    step: u32,
    /// hum, act, cld; x fastest, then y, then height.
    cells: [Vec<bool>; 3],
}

impl ScalarAutomaton {
    /// From a state, with layers of probabilities, lowest first.
    ///
    /// # Errors
    /// When the state has another size than the configuration.
    pub fn new(
        config: &AutomatonConfig,
        fields: &CloudFields,
        stack: Vec<Box<dyn ProbabilityLayer>>,
    ) -> Result<Self, CloudError> {
        if fields.size() != config.size {
            let (found, expected) = (fields.size().to_vec(), config.size.to_vec());
            return Err(CloudError::OtherSize { what: "the state".to_owned(), found, expected });
        }
        let bytes = fields.to_bytes();
        let cells = [0, 1, 2].map(|bit| bytes.iter().map(|byte| (byte >> bit) & 1 == 1).collect());
        let wind = Wind::new(config.wind.clone(), config.size[2]);
        Ok(Self { config: config.clone(), stack, wind, step: 0, cells })
    }

    /// The state, for comparison.
    ///
    /// # Errors
    /// Never for a size that [`ScalarAutomaton::new`] took.
    pub fn fields(&self) -> Result<CloudFields, CloudError> {
        let [hum, act, cld] = &self.cells;
        let cells = hum.iter().zip(act).zip(cld);
        let bytes: Vec<u8> = cells.map(|((&h, &a), &c)| u8::from(h) | u8::from(a) << 1 | u8::from(c) << 2).collect();
        CloudFields::from_bytes(self.config.size, &bytes)
    }

    /// Makes one step: rule, draws, wind.
    pub fn step(&mut self) {
        self.rule();
        self.draws();
        let plan = self.wind.advance();
        self.blow(&plan);
        self.step += 1;
        let wind = &self.wind;
        for layer in &mut self.stack {
            layer.blow(wind);
        }
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.config.size[1] + y) * self.config.size[0] + x
    }

    /// All cells, x fastest.
    fn all_cells(&self) -> Vec<[usize; 3]> {
        let [nx, ny, nz] = self.config.size;
        let row = |y, z| (0..nx).map(move |x| [x, y, z]);
        (0..nz).flat_map(|z| (0..ny).flat_map(move |y| row(y, z))).collect()
    }

    /// A cell moved by an offset: wrapped around the sides or none outside; never outside in height.
    fn moved(&self, cell: [usize; 3], offset: [i64; 3]) -> Option<[usize; 3]> {
        let mut target = [0; 3];
        for axis in 0..3 {
            let count = i64::try_from(self.config.size[axis]).ok()?;
            let position = i64::try_from(cell[axis]).ok()? + offset[axis];
            let wraps = axis < 2 && self.config.edges == Edges::Wrap;
            let position = if wraps { position.rem_euclid(count) } else { position };
            target[axis] = usize::try_from(position).ok().filter(|&position| position < self.config.size[axis])?;
        }
        Some(target)
    }

    fn rule(&mut self) {
        let before = self.cells.clone();
        let [hum, act, _] = &before;
        for cell in self.all_cells() {
            let i = self.index(cell);
            let active = |offset: &[i64; 3]| self.moved(cell, *offset).is_some_and(|cell| act[self.index(cell)]);
            let spreads = NEIGHBOURS.iter().any(active);
            self.cells[0][i] = hum[i] && !act[i];
            self.cells[1][i] = !act[i] && hum[i] && spreads;
            self.cells[2][i] |= act[i];
        }
    }

    fn draws(&mut self) {
        if self.stack.is_empty() {
            return;
        }
        let [nx, ny, nz] = self.config.size;
        let supplied = self.step.is_multiple_of(self.config.supply_interval);
        let mut row = ProbabilityRow::zeros(nx);
        for z in 0..nz {
            for y in 0..ny {
                row.fill(Probabilities::default());
                self.stack.iter().for_each(|layer| layer.apply(y, z, &mut row));
                self.draw_row(&row, y, z, supplied);
            }
        }
    }

    fn draw_row(&mut self, row: &ProbabilityRow, y: usize, z: usize, supplied: bool) {
        let [nx, ny, _] = self.config.size;
        let rng = CellRng::new(self.config.seed);
        let hashes = [STREAM_EXTINCTION, STREAM_HUMIDITY, STREAM_ACTIVATION].map(|s| draw_hashes(rng, self.step, s));
        let first = first_column([nx, ny], z / HEIGHTS_PER_LAYER, y);
        for (x, column) in (0..nx).zip(first..) {
            let i = self.index([x, y, z]);
            self.cells[2][i] &= !draw_cell(row.extinction[x], &hashes[0], column, z);
            if supplied {
                self.cells[0][i] |= draw_cell(row.humidity[x], &hashes[1], column, z);
                self.cells[1][i] |= draw_cell(row.activation[x], &hashes[2], column, z);
            }
        }
    }

    fn blow(&mut self, plan: &ShiftPlan) {
        if plan.is_still() {
            return;
        }
        let [nx, ny, _] = self.config.size;
        let before = self.cells.clone();
        let hashes = draw_hashes(CellRng::new(self.config.seed), self.step, STREAM_INFLOW);
        for cell in self.all_cells() {
            let [x, y, z] = cell;
            let here = |mask: u32| (mask >> (z % HEIGHTS_PER_LAYER)) & 1 == 1;
            let shift = plan.layer(z / HEIGHTS_PER_LAYER).iter().find(|shift| here(shift.mask));
            let [dx, dy] = shift.map_or([0; 2], |shift| shift.cells);
            let source = self.moved(cell, [-dx, -dy, 0]);
            let i = self.index(cell);
            for (after, before) in self.cells.iter_mut().zip(&before) {
                after[i] = source.is_some_and(|[x, y, z]| before[(z * ny + y) * nx + x]);
            }
            if source.is_none() {
                let first = first_column([nx, ny], z / HEIGHTS_PER_LAYER, y);
                let column = (0..=x).zip(first..).last().map_or(first, |(_, column)| column);
                self.cells[0][i] = draw_cell(self.config.inflow_humidity, &hashes, column, z);
            }
        }
    }
}
