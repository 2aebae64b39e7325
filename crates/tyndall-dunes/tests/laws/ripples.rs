//! Laws of the ripple automaton.

use crate::support::{on_threads, r_squared, rows_of};
use tyndall_dunes::measure::{HeightGrid, drift_cells, mean_wavelength_cells};
use tyndall_dunes::ripples::linear_theory::{LinearRule, Regime, regime};
use tyndall_dunes::ripples::split_bed::SplitBed;
use tyndall_dunes::ripples::{RIPPLE_QUANTA_PER_CELL, RippleBed, RippleParams, RippleRule};
use tyndall_dunes::{SandSimulation as _, Side};

/// The rule as first printed, with dithered hops: no lee shadow.
fn plain() -> RippleParams {
    RippleParams { lee_slope: 0.0, ..RippleParams::default() }
}

fn bed(params: &RippleParams, size: [usize; 2]) -> RippleBed {
    let square = RippleBed::new(&RippleParams { side: Side::Cells512, ..params.clone() }).expect("in range");
    let noise: Vec<i32> = (0..size[1]).flat_map(|y| square.heights()[y * 512..][..size[0]].to_vec()).collect();
    let mut bed = RippleBed::with_rule(*square.rule(), size, params.seed).expect("powers of two");
    bed.set_heights(&noise).expect("the right number");
    bed
}

fn grid(bed: &RippleBed) -> HeightGrid {
    HeightGrid::from_quanta(bed.lattice().size(), bed.heights(), RIPPLE_QUANTA_PER_CELL).expect("the right number")
}

