//! What callers of this crate can do wrong.

/// Refusals of this crate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ScatteringError {
    /// The GPU tables carry eight wavelengths; this atmosphere has another number.
    #[error("the tables need {expected} wavelengths; this atmosphere has {count}")]
    WavelengthCount {
        /// Wavelengths of the atmosphere.
        count: usize,
        /// Wavelengths of the tables.
        expected: usize,
    },
    /// The shaders know fewer profiles than the library.
    #[error(
        "the GPU draws exponential air and aerosol and a tent of ozone; this atmosphere's {medium} has another profile"
    )]
    ProfileOnGpu {
        /// The medium.
        medium: &'static str,
    },
    /// A line of an atmosphere file cannot be read.
    #[error("line {line}: {message}")]
    AtmosphereFile {
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A row that an atmosphere file needs is absent or has the wrong number of values.
    #[error("row `{row}` has {found} values; {expected} are needed")]
    AtmosphereRow {
        /// Name of the row.
        row: &'static str,
        /// Values found.
        found: usize,
        /// Values needed.
        expected: usize,
    },
    /// A number of things to compute is outside its range.
    #[error("{value} {what}: {} to {} are possible", range[0], range[1])]
    Count {
        /// Of what.
        what: &'static str,
        /// How many were asked for.
        value: f64,
        /// Fewest and most.
        range: [f64; 2],
    },
}
