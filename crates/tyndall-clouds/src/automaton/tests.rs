use rayon::ThreadPoolBuilder;

use super::*;
use crate::dobashi2000::ScalarAutomaton;
use crate::{Ellipsoid, EllipsoidSupply, HumidEllipsoids, Probabilities, ProbabilityRow, WindKnot};

/// Counts of hum, act and cld and hash of 24 x 20 x 16 random cells, step by step, from an independent array program.
const RANDOM_RUN: [([u64; 3], u64); 9] = [
    ([4528, 98, 0], 0x99ce_8eca_cc28_b0a1),
    ([4474, 559, 98], 0x6062_a68f_5401_f2f7),
    ([3915, 1435, 657], 0x5507_c2ef_3b12_afac),
    ([2480, 1686, 2092], 0x56f2_f0e2_3b6a_7a63),
    ([794, 687, 3778], 0x1f8c_d5fd_5e4f_9b8d),
    ([107, 94, 4465], 0x685d_e788_8af2_d394),
    ([13, 10, 4559], 0x5dad_d503_e42e_d022),
    ([3, 3, 4569], 0xc158_be77_afaa_25e0),
    ([0, 0, 4572], 0xcde5_e110_3c9a_c775),
];

/// Draws of the 64-bit congruential generator that the independent program starts from.
fn congruential(seed: u64) -> impl FnMut() -> u64 {
    let mut x = seed;
    move || {
        x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (x >> 33) & 255
    }
}

/// Random cells: humid with probability `hum` / 256, then active with `act` / 256.
fn random_fields(size: [usize; 3], seed: u64, hum: u64, act: u64) -> CloudFields {
    let mut draw = congruential(seed);
    let cells: usize = size.iter().product();
    let bytes: Vec<u8> = (0..cells).map(|_| u8::from(draw() < hum) | u8::from(draw() < act) << 1).collect();
    CloudFields::from_bytes(size, &bytes).unwrap()
}

fn automaton(config: &AutomatonConfig, fields: CloudFields) -> Automaton {
    let mut automaton = Automaton::new(config).unwrap();
    automaton.restore(fields, 0).unwrap();
    automaton
}

/// Probabilities that differ from cell to cell, with cells of never and always among them.
#[derive(Clone, Copy, Debug)]
struct Patchwork;

impl ProbabilityLayer for Patchwork {
    fn apply(&self, y: usize, z: usize, row: &mut ProbabilityRow) {
        for x in 0..row.extinction.len() {
            let part = |modulus: usize, scale: f32| ((x + 3 * y + 7 * z) % modulus) as f32 * scale;
            row.extinction[x] = part(11, 0.1);
            row.humidity[x] = part(7, 0.05) - 0.05;
            row.activation[x] = part(13, 0.002);
        }
    }
}

fn sheared_wind() -> WindProfile {
    let knot = |height_cells, cells_per_step| WindKnot { height_cells, cells_per_step };
    WindProfile::new(vec![knot(0.0, [0.4, -0.3]), knot(20.0, [2.3, 0.9]), knot(70.0, [-1.7, 3.1])]).unwrap()
}

#[test]
fn one_seed_in_humid_air_grows_by_the_exact_polynomial() {
    let size = [61, 61, 61];
    let mut fields = CloudFields::new(size).unwrap();
    fields.hum.fill_with(|_| true);
    fields.act.set([30, 30, 30], true);
    let mut automaton = automaton(&AutomatonConfig { size, ..AutomatonConfig::default() }, fields);
    let mut sum = 1;
    for (t, steps) in (1..=10_u64).zip(1_usize..) {
        automaton.step();
        let [_, act, cld] = automaton.fields().counts();
        assert_eq!(act, 24 * t * t + 19 - 32 * t, "active cells at step {t}");
        assert_eq!(cld, sum, "cloud is the sum of all activations before step {t}");
        sum += act;
        let reach = 2 * steps;
        for (cell, wanted) in [
            ([30 - reach, 30, 30], true),
            ([30, 30 + reach, 30], true),
            ([30, 30, 30 + reach], true),
            ([30, 30, 30 - steps], true),
            ([30, 30, 30 - steps - 1], false),
        ] {
            assert_eq!(automaton.fields().act.get(cell), wanted, "cell {cell:?} at step {t}");
        }
    }
}

#[test]
fn a_random_start_gives_the_hashes_of_an_independent_program() {
    let size = [24, 20, 16];
    let mut automaton =
        automaton(&AutomatonConfig { size, ..AutomatonConfig::default() }, random_fields(size, 1, 150, 3));
    for step in 0..17 {
        let (counts, hash) = RANDOM_RUN[step.min(8)];
        assert_eq!(automaton.fields().counts(), counts, "counts at step {step}");
        assert_eq!(automaton.fields().hash(), hash, "hash at step {step}");
        automaton.step();
    }
}

