//! The desktop program without its window, driven through the names that screen readers see.

mod device_loss;
mod documents;
mod harness;
mod navigation;
mod parameters;
mod plots;
mod preconditions;
mod rest;
mod time;
