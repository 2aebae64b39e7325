//! Which crate may know which: the arrows of the architecture, read from cargo's own resolution.

mod arrows;
mod foreign;
mod graph;
