//! Lists of metaballs as JSON: the names of the columns, and one array of five numbers for each ball.

use std::fmt::{self, Write as _};

use serde::de::{self, Deserialize, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::error::CloudError;
use crate::metaballs::{COLUMNS, Metaball, Metaballs};
use crate::narrow::narrow;

impl Metaballs {
    /// As JSON; [`Metaballs::from_json`] reads every number back.
    #[must_use]
    pub fn to_json(&self) -> String {
        let names = COLUMNS.map(|name| format!("\"{name}\"")).join(",");
        let mut text = format!("{{\"columns\":[{names}],\"balls\":[\n");
        for (index, Metaball { centre_m: [x, y, z], radius_m, extinction_per_m }) in self.balls.iter().enumerate() {
            let end = if index + 1 < self.balls.len() { "," } else { "" };
            // Writing to a String cannot fail.
            let _ = writeln!(text, "[{x},{y},{z},{radius_m},{extinction_per_m}]{end}");
        }
        text + "]}\n"
    }

    /// Reads what [`Metaballs::to_json`] writes.
    ///
    /// # Errors
    /// [`CloudError::BallPlace`] with line and column when the text is no JSON, has other columns or no list of balls, or a
    /// ball is none: not five numbers, a radius that is not above 0, an extinction below 0.
    pub fn from_json(text: &str) -> Result<Self, CloudError> {
        let list: List = serde_json::from_str(text).map_err(|error| {
            let (line, column) = (error.line(), error.column());
            let mut problem = error.to_string();
            if let Some(end) = problem.find(&format!(" at line {line} column {column}")) {
                problem.truncate(end);
            }
            CloudError::BallPlace { line, column, problem }
        })?;
        Ok(Self { balls: list.0.into_iter().map(|ball| ball.0).collect() })
    }
}

/// The whole text.
struct List(Vec<Ball>);

/// One ball that has been checked.
struct Ball(Metaball);

impl<'de> Deserialize<'de> for List {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ListVisitor)
    }
}

struct ListVisitor;

impl<'de> Visitor<'de> for ListVisitor {
    type Value = List;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an object with `columns` and `balls`")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<List, A::Error> {
        let mut balls = None;
        while let Some(key) = entries.next_key::<String>()? {
            match key.as_str() {
                "columns" => check_columns(&entries.next_value::<Vec<String>>()?)?,
                "balls" if balls.is_some() => return Err(de::Error::custom("there are two lists of `balls`")),
                "balls" => balls = Some(entries.next_value()?),
                other => return Err(de::Error::unknown_field(other, &["columns", "balls"])),
            }
        }
        balls.map(List).ok_or_else(|| de::Error::missing_field("balls"))
    }
}

fn check_columns<E: de::Error>(found: &[String]) -> Result<(), E> {
    if found == COLUMNS {
        return Ok(());
    }
    Err(E::custom(format!("the columns are {}; {} are read", found.join(", "), COLUMNS.join(", "))))
}

impl<'de> Deserialize<'de> for Ball {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(BallVisitor)
    }
}

struct BallVisitor;

impl<'de> Visitor<'de> for BallVisitor {
    type Value = Ball;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "an array of the five numbers {}", COLUMNS.join(", "))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Ball, A::Error> {
        let mut five = [0.0_f32; 5];
        for (index, place) in five.iter_mut().enumerate() {
            let number: f64 = numbers.next_element()?.ok_or_else(|| de::Error::invalid_length(index, &self))?;
            *place = narrow(number);
        }
        if numbers.next_element::<IgnoredAny>()?.is_some() {
            return Err(de::Error::custom("a ball has more than five numbers"));
        }
        Metaball::from_numbers(five).map(Ball).map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use tyndall_core::rng::CellRng;

    use super::*;

    /// Balls of any finite size, from random bits.
    fn some() -> Metaballs {
        let number = |ball: u64, column: u32| {
            let [bits, ..] = CellRng::new(3).words(column, ball, 0);
            Some(f32::from_bits(bits)).filter(|value| value.is_finite()).unwrap_or(0.1)
        };
        let ball = |ball| Metaball {
            centre_m: [0, 1, 2].map(|axis| number(ball, axis)),
            radius_m: number(ball, 3).abs().max(f32::MIN_POSITIVE),
            extinction_per_m: number(ball, 4).abs(),
        };
        Metaballs { balls: (0..4000).map(ball).collect() }
    }

    #[test]
    fn every_number_survives_the_way_through_json() {
        assert_eq!(Metaballs::from_json(&some().to_json()), Ok(some()), "bit for bit");
        assert_eq!(Metaballs::from_json(&Metaballs::default().to_json()), Ok(Metaballs::default()), "no ball");
    }

    #[test]
    fn json_has_a_row_for_each_ball() {
        let text = some().to_json();
        assert_eq!(text.lines().count(), 4002, "head, balls, end");
        assert!(text.starts_with("{\"columns\":[\"x_m\","), "{text}");
    }

    #[test]
    fn other_programs_may_lay_the_text_out_as_they_like() {
        let text = "{ \"balls\" : [ [1, 2e0, -3.5,\n 4, 0.5] ] }";
        let ball = Metaball { centre_m: [1.0, 2.0, -3.5], radius_m: 4.0, extinction_per_m: 0.5 };
        assert_eq!(Metaballs::from_json(text), Ok(Metaballs { balls: vec![ball] }), "spaces, order, no columns");
    }

    #[test]
    fn what_is_no_list_is_refused_with_line_column_and_reason() {
        for (text, place, reason) in [
            (
                "{\"balls\":[\n[1,2,3,4]]}",
                "line 2, column 9: ",
                "invalid length 4, expected an array of the five numbers x_m",
            ),
            ("{\"balls\":[\n[1,2,3,4,5,6]]}", "line 2, ", "more than five numbers"),
            ("{\"balls\":[\n[1,2,3,0,5]]}", "line 2, ", "radius 0 m must be above 0"),
            ("{\"balls\":[\n[1,2,3,4,-5]]}", "line 2, ", "extinction -5 1/m must not be below 0"),
            ("{\"balls\":[\n[1,2,\"x\",4,5]]}", "line 2, ", "string \"x\""),
            ("{\"balls\":[\n[1,2,1e39,4,5]]}", "line 2, ", "inf is not a finite number"),
            ("{\"balls\":[[1,2,3,4,5]", "line 1, ", "EOF while parsing"),
            ("{\"spheres\":[]}", "line 1, ", "unknown field `spheres`"),
            ("{\"columns\":[\"x\"],\"balls\":[]}", "line 1, ", "the columns are x; x_m, y_m, z_m"),
            ("{}", "line 1, ", "missing field `balls`"),
            ("x_m,y_m", "line 1, column 1: ", "expected value"),
        ] {
            let error = Metaballs::from_json(text).unwrap_err().to_string();
            assert!(error.starts_with(place) && error.contains(reason), "{text:?}: {error}");
        }
    }
}
