//! States as named arrays, for files.
//!
//! `height`, `bedrock`, `mean` are 32-bit integers in quanta of 1/256 cell, index [x, y] from the south-west; `sand` is their
//! difference, for readers. `hash` is that of the field, `params` that of the parameters that the steps followed from
//! ([`DesertParams::step_hash`]), `ledger` the six amounts of [`Ledger`] in the order of its fields. `plant_cover` and
//! `plant_height` are there where plants grow, `moved_at` where ages are kept. Everything else is in the parameters.

use tyndall_core::array::{Array, ArrayData, NamedArrays};

use super::{DesertInputs, DesertParams, DesertSimulation};
use crate::DuneError;
use crate::ledger::Ledger;
use crate::slab::{DUNE_QUANTA_PER_CELL, DuneState, PlantState};

/// Version of the arrays' meaning.
const VERSION: u64 = 1;

impl DesertSimulation {
    /// Everything that steps change.
    #[must_use]
    pub fn state(&self) -> NamedArrays {
        let size = self.size().to_vec();
        let state = self.field().state();
        let Ledger { start, entered, left, brushed_on, brushed_off, abraded } = state.ledger;
        let mut arrays = NamedArrays::new();
        let mut push = |name: &str, shape: &[usize], data: ArrayData| {
            arrays.extend(Array::new(shape.to_vec(), data).map(|array| (name.to_owned(), array)));
        };
        push("version", &[], ArrayData::U64(vec![VERSION]));
        push("step", &[], ArrayData::U64(vec![u64::from(state.step)]));
        push("hash", &[], ArrayData::U64(vec![self.hash()]));
        push("seed", &[], ArrayData::U64(vec![u64::from(self.params().dunes.seed)]));
        push("params", &[], ArrayData::U64(vec![self.params().step_hash()]));
        push("cell_m", &[], ArrayData::F64(vec![self.cell_m()]));
        push("quanta_per_cell", &[], ArrayData::I32(vec![DUNE_QUANTA_PER_CELL]));
        push("ledger", &[6], ArrayData::I64(vec![start, entered, left, brushed_on, brushed_off, abraded]));
        let sand = state.heights.iter().zip(&state.bedrock).map(|(height, rock)| height - rock).collect();
        push("height", &size, ArrayData::I32(state.heights));
        push("sand", &size, ArrayData::I32(sand));
        push("bedrock", &size, ArrayData::I32(state.bedrock));
        push("mean", &size, ArrayData::I32(state.means));
        if let Some(plants) = state.plants {
            push("plant_cover", &size, ArrayData::U8(plants.cover));
            push("plant_height", &size, ArrayData::I32(plants.heights_then));
        }
        if let Some(moved_at) = self.moved_at() {
            push("moved_at", &size, ArrayData::U32(moved_at.to_vec()));
        }
        arrays
    }

    /// A desert that goes on from a state, as if it had never stopped when the parameters are the same.
    ///
    /// # Errors
    /// As for [`DesertSimulation::cold`] and [`DesertSimulation::restore`].
    pub fn from_state(params: &DesertParams, inputs: &DesertInputs, arrays: &NamedArrays) -> Result<Self, DuneError> {
        let mut simulation = Self::cold(params, inputs)?;
        simulation.restore(arrays)?;
        Ok(simulation)
    }

    /// Whether a state's steps followed from the same parameters, so that it goes on as it would have by itself.
    ///
    /// # Errors
    /// [`DuneError::Array`] when the state does not say.
    pub fn continues(params: &DesertParams, arrays: &NamedArrays) -> Result<bool, DuneError> {
        Ok(number(arrays, "params")? == params.step_hash())
    }

