//! The sand automata on an adapter against those in main memory: the same bits.

use tyndall_dunes::by_hand::{parse_strokes, touches};
use tyndall_dunes::ripples::{RippleBed, RippleParams, RippleRule};
use tyndall_dunes::slab::{
    AbrasionParams, ClassicParams, DuneField, DuneModel, DuneParams, DuneState, VegetationParams,
};
use tyndall_dunes::wind::{Wind, WindSchedule};
use tyndall_dunes::{
    DesertInputs, DesertParams, DesertSource, DuneStepper, Edges, SandDevice, SandSimulation as _, Side, SteppedBy,
};
use tyndall_gpu::{AdapterChoice, GpuError, GpuOptions};
use tyndall_gpu_sim::{GpuDunes, GpuRipples, GpuSimError, GpuStepper};
use tyndall_tests::gpu;

use crate::memory::with_budget;

/// Winds along the rows, across the lattice, and almost against the first; the sides of the beds that they blow over.
const WINDS: [(f64, usize); 3] = [(0.0, 128), (37.0, 256), (200.0, 128)];

/// Runs both, compares their hashes, and gives back what was read from the device.
fn assert_equal_after<D>(what: &str, device: &mut D, host: &mut D::Host, steps: u32) -> D::Host
where
    D: SandDevice<Error = GpuSimError>,
{
    device.run(steps).unwrap_or_else(|error| panic!("{what}: {error}"));
    host.run(steps);
    let read = device.read().unwrap_or_else(|error| panic!("{what}: {error}"));
    let step = host.steps_done();
    assert_eq!(device.steps_done(), step, "{what}: steps");
    assert_eq!(read.mass_quanta(), host.mass_quanta(), "{what}: sand after {step} steps");
    assert_eq!(read.state_hash(), host.state_hash(), "{what}: bits after {step} steps");
    read
}

fn bed(params: &RippleParams, size: [usize; 2]) -> RippleBed {
    let noisy = RippleBed::new(&RippleParams { side: Side::Cells256, ..params.clone() });
    let noisy = noisy.expect("parameters are in range");
    let mut bed = RippleBed::with_rule(RippleRule::new(params).expect("in range"), size, 3).expect("powers of two");
    bed.set_heights(&noisy.heights()[..size[0] * size[1]]).expect("as many as there are cells");
    bed
}

fn field(params: &DuneParams, size: [usize; 2]) -> DuneField {
    DuneField::with_size(params, size).expect("parameters are in range")
}

