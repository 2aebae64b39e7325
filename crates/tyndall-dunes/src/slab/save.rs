//! A field of dunes to and from named arrays.

use tyndall_core::array::{ArrayData, NamedArrays};

use super::field::DuneField;
use super::rule::{DUNE_QUANTA_PER_CELL, MAX_HEIGHT_CELLS};
use crate::DuneError;
use crate::ledger::Ledger;
use crate::simulation::{SandSimulation as _, StateHash};
use crate::state;

impl DuneField {
    /// Everything that steps change: `height` and `bedrock` (quanta), `means`, `ledger`, plants; and `sand_cells` for others.
    #[must_use]
    pub fn state(&self) -> NamedArrays {
        let size = self.lattice.size().to_vec();
        let mut arrays = state::begin(self.step, self.state_hash());
        let sand = self.heights.iter().zip(&self.bedrock);
        let sand = sand.map(|(height, rock)| (height - rock) as f32 / DUNE_QUANTA_PER_CELL as f32).collect();
        let Ledger { start, entered, left, brushed_on, brushed_off, abraded } = self.ledger;
        for (name, data) in [
            ("height", state::quanta(&self.heights)),
            ("bedrock", state::quanta(&self.bedrock)),
            ("means", state::quanta(&self.means)),
            ("sand_cells", ArrayData::F32(sand)),
        ] {
            state::push(&mut arrays, name, size.clone(), data);
        }
        let ledger = vec![start, entered, left, brushed_on, brushed_off, abraded];
        state::push(&mut arrays, "ledger", vec![ledger.len()], ArrayData::I64(ledger));
        if let Some(plants) = &self.plants {
            let cover = plants.cover.iter().map(|&cover| i64::from(cover)).collect();
            state::push(&mut arrays, "cover", size.clone(), ArrayData::I64(cover));
            state::push(&mut arrays, "plant_heights", size, state::quanta(&plants.then));
        }
        arrays
    }

    /// Takes up a state that a field with the same parameters gave; nothing changes when it is refused.
    ///
    /// # Errors
    /// [`DuneError::State`] when an array is absent, of another kind or size, out of range, or does not have the hash that
    /// the state says.
    pub fn restore(&mut self, arrays: &NamedArrays) -> Result<(), DuneError> {
        let (step, hash) = state::step_and_hash(arrays)?;
        let limit = 2 * MAX_HEIGHT_CELLS * DUNE_QUANTA_PER_CELL;
        let grid = |name: &str| state::heights(arrays, name, self.lattice.cells(), limit);
        let (heights, bedrock, means) = (grid("height")?, grid("bedrock")?, grid("means")?);
        if StateHash::new(self.lattice, step).with_grid(&heights).with_grid(&bedrock).finish() != hash {
            return Err(state::wrong("hash", "it is not the hash of the heights; the file is damaged".to_owned()));
        }
        if let Some(index) = heights.iter().zip(&bedrock).position(|(height, rock)| height < rock) {
            return Err(state::wrong("height", format!("cell {index} lies below its bedrock")));
        }
        let ledger = state::integers(arrays, "ledger", 6, i64::MAX)?;
        let plants = match &self.plants {
            None => None,
            Some(plants) => {
                let cover = state::integers(arrays, "cover", self.lattice.cells(), 255)?;
                let cover = cover.into_iter().map(|cover| cover.unsigned_abs() as u8).collect();
                Some(plants.clone().with_state(cover, grid("plant_heights")?))
            }
        };
        self.ledger = Ledger {
            start: ledger[0],
            entered: ledger[1],
            left: ledger[2],
            brushed_on: ledger[3],
            brushed_off: ledger[4],
            abraded: ledger[5],
        };
        (self.heights, self.bedrock, self.means, self.plants, self.step) = (heights, bedrock, means, plants, step);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Edges;
    use crate::slab::{DuneParams, VegetationParams};

    fn field() -> DuneField {
        let params = DuneParams { edges: Edges::Open, inflow: 0.2, ..DuneParams::default() };
        let mut field = DuneField::with_size(&params, [64, 32]).unwrap();
        field.set_vegetation(&VegetationParams { enabled: true, ..VegetationParams::default() }).unwrap();
        field
    }

    #[test]
    fn a_restored_field_goes_on_with_the_same_bits() {
        let mut original = field();
        original.run(37);
        let saved = original.state();
        let mut other = field();
        other.restore(&saved).unwrap();
        original.run(50);
        other.run(50);
        assert_eq!(original.state(), other.state(), "heights, plants and ledger");
    }

    #[test]
    fn damaged_states_are_refused_and_change_nothing() {
        let mut saved = field().state();
        let height = saved.iter().position(|(name, _)| name == "height").unwrap();
        let mut other = field();
        let before = other.state();
        let mut refuse = |arrays: &NamedArrays| other.restore(arrays).unwrap_err().to_string();
        let mut numbers = vec![0; 64 * 32];
        numbers[5] = 1;
        let altered = tyndall_core::array::Array::new(vec![64, 32], ArrayData::I64(numbers)).unwrap();
        let absent: NamedArrays = saved.iter().filter(|(name, _)| name != "height").cloned().collect();
        assert_eq!(refuse(&absent), "array `height` of the state: it is absent", "without heights");
        saved[height].1 = altered;
        assert!(refuse(&saved).starts_with("array `hash` of the state: it is not the hash"), "other heights");
        assert_eq!(other.state(), before, "as it was");
    }
}
