//! What Tyndall's tests share: an adapter, WGSL functions run on many inputs, picture differences, reference data and the
//! command line program.

mod data;
mod device;
mod pictures;
mod program;
mod shader_function;
mod tolerance;

pub use data::shared_data;
pub use device::{gpu, own_gpu};
pub use pictures::{Difference, assert_pictures_match, halves_to_f32, picture_difference};
pub use program::tyndall_binary;
pub use shader_function::{assert_matches_cpu, evaluate, evaluate_text, mismatch, sample_box};
pub use tolerance::Tolerance;
