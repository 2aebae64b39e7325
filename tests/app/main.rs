//! The desktop program without its window, driven through the names that screen readers see.

mod accuracy;
mod clouds;
mod desert;
mod device_loss;
mod documents;
mod exports;
mod harness;
mod navigation;
mod parameters;
mod plots;
mod preconditions;
mod rest;
mod time;
