//! What callers of this crate can do wrong.

use tyndall_core::{ParamError, ParamSet};

/// Refusals of this crate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DuneError {
    /// Sides are powers of two, so that indices wrap by a mask, in shaders too.
    #[error("the {axis} side has {cells} cells; powers of two from {low} to {high} are allowed")]
    Side {
        /// `x` or `y`.
        axis: char,
        /// Cells asked for.
        cells: usize,
        /// Smallest side.
        low: usize,
        /// Largest side.
        high: usize,
    },
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParamError),
    /// A grid does not fit the bed that it is meant for.
    #[error("{what} has {found} cells; the bed of {} x {} cells needs {}", size[0], size[1], size[0] * size[1])]
    GridSize {
        /// What was given.
        what: &'static str,
        /// Its cells.
        found: usize,
        /// Cells of the bed along x and y.
        size: [usize; 2],
    },
    /// A height that integers of the automaton do not hold, or no number.
    #[error("{what} at cell ({x}, {y}) is {value} cells; -{limit} to {limit} is allowed")]
    Height {
        /// What was given.
        what: &'static str,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// The value.
        value: f64,
        /// Largest magnitude.
        limit: f64,
    },
    /// A value of a call is outside its range.
    #[error("{what} = {value}{unit} is outside {low} to {high}{unit}")]
    Value {
        /// Name of the value.
        what: &'static str,
        /// The value.
        value: f64,
        /// Unit with a space before it, or nothing.
        unit: &'static str,
        /// Lowest allowed.
        low: f64,
        /// Highest allowed.
        high: f64,
    },
    /// A text by hand cannot be read.
    #[error("{name}: {problem}")]
    Text {
        /// The parameter.
        name: &'static str,
        /// What is wrong and what is allowed.
        problem: String,
    },
    /// A line of a table of winds cannot be read.
    #[error("line {line}, column {column}: {message}")]
    WindTable {
        /// Line, from 1.
        line: usize,
        /// Column of the table, from 1.
        column: usize,
        /// What is wrong and what is allowed.
        message: String,
    },
    /// Plants grow either in a state or in the field that is to go on from it.
    #[error(
        "plants grow in the {} but not in the {}; set the same vegetation first",
        if *in_field { "field" } else { "state" },
        if *in_field { "state" } else { "field" }
    )]
    Plants {
        /// Whether it is the field that has them.
        in_field: bool,
    },
    /// An array of a state is absent, damaged, or not this desert's.
    #[error("array `{name}`: {problem}")]
    Array {
        /// Name of the array.
        name: String,
        /// What is wrong and what is needed.
        problem: String,
    },
    /// A wind schedule needs at least one wind that blows.
    #[error("the wind schedule has no wind that blows; at least one needs a share above 0")]
    NoWind,
}

/// Checks every parameter of a group against its declared range.
pub(crate) fn check_params(params: &dyn ParamSet) -> Result<(), DuneError> {
    for (index, info) in params.info().iter().enumerate() {
        info.check(params.get(index))?;
    }
    Ok(())
}

/// Checks that `value` lies in `low..=high`; NaN does not.
pub(crate) fn check_value(
    what: &'static str,
    value: f64,
    unit: &'static str,
    range: std::ops::RangeInclusive<f64>,
) -> Result<f64, DuneError> {
    if range.contains(&value) {
        return Ok(value);
    }
    Err(DuneError::Value { what, value, unit, low: *range.start(), high: *range.end() })
}
