//! Lists of metaballs: free places and radii, for splatting, for other programs, and for merging in the distance.

use std::fmt::Write as _;

use tyndall_core::metaball::{BALL_MASS, ball_column, ball_field};

use crate::error::CloudError;
use crate::narrow::narrow;

/// One ball of equation (3).
#[expect(clippy::struct_field_names, reason = "names end in their units")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metaball {
    /// Centre (m): east, north, up.
    pub centre_m: [f32; 3],
    /// Radius beyond which it is nothing (m).
    pub radius_m: f32,
    /// Extinction in the centre, the paper's `q_j` (1/m).
    pub extinction_per_m: f32,
}

impl Metaball {
    /// From the numbers of a file in the order of [`COLUMNS`], or a sentence about what is wrong with them.
    pub(crate) fn from_numbers(numbers: [f32; 5]) -> Result<Self, String> {
        if let Some(number) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(format!("{number} is not a finite number"));
        }
        let [x, y, z, radius_m, extinction_per_m] = numbers;
        if radius_m <= 0.0 {
            return Err(format!("radius {radius_m} m must be above 0"));
        }
        if extinction_per_m < 0.0 {
            return Err(format!("extinction {extinction_per_m} 1/m must not be below 0"));
        }
        Ok(Self { centre_m: [x, y, z], radius_m, extinction_per_m })
    }

    /// Integral of extinction over the ball (m^2): how much light it takes in all, if that is little.
    #[must_use]
    pub fn mass_m2(&self) -> f64 {
        BALL_MASS * f64::from(self.extinction_per_m) * f64::from(self.radius_m).powi(3)
    }

    /// Optical depth of a line at a distance from the centre (m).
    #[must_use]
    pub fn optical_depth(&self, distance_m: f64) -> f64 {
        let radius_m = f64::from(self.radius_m);
        f64::from(self.extinction_per_m) * radius_m * ball_column(distance_m / radius_m)
    }
}

/// A cloud as balls.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metaballs {
    /// The balls, in no particular order.
    pub balls: Vec<Metaball>,
}

/// The numbers of a ball in files, in their order.
pub(crate) const COLUMNS: [&str; 5] = ["x_m", "y_m", "z_m", "radius_m", "extinction_per_m"];
/// First line of the text form.
const CSV_HEAD: &str = "x_m,y_m,z_m,radius_m,extinction_per_m";

impl Metaballs {
    /// Sum of the balls' masses (m^2).
    #[must_use]
    pub fn mass_m2(&self) -> f64 {
        self.balls.iter().map(Metaball::mass_m2).sum()
    }

    /// Extinction at a point (1/m): equation (3). For references; the time is that of all balls.
    #[must_use]
    pub fn extinction_per_m(&self, point_m: [f64; 3]) -> f64 {
        let at = |ball: &Metaball| {
            let apart = [0, 1, 2].map(|axis| point_m[axis] - f64::from(ball.centre_m[axis]));
            let distance_m = apart.iter().map(|part| part * part).sum::<f64>().sqrt();
            f64::from(ball.extinction_per_m) * ball_field(distance_m / f64::from(ball.radius_m))
        };
        self.balls.iter().map(at).sum()
    }

    /// Balls of one lattice merged by cubes of side `cube_m` into one each, at their centre of mass, with radii twice as large
    /// and the same mass: a coarser cloud for the distance.
    #[must_use]
    pub fn merged(&self, cube_m: f32) -> Self {
        let groups = cubes(self.balls.iter(), cube_m, |ball| *ball);
        Self { balls: groups.iter().filter_map(|group| merge(&group.iter().copied())).collect() }
    }

    /// As comma-separated values, one ball a line under a line of names; [`Metaballs::from_csv`] reads every number back.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text = format!("{CSV_HEAD}\n");
        for Metaball { centre_m: [x, y, z], radius_m, extinction_per_m } in &self.balls {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{x},{y},{z},{radius_m},{extinction_per_m}");
        }
        text
    }

    /// Reads what [`Metaballs::to_csv`] writes; empty lines and lines that begin with `#` are skipped.
    ///
    /// # Errors
    /// [`CloudError::BallLine`] with the line's number when it does not hold five numbers, or a radius or an extinction is
    /// not allowed.
    pub fn from_csv(text: &str) -> Result<Self, CloudError> {
        let mut balls = Vec::new();
        let lines = text.lines().map(str::trim).zip(1..);
        for (content, line) in lines.filter(|(content, _)| !content.is_empty() && !content.starts_with('#')) {
            if content == CSV_HEAD {
                continue;
            }
            balls.push(ball_from_line(content).map_err(|problem| CloudError::BallLine { line, problem })?);
        }
        Ok(Self { balls })
    }
}

