//! Every WGSL file: valid, portable, without the constructs that software adapters get wrong, documented, and compared
//! with its Rust twin.

mod blowing;
mod documentation;
mod glints;
mod layouts;
mod loops;
mod modules;
mod portability;
mod rays;
mod relief;
mod rules;
mod twins;
