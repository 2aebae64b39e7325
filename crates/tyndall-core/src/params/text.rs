//! Parameters that are text: names of files and of what is in them.

use super::{ParamError, info::label_of};

/// Longest text (bytes).
pub const MAX_TEXT_BYTES: usize = 4096;

/// Static description of one parameter that is text. Texts stand beside the numbers of [`ParamInfo`](super::ParamInfo), as no
/// slider moves them and no keyframe interpolates them.
#[derive(Clone, Debug)]
pub struct TextInfo {
    /// Key in scene files and on the command line.
    pub name: &'static str,
    /// Text of a new scene.
    pub default: &'static str,
    /// What the parameter does; tooltip and help text.
    pub doc: &'static str,
    /// Paper, section or equation that the parameter comes from.
    pub source: &'static str,
}

impl TextInfo {
    /// The name for people: `file` becomes "File".
    #[must_use]
    pub fn label(&self) -> String {
        label_of(self.name)
    }

    /// Checks that the text fits on a line.
    ///
    /// # Errors
    /// When it is longer than [`MAX_TEXT_BYTES`] or has line breaks or other control characters.
    pub fn check<'a>(&self, text: &'a str) -> Result<&'a str, ParamError> {
        if text.len() > MAX_TEXT_BYTES {
            let reason = format!("it has {} bytes; {MAX_TEXT_BYTES} are allowed", text.len());
            return Err(ParamError::Text { name: self.name, reason });
        }
        if let Some(found) = text.chars().find(|c| c.is_control()) {
            let reason = format!("it has the control character {found:?}; one line of text is allowed");
            return Err(ParamError::Text { name: self.name, reason });
        }
        Ok(text)
    }

    /// What a text takes, for messages.
    pub const EXPECTED: &'static str = "a line of text";
}
