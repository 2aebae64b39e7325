//! One declaration per parameter.
//!
//! [`params!`](crate::params!) turns a list of `name: type = default, ["unit", low..=high, Scale], "source";` lines into a
//! plain struct with `Default`, and into a table of [`ParamInfo`] that scene files, `--set`, sliders, `--help`, the JSON
//! schema and the documentation walk without knowing the type. [`choices!`](crate::choices!) does the same for parameters
//! that pick one of a few names. Texts, such as the name of a file, stand in a section of their own: [`TextInfo`].

pub mod docs;
mod error;
mod info;
mod macros;
mod set;
mod text;
#[doc(hidden)]
pub mod types;

pub use error::ParamError;
pub use info::{ParamInfo, ParamKind, Scale};
pub use set::ParamSet;
pub use text::{MAX_TEXT_BYTES, TextInfo};
pub use types::ParamType;

#[cfg(test)]
mod tests;
