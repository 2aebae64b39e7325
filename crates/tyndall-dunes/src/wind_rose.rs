//! Winds from measurements: tables of directions and speeds, the sand that they can move, and the schedule they make.
//!
//! A table has a line of names and at least the columns `direction_deg` (where the wind comes from, clockwise from north,
//! as weather stations give it) and `speed_m_s` (at 10 m). A third, `weight`, says how often a line counts. Drift
//! potential after Fryberger 1979: `U^2 (U - Ut)` for speeds U above the threshold Ut, in vector units for knots.

use crate::DuneError;
use crate::wind::{Wind, WindSchedule};

/// Knots in a metre a second.
const KNOTS_PER_M_S: f64 = 1.943_844;
/// Most sectors of a rose.
pub const MAX_SECTORS: usize = 64;

/// One measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindSample {
    /// Where the wind comes from, clockwise from north (deg).
    pub from_deg: f64,
    /// Speed at a height of 10 m (m/s).
    pub speed_m_s: f64,
    /// How often it counts (1).
    pub weight: f64,
}

/// Speed at 10 m above which wind lifts sand of this grain size (m/s), after Bagnold: `u* = 0.10 sqrt(g d (rho_s - rho) /
/// rho)` and a logarithmic profile over a roughness of d / 30.
#[must_use]
pub fn threshold_speed_m_s(grain_um: f64) -> f64 {
    let grain_m = grain_um * 1e-6;
    let friction_m_s = 0.10 * ((2650.0 - 1.2) * 9.81 * grain_m / 1.2).sqrt();
    friction_m_s / 0.4 * (10.0 * 30.0 / grain_m).ln()
}

/// What a wind record can do to sand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriftPotential {
    /// Sum over all winds (vector units).
    pub total: f64,
    /// Length of the vector sum (vector units).
    pub resultant: f64,
    /// Where the vector sum points, anticlockwise from east (deg).
    pub resultant_toward_deg: f64,
}

impl DriftPotential {
    /// Resultant over total: 1 is one wind, 0 winds that cancel. 0 without wind that moves sand.
    #[must_use]
    pub fn variability(&self) -> f64 {
        if self.total > 0.0 { self.resultant / self.total } else { 0.0 }
    }
}

/// A record of winds.
#[derive(Clone, Debug, PartialEq)]
pub struct WindRose {
    samples: Vec<WindSample>,
}

impl WindRose {
    /// Reads a table of comma-separated values; lines that start with # are comments.
    ///
    /// # Errors
    /// [`DuneError::WindTable`] with the place of the first cell that cannot be used; [`DuneError::NoWind`] for a table
    /// without lines.
    pub fn parse_csv(table: &str) -> Result<Self, DuneError> {
        let lines = table.trim_start_matches('\u{feff}').lines().enumerate();
        let mut lines = lines
            .map(|(index, line)| (index + 1, line.trim()))
            .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let (head_line, head) = lines.next().ok_or(DuneError::NoWind)?;
        let columns = Columns::find(head_line, head)?;
        let samples: Vec<_> = lines.map(|(line, text)| columns.sample(line, text)).collect::<Result<_, _>>()?;
        if samples.is_empty() { Err(DuneError::NoWind) } else { Ok(Self { samples }) }
    }

    /// The measurements.
    #[must_use]
    pub fn samples(&self) -> &[WindSample] {
        &self.samples
    }

    /// Drift potential of all winds above a threshold (m/s).
    #[must_use]
    pub fn drift_potential(&self, threshold_m_s: f64) -> DriftPotential {
        let weight: f64 = self.samples.iter().map(|sample| sample.weight).sum();
        let parts = self.samples.iter().map(|sample| (potential(sample, threshold_m_s), toward_deg(sample)));
        let [total, x, y] = parts.fold([0.0; 3], |[total, x, y], (part, toward_deg)| {
            let (sin, cos) = toward_deg.to_radians().sin_cos();
            [total + part, x + part * cos, y + part * sin]
        });
        // Vector units are percentages of the time.
        let scale = if weight > 0.0 { 100.0 / weight } else { 0.0 };
        DriftPotential {
            total: total * scale,
            resultant: x.hypot(y) * scale,
            resultant_toward_deg: y.atan2(x).to_degrees(),
        }
    }

    /// The rose in so many sectors, each with its share of the drift potential: the winds of a schedule.
    ///
    /// # Errors
    /// [`DuneError::Value`] when `sectors` is 0 or above [`MAX_SECTORS`]; [`DuneError::NoWind`] when no wind is above the
    /// threshold.
    pub fn sectors(&self, sectors: usize, threshold_m_s: f64) -> Result<Vec<Wind>, DuneError> {
        if !(1..=MAX_SECTORS).contains(&sectors) {
            let (value, high) = (sectors as f64, MAX_SECTORS as f64);
            return Err(DuneError::Value { what: "number of sectors", value, unit: "", low: 1.0, high });
        }
        let width_deg = 360.0 / sectors as f64;
        let mut shares = vec![0.0; sectors];
        for sample in &self.samples {
            let sector = (toward_deg(sample) / width_deg).round().rem_euclid(sectors as f64) as usize;
            shares[sector % sectors] += potential(sample, threshold_m_s);
        }
        let total: f64 = shares.iter().sum();
        if total <= 0.0 {
            return Err(DuneError::NoWind);
        }
        let winds = shares.iter().enumerate().filter(|(_, share)| **share > 0.0);
        Ok(winds.map(|(sector, share)| Wind { toward_deg: sector as f64 * width_deg, share: share / total }).collect())
    }

