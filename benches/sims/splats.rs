//! Metaballs as billboards at 640 x 480, on one core: the sun pass, the view pass, and a whole frame of both.

use anyhow::Result;
use rayon::ThreadPoolBuilder;
use tyndall_benches::{Samples, measure};
use tyndall_clouds::Metaball;
use tyndall_clouds::splats::{SplatLighting, SplatOrders, SplatProjection, SplatView, light_balls, project, rasterise};
use tyndall_core::rng::CellRng;

use crate::{Case, Effort};

/// Name of [`large`].
pub(crate) const LARGE: &str = "splats, 20 thousand of 8 px";
/// Name of [`many`].
pub(crate) const MANY: &str = "splats, 100 thousand of 4 px";

/// A picture with a pixel to the metre, and a box as deep as it is wide.
const SIZE_PX: [usize; 2] = [640, 480];

pub(crate) fn large(effort: Effort) -> Result<Case> {
    frame(LARGE, if effort.samples > 1 { 20_000 } else { 200 }, 8.0, effort)
}

pub(crate) fn many(effort: Effort) -> Result<Case> {
    frame(MANY, if effort.samples > 1 { 100_000 } else { 1000 }, 4.0, effort)
}

fn frame(name: &'static str, count: u32, radius_m: f32, effort: Effort) -> Result<Case> {
    let balls: Vec<_> = (0..count).map(|index| ball(index, radius_m)).collect();
    let [width, height] = SIZE_PX.map(|side| side as f64);
    let view = SplatView {
        position_m: [width / 2.0, -100.0, height / 2.0],
        axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
        projection: SplatProjection::Orthographic { half_m: [width / 2.0, height / 2.0] },
        size_px: SIZE_PX,
        planet_radius_m: f64::INFINITY,
        reach_m: f64::INFINITY,
    };
    let lighting = SplatLighting { to_sun: [0.5, 0.3, 0.8], transport: None };
    let lit = light_balls(&balls, &[], lighting)?;
    let ways = [
        ("sun pass", timed(effort, || light_balls(&balls, &[], lighting).map(|lit| lit.len()))?),
        (
            "view pass",
            timed(effort, || {
                rasterise(&project(&lit, &view), &view, SplatOrders::Single, None).map(|p| p.size_px()[0])
            })?,
        ),
        (
            "both",
            timed(effort, || {
                let lit = light_balls(&balls, &[], lighting)?;
                rasterise(&project(&lit, &view), &view, SplatOrders::Single, None).map(|planes| planes.size_px()[0])
            })?,
        ),
    ];
    Ok(Case { name, ways: ways.into_iter().map(|(way, times)| (way.to_owned(), times)).collect() })
}

/// A ball at a random place.
fn ball(index: u32, radius_m: f32) -> Metaball {
    let share = |axis: u32| CellRng::new(1).uniform(0, u64::from(index), axis);
    let centre_m = [640.0 * share(0), 640.0 * share(1), 480.0 * share(2)];
    Metaball { centre_m, radius_m, extinction_per_m: 0.3 / radius_m }
}

/// Times on one thread.
fn timed<T: Send, E: Send>(effort: Effort, work: impl Fn() -> Result<T, E> + Sync) -> Result<Samples> {
    let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
    Ok(pool.install(|| measure(effort.samples, || drop(std::hint::black_box(work())))))
}
