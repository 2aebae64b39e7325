//! State and density as named arrays, for files.
//!
//! `cells` has one byte per cell (hum + 2 act + 4 cld), `hash` its FNV-1a hash, `seed` and `params` the seed and the hash of
//! the parameters that the steps followed from ([`CloudParams::step_hash`]), `cld_history` one byte per cell whose bit n is
//! the cloud n steps ago, `wind` the displacement of each height in 2^-32 cells, `layer_n` what moves in layer n of the
//! probabilities. Everything else is in the parameters: a simulation made of the same ones goes on with the same bits.

use std::collections::VecDeque;

use tyndall_core::array::{Array, ArrayData, NamedArrays};
use tyndall_core::grid::Grid3;

use crate::bit_field::BitField;
use crate::error::CloudError;
use crate::fields::CloudFields;
use crate::grid_size::cells;
use crate::narrow::narrow;
use crate::params::CloudParams;
use crate::simulation::CloudSimulation;

/// Version of the arrays' meaning.
const VERSION: u64 = 1;

impl CloudSimulation {
    /// Everything that steps change.
    #[must_use]
    pub fn state(&self) -> NamedArrays {
        let automaton = self.automaton();
        let size = automaton.size();
        let mut arrays = NamedArrays::new();
        let mut push = |name: &str, shape: Vec<usize>, data: ArrayData| {
            arrays.extend(Array::new(shape, data).map(|array| (name.to_owned(), array)));
        };
        push("version", vec![], ArrayData::U64(vec![VERSION]));
        push("step", vec![], ArrayData::U64(vec![u64::from(automaton.step_count())]));
        push("hash", vec![], ArrayData::U64(vec![automaton.fields().hash()]));
        push("seed", vec![], ArrayData::U64(vec![u64::from(self.params().grid.seed)]));
        push("params", vec![], ArrayData::U64(vec![self.params().step_hash()]));
        push("cells", size.to_vec(), ArrayData::U8(automaton.fields().to_bytes()));
        push("cld_history", size.to_vec(), ArrayData::U8(history_bytes(self.density_history().history(), size)));
        let wind: Vec<i64> = automaton.wind().raw_displacements().iter().flatten().copied().collect();
        push("wind", vec![2, size[2]], ArrayData::I64(wind));
        for (index, layer) in automaton.probabilities().iter().enumerate() {
            let numbers = layer.state();
            push(&format!("layer_{index}"), vec![numbers.len()], ArrayData::F64(numbers));
        }
        arrays
    }

    /// A simulation that goes on from a state; of the warm-up no step is made.
    ///
    /// # Errors
    /// As for [`CloudSimulation::new`] and [`CloudSimulation::restore`].
    pub fn from_state(params: &CloudParams, arrays: &NamedArrays) -> Result<Self, CloudError> {
        let mut simulation = Self::cold(params)?;
        simulation.restore(arrays)?;
        Ok(simulation)
    }

    /// Whether a state's steps followed from the same parameters, so that it goes on as it would have by itself.
    ///
    /// # Errors
    /// [`CloudError::Array`] when the state does not say.
    pub fn continues(params: &CloudParams, arrays: &NamedArrays) -> Result<bool, CloudError> {
        Ok(one_number(arrays, "params")? == params.step_hash())
    }

    /// Takes up a state that a simulation of the same grid and with as many bubbles gave; nothing changes when it is refused.
    ///
    /// # Errors
    /// [`CloudError::Array`] when an array is absent, of another kind, or does not have the hash that the file says;
    /// [`CloudError::OtherSize`] when the grid is another, [`CloudError::WrongLength`] when the bubbles are.
    pub fn restore(&mut self, arrays: &NamedArrays) -> Result<(), CloudError> {
        let version = one_number(arrays, "version")?;
        if version != VERSION {
            return Err(wrong("version", format!("{version} is not known; this program reads {VERSION}")));
        }
        let step = state_step(arrays)?;
        let size = self.automaton().size();
        let fields = CloudFields::from_bytes(size, bytes(arrays, "cells", size)?)?;
        if fields.hash() != one_number(arrays, "hash")? {
            return Err(wrong("hash", "it is not the hash of `cells`; the file is damaged".to_owned()));
        }
        let history = history_from(bytes(arrays, "cld_history", size)?, size, self.density_history().history().len());
        let wind = displacements(arrays, size[2])?;
        let layers: Vec<&[f64]> = (0..self.automaton().probabilities().len())
            .map(|index| layer_numbers(arrays, &format!("layer_{index}")))
            .collect::<Result<_, _>>()?;
        self.automaton_mut().restore_layers(&layers)?;
        self.automaton_mut().restore(fields, step)?;
        self.automaton_mut().wind_mut().set_raw_displacements(&wind)?;
        self.density_history_mut().set_history(history)
    }
}

