//! A step of the cloud automaton, and what a frame needs of it, on one core.

use anyhow::Result;
use rayon::ThreadPoolBuilder;
use tyndall_benches::{Samples, measure};
use tyndall_clouds::{
    Automaton, AutomatonConfig, CloudDensity, Edges, Ellipsoid, EllipsoidSupply, HumidEllipsoids, Probabilities,
    ProbabilityLayer, SmoothingWindow, WindKnot, WindProfile, ball_density_into, cloud_light, floor_shadow,
    sun_depth_into, sunlight_scattered_often,
};
use tyndall_core::grid::Grid3;

use crate::naive_clouds::NaiveClouds;
use crate::{Case, Effort};

/// Name of [`rule`].
pub(crate) const RULE: &str = "clouds, rule, 2.1 Mcell";
/// Name of [`step`].
pub(crate) const STEP: &str = "clouds, full step, 2.1 Mcell";
/// Name of [`frame`].
pub(crate) const FRAME: &str = "clouds, a frame's data, 2.1 Mcell";
/// Name of [`large`].
pub(crate) const LARGE: &str = "clouds, 1024 x 1024 x 64";

/// Steps of one time: a single one is shorter than what a clock is good for.
const STEPS: usize = 20;

fn size(effort: Effort) -> [usize; 3] {
    if effort.samples > 1 { [256, 256, 32] } else { [32, 32, 32] }
}

/// An automaton in which a tenth of the cells is activated, or with draws in every cell.
fn automaton(size: [usize; 3], with_draws: bool) -> Result<Automaton> {
    automaton_within(size, Edges::Open, with_draws)
}

fn automaton_within(size: [usize; 3], edges: Edges, with_draws: bool) -> Result<Automaton> {
    let mut automaton = Automaton::new(&AutomatonConfig { size, edges, ..AutomatonConfig::default() })?;
    automaton.moisten(&[Box::new(Probabilities { humidity: 1.0, activation: 0.1, extinction: 0.0 })]);
    if with_draws {
        let half = size.map(|side| side as f64 / 2.0);
        let ellipsoid = Ellipsoid { centre_cells: half, radii_cells: half, base_cells: 0.0, strength: 1.0 };
        let supply = EllipsoidSupply { extinction: 0.1, humidity: 0.1, activation: 0.01 };
        let outside = Probabilities { extinction: 0.2, ..Probabilities::default() };
        let bubble = HumidEllipsoids::new(size, edges, 1, supply, &[ellipsoid])?;
        let stack: Vec<Box<dyn ProbabilityLayer>> = vec![Box::new(outside), Box::new(bubble)];
        automaton.set_probabilities(stack);
    }
    Ok(automaton)
}

/// Three different shifts, a tenth of a cell to two cells a step.
fn sheared(nz: usize) -> Result<WindProfile> {
    let knot = |height_cells: f64, east: f64| WindKnot { height_cells, cells_per_step: [east, 0.0] };
    Ok(WindProfile::new(vec![knot(0.0, 0.1), knot(nz as f64, 2.0)])?)
}

/// Times of one of [`STEPS`] calls, on one thread.
fn timed(effort: Effort, mut work: impl FnMut() + Send) -> Result<Samples> {
    let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
    let steps = if effort.samples > 1 { STEPS } else { 1 };
    Ok(pool.install(|| measure(effort.samples, || (0..steps).for_each(|_| work()))).per_call(steps))
}

pub(crate) fn rule(effort: Effort) -> Result<Case> {
    let mut naive = NaiveClouds::new(size(effort));
    let naive_times = measure(effort.samples.min(3), || naive.rule());
    std::hint::black_box(naive.cloud());
    let mut fast = automaton(size(effort), false)?;
    let ways = vec![
        ("a byte per cell".to_owned(), naive_times),
        ("a bit per cell".to_owned(), timed(effort, || drop(fast.step()))?),
    ];
    Ok(Case { name: RULE, ways })
}