fn dunes(field: &DuneField) -> GpuDunes {
    GpuDunes::new(gpu(), field).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn ripples_have_the_bits_of_the_cpu_after_500_steps_under_each_wind() {
    for (wind_deg, side) in WINDS {
        let mut host = bed(&RippleParams::default(), [side, side]);
        host.set_wind_deg(wind_deg);
        let mut device = GpuRipples::new(gpu(), &host).unwrap_or_else(|error| panic!("{error}"));
        assert_equal_after(&format!("ripples, wind to {wind_deg} deg"), &mut device, &mut host, 500);
    }
}

#[test]
fn every_form_of_the_ripple_rule_has_the_bits_of_the_cpu() {
    let plain = RippleParams { dither: false, lee_slope: 0.0, noise_cells: 1.0, ..RippleParams::default() };
    for (what, params) in [
        ("plain", plain.clone()),
        ("dithered, no shadow", RippleParams { dither: true, ..plain.clone() }),
        ("shadow, no dither", RippleParams { lee_slope: 0.1, ..plain.clone() }),
        ("little sand", RippleParams { depth_cells: 0.3, layer_cells: 0.2, ..RippleParams::default() }),
        ("planed by the wind", RippleParams { hop_cells: 40.0, ..plain.clone() }),
        ("longest hops", RippleParams { hop_cells: 30.0, hop_per_height: 8.0, creep: 0.75, ..plain }),
    ] {
        let mut host = bed(&params, [64, 16]);
        let mut device = GpuRipples::new(gpu(), &host).unwrap_or_else(|error| panic!("{error}"));
        for wind_deg in [0.0, 90.0, 301.0] {
            host.set_wind_deg(wind_deg);
            device.set_wind_deg(wind_deg);
            assert_equal_after(&format!("{what}, wind to {wind_deg} deg"), &mut device, &mut host, 41);
        }
    }
}

#[test]
fn dunes_have_the_bits_of_the_cpu_after_500_steps_under_each_wind() {
    for (wind_deg, side) in WINDS {
        let mut host = field(&DuneParams::default(), [side, side]);
        host.set_winds(WindSchedule::steady(wind_deg));
        let start = host.mass_quanta();
        let read = assert_equal_after(&format!("dunes, wind to {wind_deg} deg"), &mut dunes(&host), &mut host, 500);
        assert_eq!(read.mass_quanta(), start, "wind to {wind_deg} deg: not a quantum is lost");
        assert_eq!(read.state(), host.state(), "wind to {wind_deg} deg: the whole state");
    }
}

#[test]
fn dunes_under_winds_that_take_turns_have_the_bits_of_the_cpu() {
    let winds = [(0.0, 2.0), (135.0, 1.0)].map(|(toward_deg, share)| Wind { toward_deg, share });
    let mut host = field(&DuneParams { lift: 1.0, ..DuneParams::default() }, [128, 64]);
    host.set_winds(WindSchedule::new(&winds, 30).expect("there is wind"));
    assert_equal_after("R = 2, 135 deg apart", &mut dunes(&host), &mut host, 200);
}

#[test]
fn open_edges_have_the_bits_and_the_ledger_of_the_cpu() {
    let params = DuneParams { edges: Edges::Open, inflow: 0.3, sand_cells: 1.0, ..DuneParams::default() };
    // The narrow bed is smaller than hops, lees and shadows reach.
    for size in [[128, 64], [16, 128]] {
        let mut host = field(&params, size);
        let mut device = dunes(&host);
        for wind_deg in [0.0, 37.0, 200.0, 270.0] {
            host.set_winds(WindSchedule::steady(wind_deg));
            device.set_winds(WindSchedule::steady(wind_deg));
            let what = format!("open edges, {size:?}, wind to {wind_deg} deg");
            let read = assert_equal_after(&what, &mut device, &mut host, 60);
            assert_eq!(read.ledger(), host.ledger(), "{what}");
            assert_eq!(read.mass_quanta(), read.ledger().expected(), "{what}: every quantum is in the ledger");
        }
        assert!(host.ledger().left > 0 && host.ledger().entered > 0, "sand crossed the edges: {:?}", host.ledger());
    }
}

/// A field with plants, rock that wears, a wall and steep terrain.
fn rich_field(edges: Edges) -> DuneField {
    let mut field = field(&DuneParams { sand_cells: 0.6, edges, ..DuneParams::default() }, [64, 64]);
    let in_wall = |index: usize| (30..36).contains(&(index % 64)) && (20..40).contains(&(index / 64));
    let cells = 0..64 * 64;
    let rock: Vec<f32> =
        cells.clone().map(|index| if in_wall(index) { 10.0 } else { (index % 64) as f32 * 0.3 }).collect();
    field.set_bedrock_cells(&rock).expect("in range");
    field.set_walls(&cells.clone().map(|index| u8::from(in_wall(index))).collect::<Vec<_>>()).expect("it fits");
    let plants = VegetationParams { enabled: true, cover: 0.1, ..VegetationParams::default() };
    field.set_vegetation(&plants).expect("in range");
    let hardness: Vec<u8> = cells.map(|index| (index * 7).to_le_bytes()[0]).collect();
    let wear = AbrasionParams { enabled: true, rate: 0.9, ..AbrasionParams::default() };
    field.set_abrasion(&wear, Some(&hardness)).expect("in range");
    field
}

#[test]
fn plants_rock_and_walls_have_the_bits_of_the_cpu() {
    for edges in [Edges::Periodic, Edges::Open] {
        let mut host = rich_field(edges);
        let mut device = dunes(&host);
        for (wind_deg, steps) in [(0.0, 50), (121.0, 70)] {
            host.set_winds(WindSchedule::steady(wind_deg));
            device.set_winds(WindSchedule::steady(wind_deg));
            let read = assert_equal_after(&format!("{edges:?}, {wind_deg} deg"), &mut device, &mut host, steps);
            assert_eq!(read.state(), host.state(), "{edges:?}, {wind_deg} deg: plants, means and ledger too");
        }
        assert!(host.ledger().abraded > 0, "rock was worn: {:?}", host.ledger());
        let cover = host.plant_cover().expect("plants grow");
        assert!(cover.iter().any(|&cover| cover > 0), "plants are there");
    }
}

#[test]
fn what_was_done_on_the_cpu_in_between_goes_back_to_the_device() {
    let mut host = field(&DuneParams::default(), [64, 64]);
    let mut device = dunes(&host);
    let mut read = assert_equal_after("before", &mut device, &mut host, 13);
    read.settle();
    host.settle();
    device.write(&read).unwrap_or_else(|error| panic!("{error}"));
    assert_equal_after("after settling", &mut device, &mut host, 20);
    let mut other = field(&DuneParams { slide_passes: 3, seed: 9, ..DuneParams::default() }, [128, 16]);
    device.write(&other).unwrap_or_else(|error| panic!("{error}"));
    assert_equal_after("another size and rule", &mut device, &mut other, 20);
}

#[test]
fn steps_are_counted_and_drawn_alike_beyond_32_bits() {
    let mut host = field(&DuneParams::default(), [64, 64]);
    let state = DuneState { step: u32::MAX - 5, ..host.state() };
    host.set_state(state).expect("it is its own");
    assert_equal_after("past the last step", &mut dunes(&host), &mut host, 20);
}

#[test]
fn a_bed_that_exceeds_the_memory_is_refused_with_sizes() {
    let small = with_budget(1 << 20);
    let error = GpuDunes::new(&small, &field(&DuneParams::default(), [256, 256])).expect_err("11 grids of 256 KiB");
    assert!(matches!(error, GpuSimError::Gpu(GpuError::OverBudget { budget_bytes: 0x10_0000, .. })), "{error}");
    assert_eq!(small.used_memory_bytes(), 0, "what was allocated is given back");
}

#[test]
fn the_classic_rule_is_refused_by_name() {
    let mut classic = field(&DuneParams { model: DuneModel::Classic, ..DuneParams::default() }, [64, 64]);
    classic.set_classic(&ClassicParams::default()).expect("in range");
    let error = GpuDunes::new(gpu(), &classic).expect_err("there is no shader for it");
    assert_eq!(
        error.to_string(),
        "the model `classic` runs on the CPU only; the compute form has the model `slab`",
        "what to do instead"
    );
    let host = field(&DuneParams::default(), [64, 64]);
    let mut device = dunes(&host);
    assert_eq!(device.write(&classic), Err(GpuSimError::Classic), "nor can it be brought later");
    let read = device.read().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(read.state_hash(), host.state_hash(), "the field on the device is as it was");
}

#[test]
fn the_desert_of_a_scene_is_the_same_sand_whoever_makes_its_steps() {
    let made = |params: &DesertParams, stepper: Option<Box<dyn DuneStepper>>| {
        let strokes = parse_strokes("20 dig 6 2 0 0 10 0; 45 add 5 1 -9 3").expect("strokes");
        let touches = touches(&strokes, 1.0, [64, 64]).expect("on the field");
        let inputs = DesertInputs { touches, ..DesertInputs::default() };
        let mut source = DesertSource::default();
        source.set_stepper(stepper);
        // Asked for in pieces, and from before a stroke, as a window with a brush does.
        let hashes = [30, 70, 50].map(|step| {
            let desert = source.at_unless(params, &inputs, step, &|_| false).expect("possible");
            desert.expect("waited for").hash()
        });
        (hashes, source.stepped_by().clone())
    };
    let device = || {
        let options = GpuOptions { adapter: AdapterChoice::Software, max_memory_bytes: None };
        Some(Box::new(GpuStepper::new(options)) as Box<dyn DuneStepper>)
    };
    let mut params = DesertParams::default();
    params.dunes.side = Side::Cells64;
    let (plain, by) = made(&params, None);
    assert_eq!(by, SteppedBy::Processor, "unless a device is chosen");
    assert_eq!(made(&params, device()), (plain, SteppedBy::Device), "the bits of the processor");

    params.dunes.model = DuneModel::Classic;
    let (classic, _) = made(&params, None);
    let (instead, by) = made(&params, device());
    assert_eq!(instead, classic, "what the device cannot do the processor does");
    let SteppedBy::ProcessorInstead(reason) = by else { panic!("the classic rule has no compute form: {by:?}") };
    assert!(reason.contains("classic"), "{reason}");
}