/// Steps that a state has behind it.
///
/// # Errors
/// [`CloudError::Array`] when the state does not say, or the number is too large.
pub fn state_step(arrays: &NamedArrays) -> Result<u32, CloudError> {
    let step = one_number(arrays, "step")?;
    u32::try_from(step).map_err(|_too_large| wrong("step", format!("{step} is above {}", u32::MAX)))
}

/// A density of a file: bytes and 16-bit numbers as shares of their largest, others as they are.
///
/// # Errors
/// When the array has not three dimensions, is of another kind, or has a number that is negative or not finite.
pub fn density_from_array(name: &str, array: &Array) -> Result<Grid3<f32>, CloudError> {
    let &[nx, ny, nz] = array.shape() else {
        return Err(wrong(name, format!("its shape is {:?}; three dimensions are needed", array.shape())));
    };
    let cells: Vec<f32> = match array.data() {
        ArrayData::U8(values) => values.iter().map(|&value| f32::from(value) / 255.0).collect(),
        ArrayData::U16(values) => values.iter().map(|&value| f32::from(value) / 65_535.0).collect(),
        ArrayData::F32(values) => values.clone(),
        ArrayData::F64(values) => values.iter().copied().map(narrow).collect(),
        _ => return Err(wrong(name, "whole numbers of 32 or 64 bits are no density".to_owned())),
    };
    if let Some(value) = cells.iter().find(|value| !(value.is_finite() && **value >= 0.0)) {
        return Err(wrong(name, format!("{value} is no density; 0 and more is allowed")));
    }
    Grid3::from_cells([nx, ny, nz], cells).ok_or_else(|| wrong(name, "shape and numbers do not agree".to_owned()))
}

/// The density of a file with several arrays: the one of that name, or the only one with three dimensions.
///
/// # Errors
/// When there is no such array, or more than one to choose from, and as for [`density_from_array`].
pub fn density_from_arrays(arrays: &NamedArrays, name: Option<&str>) -> Result<Grid3<f32>, CloudError> {
    if let Some(name) = name {
        return density_from_array(name, find(arrays, name)?);
    }
    let candidates: Vec<_> = arrays.iter().filter(|(_, array)| array.shape().len() == 3).collect();
    match candidates[..] {
        [(name, array)] => density_from_array(name, array),
        [] => Err(wrong("density", "no array of the file has three dimensions".to_owned())),
        _ => {
            let names: Vec<_> = candidates.iter().map(|(name, _)| name.as_str()).collect();
            Err(wrong("density", format!("name one of the arrays with three dimensions: {}", names.join(", "))))
        }
    }
}

fn wrong(name: &str, problem: String) -> CloudError {
    CloudError::Array { name: name.to_owned(), problem }
}

fn find<'a>(arrays: &'a NamedArrays, name: &str) -> Result<&'a Array, CloudError> {
    let found = arrays.iter().find(|(found, _)| found == name).map(|(_, array)| array);
    found.ok_or_else(|| wrong(name, "the file has none of this name".to_owned()))
}

fn one_number(arrays: &NamedArrays, name: &str) -> Result<u64, CloudError> {
    match find(arrays, name)?.data() {
        ArrayData::U64(values) if values.len() == 1 => Ok(values[0]),
        _ => Err(wrong(name, "one 64-bit whole number is needed".to_owned())),
    }
}

fn bytes<'a>(arrays: &'a NamedArrays, name: &str, size: [usize; 3]) -> Result<&'a [u8], CloudError> {
    let array = find(arrays, name)?;
    if array.shape() != size {
        let (found, expected) = (array.shape().to_vec(), size.to_vec());
        return Err(CloudError::OtherSize { what: format!("array `{name}`"), found, expected });
    }
    match array.data() {
        ArrayData::U8(values) => Ok(values),
        _ => Err(wrong(name, "bytes are needed".to_owned())),
    }
}

fn displacements(arrays: &NamedArrays, nz: usize) -> Result<Vec<[i64; 2]>, CloudError> {
    match find(arrays, "wind")?.data() {
        ArrayData::I64(values) if values.len() == 2 * nz => Ok(values.as_chunks().0.to_vec()),
        _ => Err(wrong("wind", format!("two 64-bit whole numbers for each of {nz} heights are needed"))),
    }
}

fn layer_numbers<'a>(arrays: &'a NamedArrays, name: &str) -> Result<&'a [f64], CloudError> {
    match find(arrays, name)?.data() {
        ArrayData::F64(values) => Ok(values),
        _ => Err(wrong(name, "numbers in double precision are needed".to_owned())),
    }
}