    /// Takes up a state of a desert of the same size; nothing changes when it is refused.
    ///
    /// # Errors
    /// [`DuneError::Array`] when an array is absent, of another kind or size, or has not the hash that the file says;
    /// [`DuneError::Height`] when a height is too large; [`DuneError::Plants`] when plants grow in one of both only.
    pub fn restore(&mut self, arrays: &NamedArrays) -> Result<(), DuneError> {
        let version = number(arrays, "version")?;
        if version != VERSION {
            return Err(wrong("version", format!("{version} is not known; this program reads {VERSION}")));
        }
        let size = self.size();
        let state = DuneState {
            step: state_step(arrays)?,
            heights: integers(arrays, "height", size)?.to_vec(),
            bedrock: integers(arrays, "bedrock", size)?.to_vec(),
            means: integers(arrays, "mean", size)?.to_vec(),
            plants: plants(arrays, size)?,
            ledger: ledger(arrays)?,
        };
        if self.field().hash_of(&state) != number(arrays, "hash")? {
            let problem = "it is not the hash of `height` and `bedrock`; the file is damaged".to_owned();
            return Err(wrong("hash", problem));
        }
        let moved_at = optional(arrays, "moved_at").map(|array| match array.data() {
            ArrayData::U32(values) if array.shape() == size => Ok(values.clone()),
            _ => Err(misfit("moved_at", array, size)),
        });
        let moved_at = moved_at.transpose()?;
        self.field_mut().set_state(state)?;
        self.skip_touches();
        self.set_moved_at(moved_at);
        Ok(())
    }
}

/// Steps that a state has behind it.
///
/// # Errors
/// [`DuneError::Array`] when the state does not say, or the number is too large.
pub fn state_step(arrays: &NamedArrays) -> Result<u32, DuneError> {
    let step = number(arrays, "step")?;
    u32::try_from(step).map_err(|_too_large| wrong("step", format!("{step} is above {}", u32::MAX)))
}

fn wrong(name: &str, problem: String) -> DuneError {
    DuneError::Array { name: name.to_owned(), problem }
}

fn misfit(name: &str, array: &Array, [nx, ny]: [usize; 2]) -> DuneError {
    wrong(name, format!("it has {:?} numbers of another kind or size; the bed has [{nx}, {ny}] cells", array.shape()))
}

fn optional<'a>(arrays: &'a NamedArrays, name: &str) -> Option<&'a Array> {
    arrays.iter().find(|(found, _)| found == name).map(|(_, array)| array)
}

fn find<'a>(arrays: &'a NamedArrays, name: &str) -> Result<&'a Array, DuneError> {
    optional(arrays, name).ok_or_else(|| wrong(name, "the file has none of this name".to_owned()))
}

fn number(arrays: &NamedArrays, name: &str) -> Result<u64, DuneError> {
    match find(arrays, name)?.data() {
        ArrayData::U64(values) if values.len() == 1 => Ok(values[0]),
        _ => Err(wrong(name, "one 64-bit whole number is needed".to_owned())),
    }
}

fn integers<'a>(arrays: &'a NamedArrays, name: &str, size: [usize; 2]) -> Result<&'a [i32], DuneError> {
    let array = find(arrays, name)?;
    match array.data() {
        ArrayData::I32(values) if array.shape() == size => Ok(values),
        _ => Err(misfit(name, array, size)),
    }
}

fn plants(arrays: &NamedArrays, size: [usize; 2]) -> Result<Option<PlantState>, DuneError> {
    let Some(array) = optional(arrays, "plant_cover") else { return Ok(None) };
    let ArrayData::U8(cover) = array.data() else { return Err(misfit("plant_cover", array, size)) };
    if array.shape() != size {
        return Err(misfit("plant_cover", array, size));
    }
    let heights_then = integers(arrays, "plant_height", size)?.to_vec();
    Ok(Some(PlantState { cover: cover.clone(), heights_then }))
}

