//! Streams of random words of a field, and their keys in a step.

use crate::hash::step_key;

/// Lifting and hopping slabs.
const LIFT_STREAM: u32 = 0;
/// Slabs that come in over open edges.
const INFLOW_STREAM: u32 = 1;
/// Which of equally steep neighbours sand slides to.
const SLIDE_STREAM: u32 = 2;
/// Noise on the sand at the start.
pub(super) const NOISE_STREAM: u32 = 3;
/// Rock that wears.
const ABRASION_STREAM: u32 = 4;
/// Seedlings at the start.
pub(super) const PLANT_STREAM: u32 = 5;

/// Keys of all random words of one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DuneKeys {
    /// Of lifting and hopping slabs.
    pub lift: u32,
    /// Of slabs that come in over open edges.
    pub inflow: u32,
    /// Of the first pass of sliding; each further pass adds 1.
    pub slide: u32,
    /// Of rock that wears.
    pub abrasion: u32,
}

impl DuneKeys {
    /// Keys of a step.
    #[must_use]
    pub fn new(seed: u32, step: u32) -> Self {
        let key = |stream| step_key(seed, step, stream);
        Self {
            lift: key(LIFT_STREAM),
            inflow: key(INFLOW_STREAM),
            slide: key(SLIDE_STREAM),
            abrasion: key(ABRASION_STREAM),
        }
    }
}
