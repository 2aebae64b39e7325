//! The panels around the viewport.

pub(crate) mod camera;
mod cloud_figures;
pub(crate) mod clouds;
pub(crate) mod desert;
mod desert_figures;
pub(crate) mod dial;
pub(crate) mod export;
mod figure_table;
pub(crate) mod gallery;
pub(crate) mod group;
pub(crate) mod log;
pub(crate) mod parameters;
pub(crate) mod plots;
mod rose;
pub(crate) mod row;
mod signs;
mod sky_map;
mod text_row;
pub(crate) mod time;
pub(crate) mod timings;
pub(crate) mod validate;
pub(crate) mod validate_clouds;
pub(crate) mod wind;

/// Room beside the contents of a list for its scroll bar.
pub(crate) const SCROLL_MARGIN: egui::Margin = egui::Margin { left: 4, right: 10, top: 0, bottom: 0 };