fn history_bytes(history: &VecDeque<BitField>, size: [usize; 3]) -> Vec<u8> {
    let byte = |cell| history.iter().zip(0..).fold(0, |byte, (field, bit)| byte | u8::from(field.get(cell)) << bit);
    cells(size).map(byte).collect()
}

fn history_from(bytes: &[u8], size: [usize; 3], count: usize) -> VecDeque<BitField> {
    let field = |bit: usize| {
        let mut field = BitField::new(size);
        let mut place = bytes.iter();
        // `fill_with` goes through the cells in the order of the bytes.
        field.fill_with(|_| place.next().is_some_and(|byte| (byte >> bit) & 1 == 1));
        field
    };
    (0..count).map(field).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn params() -> CloudParams {
        let mut params = CloudParams::default();
        (params.grid.cells_east, params.grid.cells_north, params.grid.cells_up) = (48, 40, 34);
        (params.grid.warm_up_steps, params.vapour.bubble_radius_m) = (25, 300.0);
        params
    }

    #[test]
    fn a_restored_simulation_goes_on_with_the_same_bits_and_the_same_density() {
        let mut first = CloudSimulation::new(&params()).unwrap();
        let mut second = CloudSimulation::cold(&params()).unwrap();
        second.restore(&first.state()).unwrap();
        assert_eq!(first.state(), second.state(), "all arrays");
        for _ in 0..3 {
            assert_eq!(first.share(0.4).unwrap(), second.share(0.4).unwrap(), "density between the steps");
            first.advance(7);
            second.advance(7);
            assert_eq!(first.automaton().fields().hash(), second.automaton().fields().hash(), "bits");
        }
        assert!(first.automaton().fields().counts()[2] > 0, "there are clouds");
    }

    #[test]
    fn a_state_knows_whether_its_steps_followed_from_the_same_parameters() {
        let state = CloudSimulation::cold(&params()).unwrap().state();
        assert_eq!(CloudSimulation::continues(&params(), &state), Ok(true), "the same");
        let mut windy = params();
        windy.wind.floor_speed_m_s += 1.0;
        assert_eq!(CloudSimulation::continues(&windy, &state), Ok(false), "another wind");
        assert!(CloudSimulation::from_state(&windy, &state).is_ok(), "which may take it up all the same");
        let mut wide = params();
        wide.grid.cells_east += 1;
        let text = CloudSimulation::from_state(&wide, &state).unwrap_err().to_string();
        assert_eq!(text, "array `cells` has [48, 40, 34] cells; the grid has [49, 40, 34]");
    }

    #[test]
    fn damaged_and_foreign_states_are_refused_with_the_arrays_name() {
        let mut simulation = CloudSimulation::new(&params()).unwrap();
        let before = simulation.state();
        let change = |name: &str, array: Array| {
            let mut arrays = before.clone();
            arrays.iter_mut().filter(|(found, _)| found == name).for_each(|(_, old)| *old = array.clone());
            arrays
        };
        let number = |value| Array::new(vec![], ArrayData::U64(vec![value])).unwrap();
        let mut absent = before.clone();
        absent.retain(|(name, _)| name != "wind");
        for (arrays, reason) in [
            (change("hash", number(1)), "array `hash`: it is not the hash of `cells`"),
            (change("version", number(9)), "array `version`: 9 is not known"),
            (change("cells", number(9)), "array `cells` has [] cells"),
            (change("step", number(1 << 40)), "array `step`: 1099511627776 is above"),
            (absent, "array `wind`: the file has none of this name"),
        ] {
            let text = simulation.restore(&arrays).unwrap_err().to_string();
            assert!(text.contains(reason), "{text:?} should say {reason:?}");
            assert_eq!(simulation.state(), before, "nothing changed");
        }
    }

    #[test]
    fn a_density_is_taken_from_the_only_grid_of_a_file_and_checked() {
        let grid = Array::new(vec![2, 1, 2], ArrayData::U8(vec![0, 255, 51, 0])).unwrap();
        let mut arrays = vec![("q_u8".to_owned(), grid)];
        let density = density_from_arrays(&arrays, None).unwrap();
        assert!((density[[1, 0, 0]] - 1.0).abs() < 1e-7 && (density[[0, 0, 1]] - 0.2).abs() < 1e-7, "{density:?}");
        let bad = Array::new(vec![1, 1, 1], ArrayData::F32(vec![-0.5])).unwrap();
        arrays.push(("other".to_owned(), bad));
        let text = density_from_arrays(&arrays, None).unwrap_err().to_string();
        assert!(text.contains("q_u8, other"), "{text}");
        let text = density_from_arrays(&arrays, Some("other")).unwrap_err().to_string();
        assert_eq!(text, "array `other`: -0.5 is no density; 0 and more is allowed");
    }
}
