//! Every function of `shaders/common` against its Rust twin: same name, same order of arguments, f64.
//!
//! To add a file: write `twins/NAME.rs` with a [`twins!`] table, and add `mod NAME;` and `NAME::ROWS` below.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use tyndall_shaders::FILES;

use crate::documentation::{SHARED, functions};

/// Inputs that a function is tried on.
pub(crate) const INPUTS: usize = 4096;

/// Range of an axis that a function does not use.
pub(crate) const NONE: RangeInclusive<f32> = 0.0..=0.0;

/// A function and the expressions that are compared.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) file: &'static str,
    pub(crate) function: &'static str,
    pub(crate) expressions: &'static [&'static str],
}

/// A table of functions of one file, and a test for each:
///
/// ```text
/// twins! { "common/phase.wgsl";
///     phase_hg in [-1.0..=1.0, -0.9..=0.9, NONE, NONE], within Tolerance::relative(1e-5), {
///         "phase_hg(x.x, x.y)" => |x| phase::phase_hg(x[0], x[1]),
///     }
/// }
/// ```
macro_rules! twins {
    ($file:literal; $($function:ident in $ranges:expr, within $tolerance:expr, {
        $($expression:literal => $reference:expr),+ $(,)?
    })+) => {
        pub(crate) const ROWS: &[$crate::twins::Row] = &[$($crate::twins::Row {
            file: $file,
            function: stringify!($function),
            expressions: &[$($expression),+],
        }),+];

        $(mod $function {
            use super::*;

            #[test]
            fn matches_its_rust_twin() {
                let inputs = tyndall_tests::sample_box(&$ranges, $crate::twins::INPUTS);
                $(tyndall_tests::assert_matches_cpu($expression, &[$file], &inputs, $reference, $tolerance);)+
            }
        })+
    };
}

mod erosion;
mod grain;
mod lattice;
mod noise;
mod phase;
mod sand;
mod spectrum;
mod sphere;
mod tone;

/// The tables of all files.
const TABLES: &[&[Row]] = &[
    erosion::ROWS,
    grain::ROWS,
    lattice::ROWS,
    noise::ROWS,
    phase::ROWS,
    sand::ROWS,
    spectrum::ROWS,
    sphere::ROWS,
    tone::ROWS,
];

/// Shared functions that no row compares, and rows that compare no shared function.
fn gaps(files: &[(&str, &str)], rows: &[&Row]) -> Vec<String> {
    let shared = files.iter().filter(|(name, _)| name.starts_with(SHARED));
    let declared: BTreeSet<(&str, &str)> =
        shared.flat_map(|(file, text)| functions(text).map(move |(name, _)| (*file, name))).collect();
    let calls = |row: &Row| row.expressions.iter().all(|expression| expression.contains(&format!("{}(", row.function)));
    let compared: BTreeSet<(&str, &str)> =
        rows.iter().filter(|row| calls(row)).map(|row| (row.file, row.function)).collect();
    let without = declared.difference(&compared).map(|(file, name)| {
        format!("{file}: `{name}` has no row in tests/shaders/twins/ whose every expression calls it")
    });
    let dangling = compared.difference(&declared).map(|(file, name)| format!("{file} has no function `{name}`"));
    without.chain(dangling).collect()
}

#[test]
fn every_shared_function_is_compared_with_its_twin() {
    let rows: Vec<&Row> = TABLES.iter().copied().flatten().collect();
    let gaps = gaps(FILES, &rows);
    assert!(gaps.is_empty(), "{}", gaps.join("\n"));
}

#[test]
fn planted_functions_without_twin_and_rows_without_function_are_found() {
    let files = [("common/a.wgsl", "fn a(x: f32) -> f32 { return x; }\nfn b() {}\n"), ("sky/c.wgsl", "fn c() {}\n")];
    let row = |function, expressions| Row { file: "common/a.wgsl", function, expressions };
    let (good, gone, idle) = (row("a", &["a(x.x)"]), row("z", &["z(x.x)"]), row("b", &["x.x"]));
    let found = gaps(&files, &[&good, &gone]);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].starts_with("common/a.wgsl: `b` has no row"), "{found:?}");
    assert_eq!(found[1], "common/a.wgsl has no function `z`", "a row that outlived its function");
    let found = gaps(&files, &[&good, &idle]);
    assert_eq!(found.len(), 1, "a row whose expression does not call its function is no test: {found:?}");
}
