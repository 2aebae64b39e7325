//! Broken scene files: each is refused at the right line and column, with the right field and words that help.

use tyndall_scene::{MAX_BYTES, SceneError, SceneFile};

/// What a broken text must be answered with: line, column, field, and a part of the message.
struct Case {
    what: &'static str,
    text: &'static str,
    at: (usize, usize),
    field: &'static str,
    says: &'static str,
}

const fn case(
    what: &'static str,
    text: &'static str,
    at: (usize, usize),
    field: &'static str,
    says: &'static str,
) -> Case {
    Case { what, text, at, field, says }
}

fn refusal(text: &str) -> SceneError {
    match SceneFile::parse("scene.toml", text) {
        Err(error) => error,
        Ok(file) => panic!("{text:?} was taken for {:?}", file.scene),
    }
}

fn assert_refused(cases: &[Case]) {
    for Case { what, text, at: (line, column), field, says } in cases {
        let error = refusal(text);
        let place = error.place().unwrap_or_else(|| panic!("{what}: no place in {error}"));
        assert_eq!((place.line, place.column), (*line, *column), "{what}:\n{}", error.report());
        assert_eq!(error.field().as_deref().unwrap_or_default(), *field, "{what}: {error}");
        assert!(error.to_string().contains(says), "{what}: {error:?} does not say {says:?}");
        let report = error.report();
        let caret = report.lines().last().and_then(|line| line.find('^'));
        assert!(caret.is_some() && report.contains(&format!("{place}")), "{what}:\n{report}");
        assert!(!report.contains('\u{1b}'), "{what}: {report:?} steers the terminal");
    }
}

#[test]
fn files_without_a_known_format_are_refused() {
    let missing = "`format` is missing; a scene file begins with `format = 1`";
    assert_refused(&[
        case("empty file", "", (1, 1), "format", missing),
        case("comments only", "# nothing yet\n", (1, 1), "format", missing),
        case("no format", "title = \"x\"\n[sun]\n", (1, 1), "format", missing),
        case("format inside a group", "[sun]\nformat = 1\n", (1, 1), "format", missing),
        case("format as string", "format = \"1\"\n", (1, 10), "format", "\"1\" is a string, not the whole number 1"),
        case("format as float", "format = 1.0\n", (1, 10), "format", "1.0 is a float"),
        case("newer format", "format = 2\n", (1, 10), "format", "a newer version of Tyndall wrote this file"),
        case("format that never was", "format = 0\n", (1, 10), "format", "`format` = 0 is not known"),
        case("format before all else", "[sum]\nx = 1\n", (1, 1), "format", missing),
    ]);
}

#[test]
fn unknown_names_are_refused_with_the_nearest_one() {
    assert_refused(&[
        case("group", "format = 1\n[sum]\n", (2, 2), "sum", "unknown group `sum`; did you mean `sun`?"),
        case(
            "parameter",
            "format = 1\n[sun]\n  elevatoin_deg = 3\n",
            (3, 3),
            "sun.elevatoin_deg",
            "unknown parameter `sun.elevatoin_deg`; did you mean `sun.elevation_deg`?",
        ),
        case(
            "without its unit",
            "format = 1\n[image]\nwidth = 3\n",
            (3, 1),
            "image.width",
            "did you mean `image.width_px`?",
        ),
        case(
            "of another group",
            "format = 1\n[camera]\nelevation_deg = 3\n",
            (3, 1),
            "camera.elevation_deg",
            "did you mean `sun.elevation_deg`?",
        ),
        case("outside any group", "format = 1\nev100 = 3\n", (2, 1), "ev100", "did you mean `film.ev100`?"),
        case(
            "in an inline table",
            "format = 1\nsun = { elevation_deg = 3, azimut_deg = 4 }\n",
            (2, 28),
            "sun.azimut_deg",
            "did you mean `sun.azimuth_deg`?",
        ),
        case("like nothing known", "format = 1\n[wombat]\n", (2, 2), "wombat", "unknown group `wombat`"),
        case("with a control character", "format = 1\n\"s\\u001b\" = 1\n", (2, 1), "s\u{fffd}", "unknown group"),
    ]);
}

