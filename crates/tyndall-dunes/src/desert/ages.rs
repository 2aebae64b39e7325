//! When the bed last moved, cell by cell: an observer that changes nothing of what it looks at.

use rayon::prelude::*;

/// Cells that a thread takes at a time.
const CHUNK: usize = 1 << 14;

/// The step in which each cell's height changed last.
#[derive(Clone, Debug)]
pub(super) struct Ages {
    before: Vec<i32>,
    pub(super) moved_at: Vec<u32>,
}

impl Ages {
    /// Of a bed that has not moved so far.
    pub(super) fn new(heights: &[i32], step: u32) -> Self {
        Self { before: heights.to_vec(), moved_at: vec![step; heights.len()] }
    }

    /// Of a bed with a past.
    pub(super) fn with_past(heights: &[i32], moved_at: Vec<u32>) -> Self {
        Self { before: heights.to_vec(), moved_at }
    }

    /// Looks at the bed after a step.
    pub(super) fn observe(&mut self, heights: &[i32], step: u32) {
        let cells = self.before.par_chunks_mut(CHUNK).zip(self.moved_at.par_chunks_mut(CHUNK));
        cells.zip(heights.par_chunks(CHUNK)).for_each(|((before, moved_at), heights)| {
            for ((before, moved_at), &height) in before.iter_mut().zip(moved_at).zip(heights) {
                *moved_at = if *before == height { *moved_at } else { step };
                *before = height;
            }
        });
    }
}
