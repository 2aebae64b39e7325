//! `tyndall probe sky`: spectral radiance in a list of directions.
//!
//! By the tables that the pictures use, by the exact integral of single scattering, or by Monte-Carlo.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, ValueEnum};
use tyndall_core::observer::ColourWeights;
use tyndall_core::units::M_PER_KM;
use tyndall_io::atomic::{check_writable, write_atomically};
use tyndall_scattering::Atmosphere;
use tyndall_scattering::atmosphere_file::parse_atmosphere;
use tyndall_scattering::geometry::{Ray, enter_atmosphere};
use tyndall_scattering::monte_carlo::{MonteCarlo, Sampling};
use tyndall_scattering::orders::OrdersQuality;
use tyndall_scattering::single_scattering::{RayEnd, ray_end, single_scattering_to};
use tyndall_scattering::table_sky::TableSky;
use tyndall_scattering::validate::ValidateOptions;

use super::directions::{Line, read};
use super::table::{Row, colour_note, csv, read_weights};
use crate::Failure;
use crate::interrupt::Interrupt;
use crate::output;
use crate::progress::{Progress, ProgressFormat};
use crate::render::source;
use crate::values::parse_setting;

const EXAMPLES: &str = "\
Examples:
  tyndall probe sky --scene preset:noon --directions dirs.txt -o rows.csv
  tyndall probe sky --atmosphere atm.txt --directions dirs.txt -o - --single
  tyndall probe sky --atmosphere atm.txt --directions dirs.txt -o truth.csv --reference --paths 20000
  tyndall probe sky --atmosphere atm.txt --directions dirs.txt -o - --altitude 400

A line of the list is `sun_zenith view_zenith azimuth`, in degrees; azimuth counts
from the sun; a view_zenith of -1 asks for the sky's irradiance on level ground.
L<nm> is in W/m2/sr/nm, cd_m2 in cd/m2 (irradiance: W/m2/nm and lux).";

/// Standing on the ground is this far above it (m), so that rays to the horizon are defined.
const LOWEST_M: f64 = 1e-3;

/// Farthest altitude and distance (km).
const FARTHEST_KM: f64 = 1e7;

/// How finely the tables are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Detail {
    /// As for a slider that is dragged
    Preview,
    /// As for pictures
    #[default]
    Best,
    /// Not finer: the second order by eight directions alone, as in Nishita et al. 1996
    #[value(name = "nishita-1996")]
    Nishita1996,
}

impl Detail {
    /// Sizes of the tables.
    #[must_use]
    pub fn quality(self) -> OrdersQuality {
        match self {
            Self::Preview => OrdersQuality::preview(),
            Self::Best => OrdersQuality::best(),
            Self::Nishita1996 => OrdersQuality::nishita1996(),
        }
    }

    /// What the tables hold, in words.
    fn method(self) -> &'static str {
        match self {
            Self::Preview => "all orders, tables in preview detail",
            Self::Best => "all orders, tables in best detail",
            Self::Nishita1996 => "two orders by eight directions, tables",
        }
    }
}

/// What `tyndall probe sky` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group = ArgGroup::new("where").required(true).args(["atmosphere", "scene"]))]
pub struct SkyProbeArguments {
    /// Atmosphere as text: `key value...` a line, any number of wavelengths
    #[arg(long, value_name = "FILE")]
    pub atmosphere: Option<PathBuf>,
    /// Scene file or `preset:NAME`: its atmosphere, ground and haze, the sunlight's brightness and the camera's altitude
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<PathBuf>,
    /// Change a parameter of the scene; may be repeated
    #[arg(long, value_name = "GROUP.KEY=VALUE", value_parser = parse_setting, requires = "scene")]
    pub set: Vec<(String, String)>,
    /// Directions, one a line
    #[arg(long, value_name = "FILE")]
    pub directions: PathBuf,
    /// Altitude of the observer (km); the ground, or the scene's camera, unless given
    #[arg(long, value_name = "KM", allow_negative_numbers = true, value_parser = parse_km)]
    pub altitude: Option<f64>,
    /// Only the light of this much air (km, from where a ray enters the atmosphere)
    #[arg(long, value_name = "KM", allow_negative_numbers = true, value_parser = parse_km)]
    pub distance: Option<f64>,
    /// Light that was scattered once, by the exact integral
    #[arg(long, conflicts_with = "reference")]
    pub single: bool,
    /// All orders by Monte-Carlo, with standard errors
    #[arg(long)]
    pub reference: bool,
    /// Random walks in each direction
    #[arg(long, value_name = "N", default_value_t = 16_384, requires = "reference",
        value_parser = clap::value_parser!(u32).range(i64::from(*ValidateOptions::PATHS.start())..=1_000_000_000))]
    pub paths: u32,
    /// Seed of the walks; the same seed gives the same bits
    #[arg(long, value_name = "SEED", default_value_t = 1, requires = "reference")]
    pub seed: u64,
    /// How finely the tables are made
    #[arg(long, value_enum, default_value_t)]
    pub detail: Detail,
    /// Weights from spectrum to colour: `wavelength_nm,X,Y,Z` a line
    #[arg(long, value_name = "FILE")]
    pub weights: Option<PathBuf>,
    /// CSV file, or `-` for standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

