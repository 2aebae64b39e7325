//! What options take: sizes in pixels and in bytes, and settings of parameters.

/// Width and height in pixels from a text like `1920x1080`. Any size that is one; the scene's range is checked later.
///
/// # Errors
/// A sentence for the user.
pub fn parse_size_px(text: &str) -> Result<[u32; 2], String> {
    let wrong = || "a size is width x height in pixels, such as 1920x1080".to_owned();
    let (width, height) = text.split_once(['x', 'X', '\u{d7}']).ok_or_else(wrong)?;
    let side_px = |text: &str| text.trim().parse::<u32>().map_err(|_not_a_number| wrong());
    Ok([side_px(width)?, side_px(height)?])
}

/// Bytes from a text like `8G`, `512MiB` or `1.5g`; the units are powers of 1024.
///
/// # Errors
/// A sentence for the user.
pub fn parse_bytes(text: &str) -> Result<u64, String> {
    let wrong = || "an amount of memory is a number with K, M, G or T, such as 8G or 512M".to_owned();
    let lower = text.trim().to_ascii_lowercase();
    let plain = lower.strip_suffix("ib").or_else(|| lower.strip_suffix('b')).unwrap_or(&lower);
    let units = [('k', 1_u64 << 10), ('m', 1 << 20), ('g', 1 << 30), ('t', 1 << 40)];
    let (number, unit) = units
        .into_iter()
        .find_map(|(letter, unit)| plain.strip_suffix(letter).map(|number| (number, unit)))
        .unwrap_or((plain, 1));
    let amount: f64 = number.trim().parse().map_err(|_not_a_number| wrong())?;
    let bytes = amount * unit as f64;
    if !(1.0..=MOST_BYTES).contains(&bytes) {
        return Err(wrong());
    }
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^53; a fraction of a byte does not matter")]
    let whole = bytes as u64;
    Ok(whole)
}

/// Amounts of memory up to here are exact as numbers with a fraction.
const MOST_BYTES: f64 = 9_007_199_254_740_992.0;

/// Path and value from a text like `sun.elevation_deg=12.5`. Whether there is such a parameter is for the scene to say.
///
/// # Errors
/// A sentence for the user.
pub fn parse_setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() && !value.trim().is_empty() => {
            Ok((path.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("a setting is group.parameter=value, such as sun.elevation_deg=12.5".to_owned()),
    }
}

/// An amount of memory with the unit that suits it.
#[must_use]
pub fn format_bytes(bytes: u64) -> String {
    let units = [("TiB", 1_u64 << 40), ("GiB", 1 << 30), ("MiB", 1 << 20), ("KiB", 1 << 10)];
    units
        .into_iter()
        .find(|(_, unit)| bytes >= *unit)
        .map_or_else(|| format!("{bytes} bytes"), |(name, unit)| format!("{:.1} {name}", bytes as f64 / unit as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_width_x_height() {
        for text in ["1920x1080", "1920X1080", " 1920 x 1080", "1920\u{d7}1080"] {
            assert_eq!(parse_size_px(text), Ok([1920, 1080]), "{text}");
        }
        for text in ["", "x", "1920", "1920x", "1920x1080x3", "-1x5", "nanx1", "99999999999x1"] {
            assert!(parse_size_px(text).is_err_and(|sentence| sentence.contains("1920x1080")), "{text:?}");
        }
    }

    #[test]
    fn amounts_of_memory_have_binary_units() {
        for (text, bytes) in
            [("8G", 8 << 30), ("8GiB", 8 << 30), ("1.5g", 3 << 29), ("512 M", 512 << 20), ("100", 100), ("2kb", 2048)]
        {
            assert_eq!(parse_bytes(text), Ok(bytes), "{text}");
        }
        for text in ["", "G", "-1G", "0", "nan", "inf", "1e40T", "8X"] {
            assert!(parse_bytes(text).is_err_and(|sentence| sentence.contains("8G")), "{text:?}");
        }
    }

    #[test]
    fn formatted_amounts_of_memory_are_read_back() {
        for bytes in [1 << 10, 3 << 29, 5 << 40] {
            assert_eq!(parse_bytes(&format_bytes(bytes)), Ok(bytes), "{}", format_bytes(bytes));
        }
    }

    #[test]
    fn settings_are_split_at_the_first_equals_sign() {
        assert_eq!(parse_setting("a.b = c=d"), Ok(("a.b".to_owned(), "c=d".to_owned())), "trimmed");
        for text in ["", "a.b", "=1", "a.b=", " = "] {
            assert!(parse_setting(text).is_err(), "{text:?}");
        }
    }
}
