//! `tyndall simulate`: makes steps of what a scene simulates, and writes its state.
//!
//! A state is an NPZ file with everything that steps change. A simulation that goes on from it makes the same bits as one that
//! never stopped, on any number of threads.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use rayon::ThreadPoolBuilder;
use serde_json::json;
use tyndall_core::array::NamedArrays;
use tyndall_io::atomic::check_writable;
use tyndall_io::{Destination, IoError, read_npz, write_npz};
use tyndall_render::desert_inputs::desert_inputs;
use tyndall_scene::{DesertInputs, Scene, SceneError, SceneSimulation, SimulationKind};

use crate::interrupt::Interrupt;
use crate::progress::{Progress, ProgressFormat, Stage};
use crate::scene_arguments::SceneArguments;
use crate::{Exit, Failure, output};

/// How often progress is told.
const TELLING: Duration = Duration::from_millis(100);

const EXAMPLES: &str = "\
Examples:
  tyndall simulate preset:cumulus -o ready.npz
  tyndall simulate preset:cumulus --steps 200 -o later.npz
  tyndall simulate preset:cumulus --state later.npz --steps 50 -o latest.npz
  tyndall render preset:cumulus --state latest.npz -o latest.png
  tyndall simulate preset:barchans --steps 4000 -o dunes.npz
  tyndall render preset:barchans --state dunes.npz -o dunes.png

A state of clouds holds an array `cells` of bytes, index [x, y, z] from west, south and
below: hum + 2 act + 4 cld; one of a desert `height`, `sand` and `bedrock`, index
[x, y], in 1/256 of a cell, and `moved_at`, the step in which a cell changed last. Its hash is printed on standard output with the step.";

/// What `tyndall simulate` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
pub struct SimulateArguments {
    /// What to simulate.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// State to write after the last step: an .npz file; without it only its hash is told
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Steps to make; up to the moment that a picture of the scene shows unless given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=10_000_000))]
    pub steps: Option<u32>,
    /// What to simulate where the scene has both; else the only one, or the one that --state belongs to
    #[arg(long, value_name = "WHAT", value_parser = parse_kind)]
    pub of: Option<SimulationKind>,
    /// Where the state comes from that it starts with.
    #[command(flatten)]
    pub start: StartArguments,
    /// Threads to work on, which change nothing but the time; 0 takes all
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=1024))]
    pub threads: u16,
    /// How to report progress
    #[arg(long, value_name = "READER", value_enum, default_value_t)]
    pub progress: ProgressFormat,
}

/// Where a simulation begins.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct StartArguments {
    /// Start from a state that `tyndall simulate` wrote, in place of the beginning and the warm-up
    #[arg(long, value_name = "FILE")]
    pub state: Option<PathBuf>,
}

impl StartArguments {
    /// The arrays of the state, if one is named; a warning when it is not quite the scene's own. `named` is what is to start
    /// from it.
    ///
    /// # Errors
    /// When the file cannot be read or holds no state, or the scene has nothing that would go on from it.
    pub fn load(
        &self,
        scene: &Scene,
        named: Option<SimulationKind>,
        progress: &Progress,
    ) -> Result<Option<NamedArrays>, Failure> {
        let Some(path) = &self.state else { return Ok(None) };
        let state = read_npz(path).map_err(|error: IoError| Failure::Usage(error.to_string()))?;
        let kind = scene.simulated(named, Some(&state)).map_err(|error| self.blame(error.into()))?;
        if !scene.continues(kind, &state).map_err(|error| self.blame(error.into()))? {
            progress.warn("the state comes from other parameters; from here on those of the scene count");
        }
        Ok(Some(state))
    }

    /// Makes sure that the scene goes on from the state, before anything that takes time.
    ///
    /// # Errors
    /// When the state is damaged or that of other cells.
    pub fn check(&self, scene: &Scene, state: Option<&NamedArrays>) -> Result<(), Failure> {
        let Some(state) = state else { return Ok(()) };
        let kind = scene.simulated(None, Some(state))?;
        let inputs = if kind == SimulationKind::Desert { desert_inputs(scene)? } else { DesertInputs::default() };
        scene.simulation(kind, &inputs, Some(state)).map(drop).map_err(|error| self.blame(error.into()))
    }

    /// The scene whose picture a desert's state belongs to: one that is further than `desert.steps` is shown as it is.
    ///
    /// # Errors
    /// When the state does not say its step, or it is beyond what a scene takes.
    pub fn advanced(&self, scene: &Scene, state: Option<&NamedArrays>) -> Result<Scene, Failure> {
        let mut scene = scene.clone();
        let of_desert = state.filter(|state| SimulationKind::of_state(state) == Some(SimulationKind::Desert));
        if let Some(state) = of_desert {
            let step = tyndall_scene::desert_state_step(state).map_err(SceneError::Sand);
            let step = step.map_err(|error| self.blame(error.into()))?;
            scene.set("desert.steps", scene.desert.steps.max(step).into())?;
        }
        Ok(scene)
    }

