//! The known name that a misspelt one most likely stands for.

/// Similarity below which two names have nothing to do with each other. 0.8 takes one or two wrong, missing or swapped
/// letters and a forgotten unit (`elevation` for `elevation_deg`), and refuses `colour` for `camera`.
const LEAST_SIMILARITY: f64 = 0.8;

/// The candidate most similar to `word` (Winkler 1990), the first of equals.
pub(crate) fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let mut best = (LEAST_SIMILARITY, None);
    for candidate in candidates {
        let similarity = strsim::jaro_winkler(word, candidate);
        if similarity > best.0 {
            best = (similarity, Some(candidate));
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspelt_names_find_the_right_one_and_foreign_ones_find_none() {
        let known = ["elevation_deg", "azimuth_deg", "time_h", "disc", "camera"];
        for (word, expected) in [
            ("elevatoin_deg", Some("elevation_deg")),
            ("elevation", Some("elevation_deg")),
            ("disk", Some("disc")),
            ("azimut_deg", Some("azimuth_deg")),
            ("colour", None),
            ("", None),
        ] {
            assert_eq!(nearest(word, known.into_iter()), expected, "{word}");
        }
    }
}
