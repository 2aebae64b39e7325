//! What lies beyond the sides of the grid.

tyndall_core::choices! {
    /// What lies beyond the sides of the grid; below and above there is never anything.
    pub enum Edges {
        /// Nothing: neighbours are empty, clouds leave with the wind, and air of a given humidity comes in.
        Open = "open",
        /// The grid again: what leaves on one side comes in on the other, and pictures tile.
        Wrap = "wrap",
    }
}
