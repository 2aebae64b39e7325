//! The panels around the viewport.

pub(crate) mod camera;
pub(crate) mod export;
pub(crate) mod gallery;
pub(crate) mod group;
pub(crate) mod log;
pub(crate) mod parameters;
pub(crate) mod row;
pub(crate) mod timings;
