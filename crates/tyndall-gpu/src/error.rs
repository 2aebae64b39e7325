//! Everything that can go wrong between a shader file and bytes read back.

use tyndall_shaders::ComposeError;

/// Errors of this crate. Byte counts are printed with a binary unit and in full.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GpuError {
    /// The system offers no adapter at all.
    #[error("no graphics driver was found; {advice}")]
    NoAdapter {
        /// What to install on this system.
        advice: &'static str,
    },
    /// There are adapters, but none as asked for.
    #[error("no adapter fits `{wanted}`; there are: {available}{advice}")]
    AdapterNotFound {
        /// The choice as the user wrote it.
        wanted: String,
        /// The adapters there are, each with its index.
        available: String,
        /// What to install to get one, with a separator before it; may be empty.
        advice: String,
    },
    /// An empty text where an adapter is named.
    #[error("an adapter is `auto`, `software`, an index such as 0, or a part of its name; the text is empty")]
    EmptyAdapterChoice,
    /// The adapter gave no device.
    #[error("{adapter} gave no device: {message}")]
    NoDevice {
        /// The adapter.
        adapter: String,
        /// What the driver or wgpu says.
        message: String,
    },
    /// An allocation would exceed the byte budget; nothing was allocated.
    #[error(
        "{what} needs {}, but of the memory budget of {} only {} are free",
        bytes_text(*needed_bytes),
        bytes_text(*budget_bytes),
        bytes_text(*free_bytes)
    )]
    OverBudget {
        /// What was to be allocated.
        what: String,
        /// Bytes it needs.
        needed_bytes: u64,
        /// Bytes of the budget that are not in use.
        free_bytes: u64,
        /// The whole budget.
        budget_bytes: u64,
    },
    /// A size is outside what the device can do; nothing was allocated.
    #[error("{what} is {value}{unit}, outside 1 to {high}{unit}, the range of this device")]
    OverLimit {
        /// Which size of what.
        what: String,
        /// The size asked for.
        value: u64,
        /// Its unit with a space before it, or empty.
        unit: &'static str,
        /// Largest allowed size.
        high: u64,
    },
    /// WGSL files could not be put together.
    #[error(transparent)]
    Compose(#[from] ComposeError),
    /// A shader is not valid WGSL.
    #[error("{file}:{line}:{column}: {message}")]
    Shader {
        /// Original file.
        file: String,
        /// Its line, from 1.
        line: u32,
        /// Column in bytes, from 1.
        column: u32,
        /// What is wrong, and the line with a caret below it.
        message: String,
    },
    /// The shader has no such entry point of the stage asked for.
    #[error("{shader} has no {stage} entry point `{entry}`; it has: {available}")]
    UnknownEntry {
        /// Name of the shader.
        shader: String,
        /// compute, vertex or fragment.
        stage: &'static str,
        /// The entry point asked for.
        entry: String,
        /// The entry points of that stage.
        available: String,
    },
    /// An override constant does not exist, or a value is not possible for it.
    #[error("constants of `{entry}` in {shader}: {message}")]
    Constants {
        /// Name of the shader.
        shader: String,
        /// The entry point.
        entry: String,
        /// What is wrong.
        message: String,
    },
    /// The resources given do not fit the shader's variables.
    #[error("group {group} of {pipeline}: {problem}; it takes: {expected}")]
    Bindings {
        /// The pipeline.
        pipeline: String,
        /// Index of the bind group.
        group: u32,
        /// Which names are missing, unknown or given twice.
        problem: String,
        /// The names of the variables and what each is.
        expected: String,
    },
    /// wgpu refused a call.
    #[error("{what}: {message}")]
    Validation {
        /// What was being made or done.
        what: String,
        /// wgpu's explanation.
        message: String,
    },
    /// The driver has no memory left.
    #[error("{what}: the graphics driver is out of memory")]
    OutOfMemory {
        /// What was being made.
        what: String,
    },
    /// The device is gone; nothing computed since counts.
    #[error("the graphics device was lost ({reason}); what it computed does not count")]
    DeviceLost {
        /// What the driver says.
        reason: String,
    },
    /// Bytes could not be read back.
    #[error("reading back {what}: {message}")]
    Readback {
        /// The texture or buffer.
        what: String,
        /// Why not.
        message: String,
    },
}

/// `1.50 GiB (1610612736 bytes)`.
pub(crate) fn bytes_text(bytes: u64) -> String {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    let mut scaled = bytes as f64 / 1024.0;
    let mut unit = 0;
    while scaled >= 1024.0 && unit + 1 < UNITS.len() {
        scaled /= 1024.0;
        unit += 1;
    }
    if bytes < 1024 { format!("{bytes} bytes") } else { format!("{scaled:.2} {} ({bytes} bytes)", UNITS[unit]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn byte_counts_are_printed_with_unit_and_in_full() {
        for (bytes, text) in [
            (0, "0 bytes"),
            (1023, "1023 bytes"),
            (1024, "1.00 KiB (1024 bytes)"),
            (3 << 29, "1.50 GiB (1610612736 bytes)"),
            (u64::MAX, "16777216.00 TiB (18446744073709551615 bytes)"),
        ] {
            assert_eq!(bytes_text(bytes), text, "{bytes} bytes");
        }
    }
}
