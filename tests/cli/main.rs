//! The program `tyndall` as its users meet it: files, sentences and exit codes.

mod blender;
mod frames;
mod heightmap;
mod light;
mod outside;
mod pictures;
mod probe;
mod program;
mod progress;
mod refusals;
mod simulate;
mod tables;
mod volume;
