//! Why a parameter's value was not taken.

/// Refusals of [`ParamSet::set`](super::ParamSet::set) and [`ParamInfo::parse`](super::ParamInfo::parse).
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ParamError {
    /// No parameter of that name.
    #[error("unknown parameter `{name}`")]
    Unknown {
        /// The name as the user wrote it.
        name: String,
    },
    /// The value lies outside its range, or is NaN or infinite.
    #[error("`{name}` = {value}{unit} is outside {low} to {high}{unit}")]
    OutOfRange {
        /// Name of the parameter.
        name: &'static str,
        /// The value as the user wrote it.
        value: f64,
        /// Smallest allowed value.
        low: f64,
        /// Largest allowed value.
        high: f64,
        /// Unit of value and range with a space before it; empty when dimensionless.
        unit: String,
    },
    /// A fraction where a whole number is needed.
    #[error("`{name}` = {value} must be a whole number")]
    NotWhole {
        /// Name of the parameter.
        name: &'static str,
        /// The value as the user wrote it.
        value: f64,
    },
    /// A text that is too long or has characters that are not allowed.
    #[error("`{name}`: {reason}")]
    Text {
        /// Name of the parameter.
        name: &'static str,
        /// What is wrong and what would be allowed.
        reason: String,
    },
    /// A number for a parameter that is text.
    #[error("`{name}` is a text, not a number")]
    IsText {
        /// Name of the parameter.
        name: &'static str,
    },
    /// The text cannot be a value of this parameter.
    #[error("`{name}` = {text:?} is not {expected}")]
    WrongKind {
        /// Name of the parameter.
        name: &'static str,
        /// The text as the user wrote it.
        text: String,
        /// What would be allowed.
        expected: String,
    },
}