/// Bubbles that drift with the wind of one height: the probabilities are moved, not made anew.
#[test]
fn bits_under_drifting_bubbles_are_those_of_the_scalar_reference_in_grids_of_any_width() {
    for size in [[48, 30, 20], [37, 21, 40], [16, 12, 9], [65, 8, 33]] {
        let wind = WindProfile::uniform([1.3, -0.7]).unwrap();
        let config = AutomatonConfig { size, seed: 3, edges: Edges::Wrap, wind, ..AutomatonConfig::default() };
        let bubble = |x: f64, y: f64, radius: f64| Ellipsoid {
            centre_cells: [x, y, 4.0],
            radii_cells: [radius, 0.7 * radius, 5.0],
            base_cells: 2.0,
            strength: 1.0,
        };
        let stack = || -> Vec<Box<dyn ProbabilityLayer>> {
            let outside = Probabilities { extinction: 0.37, ..Probabilities::default() };
            let supply = EllipsoidSupply { extinction: 0.06, humidity: 0.3, activation: 0.03 };
            let bubbles = [bubble(1.5, 2.5, 4.0), bubble(12.5, 6.0, 3.3), bubble(9.0, 7.5, 5.0)];
            vec![Box::new(outside), Box::new(HumidEllipsoids::new(size, Edges::Wrap, 1, supply, &bubbles).unwrap())]
        };
        let fields = random_fields(size, 5, 120, 9);
        let mut scalar = ScalarAutomaton::new(&config, &fields, stack()).unwrap();
        let mut fast = automaton(&config, fields);
        fast.set_probabilities(stack());
        for step in 1..=40 {
            scalar.step();
            fast.step();
            assert_eq!(fast.fields().hash(), scalar.fields().unwrap().hash(), "{size:?} at step {step}");
        }
        assert!(fast.fields().counts()[2] > 0, "{size:?}: there is cloud");
    }
}

#[test]
fn bits_are_those_of_the_scalar_reference_for_any_size_wind_edge_and_probability() {
    for (size, supply_interval) in
        [([17, 13, 9], 1), ([1, 1, 40], 2), ([33, 3, 33], 3), ([16, 2, 64], 1), ([5, 21, 71], 2), ([35, 40, 32], 1)]
    {
        for edges in [Edges::Open, Edges::Wrap] {
            let wind = sheared_wind();
            let config = AutomatonConfig { size, seed: 9, supply_interval, edges, inflow_humidity: 0.3, wind };
            let fields = random_fields(size, 5, 120, 9);
            let mut scalar = ScalarAutomaton::new(&config, &fields, vec![Box::new(Patchwork)]).unwrap();
            let mut fast = automaton(&config, fields);
            fast.set_probabilities(vec![Box::new(Patchwork)]);
            for step in 1..=12 {
                scalar.step();
                fast.step();
                assert_eq!(
                    fast.fields().hash(),
                    scalar.fields().unwrap().hash(),
                    "{size:?}, {edges:?}, step {step}: {:?} {:?}",
                    fast.fields().counts(),
                    scalar.fields().unwrap().counts()
                );
            }
            assert!(fast.fields().counts()[0] > 0, "{size:?}, {edges:?}: something happened");
        }
    }
}

/// Hash after 500 steps in a pool of `threads` threads.
fn hash_with_threads(threads: usize, edges: Edges) -> u64 {
    let size = [96, 80, 40];
    let config =
        AutomatonConfig { size, seed: 3, supply_interval: 1, edges, inflow_humidity: 0.2, wind: sheared_wind() };
    let run = || {
        let mut automaton = automaton(&config, random_fields(size, 2, 100, 3));
        automaton.set_probabilities(vec![Box::new(Patchwork)]);
        (0..500).for_each(|_| drop(automaton.step()));
        automaton.fields().hash()
    };
    ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(run)
}

#[test]
fn five_hundred_steps_with_wind_give_the_same_bits_on_any_number_of_threads_and_every_system() {
    for (edges, pinned) in [(Edges::Open, 0x772b_aad5_7a42_f153), (Edges::Wrap, 0xffdc_a51b_db6c_5d9e)] {
        let one = hash_with_threads(1, edges);
        assert_eq!(one, hash_with_threads(2, edges), "two threads, {edges:?}");
        assert_eq!(one, hash_with_threads(5, edges), "five threads, {edges:?}");
        assert_eq!(one, pinned, "the hash that all systems have to give, {edges:?}: {one:#x}");
    }
}

