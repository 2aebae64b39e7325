//! Splats against a march through the same cloud: transmittance, and light scattered once.

use std::f64::consts::PI;

use tyndall_clouds::Metaball;
use tyndall_clouds::reference::{Medium, Ray, TabulatedPhase, single_scattering};
use tyndall_clouds::splats::{
    LitBall, SplatLighting, SplatOrders, SplatPlanes, SplatProjection, SplatView, light_balls, project, rasterise,
};
use tyndall_core::grid::Grid3;
use tyndall_core::metaball::ball_field;
use tyndall_gpu::{PassTimer, wgpu};
use tyndall_render::splats::{SplatDraw, SplatRasteriser, SplatRenderer};
use tyndall_render::{FrameTarget, RendererConfig};
use tyndall_tests::{gpu, halves_to_f32};

use crate::clouds::{CELLS, SIZE_PX, known_balls, known_picture};
use crate::render::{Studio, luminance, scene};

const OVERHEAD: SplatLighting = SplatLighting { to_sun: [0.0, 0.0, 1.0], transport: None };

/// Mean extinction in the middle of the known cloud's balls (1/cell).
const MEAN_EXTINCTION: f32 = 0.06;

/// A camera outside of a box with a corner in the origin that looks north, along parallel lines.
fn from_the_south([east, _, up]: [f64; 3], size_px: [usize; 2]) -> SplatView {
    SplatView {
        position_m: [east / 2.0, -10.0, up / 2.0],
        axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
        projection: SplatProjection::Orthographic { half_m: [east / 2.0, up / 2.0] },
        size_px,
        planet_radius_m: f64::INFINITY,
        reach_m: f64::INFINITY,
    }
}

fn splats(lit: &[LitBall], view: &SplatView) -> SplatPlanes {
    rasterise(&project(lit, view), view, SplatOrders::Single, None).expect("a picture with pixels")
}

/// Signal to noise (dB) of light scattered once by an isotropic phase function, and the ratio of means, where there is cloud.
fn likeness(planes: &SplatPlanes, wanted: &[f64]) -> [f64; 2] {
    let peak = wanted.iter().copied().fold(0.0, f64::max);
    let (mut squares, mut count, mut sums) = (0.0, 0.0, [0.0; 2]);
    for (index, wanted) in wanted.iter().enumerate() {
        let pixel = planes.pixel(index % planes.size_px()[0], index / planes.size_px()[0]);
        if pixel.transmittance < 0.999 {
            let found = f64::from(pixel.direct) / (4.0 * PI);
            squares += (found - wanted).powi(2);
            sums = [sums[0] + found, sums[1] + wanted];
            count += 1.0;
        }
    }
    [20.0 * (peak / f64::sqrt(squares / count)).log10(), sums[0] / sums[1]]
}

/// Transmittance of balls on a line to the north, by steps.
fn marched_balls(balls: &[Metaball], [x, z]: [f64; 2]) -> f64 {
    let off = |ball: &Metaball| (f64::from(ball.centre_m[0]) - x).hypot(f64::from(ball.centre_m[2]) - z);
    let near: Vec<_> = balls.iter().filter(|ball| off(ball) < f64::from(ball.radius_m)).collect();
    let step = 0.05;
    let depth = |ball: &&Metaball| {
        let radius = f64::from(ball.radius_m);
        let at = |i: i32| f64::hypot(off(ball), (f64::from(i) + 0.5) * step - radius) / radius;
        (0..80).map(|i| step * f64::from(ball.extinction_per_m) * ball_field(at(i))).sum::<f64>()
    };
    (-near.iter().map(depth).sum::<f64>()).exp()
}

#[test]
fn the_known_cloud_lets_as_much_light_through_as_in_a_march() {
    let Some(balls) = known_balls() else { return };
    let view = from_the_south(CELLS, SIZE_PX);
    let lit = light_balls(&balls.balls, &[], OVERHEAD).expect("a direction to the sun");
    let planes = splats(&lit, &view);
    for index in (0..SIZE_PX[0] * SIZE_PX[1]).step_by(17) {
        let (column, row) = (index % SIZE_PX[0], index / SIZE_PX[0]);
        let place = [0.5 * (column as f64 + 0.5), CELLS[2] - 0.5 * (row as f64 + 0.5)];
        let gap = f64::from(planes.pixel(column, row).transmittance) - marched_balls(&balls.balls, place);
        assert!(gap.abs() < 1.0 / 255.0, "({column}, {row}): off by {gap}");
    }
}

