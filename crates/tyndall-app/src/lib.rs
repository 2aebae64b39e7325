//! The Tyndall desktop program: a window in which a scene is edited and seen at once.
//!
//! The scene is a [`tyndall_scene::SceneFile`] in a document with undo history; the panels change it through the
//! parameters' declarations alone; the viewport draws it by [`tyndall_render::Renderer`] into a texture that egui shows,
//! and only when something has changed. Renders to files are child processes of the command line program.
//!
//! [`run`] opens the window. [`App`] is the program without one, which the tests drive through its accessible names.

mod action;
mod app;
mod banner;
mod bubble_handles;
mod chapters;
mod cloud_clock;
mod cloud_meter;
mod cloud_tools;
mod commands;
mod desert_clock;
mod desert_tools;
mod detail;
mod document;
mod engine;
mod error_meter;
mod export_options;
mod file_dialog;
mod jobs;
mod launch;
mod layout;
mod logging;
mod menu;
mod meter;
mod modal;
mod navigation;
mod panels;
mod preview;
mod recent;
mod recovery;
mod relevance;
mod sand_brush;
mod sky_probe;
mod stage;
mod steps_on;
mod sun_clock;
mod theme;
mod thumbnails;
mod viewport;
mod workbench;

pub use app::{App, AppOptions};
pub use launch::{run, wgpu_configuration};
pub use logging::{LogBuffer, LogEntry};
pub use panels::row::input_name;