#[test]
fn not_a_quantum_of_sand_is_lost_in_100_000_steps() {
    let thin = RippleParams { depth_cells: 0.5, ..RippleParams::default() };
    for (params, steps) in [(plain(), 5000), (thin, 5000), (RippleParams::default(), 100_000)] {
        let mut bed = bed(&params, [64, 64]);
        let before = bed.mass_quanta();
        bed.run(steps);
        assert_eq!(bed.mass_quanta(), before, "{params:?}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let hash = |threads| {
        on_threads(threads, || {
            let mut bed = bed(&RippleParams::default(), [256, 256]);
            bed.run(200);
            for wind_deg in [37.0, 90.0, -120.0] {
                bed.set_wind_deg(wind_deg);
                bed.run(20);
            }
            bed.state_hash()
        })
    };
    let one = hash(1);
    for threads in [2, 3, 7] {
        assert_eq!(hash(threads), one, "{threads} threads against one");
    }
}

/// A hash that was noted when this test was written: the same bits on every system and with every vector width.
#[test]
fn the_bits_are_those_of_every_other_system() {
    let mut bed = bed(&RippleParams::default(), [256, 64]);
    bed.run(100);
    bed.set_wind_deg(37.0);
    bed.run(10);
    assert_eq!(format!("{:016x}", bed.state_hash()), "4ced7e8989dc10f9", "after 110 steps");
}

#[test]
fn without_dithering_mirrored_and_shifted_beds_stay_so() {
    let params = RippleParams { dither: false, noise_cells: 2.0, ..RippleParams::default() };
    let (nx, ny) = (64, 32);
    let changed = |change: &dyn Fn(usize, usize) -> [usize; 2]| {
        let mut original = bed(&params, [nx, ny]);
        let move_cells = |heights: &[i32]| {
            let mut moved = vec![0; nx * ny];
            for (index, &height) in heights.iter().enumerate() {
                let [x, y] = change(index % nx, index / nx);
                moved[y * nx + x] = height;
            }
            moved
        };
        let mut other = bed(&params, [nx, ny]);
        other.set_heights(&move_cells(original.heights())).unwrap();
        original.run(100);
        other.run(100);
        assert_ne!(original.heights(), bed(&params, [nx, ny]).heights(), "the bed moves at all");
        (move_cells(original.heights()), other.heights().to_vec())
    };
    let (mirrored, mirror) = changed(&|x, y| [x, ny - 1 - y]);
    assert_eq!(mirrored, mirror, "mirror across the wind");
    let (shifted, shift) = changed(&|x, y| [(x + 19) % nx, (y + 5) % ny]);
    assert_eq!(shifted, shift, "shift by (19, 5)");
}

#[test]
fn without_dithering_a_turned_wind_turns_the_bed() {
    let params = RippleParams { dither: false, noise_cells: 2.0, ..RippleParams::default() };
    let side = 32;
    let turn = |heights: &[i32]| {
        let mut turned = vec![0; side * side];
        for (index, &height) in heights.iter().enumerate() {
            let (x, y) = (index % side, index / side);
            turned[x * side + (side - 1 - y)] = height;
        }
        turned
    };
    let mut east = bed(&params, [side, side]);
    let mut expected = east.heights().to_vec();
    for quarter in 1..4 {
        expected = turn(&expected);
        let mut turned = bed(&params, [side, side]);
        turned.set_heights(&expected).unwrap();
        turned.set_wind_deg(90.0 * f64::from(quarter));
        if quarter == 1 {
            east.run(60);
        }
        turned.run(60);
        let result = (0..quarter).fold(east.heights().to_vec(), |heights, _| turn(&heights));
        assert!(turned.heights() == result, "wind at {} deg", 90 * quarter);
    }
}

#[test]
fn growth_factors_of_the_table_are_those_of_the_closed_form() {
    for row in rows_of(include_str!("../data/no_ripple_dispersion.csv")) {
        let [hop_cells, hop_per_height, layer_cells, creep, mode, count, _, growth, phase] = row[..9] else {
            panic!("9 columns")
        };
        let rule = LinearRule { hop_cells, hop_per_height, layer_cells, creep };
        let k = std::f64::consts::TAU * mode / count;
        assert!(
            (rule.growth_factor(k) - growth).abs() < 1e-8,
            "L0 {hop_cells}, mode {mode}: {}",
            rule.growth_factor(k)
        );
        assert!((rule.drift_cells_per_step(k) * k + phase).abs() < 1e-8, "L0 {hop_cells}, mode {mode}: phase");
    }
}

#[test]
fn small_waves_grow_as_the_closed_form_says() {
    for (hop_cells, layer_cells, hop_per_height, creep) in [
        (4.5, 0.1, 2.0, 0.25),
        (7.3, 0.1, 2.0, 0.25),
        (6.8, 0.3, 1.0, 0.6),
        (11.2, 0.05, 3.0, 0.75),
        (2.4, 0.6, 2.0, 0.1),
    ] {
        let rule = LinearRule { hop_cells, hop_per_height, layer_cells, creep };
        for mode in [3.0, 7.0, 12.0, 19.0, 26.0] {
            let k = std::f64::consts::TAU * mode / 120.0;
            let wave: Vec<f64> = (0..120 * 3).map(|i| 1e-7 * (k * f64::from(i % 120)).cos()).collect();
            let amplitude = |heights: &[f64]| {
                let part = |phase: f64| {
                    heights.iter().zip(0..).map(|(h, x)| h * (k * f64::from(x) + phase).cos()).sum::<f64>()
                };
                part(0.0).hypot(part(0.5 * std::f64::consts::PI))
            };
            let mut bed = SplitBed::new(rule, 120, wave);
            let before = amplitude(bed.heights());
            bed.step();
            let growth = amplitude(bed.heights()) / before;
            assert!(
                (growth - rule.growth_factor(k)).abs() < 1e-6,
                "{rule:?}, mode {mode}: {growth}, expected {}",
                rule.growth_factor(k)
            );
        }
    }
}

#[test]
fn ripples_set_in_where_the_table_says() {
    for row in rows_of(include_str!("../data/no_ripple_onset.csv")) {
        let [hop_cells, hop_per_height, creep, layer_cells, _] = row[..5] else { panic!("5 columns") };
        let rule = LinearRule { hop_cells, hop_per_height, layer_cells, creep };
        let onset = rule.onset_layer_cells().unwrap();
        // The table has five decimals.
        assert!((onset - layer_cells).abs() < 1.1e-5, "L_eff {hop_cells}: {onset}, expected {layer_cells}");
        for (factor, grows) in [(0.8, false), (1.25, true)] {
            let rule = LinearRule { layer_cells: factor * layer_cells, ..rule };
            assert_eq!(rms_grows(rule), grows, "L_eff {hop_cells}: {factor} of the onset");
        }
    }
}

/// Whether the fastest wave of a nearly flat bed with hops split over two cells grows in 400 steps.
fn rms_grows(rule: LinearRule) -> bool {
    let nx = 400;
    let mode = (rule.fastest()[0] * f64::from(nx) / std::f64::consts::TAU).round();
    let wave = |x: i32| 1e-9 * (std::f64::consts::TAU * mode * f64::from(x) / f64::from(nx)).cos();
    let mut bed = SplitBed::new(rule, 400, (0..nx).map(wave).collect());
    let size = |bed: &SplitBed| bed.heights().iter().map(|h| h * h).sum::<f64>();
    let before = size(&bed);
    (0..400).for_each(|_| bed.step());
    size(&bed) > before
}

#[test]
fn late_wavelengths_are_proportional_to_the_hop() {
    let mut points = Vec::new();
    for hop_cells in [3.0, 5.0, 7.3, 10.0, 15.0] {
        let mean = [1, 2].map(|seed| {
            let mut bed = bed(&RippleParams { hop_cells, seed, ..plain() }, [512, 64]);
            bed.run(4281);
            mean_wavelength_cells(&grid(&bed), 200)
        });
        let wavelength = 0.5 * (mean[0] + mean[1]);
        assert!((1.45..=1.8).contains(&(wavelength / hop_cells)), "L0 {hop_cells}: {mean:?}");
        points.push((hop_cells, wavelength));
    }
    assert!(r_squared(&points) >= 0.98, "linear in L0: {points:?}");
}

#[test]
fn late_wavelengths_no_longer_change() {
    let mut bed = bed(&plain(), [512, 64]);
    bed.run(7000);
    let early = mean_wavelength_cells(&grid(&bed), 200);
    bed.run(10_000);
    let late = mean_wavelength_cells(&grid(&bed), 200);
    assert!((late / early - 1.0).abs() < 0.03, "{early} cells after 7000 steps, {late} after 17,000");
}

#[test]
fn weak_winds_leave_the_bed_flat_and_strong_ones_plane_it() {
    for (params, expected) in [
        (RippleParams { hop_cells: 1.0, ..plain() }, Regime::Smooth),
        (RippleParams { hop_cells: 2.0, ..plain() }, Regime::Smooth),
        (RippleParams { hop_cells: 40.0, ..plain() }, Regime::Planed),
    ] {
        assert_eq!(regime(&params), expected, "L0 {}", params.hop_cells);
        let mut bed = bed(&params, [256, 64]);
        bed.run(2000);
        let rms = grid(&bed).rms_cells();
        assert!(rms < 0.05, "L0 {}: rms {rms} cells", params.hop_cells);
    }
    assert_eq!(regime(&plain()), Regime::Rippled, "the default is in between");
}

#[test]
fn with_the_lee_shadow_ripples_drift_downwind() {
    let mut bed = bed(&RippleParams::default(), [512, 64]);
    bed.run(1500);
    let before = grid(&bed);
    bed.run(10);
    let drift = drift_cells(&before, &grid(&bed), 200) / 10.0;
    assert!(drift > 0.02, "{drift} cells a step");
    assert!(before.rms_cells() > 0.1, "there are ripples: rms {}", before.rms_cells());
}

#[test]
fn bedrock_is_never_dug() {
    let mut bed = bed(&RippleParams { depth_cells: 0.2, ..RippleParams::default() }, [128, 64]);
    bed.run(1000);
    let rule: &RippleRule = bed.rule();
    let lowest = bed.heights().iter().min().copied().unwrap_or_default();
    assert!(lowest >= rule.bedrock, "lowest {lowest}, bedrock {}", rule.bedrock);
}