#[test]
fn light_scattered_once_in_the_known_cloud_is_that_of_the_march_within_forty_decibels() {
    let Some(balls) = known_balls() else { return };
    let Some(wanted) = known_picture("clouds/ref_overhead_single_g0_march.npy") else { return };
    let view = from_the_south(CELLS, SIZE_PX);
    let lit = light_balls(&balls.balls, &[], OVERHEAD).expect("a direction to the sun");
    let [psnr, mean] = likeness(&splats(&lit, &view), &wanted);
    // The reference asks for 35 dB of the paper's method.
    assert!(psnr >= 40.0 && (mean - 1.0).abs() < 0.02, "{psnr} dB, mean {mean}");

    // One colour a ball, as the paper prints it: read before, between and after the ball's own splat.
    let flat = |own: f32| {
        let balls = lit.iter().map(|lit| LitBall {
            sun_depth: lit.sun_depth + own * lit.ball.extinction_per_m * lit.ball.radius_m,
            gradient_per_m: [0.0; 3],
            ..*lit
        });
        likeness(&splats(&balls.collect::<Vec<_>>(), &view), &wanted)
    };
    let [before, between, after] = [0.0, 0.5, 1.0].map(flat);
    println!("paper mode {psnr:.1} dB ({mean:.3}); one colour a ball: {before:.3?}, {between:.3?}, {after:.3?}");
    assert!(before[0] > between[0] && between[0] > after[0], "{before:?} {between:?} {after:?}");
    assert!(after[1] < 0.92, "after the ball's own splat it is too dark by a tenth: {}", after[1]);
}

/// A small cloud of balls on a lattice, and the same on a fine grid.
fn small_cloud() -> (Vec<Metaball>, Medium) {
    let (size, fine, radius) = ([16_u8, 12, 10], 4_u8, 2.0_f64);
    let cloud = |[x, y, z]: [u8; 3]| {
        let from = [f64::from(x) - 7.5, f64::from(y) - 5.5, 1.2 * (f64::from(z) - 4.5)];
        let distance2: f64 = from.iter().map(|part| part * part).sum();
        // Lumps, so that the cloud is more than a ball.
        (distance2 < 20.0 && (3 * x + 5 * y + 7 * z) % 4 != 0).then_some(MEAN_EXTINCTION)
    };
    let cells = (0..size[2]).flat_map(|z| (0..size[1]).flat_map(move |y| (0..size[0]).map(move |x| [x, y, z])));
    let balls: Vec<_> = cells
        .filter_map(|cell| {
            let centre_m = cell.map(|place| f32::from(place) + 0.5);
            cloud(cell).map(|extinction_per_m| Metaball { centre_m, radius_m: 2.0, extinction_per_m })
        })
        .collect();
    let list = tyndall_clouds::Metaballs { balls: balls.clone() };
    let [nx, ny, nz] = size.map(|cells| usize::from(cells * fine));
    let mut grid = Grid3::filled([nx, ny, nz], 0.0_f32);
    for (index, value) in grid.cells_mut().iter_mut().enumerate() {
        let place = [index % nx, index / nx % ny, index / (nx * ny)].map(|cell| (cell as f64 + 0.5) / f64::from(fine));
        #[expect(clippy::cast_possible_truncation, reason = "grids are stored in single precision")]
        let extinction = list.extinction_per_m(place) as f32;
        *value = extinction;
    }
    assert!(balls.len() > 100 && radius > 1.0, "{} balls", balls.len());
    (balls, Medium::new(grid, 1.0 / f64::from(fine)).expect("a medium"))
}

#[test]
fn a_small_cloud_has_the_transmittance_and_the_light_of_a_march() {
    let (balls, medium) = small_cloud();
    let extent = medium.extent();
    let view = from_the_south(extent, [64, 40]);
    let planes = splats(&light_balls(&balls, &[], OVERHEAD).expect("a direction to the sun"), &view);
    let phase = TabulatedPhase::new(|_| 1.0).expect("isotropic");
    let place = |index: usize| [(index % 64) as f64 + 0.5, 40.0 - (index / 64) as f64 - 0.5].map(|px| px / 4.0);
    for index in (0..64 * 40).step_by(11) {
        let gap = f64::from(planes.pixel(index % 64, index / 64).transmittance) - marched_balls(&balls, place(index));
        assert!(gap.abs() < 1.0 / 255.0, "{:?}: off by {gap}", place(index));
    }
    let wanted = (0..64 * 40).map(|index: usize| {
        let [x, z] = place(index);
        let ray = Ray { origin: [x, -10.0, z], direction: [0.0, 1.0, 0.0] };
        single_scattering(&medium, &phase, OVERHEAD.to_sun, ray, 0.125)[0]
    });
    let [psnr, mean] = likeness(&planes, &wanted.collect::<Vec<_>>());
    println!("a small cloud: {psnr:.1} dB, mean {mean:.3}");
    assert!(psnr >= 35.0 && (mean - 1.0).abs() < 0.05, "{psnr} dB, mean {mean}");
}