    /// `failure` with the name of the state, when that is what was refused.
    pub(crate) fn blame(&self, failure: Failure) -> Failure {
        match (&self.state, failure) {
            (
                Some(path),
                Failure::Scene(error @ (SceneError::Clouds(_) | SceneError::Sand(_) | SceneError::StateOfOther { .. })),
            ) => Failure::Usage(format!("cannot start from {}: {error}", path.display())),
            (_, other) => other,
        }
    }
}

/// What goes on in steps, by its name.
fn parse_kind(name: &str) -> Result<SimulationKind, String> {
    let found = SimulationKind::ALL.iter().find(|kind| kind.name() == name).copied();
    found.ok_or_else(|| format!("{name:?} is none of {}", SimulationKind::NAMES.join(", ")))
}

/// Simulates.
///
/// # Errors
/// Everything that can be wrong with scene, state and file.
pub fn run(arguments: &SimulateArguments) -> Result<(), Failure> {
    let mut progress = Progress::start(arguments.progress);
    let done = simulate(arguments, &mut progress);
    if let Err(failure) = &done {
        progress.fail(failure);
    }
    done
}

fn simulate(arguments: &SimulateArguments, progress: &mut Progress) -> Result<(), Failure> {
    let scene = arguments.scene.load()?;
    if let Some(path) = &arguments.output {
        check_place(path)?;
    }
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let state = arguments.start.load(&scene, arguments.of, progress)?;
    let kind = scene.simulated(arguments.of, state.as_ref())?;
    let inputs = if kind == SimulationKind::Desert { desert_inputs(&scene)? } else { DesertInputs::default() };
    let pool = ThreadPoolBuilder::new().num_threads(usize::from(arguments.threads)).build();
    let pool = pool.map_err(|error| Failure::Usage(format!("cannot start {} threads: {error}", arguments.threads)))?;
    pool.install(|| {
        let simulation = scene.simulation(kind, &inputs, state.as_ref());
        let mut simulation = simulation.map_err(|error| arguments.start.blame(error.into()))?;
        let steps = arguments.steps.unwrap_or_else(|| simulation.steps_to_picture());
        let began = Instant::now();
        make_steps(simulation.as_mut(), steps, &interrupt, progress)?;
        let seconds = began.elapsed().as_secs_f64();
        if let Some(path) = &arguments.output {
            progress.stage(Stage::File)?;
            write_state(path, simulation.as_ref(), &interrupt)?;
        }
        report(arguments, simulation.as_ref(), (steps, seconds), progress)
    })
}

/// A place that takes an NPZ file, asked before any step is made.
fn check_place(path: &Path) -> Result<(), Failure> {
    if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz")) {
        return Err(Failure::Usage(format!("cannot write {}: a state is an .npz file", path.display())));
    }
    Ok(check_writable(path)?)
}

fn make_steps(
    simulation: &mut dyn SceneSimulation,
    steps: u32,
    interrupt: &Interrupt,
    progress: &Progress,
) -> Result<(), Failure> {
    let mut told = None::<Instant>;
    for step in 0..steps {
        interrupt.check()?;
        if told.is_none_or(|told| told.elapsed() > TELLING) {
            progress.share("simulating", f64::from(step) / f64::from(steps))?;
            told = Some(Instant::now());
        }
        simulation.step();
    }
    interrupt.check()
}

fn write_state(path: &Path, simulation: &dyn SceneSimulation, interrupt: &Interrupt) -> Result<(), Failure> {
    match write_npz(Destination::new(path).cancelled_by(interrupt.flag()), &simulation.state()) {
        Err(IoError::Cancelled { path }) => {
            interrupt.check()?;
            Err(IoError::Cancelled { path }.into())
        }
        other => Ok(other?),
    }
}

fn report(
    arguments: &SimulateArguments,
    simulation: &dyn SceneSimulation,
    (steps, seconds): (u32, f64),
    progress: &mut Progress,
) -> Result<(), Failure> {
    let (step, hash) = (simulation.step_count(), format!("{:#018x}", simulation.hash()));
    if arguments.progress == ProgressFormat::Human {
        output::print(&format!("step {step} hash {hash}\n"))?;
    }
    let file = arguments.output.as_ref().map(|path| path.display().to_string());
    let (what, summary) = (simulation.name(), simulation.summary());
    let place = file.as_ref().map_or_else(String::new, |file| format!("{file}: "));
    let sentence = format!("{place}{what} after step {step}, {summary}; {steps} steps in {seconds:.2} s");
    progress.finish(
        &sentence,
        json!({
            "file": file,
            "simulation": what,
            "step": step,
            "hash": hash,
            "steps_made": steps,
            "seconds": progress.seconds(),
            "stepping_seconds": seconds,
        }),
    )
}
