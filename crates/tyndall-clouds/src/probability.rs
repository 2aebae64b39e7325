//! Probabilities of extinction and supply, cell by cell.
//!
//! Section 3.2 of the paper removes cloud at random and supplies vapour (hum) and activation (act) at random. Where and how
//! often is written as a stack of layers: each layer changes the probabilities that the layers below it left, one row of
//! cells at a time.

use crate::CloudError;
use crate::wind::Wind;

/// Probabilities per step of one row of cells: one value per x.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbabilityRow {
    /// That cloud of the cell vanishes.
    pub extinction: Vec<f32>,
    /// That the cell becomes humid.
    pub humidity: Vec<f32>,
    /// That the cell is activated: its vapour is about to condense.
    pub activation: Vec<f32>,
}

impl ProbabilityRow {
    /// All probabilities 0.
    #[must_use]
    pub fn zeros(nx: usize) -> Self {
        Self { extinction: vec![0.0; nx], humidity: vec![0.0; nx], activation: vec![0.0; nx] }
    }

    /// Sets every cell to the same values.
    pub fn fill(&mut self, values: Probabilities) {
        self.extinction.fill(values.extinction);
        self.humidity.fill(values.humidity);
        self.activation.fill(values.activation);
    }

    pub(crate) fn fields(&self) -> [&[f32]; 3] {
        [&self.extinction, &self.humidity, &self.activation]
    }
}

/// Probabilities per step of one cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Probabilities {
    /// That cloud of the cell vanishes.
    pub extinction: f32,
    /// That the cell becomes humid.
    pub humidity: f32,
    /// That the cell is activated.
    pub activation: f32,
}

/// How a step of the wind has changed the probabilities of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerMotion {
    /// Not at all.
    Still,
    /// Each column has those of another one, so many cells west and south of it in a grid that repeats, to the last bit.
    Shifted([i64; 2]),
    /// In some other way.
    Changed,
}

/// One layer of a stack of probabilities; later layers see what earlier ones left.
///
/// Values below 0 count as 0 and values from 1 on as always, so that a layer may scale without a test.
pub trait ProbabilityLayer: std::fmt::Debug + Send + Sync {
    /// Changes the probabilities of the cells (0.., y, z).
    fn apply(&self, y: usize, z: usize, row: &mut ProbabilityRow);

    /// Moves along with one step of the wind, and says how probabilities changed by that.
    fn blow(&mut self, wind: &Wind) -> LayerMotion {
        let _ = wind;
        LayerMotion::Still
    }

    /// Whether it does the same in every column, so that it matters to nobody where it stands.
    fn is_even(&self) -> bool {
        false
    }

    /// What changes while the layer moves, as numbers for a file.
    fn state(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Puts back what [`ProbabilityLayer::state`] gave.
    ///
    /// # Errors
    /// When the numbers are not those of such a layer.
    fn restore(&mut self, state: &[f64]) -> Result<(), CloudError> {
        let found = state.len();
        if found == 0 {
            return Ok(());
        }
        Err(CloudError::WrongLength { what: "the state of a layer that does not move".to_owned(), found, expected: 0 })
    }
}

/// The same probabilities everywhere.
impl ProbabilityLayer for Probabilities {
    fn apply(&self, _y: usize, _z: usize, row: &mut ProbabilityRow) {
        row.fill(*self);
    }

    fn is_even(&self) -> bool {
        true
    }
}
