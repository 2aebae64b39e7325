//! Words of the user's file in messages: in one line, cut to a length, without characters that steer a terminal.

/// Characters of the user's text that a message repeats at most.
const MOST: usize = 40;

/// The beginning of a text, with `..` where something was cut off.
pub(crate) fn brief(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    let cut = line.len() < text.trim_end().len() || line.chars().nth(MOST).is_some();
    let shown: String =
        line.chars().take(MOST).map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect();
    if cut { shown + ".." } else { shown }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_and_hostile_texts_become_short_and_harmless() {
        for (text, expected) in [
            ("1280.0", "1280.0"),
            ("[1, 2,\n 3]", "[1, 2,.."),
            ("su\u{1b}n", "su\u{fffd}n"),
            (&"x".repeat(1000), &("x".repeat(40) + "..")),
        ] {
            assert_eq!(brief(text), expected, "{text:?}");
        }
    }
}