#[test]
fn uniform_probabilities_reach_the_published_equilibrium() {
    // Means of hum, act, cld and their standard errors from an independent program, other random numbers.
    let cases = [
        ([0.1, 0.1, 0.001], [0.225_698_8, 0.086_791_4, 0.465_914_9], [1.643e-4, 9.145e-5, 5.279e-4]),
        ([0.05, 0.02, 0.001], [0.127_168_5, 0.018_649_1, 0.279_581_6], [1.735e-4, 5.736e-5, 7.336e-4]),
    ];
    for ([extinction, humidity, activation], wanted, their_error) in cases {
        let size = [64, 64, 32];
        let mut automaton = Automaton::new(&AutomatonConfig { size, seed: 4, ..AutomatonConfig::default() }).unwrap();
        automaton.set_probabilities(vec![Box::new(Probabilities { extinction, humidity, activation })]);
        (0..200).for_each(|_| drop(automaton.step()));
        let mut blocks = [[0.0; 3]; 10];
        for step in 0..300 {
            automaton.step();
            let fields = automaton.fields();
            for (sum, field) in blocks[step / 30].iter_mut().zip([&fields.hum, &fields.act, &fields.cld]) {
                let inner = (8..56).flat_map(|y| &field.row(0, y)[8..56]);
                let ones: u32 = inner.map(|word| (word & 0x00FF_FF00).count_ones()).sum();
                *sum += f64::from(ones) / (48.0 * 48.0 * 16.0 * 30.0);
            }
        }
        for (index, name) in ["hum", "act", "cld"].into_iter().enumerate() {
            let mean = blocks.iter().map(|block| block[index]).sum::<f64>() / 10.0;
            let variance = blocks.iter().map(|block| (block[index] - mean).powi(2)).sum::<f64>() / 9.0;
            let error = (variance / 10.0 + f64::powi(their_error[index], 2)).sqrt();
            let off = (mean - wanted[index]) / error;
            assert!(off.abs() < 4.0, "{name}: {mean} against {}, {off} standard errors", wanted[index]);
        }
    }
}

#[test]
fn the_pure_rule_never_makes_vapour_and_always_dies_out() {
    let size = [40, 40, 33];
    let mut automaton =
        automaton(&AutomatonConfig { size, ..AutomatonConfig::default() }, random_fields(size, 8, 90, 2));
    let mut hum = automaton.fields().counts()[0];
    for _ in 0..200 {
        automaton.step();
        assert!(automaton.fields().counts()[0] <= hum, "humid cells never grow in number");
        hum = automaton.fields().counts()[0];
    }
    assert_eq!(automaton.fields().counts()[1], 0, "nothing is active any more");
}

#[test]
fn probability_one_is_always_zero_is_never_and_small_ones_are_not_lost() {
    let size = [256, 128, 32];
    let run = |humidity: f32| {
        let mut automaton = Automaton::new(&AutomatonConfig { size, ..AutomatonConfig::default() }).unwrap();
        automaton.set_probabilities(vec![Box::new(Probabilities { humidity, ..Probabilities::default() })]);
        automaton.step();
        automaton.fields().counts()[0] as f64
    };
    let cells = (256 * 128 * 32) as f64;
    assert!((run(1.0) - cells).abs() < 0.5, "always");
    assert!(run(0.0) < 0.5, "never");
    for p in [0.0005_f32, 0.003, 0.2, 0.97] {
        let (mean, sigma) = (f64::from(p) * cells, (f64::from(p) * cells).sqrt());
        // Five standard deviations, and the rounding of p to 2^-17.
        let allowed = 5.0 * sigma + cells / 131_072.0;
        assert!((run(p) - mean).abs() < allowed, "p = {p}: {} instead of {mean}", run(p));
    }
}

#[test]
fn supply_waits_for_its_interval_and_extinction_does_not() {
    let size = [32, 32, 32];
    let mut fields = CloudFields::new(size).unwrap();
    fields.cld.fill_with(|_| true);
    let config = AutomatonConfig { size, supply_interval: 4, ..AutomatonConfig::default() };
    let mut automaton = automaton(&config, fields);
    automaton.set_probabilities(vec![Box::new(Probabilities { extinction: 0.1, humidity: 0.1, activation: 0.0 })]);
    let mut before = automaton.fields().counts();
    for step in 0..9 {
        automaton.step();
        let [hum, _, cld] = automaton.fields().counts();
        assert_eq!(hum > before[0], step % 4 == 0, "vapour at step {step}");
        assert!(cld < before[2], "cloud vanishes at step {step}");
        before = [hum, 0, cld];
    }
}

#[test]
fn in_a_wrapped_grid_wind_keeps_every_bit() {
    let size = [23, 19, 35];
    let fields = random_fields(size, 6, 0, 0);
    let config = AutomatonConfig { size, edges: Edges::Wrap, wind: sheared_wind(), ..AutomatonConfig::default() };
    let mut fast = automaton(&config, fields);
    fast.moisten(&[Box::new(Probabilities { humidity: 0.4, ..Probabilities::default() })]);
    let humid = fast.fields().counts()[0];
    (0..50).for_each(|_| drop(fast.step()));
    assert_eq!(fast.fields().counts()[0], humid, "vapour is only moved");
}

#[test]
fn wrong_configurations_and_states_of_other_sizes_are_refused() {
    let config = AutomatonConfig::default();
    let interval = AutomatonConfig { supply_interval: 0, ..config.clone() };
    assert!(Automaton::new(&interval).unwrap_err().to_string().contains("1 to 1000000 steps"), "interval");
    let humidity = AutomatonConfig { inflow_humidity: 1.5, ..config.clone() };
    assert!(Automaton::new(&humidity).unwrap_err().to_string().contains("1.5 is outside 0 to 1"), "inflow");
    let other = CloudFields::new([4, 4, 4]).unwrap();
    let text = Automaton::new(&config).unwrap().restore(other, 0).unwrap_err().to_string();
    assert_eq!(text, "the state has [4, 4, 4] cells; the grid has [128, 128, 32]");
}