#[test]
fn values_of_the_wrong_type_are_refused_with_what_they_should_be() {
    let angle = "not a number from -90 to 90 deg";
    assert_refused(&[
        case("string", "format = 1\n[sun]\nelevation_deg = \"35\"\n", (3, 17), "sun.elevation_deg", angle),
        case(
            "array",
            "format = 1\n[sun]\nelevation_deg = [1, 2, 3]\n",
            (3, 17),
            "sun.elevation_deg",
            "[1, 2, 3] is an array",
        ),
        case("table", "format = 1\n[sun.disc]\n", (2, 1), "sun.disc", "`sun.disc` is a table, not true or false"),
        case("dotted", "format = 1\nsun.disc.x = 1\n", (2, 5), "sun.disc", "`sun.disc` is a table"),
        case(
            "float",
            "format = 1\n[image]\nwidth_px = 1280.0\n",
            (3, 12),
            "image.width_px",
            "a whole number from 1 to 16384 px",
        ),
        case("number for toggle", "format = 1\n[sun]\ndisc = 1\n", (3, 8), "sun.disc", "an integer, not true or false"),
        case(
            "number for choice",
            "format = 1\n[film]\ntone_map = 3\n",
            (3, 12),
            "film.tone_map",
            "\"agx\", \"aces\", \"none\"",
        ),
        case(
            "date",
            "format = 1\n[sun]\nyear = 2026-06-21\n",
            (3, 8),
            "sun.year",
            "is a date or time, not a whole number",
        ),
        case("title", "format = 1\ntitle = 3\n", (2, 9), "title", "`title` = 3 is an integer, not a string"),
        case("group", "format = 1\nsun = 5\n", (2, 7), "sun", "`sun` = 5 is an integer, not a table"),
        case("array of tables", "format = 1\n[[sun]]\ndisc = true\n", (2, 1), "sun", "an array of tables"),
    ]);
}

#[test]
fn values_that_are_not_allowed_are_refused_with_unit_and_range() {
    assert_refused(&[
        case(
            "too large",
            "format = 1\n[sun]\nelevation_deg = 99\n",
            (3, 17),
            "sun.elevation_deg",
            "scene.toml:3:17: `sun.elevation_deg` = 99 deg is outside -90 to 90 deg",
        ),
        case(
            "nan",
            "format = 1\n[sun]\nelevation_deg = nan\n",
            (3, 17),
            "sun.elevation_deg",
            "NaN deg is outside -90 to 90 deg",
        ),
        case("inf", "format = 1\n[camera]\nx_m = -inf\n", (3, 7), "camera.x_m", "-inf m is outside"),
        case(
            "negative",
            "format = 1\n[image]\nwidth_px = -3\n",
            (3, 12),
            "image.width_px",
            "-3 px is outside 1 to 16384 px",
        ),
        case(
            "huge",
            "format = 1\n[image]\nwidth_px = 9223372036854775807\n",
            (3, 12),
            "image.width_px",
            "is outside 1 to 16384 px",
        ),
        case(
            "choice",
            "format = 1\n[film]\ntone_map = \"agxx\"\n",
            (3, 12),
            "film.tone_map",
            "\"agxx\" is not one of \"agx\"",
        ),
        case("dotted", "format = 1\nsun.elevation_deg = 100\n", (2, 21), "sun.elevation_deg", "100 deg is outside"),
        case("after a mark", "\u{feff}format = 1\nsun.elevation_deg = 100\n", (2, 21), "sun.elevation_deg", "100 deg"),
        case("Windows lines", "format = 1\r\n[sun]\r\ndisc = 5\r\n", (3, 8), "sun.disc", "not true or false"),
    ]);
}

#[test]
fn values_that_do_not_fit_together_are_refused_where_they_are_written() {
    assert_refused(&[
        case(
            "31 February",
            "format = 1\n[sun]\nposition = \"date\"\nmonth = 2\nday = 31\n",
            (5, 7),
            "sun.day",
            "`sun.day` = 31 is outside 1 to 28, the days of 2026-02",
        ),
        case(
            "ozone above the top",
            "format = 1\n[atmosphere]\ntop_altitude_km = 20\n",
            (3, 19),
            "atmosphere.ozone_altitude_km",
            "`atmosphere.ozone_altitude_km` = 25 km is above `atmosphere.top_altitude_km` = 20 km",
        ),
    ]);
}