/// Balls by the cube of side `cube_m` that they stand in, in an order that does not depend on theirs.
pub(crate) fn cubes<T>(items: impl Iterator<Item = T>, cube_m: f32, ball: impl Fn(&T) -> &Metaball) -> Vec<Vec<T>> {
    // An ordered map, because the order of the groups must not depend on a hash.
    let mut cubes = std::collections::BTreeMap::<[i64; 3], Vec<T>>::new();
    for item in items {
        let cube = ball(&item).centre_m.map(|place| cube_index(place / cube_m));
        cubes.entry(cube).or_default().push(item);
    }
    cubes.into_values().collect()
}

/// One ball for several: their mass, their centre of mass, twice their radius; `None` for balls without mass.
pub(crate) fn merge<'a>(balls: &(impl Iterator<Item = &'a Metaball> + Clone)) -> Option<Metaball> {
    let mass_m2: f64 = balls.clone().map(Metaball::mass_m2).sum();
    let centre = |axis: usize| {
        let moment: f64 = balls.clone().map(|ball| ball.mass_m2() * f64::from(ball.centre_m[axis])).sum();
        narrow(moment / mass_m2)
    };
    let radius_m = 2.0 * balls.clone().map(|ball| ball.radius_m).fold(0.0, f32::max);
    let extinction_per_m = narrow(mass_m2 / (BALL_MASS * f64::from(radius_m).powi(3)));
    (mass_m2 > 0.0).then(|| Metaball { centre_m: [0, 1, 2].map(centre), radius_m, extinction_per_m })
}

fn ball_from_line(content: &str) -> Result<Metaball, String> {
    let cells: Vec<_> = content.split(',').map(str::trim).collect();
    let [x, y, z, radius, extinction] = cells[..] else {
        return Err(format!("{} values in place of the five of {CSV_HEAD}", cells.len()));
    };
    let number = |text: &str| text.parse::<f32>().map_err(|_no_number| format!("{text:?} is not a finite number"));
    Metaball::from_numbers([number(x)?, number(y)?, number(z)?, number(radius)?, number(extinction)?])
}

/// The whole part of a place counted in cubes.
#[expect(clippy::cast_possible_truncation, reason = "places beyond 2^63 cubes share the last one")]
fn cube_index(place: f32) -> i64 {
    place.floor() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some() -> Metaballs {
        let ball = |i: u8| Metaball {
            centre_m: [f32::from(i % 7) * 12.5, f32::from(i % 5) * 12.5, 1000.1 + f32::from(i)],
            radius_m: 25.0,
            extinction_per_m: 0.001 + f32::from(i) / 3e3,
        };
        Metaballs { balls: (0..40).map(ball).collect() }
    }

    #[test]
    fn every_number_survives_the_way_through_csv() {
        assert_eq!(Metaballs::from_csv(&some().to_csv()), Ok(some()), "bit for bit");
    }

    #[test]
    fn bad_lines_are_refused_with_number_and_reason() {
        for (line, reason) in [
            ("1,2,3,4", "4 values in place of the five"),
            ("1,2,x,4,5", "\"x\" is not a finite number"),
            ("1,2,3,0,5", "radius 0 m must be above 0"),
            ("1,2,3,4,-5", "extinction -5 1/m must not be below 0"),
            ("1,2,inf,4,5", "inf is not a finite number"),
        ] {
            let text = Metaballs::from_csv(&format!("{CSV_HEAD}\n# note\n{line}\n")).unwrap_err().to_string();
            assert!(text.starts_with("line 3: ") && text.contains(reason), "{text}");
        }
    }

    #[test]
    fn merging_keeps_mass_and_centre_of_mass() {
        let (fine, coarse) = (some(), some().merged(50.0));
        assert!(coarse.balls.len() < fine.balls.len(), "{} balls", coarse.balls.len());
        assert!((coarse.mass_m2() / fine.mass_m2() - 1.0).abs() < 1e-5, "mass");
        let height = |list: &Metaballs| {
            list.balls.iter().map(|b| b.mass_m2() * f64::from(b.centre_m[2])).sum::<f64>() / list.mass_m2()
        };
        assert!((height(&coarse) - height(&fine)).abs() < 1e-2, "centre of mass");
    }

    #[test]
    fn extinction_at_a_point_is_the_sum_of_fields_and_columns_are_their_integrals() {
        let one = Metaballs { balls: vec![some().balls[3]] };
        let ball = one.balls[0];
        let [x, y, z] = ball.centre_m.map(f64::from);
        let count = 2000;
        let step = 2.0 * 25.0 / f64::from(count);
        let column: f64 =
            (0..count).map(|i| one.extinction_per_m([x + 5.0, y - 25.0 + (f64::from(i) + 0.5) * step, z]) * step).sum();
        assert!((column / ball.optical_depth(5.0) - 1.0).abs() < 1e-5, "{column}");
    }
}
