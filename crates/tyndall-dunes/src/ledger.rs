//! Where the sand of a field came from and went to, exactly.

/// Amounts in quanta since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ledger {
    /// Sand at the start.
    pub start: i64,
    /// Sand that came in over open edges.
    pub entered: i64,
    /// Sand that left over open edges.
    pub left: i64,
    /// Sand that brushes put down.
    pub brushed_on: i64,
    /// Sand that brushes took away.
    pub brushed_off: i64,
    /// Rock that became sand.
    pub abraded: i64,
}

impl Ledger {
    /// The sand that there must be.
    #[must_use]
    pub fn expected(&self) -> i64 {
        self.start + self.entered - self.left + self.brushed_on - self.brushed_off + self.abraded
    }
}
