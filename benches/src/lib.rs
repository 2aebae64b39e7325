//! What Tyndall's benches share: options, statistics and reports. README.md beside this crate says what each bench times and
//! how to read it.

mod options;
mod report;
mod samples;

pub use options::{CommonOptions, is_smoke};
pub use report::{JsonLines, print_line};
pub use samples::{Samples, measure};
