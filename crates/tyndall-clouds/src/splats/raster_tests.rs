use tyndall_core::metaball::{BALL_MASS, ball_column};

use super::*;
use crate::Metaball;
use crate::splats::{LitBall, SplatProjection, project};

/// A camera that looks north.
fn view(projection: SplatProjection, size_px: [usize; 2]) -> SplatView {
    SplatView {
        position_m: [0.0; 3],
        axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
        projection,
        size_px,
        planet_radius_m: f64::INFINITY,
        reach_m: f64::INFINITY,
    }
}

fn perspective(size_px: [usize; 2]) -> SplatView {
    view(SplatProjection::Perspective { tan_half: [1.0, 0.75] }, size_px)
}

fn lit(centre_m: [f32; 3], radius_m: f32, extinction_per_m: f32) -> LitBall {
    let ball = Metaball { centre_m, radius_m, extinction_per_m };
    LitBall {
        ball,
        sun_depth: -f32::ln(0.7),
        gradient_per_m: [0.0; 3],
        forward: 0.2,
        diffuse: 0.1,
        sky: 0.6,
        seen: 1.0,
    }
}

/// Many balls of several sizes, some around the camera.
fn crowd() -> Vec<LitBall> {
    let place = |i: u16, step: u16, of: u16| f32::from(i * step % of);
    (0..400_u16)
        .map(|i| {
            let centre = [place(i, 7, 41) - 20.0, place(i, 5, 53) - 3.0, place(i, 11, 37) - 18.0];
            lit(centre, 1.0 + place(i, 3, 5), 0.02 + place(i, 1, 7) / 100.0)
        })
        .collect()
}

#[test]
fn the_splat_of_one_ball_holds_its_mass_within_half_a_per_cent() {
    for radius_px in [8.0_f32, 13.3, 30.0] {
        let orthographic = view(SplatProjection::Orthographic { half_m: [40.0, 40.0] }, [80, 80]);
        let (ball, tau) = (lit([1.37, 100.0, -2.21], radius_px, 1e-3), 1e-3);
        let planes = rasterise(&project(&[ball], &orthographic), &orthographic, SplatOrders::Single, None).unwrap();
        let depths = (0..80).flat_map(|row| (0..80).map(move |column| (column, row)));
        let sum: f64 = depths.map(|(column, row)| -f64::from(planes.pixel(column, row).transmittance).ln()).sum();
        let mass = BALL_MASS * tau * f64::from(radius_px).powi(3);
        assert!((sum / mass - 1.0).abs() < 5e-3, "radius {radius_px} px: {sum} of {mass}");
    }
}

#[test]
fn transmittance_is_that_of_the_exact_column_at_any_angle_and_distance() {
    let view = perspective([64, 48]);
    for (centre, radius, peak) in
        [([0.0, 50.0, 0.0], 10.0, 2.0), ([30.0, 40.0, -25.0], 12.0, 5.0), ([-9.0, 10.0, 6.0], 4.0, 1.0)]
    {
        let ball = lit(centre, radius, peak / radius);
        let planes = rasterise(&project(&[ball], &view), &view, SplatOrders::Single, None).unwrap();
        for (row, column) in (0..48).flat_map(|row| (0..64).map(move |column| (row, column))) {
            let x = (2.0 * (column as f64 + 0.5) / 64.0 - 1.0) * 1.0;
            let y = (1.0 - 2.0 * (row as f64 + 0.5) / 48.0) * 0.75;
            let [cx, cz, cy] = centre.map(f64::from);
            let across = [cy - cz * y, cz * x - cx, cx * y - cy * x];
            let off = (across.iter().map(|part| part * part).sum::<f64>() / (1.0 + x * x + y * y)).sqrt();
            let wanted = (-f64::from(peak) * ball_column(off / f64::from(radius))).exp();
            let found = f64::from(planes.pixel(column, row).transmittance);
            assert!((found - wanted).abs() < 2e-5, "{centre:?} at ({column}, {row}): {found} {wanted}");
        }
    }
}

