//! Laws that the automata keep, on whole beds.

mod dunes;
mod ripples;
mod support;
