//! What lies beyond the edges of a bed.

use tyndall_core::choices;

choices! {
    /// What lies beyond the edges of a bed.
    pub enum Edges {
        /// The bed again: sand that leaves on one side comes back on the other.
        Periodic = "periodic",
        /// Nothing: sand that leaves is counted and gone.
        Open = "open",
    }
}