#[test]
fn no_pixel_has_more_light_than_its_balls_and_all_of_it_where_nothing_shines_through() {
    let view = perspective([80, 60]);
    let planes = rasterise(&project(&crowd(), &view), &view, SplatOrders::All { transport: 0.2 }, None).unwrap();
    for (row, column) in (0..60).flat_map(|row| (0..80).map(move |column| (row, column))) {
        let pixel = planes.pixel(column, row);
        let (seen, seen_thin) = (1.0 - pixel.transmittance, 1.0 - pixel.thin);
        assert!((-1e-6..=1.0 + 1e-6).contains(&pixel.transmittance), "{pixel:?}");
        for (value, wanted) in [
            (pixel.direct, 0.7 * seen),
            (pixel.forward, 0.2 * seen_thin),
            (pixel.diffuse, 0.1 * seen_thin),
            (pixel.sky, 0.6 * seen_thin),
        ] {
            assert!((value - wanted).abs() < 1e-4, "even light times what is seen: {pixel:?}");
        }
        // exp(-0.2 tau) is the fifth root of exp(-tau).
        assert!((pixel.thin.powi(5) - pixel.transmittance).abs() < 1e-4, "{pixel:?}");
    }
}

#[test]
fn the_order_of_the_list_and_the_number_of_threads_do_not_change_a_bit() {
    let view = perspective([80, 60]);
    let run = |balls: &[LitBall], threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| rasterise(&project(balls, &view), &view, SplatOrders::All { transport: 0.1 }, None).unwrap())
    };
    let (straight, mut turned) = (crowd(), crowd());
    turned.reverse();
    turned.swap(3, 200);
    assert!(run(&straight, 1) == run(&turned, 3), "the same balls in another order on more threads");
}

#[test]
fn a_surface_within_a_ball_ends_its_column_there_and_one_before_it_hides_it() {
    let view = perspective([16, 12]);
    let ball = lit([0.0, 50.0, 0.0], 10.0, 0.1);
    let seen = project(&[ball], &view);
    let at = |limit_m: f32| {
        let limits = vec![limit_m; 16 * 12];
        let planes = rasterise(&seen, &view, SplatOrders::Single, Some(&limits)).unwrap();
        -planes.pixel(8, 6).transmittance.ln()
    };
    let whole = at(1e9);
    assert!(whole > 0.5, "the ball is seen: {whole}");
    assert!(at(39.0).abs() < 1e-6, "hidden by what is before it");
    assert!((at(61.0) - whole).abs() < 1e-5, "whole before what is behind it");
    // The line's point nearest to the centre: the pixel's middle is a sixteenth beside the axis.
    let half = at(50.0 / f32::sqrt(1.0 + 2.0 / 256.0));
    assert!((half / whole - 0.5).abs() < 1e-3, "half before its middle: {}", half / whole);
}

#[test]
fn each_pixel_is_cut_by_its_own_surface_wherever_those_beside_it_are() {
    let view = perspective([48, 36]);
    let ball = lit([5.0, 50.0, 2.0], 30.0, 0.03);
    let seen = project(&[ball], &view);
    let orders = SplatOrders::All { transport: 0.2 };
    let drawn = |limits: &[f32]| rasterise(&seen, &view, orders, Some(limits)).unwrap();
    // Before the ball, within it and behind it, in stripes that are no multiple of a group.
    let places_m = [10.0, 48.0, 200.0];
    let of = |column: usize, row: usize| (column / 5 + row / 3) % 3;
    let limits: Vec<f32> = (0..36 * 48).map(|index| places_m[of(index % 48, index / 48)]).collect();
    let mixed = drawn(&limits);
    let even = places_m.map(|limit_m| drawn(&[limit_m; 36 * 48]));
    for (column, row) in (0..36 * 48).map(|index| (index % 48, index / 48)) {
        let (found, wanted) = (mixed.pixel(column, row), even[of(column, row)].pixel(column, row));
        for (found, wanted) in [
            (found.direct, wanted.direct),
            (found.transmittance, wanted.transmittance),
            (found.diffuse, wanted.diffuse),
            (found.thin, wanted.thin),
        ] {
            assert!((found - wanted).abs() < 1e-5, "pixel {column}, {row}: {found} and {wanted}");
        }
    }
}

#[test]
fn in_the_middle_of_a_ball_half_of_it_is_before_the_camera() {
    let view = perspective([16, 12]);
    let planes = rasterise(&project(&[lit([0.0; 3], 10.0, 0.1)], &view), &view, SplatOrders::Single, None).unwrap();
    for (column, row) in [(0, 0), (8, 6), (15, 3)] {
        let depth = -planes.pixel(column, row).transmittance.ln();
        assert!((f64::from(depth) - 0.5 * ball_column(0.0)).abs() < 1e-4, "({column}, {row}): {depth}");
    }
}

#[test]
fn a_list_of_limits_of_another_size_is_refused() {
    let text = rasterise(&[], &perspective([16, 12]), SplatOrders::Single, Some(&[1.0])).unwrap_err().to_string();
    assert_eq!(text, "the list of limits of sight has 1 entries; 192 are needed");
}