fn parse_km(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|km| (0.0..=FARTHEST_KM).contains(km));
    value.ok_or_else(|| format!("a number of kilometres from 0 to {FARTHEST_KM:.0}"))
}

/// Probes the sky.
pub(super) fn run(arguments: &SkyProbeArguments) -> Result<(), Failure> {
    let to_stdout = arguments.output == Path::new("-");
    let lines = read(&arguments.directions)?;
    let (atmosphere, altitude_m, origin) = place(arguments)?;
    let probe = Probe { arguments, atmosphere: &atmosphere, altitude_m };
    for line in &lines {
        probe.check(line)?;
    }
    let weights = match &arguments.weights {
        Some(path) => read_weights(path, &atmosphere.wavelengths_nm)?,
        None => ColourWeights::new(&atmosphere.wavelengths_nm),
    };
    if !to_stdout {
        check_writable(&arguments.output)?;
    }
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let rows = probe.rows(&lines, &interrupt)?;
    let rule = arguments.weights.is_none().then_some(weights.rule);
    let head = [probe.method(), origin, units().to_owned(), colour_note(rule).to_owned()];
    let text = csv(&atmosphere.wavelengths_nm, &weights, &head, &rows);
    if to_stdout {
        return output::print(&text);
    }
    write_atomically(&arguments.output, |file| file.write_all(text.as_bytes()))?;
    Ok(())
}

fn units() -> &'static str {
    "angles in degrees, azimuth from the sun; L<nm> in W/m2/sr/nm, cd_m2 in cd/m2; view_zenith -1: W/m2/nm and lux"
}

/// The atmosphere, the observer's altitude (m), and where they come from.
fn place(arguments: &SkyProbeArguments) -> Result<(Atmosphere, f64, String), Failure> {
    let given_m = arguments.altitude.map(|km| km * M_PER_KM);
    let (atmosphere, altitude_m, what) = if let Some(path) = &arguments.scene {
        let scene = source::load_with(path, &arguments.set)?.grounded();
        let mut atmosphere = scene.model();
        for solar in &mut atmosphere.solar_irradiance_w_m2_nm {
            *solar *= scene.sun.brightness;
        }
        (atmosphere, given_m.unwrap_or(scene.camera.altitude_m), format!("scene {}", path.display()))
    } else {
        let path = arguments.atmosphere.as_deref().unwrap_or(Path::new(""));
        let text = std::fs::read_to_string(path)
            .map_err(|error| Failure::Usage(format!("{}: cannot be read: {error}", path.display())))?;
        let atmosphere = parse_atmosphere(&text).map_err(|error| Failure::Usage(in_file(path, &error)))?;
        (atmosphere, given_m.unwrap_or(0.0), format!("atmosphere {}", path.display()))
    };
    let altitude_m = altitude_m.max(LOWEST_M);
    let distance = arguments.distance.map_or_else(String::new, |km| format!(", the first {km} km of each ray"));
    Ok((atmosphere, altitude_m, format!("{what}, observer at {} km{distance}", altitude_m / M_PER_KM)))
}

/// An error of the atmosphere file as `file:line: message`.
fn in_file(path: &Path, error: &tyndall_scattering::ScatteringError) -> String {
    match error {
        tyndall_scattering::ScatteringError::AtmosphereFile { line, message } => {
            format!("{}:{line}: {message}", path.display())
        }
        other => format!("{}: {other}", path.display()),
    }
}

/// A way of computing one line.
type Compute<'a> = Box<dyn Fn(&Line, u32) -> Row + 'a>;

/// Where and how to look.
struct Probe<'a> {
    arguments: &'a SkyProbeArguments,
    atmosphere: &'a Atmosphere,
    altitude_m: f64,
}