#[test]
fn texts_that_are_not_toml_are_refused_with_the_field_they_break_in() {
    let angle = "in `sun.elevation_deg`, which takes a number from -90 to 90 deg";
    assert_refused(&[
        case("key twice", "format = 1\n[sun]\ndisc = true\ndisc = true\n", (4, 1), "sun.disc", "duplicate key"),
        case("group twice", "format = 1\n[sun]\n[film]\n[sun]\n", (4, 2), "sun", "duplicate key"),
        case("open string", "format = 1\ntitle = \"open\n[sun]\n", (2, 14), "title", "invalid basic string"),
        case("open text", "format = 1\ntitle = \"\"\"open\n", (3, 1), "", "invalid multi-line basic string"),
        case("open table", "format = 1\n[sun\nelevation_deg = 3\n", (2, 5), "sun", "unclosed table"),
        case("bad number", "format = 1\n[sun]\nelevation_deg = 3.\n", (3, 19), "sun.elevation_deg", angle),
        case("decimal comma", "format = 1\n[sun]\nelevation_deg = 1,5\n", (3, 18), "sun.elevation_deg", angle),
        case(
            "two numbers",
            "format = 1\n[sun]\nelevation_deg = 2 3\n",
            (3, 17),
            "sun.elevation_deg",
            "`2 3` is not a value",
        ),
        case("no value", "format = 1\n[sun]\nelevation_deg =\n", (3, 16), "sun.elevation_deg", "the value is missing"),
        case("no equals", "format = 1\n[sun]\nelevation_deg 3\n", (3, 15), "sun.elevation_deg", "expected `=`"),
        case("no key", "format = 1\n= 3\n", (2, 1), "", "keys cannot be empty"),
        case("yes", "format = 1\n[sun]\ndisc = yes\n", (3, 8), "sun.disc", "`yes` is not a value; strings need quotes"),
        case(
            "beyond 64 bits",
            "format = 1\n[image]\nwidth_px = 99999999999999999999\n",
            (3, 12),
            "image.width_px",
            "which takes a whole number from 1 to 16384 px",
        ),
        case("zero byte", "format = 1\n[sun]\n\0 = 3\n", (3, 1), "sun", "invalid unquoted key"),
    ]);
}

#[test]
fn deep_nesting_is_refused_quickly() {
    for (text, line) in [
        (format!("format = 1\nsun = {}", "[".repeat(100_000)), 2),
        (format!("format = 1\n{}a = 1\n", "a.".repeat(100_000)), 2),
        (format!("format = 1\n\n{}", "{a=".repeat(100_000)), 3),
    ] {
        let start = std::time::Instant::now();
        let error = refusal(&text);
        assert_eq!(error.place().map(|place| place.line), Some(line), "{}", error.report());
        assert!(error.report().len() < 1000, "{}", error.report());
        // Measured: 40 ms; the bound is that of a user's patience.
        assert!(start.elapsed().as_secs() < 2, "{:?}", start.elapsed());
    }
}

#[test]
fn the_report_shows_the_line_with_a_caret_under_the_place() {
    let report = refusal("format = 1\n[sun]\n\televation_deg = 99 # high\n").report();
    let expected = "error: `sun.elevation_deg` = 99 deg is outside -90 to 90 deg\n \
                    --> scene.toml:3:18\n  |\n3 |  elevation_deg = 99 # high\n  |                  ^^\n";
    assert_eq!(report, expected, "{report}");
}

#[test]
fn files_that_are_no_text_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let load = || SceneFile::load(&path).unwrap_err();

    let missing = load();
    assert!(matches!(missing, SceneError::Read { .. }), "{missing}");
    assert!(missing.to_string().starts_with(&path.display().to_string()), "{missing}");

    std::fs::write(&path, b"format = 1\n# caf\xe9\n").unwrap();
    let latin = load();
    assert_eq!(latin.place().map(|place| (place.line, place.column)), Some((2, 6)), "{latin}");

    std::fs::write(&path, "#".repeat(MAX_BYTES + 1)).unwrap();
    let large = load();
    assert!(matches!(large, SceneError::TooLarge { .. }), "{large}");

    let directory = SceneFile::load(folder.path()).unwrap_err();
    assert!(matches!(directory, SceneError::Folder { .. }), "{directory}");
}
