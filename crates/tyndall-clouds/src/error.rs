//! What callers of this crate can do wrong.

use tyndall_core::grid::Grid3;

use crate::grid_size::{MAX_BALL_CELLS, MAX_BALL_SIDE_CELLS, MAX_CELLS, MAX_HEIGHT_CELLS, MAX_SIDE_CELLS};

/// Refusals of this crate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CloudError {
    /// A grid without cells, or with more than the automaton takes.
    #[error(
        "a grid of {} x {} x {} cells is outside 1 x 1 x 1 to {MAX_SIDE_CELLS} x {MAX_SIDE_CELLS} x {MAX_HEIGHT_CELLS} \
         cells and {MAX_CELLS} cells in all",
        .size[0], .size[1], .size[2]
    )]
    GridSize {
        /// [nx, ny, nz].
        size: [usize; 3],
    },
    /// A number outside its range, or NaN.
    #[error("{what} = {value}{unit} is outside {low} to {high}{unit}")]
    OutOfRange {
        /// Which number.
        what: String,
        /// The number.
        value: f64,
        /// Smallest allowed.
        low: f64,
        /// Largest allowed.
        high: f64,
        /// Unit with a space before it; empty when dimensionless.
        unit: &'static str,
    },
    /// A list or array does not have the number of entries that it must have.
    #[error("{what} has {found} entries; {expected} are needed")]
    WrongLength {
        /// Which list.
        what: String,
        /// Entries found.
        found: usize,
        /// Entries needed.
        expected: usize,
    },
    /// Two things that belong together have different grids.
    #[error("{what} has {found:?} cells; the grid has {expected:?}")]
    OtherSize {
        /// Which thing.
        what: String,
        /// Its cells along each axis.
        found: Vec<usize>,
        /// Cells needed along each axis.
        expected: Vec<usize>,
    },
    /// Knots of a wind profile that do not rise.
    #[error("knot {index} of the wind profile is at height {height_cells} cells, not above the one before it")]
    WindKnots {
        /// Which knot, from 0.
        index: usize,
        /// Its height.
        height_cells: f64,
    },
    /// A file of a cloud's state or density lacks an array, or has one of another kind.
    #[error("array `{name}`: {problem}")]
    Array {
        /// Name of the array.
        name: String,
        /// What is wrong with it.
        problem: String,
    },
    /// A list of metaballs without any.
    #[error("the list of metaballs is empty")]
    NoBalls,
    /// The grid around a list of metaballs has too many cells.
    #[error(
        "the balls need {:.0} x {:.0} x {:.0} cells of {cell_m} m; {MAX_BALL_SIDE_CELLS} along each axis and {MAX_BALL_CELLS} in all are \
         allowed: make cells larger",
        .sides[0], .sides[1], .sides[2]
    )]
    BallBox {
        /// Cells along each axis.
        sides: [f64; 3],
        /// Side of a cell (m).
        cell_m: f64,
    },
    /// A list of metaballs in JSON cannot be read.
    #[error("line {line}, column {column}: {problem}")]
    BallPlace {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong.
        problem: String,
    },
    /// A text that describes clouds cannot be read.
    #[error("`{name}`: {problem}")]
    Text {
        /// Parameter that holds it.
        name: &'static str,
        /// What is wrong with it and what is allowed.
        problem: String,
    },
    /// A line of a list of metaballs cannot be read.
    #[error("line {line}: {problem}")]
    BallLine {
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
}

/// Refuses a grid of another size.
pub(crate) fn same_size<T>(what: &str, grid: &Grid3<T>, size: [usize; 3]) -> Result<(), CloudError> {
    if grid.size() == size {
        return Ok(());
    }
    Err(CloudError::OtherSize { what: what.to_owned(), found: grid.size().to_vec(), expected: size.to_vec() })
}

/// `value` when it lies within `low..=high`, which NaN does not.
pub(crate) fn in_range(
    what: impl Into<String>,
    value: f64,
    (low, high): (f64, f64),
    unit: &'static str,
) -> Result<f64, CloudError> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(CloudError::OutOfRange { what: what.into(), value, low, high, unit })
}