impl Probe<'_> {
    /// Refuses what this way of computing cannot say.
    fn check(&self, line: &Line) -> Result<(), Failure> {
        if !line.is_irradiance() {
            return Ok(());
        }
        let SkyProbeArguments { single, reference, distance, .. } = self.arguments;
        let trouble = if distance.is_some() {
            "irradiance (view_zenith -1) has no --distance"
        } else if *single {
            "irradiance (view_zenith -1) is not computed with --single"
        } else if !reference && self.altitude_m > 1.0 {
            "irradiance (view_zenith -1) above the ground needs --reference"
        } else if self.altitude_m >= self.atmosphere.top_altitude_m {
            "irradiance (view_zenith -1) is computed inside the atmosphere only"
        } else {
            return Ok(());
        };
        Err(Failure::Usage(format!("{}:{}: {trouble}", self.arguments.directions.display(), line.number)))
    }

    /// What made the table, in one line.
    fn method(&self) -> String {
        let version = env!("CARGO_PKG_VERSION");
        let SkyProbeArguments { single, reference, paths, seed, detail, .. } = self.arguments;
        if *single {
            format!("tyndall {version}, probe sky: single scattering, exact integral")
        } else if *reference {
            format!("tyndall {version}, probe sky: all orders, Monte-Carlo with {paths} paths a direction, seed {seed}")
        } else {
            format!("tyndall {version}, probe sky: {}", detail.method())
        }
    }

    fn rows(&self, lines: &[Line], interrupt: &Interrupt) -> Result<Vec<Row>, Failure> {
        let progress = Progress::start(ProgressFormat::Human);
        let compute = self.compute()?;
        let mut rows = Vec::with_capacity(lines.len());
        for (index, line) in (0..).zip(lines) {
            interrupt.check()?;
            progress.share("looking at the sky", rows.len() as f64 / lines.len() as f64)?;
            rows.push(compute(line, index));
        }
        Ok(rows)
    }

    fn compute(&self) -> Result<Compute<'_>, Failure> {
        let stop_m = self.arguments.distance.map(|km| km * M_PER_KM);
        if self.arguments.single {
            return Ok(Box::new(move |line, _index| plain(line, self.single(&self.ray(line), stop_m), None)));
        }
        if self.arguments.reference {
            let model = MonteCarlo::new(self.atmosphere);
            let SkyProbeArguments { paths, seed, .. } = *self.arguments;
            return Ok(Box::new(move |line, direction| {
                let sampling = Sampling { paths, seed, direction };
                let estimate = if line.is_irradiance() {
                    model.irradiance(self.altitude_m, line.mu_sun(), sampling)
                } else {
                    model.radiance(&self.ray(line), stop_m, sampling)
                };
                let single = (!line.is_irradiance()).then_some(estimate.single);
                Row { standard_error: Some(estimate.standard_error), ..plain(line, estimate.mean, single) }
            }));
        }
        let sky = TableSky::new(self.atmosphere, &self.arguments.detail.quality())?;
        Ok(Box::new(move |line, _index| {
            if line.is_irradiance() {
                return plain(line, sky.irradiance(line.mu_sun()), None);
            }
            let radiance = sky.radiance(&self.ray(line), stop_m);
            plain(line, radiance.all, Some(radiance.single))
        }))
    }

    fn ray(&self, line: &Line) -> Ray {
        let [view, sun, azimuth] = [line.view_zenith_deg, line.sun_zenith_deg, line.azimuth_deg].map(f64::to_radians);
        Ray::from_angles(self.altitude_m, view, sun, azimuth)
    }

    /// The exact first order from any altitude.
    fn single(&self, ray: &Ray, stop_m: Option<f64>) -> Vec<f64> {
        let Atmosphere { planet_radius_m, top_altitude_m, .. } = *self.atmosphere;
        let Some((ray, _)) = enter_atmosphere(planet_radius_m, top_altitude_m, ray) else {
            return vec![0.0; self.atmosphere.wavelengths_nm.len()];
        };
        let end = ray_end(self.atmosphere, ray.h_m, ray.mu);
        let stopped = stop_m.filter(|stop_m| *stop_m < end.length_m);
        let end = stopped.map_or(end, |length_m| RayEnd { length_m, on_ground: false });
        single_scattering_to(self.atmosphere, &ray, end)
    }
}

fn plain(line: &Line, all: Vec<f64>, single: Option<Vec<f64>>) -> Row {
    Row { line: *line, all, single, standard_error: None }
}