fn ledger(arrays: &NamedArrays) -> Result<Ledger, DuneError> {
    match find(arrays, "ledger")?.data() {
        ArrayData::I64(values) => match values[..] {
            [start, entered, left, brushed_on, brushed_off, abraded] => {
                Ok(Ledger { start, entered, left, brushed_on, brushed_off, abraded })
            }
            _ => Err(wrong("ledger", format!("it has {} amounts; 6 are needed", values.len()))),
        },
        _ => Err(wrong("ledger", "64-bit whole numbers are needed".to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::side::Side;

    fn params() -> DesertParams {
        let mut params = DesertParams::default();
        params.dunes.side = Side::Cells64;
        (params.plants.enabled, params.wind.winds) = (true, 2);
        params
    }

    #[test]
    fn a_desert_goes_on_from_a_state_with_the_same_bits_and_ages() {
        let mut whole = DesertSimulation::cold(&params(), &DesertInputs::default()).unwrap();
        whole.keep_ages();
        whole.advance(37);
        let mut rest = DesertSimulation::from_state(&params(), &DesertInputs::default(), &whole.state()).unwrap();
        assert_eq!(whole.state(), rest.state(), "all arrays");
        for desert in [&mut whole, &mut rest] {
            desert.advance(41);
        }
        assert_eq!((whole.state(), whole.hash(), rest.step_count()), (rest.state(), rest.hash(), 78), "later too");
        let mut unwatched = DesertSimulation::cold(&params(), &DesertInputs::default()).unwrap();
        unwatched.advance(78);
        assert_eq!(unwatched.hash(), whole.hash(), "ages change no bit");
    }

    #[test]
    fn ages_count_the_steps_since_a_cell_moved() {
        let mut desert = DesertSimulation::cold(&params(), &DesertInputs::default()).unwrap();
        assert_eq!(desert.age_steps(), None, "not kept");
        desert.keep_ages();
        desert.advance(5);
        let before = desert.field().heights().to_vec();
        let old = desert.age_steps().unwrap();
        desert.advance(1);
        let ages = desert.age_steps().unwrap();
        for (index, (&age, &height)) in ages.iter().zip(desert.field().heights()).enumerate() {
            let expected = if height == before[index] { old[index] + 1 } else { 0 };
            assert_eq!(age, expected, "cell {index}");
        }
        assert!(ages.contains(&0) && ages.iter().any(|&age| age > 0), "some have moved, some not");
    }

    #[test]
    fn a_state_knows_whether_its_steps_followed_from_the_same_parameters() {
        let state = DesertSimulation::cold(&params(), &DesertInputs::default()).unwrap().state();
        assert_eq!(DesertSimulation::continues(&params(), &state), Ok(true), "the same");
        let mut windy = params();
        windy.wind.direction_deg += 1.0;
        assert_eq!(DesertSimulation::continues(&windy, &state), Ok(false), "another wind");
        assert!(
            DesertSimulation::from_state(&windy, &DesertInputs::default(), &state).is_ok(),
            "which may take it up all the same"
        );
    }

    #[test]
    fn damaged_and_foreign_states_are_refused_with_the_arrays_name() {
        let mut desert = DesertSimulation::cold(&params(), &DesertInputs::default()).unwrap();
        let before = desert.state();
        let change = |name: &str, array: Array| {
            let mut arrays = before.clone();
            arrays.iter_mut().filter(|(found, _)| found == name).for_each(|(_, old)| *old = array.clone());
            arrays
        };
        let without = |name: &str| before.iter().filter(|(found, _)| found != name).cloned().collect::<NamedArrays>();
        let number = |value| Array::new(vec![], ArrayData::U64(vec![value])).unwrap();
        let level = Array::new(vec![64, 64], ArrayData::I32(vec![0; 4096])).unwrap();
        let small = Array::new(vec![2, 1], ArrayData::I32(vec![0; 2])).unwrap();
        for (arrays, reason) in [
            (change("hash", number(1)), "array `hash`: it is not the hash"),
            (change("height", level), "array `hash`: it is not the hash"),
            (change("version", number(9)), "array `version`: 9 is not known"),
            (
                change("height", small),
                "array `height`: it has [2, 1] numbers of another kind or size; the bed has [64, 64]",
            ),
            (change("step", number(1 << 40)), "array `step`: 1099511627776 is above"),
            (without("ledger"), "array `ledger`: the file has none of this name"),
            (without("plant_cover"), "plants grow in the field but not in the state"),
        ] {
            let text = desert.restore(&arrays).unwrap_err().to_string();
            assert!(text.contains(reason), "{text:?} should say {reason:?}");
            assert_eq!(desert.state(), before, "nothing changed");
        }
    }
}