    /// A schedule of [`WindRose::sectors`].
    ///
    /// # Errors
    /// As [`WindRose::sectors`] and [`WindSchedule::new`].
    pub fn schedule(&self, sectors: usize, threshold_m_s: f64, period_steps: u32) -> Result<WindSchedule, DuneError> {
        WindSchedule::new(&self.sectors(sectors, threshold_m_s)?, period_steps)
    }
}

/// Where a wind blows to, anticlockwise from east.
fn toward_deg(sample: &WindSample) -> f64 {
    (270.0 - sample.from_deg).rem_euclid(360.0)
}

fn potential(sample: &WindSample, threshold_m_s: f64) -> f64 {
    let (speed, threshold) = (sample.speed_m_s * KNOTS_PER_M_S, threshold_m_s * KNOTS_PER_M_S);
    if speed > threshold { sample.weight * speed * speed * (speed - threshold) } else { 0.0 }
}

/// Where the values stand in a line.
#[derive(Clone, Copy, Debug)]
struct Columns {
    direction: usize,
    speed: usize,
    weight: Option<usize>,
}

impl Columns {
    fn find(line: usize, head: &str) -> Result<Self, DuneError> {
        let names: Vec<_> = head.split(',').map(|name| name.trim().to_ascii_lowercase()).collect();
        let position = |wanted: &str| names.iter().position(|name| name == wanted);
        let needed = |wanted: &str| {
            position(wanted).ok_or_else(|| DuneError::WindTable {
                line,
                column: 1,
                message: format!("no column is called `{wanted}`; the table needs `direction_deg` and `speed_m_s`"),
            })
        };
        Ok(Self { direction: needed("direction_deg")?, speed: needed("speed_m_s")?, weight: position("weight") })
    }

    fn sample(self, line: usize, text: &str) -> Result<WindSample, DuneError> {
        let cells: Vec<_> = text.split(',').map(str::trim).collect();
        let number = |column: usize, what: &str, [low, high]: [f64; 2]| {
            let cell = cells.get(column).copied().unwrap_or_default();
            let value = cell.parse::<f64>().ok().filter(|value| (low..=high).contains(value));
            value.ok_or_else(|| DuneError::WindTable {
                line,
                column: column + 1,
                message: format!("`{cell}` is no {what}; a number from {low} to {high} is allowed"),
            })
        };
        Ok(WindSample {
            from_deg: number(self.direction, "direction in degrees", [0.0, 360.0])?,
            speed_m_s: number(self.speed, "speed in m/s", [0.0, 150.0])?,
            weight: self.weight.map_or(Ok(1.0), |column| number(column, "weight", [0.0, 1e12]))?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO_WINDS: &str = "# a made-up station\ndirection_deg,speed_m_s,weight\n270, 10, 3\n180,10,1\n90,4,100\n";

    #[test]
    fn sand_goes_where_the_wind_does_not_come_from() {
        let rose = WindRose::parse_csv(TWO_WINDS).unwrap();
        let drift = rose.drift_potential(6.0);
        // West wind three times, south wind once, the east wind is too weak.
        assert!((drift.resultant_toward_deg - f64::atan2(1.0, 3.0).to_degrees()).abs() < 1e-9, "{drift:?}");
        assert!((drift.variability() - 10f64.sqrt() / 4.0).abs() < 1e-12, "{drift:?}");
        let winds = rose.sectors(4, 6.0).unwrap();
        assert_eq!(winds.len(), 2, "{winds:?}");
        assert!((winds[0].share - 0.75).abs() < 1e-12 && winds[0].toward_deg.abs() < 1e-12, "east: {winds:?}");
        assert!(
            (winds[1].share - 0.25).abs() < 1e-12 && (winds[1].toward_deg - 90.0).abs() < 1e-12,
            "north: {winds:?}"
        );
    }

    #[test]
    fn potential_is_that_of_fryberger() {
        let rose = WindRose::parse_csv("speed_m_s,direction_deg\n10,270\n5,0\n").unwrap();
        // Half of the time 19.44 knots over a threshold of 12: 19.44^2 (19.44 - 12) * 50.
        let threshold_m_s = 12.0 / KNOTS_PER_M_S;
        let speed = 10.0 * KNOTS_PER_M_S;
        let expected = 50.0 * speed * speed * (speed - 12.0);
        let drift = rose.drift_potential(threshold_m_s);
        assert!((drift.total / expected - 1.0).abs() < 1e-12, "{drift:?}, expected {expected}");
    }

    #[test]
    fn quarter_millimetre_sand_moves_from_eight_metres_a_second_on() {
        let threshold = threshold_speed_m_s(250.0);
        assert!((threshold - 8.14).abs() < 0.05, "{threshold} m/s");
    }

    #[test]
    fn what_cannot_be_read_is_named_with_its_place() {
        let message = |table: &str| WindRose::parse_csv(table).unwrap_err().to_string();
        assert_eq!(
            message("direction_deg,speed_m_s\n270,10\nwest,4\n"),
            "line 3, column 1: `west` is no direction in degrees; a number from 0 to 360 is allowed",
            "a word for a number"
        );
        assert!(
            message("direction_deg,speed_m_s\n270\n").starts_with("line 2, column 2: `` is no speed"),
            "a short line"
        );
        assert!(message("direction_deg,speed_m_s\n10,NaN\n").contains("`NaN` is no speed"), "NaN");
        assert!(message("dir,speed_m_s\n1,1\n").contains("no column is called `direction_deg`"), "a missing column");
        assert_eq!(WindRose::parse_csv("").unwrap_err(), DuneError::NoWind, "nothing");
    }
}
