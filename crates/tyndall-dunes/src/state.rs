//! State of the automata as named arrays, for files.
//!
//! Dunes: `height`, `bedrock` (quanta), `sand_cells` for other programs, `ledger`; ripples: `height`. Both with `version`,
//! `step` and `hash`. Plants, rock and walls are set up by their parameters; `cover` and `plant_heights` are what plants
//! change. A simulation made of the same parameters goes on with the same bits.

use tyndall_core::array::{Array, ArrayData, NamedArrays};

use crate::DuneError;

/// Version of the arrays' meaning.
const VERSION: u64 = 1;

/// Adds an array.
pub(crate) fn push(arrays: &mut NamedArrays, name: &str, shape: Vec<usize>, data: ArrayData) {
    arrays.extend(Array::new(shape, data).map(|array| (name.to_owned(), array)));
}

/// Begins a state.
pub(crate) fn begin(step: u32, hash: u64) -> NamedArrays {
    let mut arrays = NamedArrays::new();
    for (name, value) in [("version", VERSION), ("step", u64::from(step)), ("hash", hash)] {
        push(&mut arrays, name, vec![], ArrayData::U64(vec![value]));
    }
    arrays
}

/// Heights as the whole numbers that files have.
pub(crate) fn quanta(heights: &[i32]) -> ArrayData {
    ArrayData::I64(heights.iter().map(|&height| i64::from(height)).collect())
}

/// Step and hash of a state whose version is known.
pub(crate) fn step_and_hash(arrays: &NamedArrays) -> Result<(u32, u64), DuneError> {
    let version = number(arrays, "version")?;
    if version != VERSION {
        return Err(wrong("version", format!("{version} is not known; this program reads {VERSION}")));
    }
    let step = number(arrays, "step")?;
    let step = u32::try_from(step).map_err(|_too_large| wrong("step", format!("{step} is above {}", u32::MAX)))?;
    Ok((step, number(arrays, "hash")?))
}

/// Whole numbers of an array that has `count` of them, each within `limit` of 0.
pub(crate) fn integers(arrays: &NamedArrays, name: &str, count: usize, limit: i64) -> Result<Vec<i64>, DuneError> {
    let ArrayData::I64(values) = find(arrays, name)?.data() else {
        return Err(wrong(name, "it is of another kind; 64-bit whole numbers are needed".to_owned()));
    };
    if values.len() != count {
        return Err(wrong(name, format!("it has {} numbers; this simulation needs {count}", values.len())));
    }
    match values.iter().find(|value| value.unsigned_abs() > limit.unsigned_abs()) {
        Some(value) => Err(wrong(name, format!("{value} is outside -{limit} to {limit}"))),
        None => Ok(values.clone()),
    }
}

/// Heights of an array.
pub(crate) fn heights(arrays: &NamedArrays, name: &str, count: usize, limit: i32) -> Result<Vec<i32>, DuneError> {
    Ok(integers(arrays, name, count, i64::from(limit))?.into_iter().map(|value| value as i32).collect())
}

fn number(arrays: &NamedArrays, name: &str) -> Result<u64, DuneError> {
    match find(arrays, name)?.data() {
        ArrayData::U64(values) if values.len() == 1 => Ok(values[0]),
        _ => Err(wrong(name, "it is not one 64-bit number".to_owned())),
    }
}

fn find<'a>(arrays: &'a NamedArrays, name: &str) -> Result<&'a Array, DuneError> {
    let found = arrays.iter().find(|(other, _)| other == name).map(|(_, array)| array);
    found.ok_or_else(|| wrong(name, "it is absent".to_owned()))
}

pub(crate) fn wrong(name: &str, problem: String) -> DuneError {
    DuneError::State { name: name.to_owned(), problem }
}
