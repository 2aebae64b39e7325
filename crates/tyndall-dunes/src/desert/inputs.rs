//! What a desert takes from files and hands beside its parameters.

use std::sync::Arc;

use super::by_hand::Touch;
use crate::terrain::Terrain;
use crate::wind::WindSchedule;

/// What a desert takes from files and hands beside its parameters; nothing of it unless somebody reads them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DesertInputs {
    /// What lies under the sand, in place of level ground.
    pub terrain: Option<Arc<Terrain>>,
    /// Winds in place of those of the parameters.
    pub winds: Option<WindSchedule>,
    /// Touches by hand, in the order of their steps.
    pub touches: Vec<Touch>,
}
