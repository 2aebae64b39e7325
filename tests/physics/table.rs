//! Tables of numbers as text.

/// The numbers of a line between commas; words are left out.
pub(crate) fn numbers(line: &str) -> Vec<f64> {
    line.split(',').filter_map(|word| word.trim().parse().ok()).collect()
}

/// The lines that start with a number.
pub(crate) fn data_rows(text: &str) -> impl Iterator<Item = Vec<f64>> {
    text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())).map(numbers)
}