/// The small cloud as a perspective camera south of it sees it, in front of nothing.
fn from_one_point(size_px: [usize; 2]) -> SplatView {
    let projection = SplatProjection::Perspective { tan_half: [0.5, 0.4] };
    SplatView { position_m: [7.0, -12.0, 3.0], projection, ..from_the_south([16.0, 12.0, 10.0], size_px) }
}

#[test]
fn billboards_of_the_gpu_are_those_of_the_cpu() {
    let (balls, _) = small_cloud();
    let lighting = SplatLighting { to_sun: [0.48, -0.36, 0.8], transport: Some(0.2) };
    let lit = light_balls(&balls, &[], lighting).expect("a direction to the sun");
    let orders = SplatOrders::All { transport: 0.2 };
    let target = FrameTarget::new(gpu(), [96, 64], RendererConfig::default()).expect("a small target");
    for view in [from_one_point([96, 64]), from_the_south([16.0, 12.0, 10.0], [96, 64])] {
        let seen = project(&lit, &view);
        let draw = SplatDraw { balls: &seen, view: &view, orders };
        let [by_cpu, by_gpu] = [SplatRasteriser::Cpu, SplatRasteriser::Gpu].map(|rasteriser| {
            let mut renderer = SplatRenderer::new(gpu()).expect("a pipeline");
            renderer.set_rasteriser(rasteriser);
            let mut encoder = gpu().device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let mut timer = PassTimer::new(gpu(), 4).expect("a timer");
            timer.begin_frame();
            renderer.draw(gpu(), (&mut encoder, &mut timer), draw, &target).expect("a picture");
            gpu().queue.submit([encoder.finish()]);
            let planes = renderer.planes(gpu(), [96, 64]).expect("planes");
            planes.each_ref().map(|plane| {
                let bytes = gpu().read_texture(plane).expect("a picture to read");
                if plane.format() == wgpu::TextureFormat::Rgba16Float {
                    return halves_to_f32(&bytes);
                }
                bytes.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect()
            })
        });
        let mut most = 0.0_f32;
        for (plane, (cpu, gpu)) in by_cpu.iter().zip(&by_gpu).enumerate() {
            for (index, (cpu, gpu)) in cpu.iter().zip(gpu).enumerate() {
                // Distances are in metres, up to 30; lavapipe's exponentials are good to 1e-4 after many layers.
                let scale = if plane == 0 && index % 4 == 1 { 30.0 } else { 1.0 };
                assert!((cpu - gpu).abs() < 1e-3 * scale, "plane {plane}, value {index}: {cpu} {gpu}");
                most = most.max(cpu.abs());
            }
        }
        assert!(most > 1.0, "something is drawn: {most}");
    }
}

#[test]
fn clouds_of_splats_are_as_bright_and_cover_as_much_as_marched_ones() {
    let mut studio = Studio::new();
    let changes = [
        ("clouds.kind", "automaton"),
        ("clouds.detail", "0"),
        ("clouds.reach_km", "20"),
        ("cloud_grid.cells_east", "64"),
        ("cloud_grid.cells_north", "64"),
        ("cloud_grid.cells_up", "20"),
        ("camera.pitch_deg", "25"),
    ];
    let mut mean = |method| {
        let scene = scene("noon", &[&changes[..], &[("clouds.method", method)]].concat());
        let pixels = studio.radiance(&scene, [96, 64]);
        pixels.iter().map(|pixel| luminance(*pixel)).sum::<f64>() / pixels.len() as f64
    };
    let [marched, splats] = ["volume", "splats"].map(&mut mean);
    assert!((splats / marched - 1.0).abs() < 0.15, "mean luminance {splats} cd/m2, marched {marched}");
}
