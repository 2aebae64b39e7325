//! Laws of the parameter declarations.

use crate::{ParamError, ParamSet as _, choices, params};

choices! {
    /// Example of a choice.
    enum Shape {
        /// Round.
        Round = "round",
        /// Square.
        Square = "square",
    }
}

params! {
    /// Example of a set.
    struct Thing {
        /// Elevation above
        /// the horizon.
        elevation_deg: f64 = 30.0, ["deg", -90.0..=90.0, Linear], "Example, eq. 1";
        /// Hours ahead of UTC.
        utc_offset_h: f64 = 0.0, ["h", -12.0..=14.0, Linear], "Example";
        /// Column of ozone.
        ozone_du: f64 = 300.0, ["DU", 0.0..=1000.0, Linear], "Example";
        /// Number of cells.
        cells: u32 = 64, ["1", 8..=1024, Log], "Example, eq. 2";
        /// Switch.
        on: bool = true, "Example";
        /// Outline.
        shape: Shape = Shape::Square, "Example";
    }
    text {
        /// Name of
        /// a file.
        source_file = "none.csv", "Example";
    }
}

#[test]
fn every_default_is_an_allowed_value() {
    let thing = Thing::default();
    for (index, info) in thing.info().iter().enumerate() {
        assert_eq!(info.check(info.default), Ok(thing.get(index)), "{}", info.name);
    }
}

#[test]
fn text_survives_the_way_through_format_and_parse() {
    let mut thing = Thing {
        elevation_deg: -0.125,
        utc_offset_h: 5.5,
        ozone_du: 0.0,
        cells: 1000,
        on: false,
        shape: Shape::Round,
        ..Thing::default()
    };
    assert_eq!(thing.shape.name(), "round");
    let texts: Vec<_> = thing.info().iter().enumerate().map(|(i, info)| info.format(thing.get(i))).collect();
    assert_eq!(texts, ["-0.125", "5.5", "0.0", "1000", "false", "round"]);
    let written = thing.clone();
    thing = Thing::default();
    for (info, text) in Thing::default().info().iter().zip(&texts) {
        thing.set_text(info.name, text).unwrap();
    }
    assert_eq!(thing, written);
}

#[test]
fn nan_infinity_and_values_out_of_range_are_refused() {
    let mut thing = Thing::default();
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 90.001, -91.0] {
        assert!(matches!(thing.set("elevation_deg", value), Err(ParamError::OutOfRange { .. })), "{value}");
    }
    assert_eq!(thing, Thing::default(), "a refused value changes nothing");
}

#[test]
fn messages_name_value_unit_and_allowed_range() {
    let mut thing = Thing::default();
    let message = |result: Result<(), ParamError>| result.unwrap_err().to_string();
    assert_eq!(message(thing.set("elevation_deg", 99.0)), "`elevation_deg` = 99 deg is outside -90 to 90 deg");
    assert_eq!(message(thing.set("cells", 8.5)), "`cells` = 8.5 must be a whole number");
    assert_eq!(message(thing.set_text("shape", "oval")), r#"`shape` = "oval" is not one of "round", "square""#);
    assert_eq!(
        message(thing.set_text("elevation_deg", "up")),
        r#"`elevation_deg` = "up" is not a number from -90 to 90 deg"#
    );
    assert_eq!(message(thing.set("elevatoin_deg", 1.0)), "unknown parameter `elevatoin_deg`");
}

#[test]
fn labels_drop_the_unit_and_docs_lose_their_line_breaks() {
    let thing = Thing::default();
    let labels: Vec<_> = thing.info().iter().map(super::ParamInfo::label).collect();
    assert_eq!(labels, ["Elevation", "UTC offset", "Ozone", "Cells", "On", "Shape"]);
    assert_eq!(thing.info()[0].doc, "Elevation above the horizon.");
}

#[test]
fn texts_are_set_by_name_and_bad_ones_are_refused() {
    let mut thing = Thing::default();
    thing.set_text("source_file", "a folder/b=c.npz").unwrap();
    assert_eq!((thing.source_file.as_str(), thing.text(0)), ("a folder/b=c.npz", "a folder/b=c.npz"));
    let message = |result: Result<(), ParamError>| result.unwrap_err().to_string();
    let refused = message(thing.set_text("source_file", "two\nlines"));
    assert_eq!(refused, r"`source_file`: it has the control character '\n'; one line of text is allowed");
    let refused = message(thing.set_text("source_file", &"x".repeat(5000)));
    assert_eq!(refused, "`source_file`: it has 5000 bytes; 4096 are allowed");
    assert_eq!(message(thing.set("source_file", 1.0)), "`source_file` is a text, not a number");
    assert_eq!(thing.source_file, "a folder/b=c.npz", "a refused text changes nothing");
    let info = &thing.text_info()[0];
    assert_eq!((info.label().as_str(), info.doc, info.default), ("Source file", "Name of a file.", "none.csv"));
}