pub(crate) fn step(effort: Effort) -> Result<Case> {
    let mut naive = NaiveClouds::new(size(effort));
    let naive_times = measure(effort.samples.min(3), || naive.step());
    std::hint::black_box(naive.cloud());
    let mut still = automaton(size(effort), true)?;
    let still_times = timed(effort, || drop(still.step()))?;
    let wind = sheared(size(effort)[2])?;
    let bubbles = |edges| -> Result<Samples> {
        let mut windy = automaton_within(size(effort), edges, true)?;
        windy.wind_mut().set_profile(wind.clone());
        timed(effort, || drop(windy.step()))
    };
    let (drifting, entering) = (bubbles(Edges::Wrap)?, bubbles(Edges::Open)?);
    // The same probabilities in every step, as where vapour stays over a mountain.
    let mut over_hill = automaton(size(effort), false)?;
    let [humidity, activation, extinction] = [0.1, 0.01, 0.1];
    let everywhere = Probabilities { extinction, humidity, activation };
    over_hill.set_probabilities(vec![Box::new(everywhere)]);
    over_hill.wind_mut().set_profile(wind.clone());
    let blown = timed(effort, || drop(over_hill.step()))?;
    let ways = vec![
        ("a byte per cell, no wind".to_owned(), naive_times),
        ("draws in bits, no wind".to_owned(), still_times),
        ("draws in bits, wind".to_owned(), blown),
        ("bubbles drift, wrapped grid".to_owned(), drifting),
        ("bubbles enter, open grid".to_owned(), entering),
    ];
    Ok(Case { name: STEP, ways })
}

/// The largest grid that the design asks for, where the state no longer fits into caches.
pub(crate) fn large(effort: Effort) -> Result<Case> {
    let size = if effort.samples > 1 { [1024, 1024, 64] } else { [64, 64, 64] };
    let effort = Effort { samples: effort.samples.min(3), ..effort };
    let mut naive = NaiveClouds::new(size);
    let naive_times = measure(1, || naive.step());
    std::hint::black_box(naive.cloud());
    drop(naive);
    let mut pure = automaton(size, false)?;
    let rule_times = timed(effort, || drop(pure.step()))?;
    drop(pure);
    let mut full = automaton_within(size, Edges::Wrap, true)?;
    full.wind_mut().set_profile(sheared(size[2])?);
    let ways = vec![
        ("full, a byte per cell, no wind".to_owned(), naive_times),
        ("rule alone, in bits".to_owned(), rule_times),
        ("full with wind and bubbles".to_owned(), timed(effort, || drop(full.step()))?),
    ];
    Ok(Case { name: LARGE, ways })
}

pub(crate) fn frame(effort: Effort) -> Result<Case> {
    let size = size(effort);
    // As scenes have it: wrapped, with wind, under a bubble that drifts.
    let mut clouds = automaton_within(size, Edges::Wrap, true)?;
    clouds.wind_mut().set_profile(sheared(size[2])?);
    let mut density = CloudDensity::new(&clouds, SmoothingWindow::default());
    for _ in 0..6 {
        let plan = clouds.step();
        density.observe(&clouds, &plan);
    }
    let [mut share, mut balls, mut depth] = [(); 3].map(|()| Grid3::filled(size, 0.0_f32));
    let smooth = timed(effort, || drop(density.at_into(&clouds, 1.0, &mut share)))?;
    let convolve = timed(effort, || drop(ball_density_into(&share, 2.0, Edges::Open, &mut balls)))?;
    let high = timed(effort, || drop(sun_depth_into(&balls, [0.3, 0.2, 0.8], &mut depth)))?;
    let low = timed(effort, || drop(sun_depth_into(&balls, [0.3, 0.9, 0.3], &mut depth)))?;
    let all = timed(effort, || {
        let plan = clouds.step();
        density.observe(&clouds, &plan);
        // The sizes agree, as they did above.
        let _ = density.at_into(&clouds, 1.0, &mut share);
        let _ = ball_density_into(&share, 2.0, Edges::Open, &mut balls);
        let _ = sun_depth_into(&balls, [0.3, 0.2, 0.8], &mut depth);
    })?;
    let (sun, transport) = ([0.3, 0.2, 0.8], 0.15);
    let mut matter = balls.clone();
    matter.cells_mut().iter_mut().for_each(|cell| *cell *= 0.07);
    let few = Effort { samples: effort.samples.min(2), ..effort };
    let spread = timed(few, || drop(sunlight_scattered_often(&matter, 50.0, sun, transport, Edges::Wrap)))?;
    let light = timed(few, || drop(cloud_light(&matter, 50.0, sun, transport, Edges::Wrap)))?;
    let floor = timed(few, || drop(floor_shadow(&matter, 50.0, sun, transport, Edges::Wrap)))?;
    let ways = vec![
        ("step, smoothing, balls, light volume".to_owned(), all),
        ("smoothing, 5^3 cells x 5 steps".to_owned(), smooth),
        ("balls, R = 2".to_owned(), convolve),
        ("light volume, high sun".to_owned(), high),
        ("light volume, low sun".to_owned(), low),
        ("light volume and diffusion, wrapped".to_owned(), spread),
        ("the same with light of sky and ground".to_owned(), light),
        ("floor shadow".to_owned(), floor),
    ];
    Ok(Case { name: FRAME, ways })
}
