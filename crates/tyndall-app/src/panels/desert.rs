//! The panel of the desert: steps, presets, what the sand amounts to.

use std::time::Duration;

use egui::{Button, RichText, ScrollArea, Slider, Ui};
use tyndall_core::ParamSet as _;
use tyndall_dunes::by_hand::{HandTool, parse_strokes};
use tyndall_dunes::presets::{DunePreset, dune_presets, ripple_preset};
use tyndall_render::desert::DesertProgress;
use tyndall_scene::{DesertKind, LandscapeKind, RippleParams, Scene};

use super::{
    SCROLL_MARGIN,
    clouds::{another_seed, sign},
    desert_figures, rose,
    row::rename,
    signs::Sign,
};
use crate::{
    desert_clock::{DesertClock, SPEEDS},
    desert_tools::DesertTools,
    steps_on::StepsOn,
};

/// Ranges of the brush's radius and depth (m).
const RADII_M: std::ops::RangeInclusive<f64> = 0.3..=200.0;
const DEPTHS_M: std::ops::RangeInclusive<f64> = 0.02..=20.0;

/// Times of a step between which numbers of them are chosen, and least time that a picture is thought to take.
const FAST_STEP: Duration = Duration::from_micros(100);
const SLOW_STEP: Duration = Duration::from_millis(50);
const LEAST_TIME: Duration = Duration::from_millis(30);

/// Shows the panel; `progress` is how the desert of the viewport stands.
pub(crate) fn show(
    ui: &mut Ui,
    scene: &mut Scene,
    (clock, tools): (&mut DesertClock, &mut DesertTools),
    progress: Option<&DesertProgress>,
) {
    ScrollArea::vertical().auto_shrink(false).content_margin(SCROLL_MARGIN).show(ui, |ui| {
        presets(ui, scene);
        if scene.desert.kind == DesertKind::None {
            ui.add_space(4.0);
            ui.weak("There is no desert in this scene; a button above brings one.");
            return;
        }
        ui.add_space(6.0);
        transport(ui, scene, clock, progress);
        ui.add_space(6.0);
        brushes(ui, scene, tools);
        ui.add_space(6.0);
        let Some(progress) = progress else { return };
        rose::show(ui, scene, progress.report.as_deref());
        ui.add_space(6.0);
        match &progress.report {
            Some(report) => desert_figures::show(ui, report, scene, clock),
            None => drop(ui.weak("No figures yet.")),
        }
    });
}

/// A button for each kind of desert.
fn presets(ui: &mut Ui, scene: &mut Scene) {
    ui.strong("Desert");
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for preset in dune_presets() {
            let button = ui.add(Button::selectable(is_chosen(scene, &preset), title(preset.name)));
            rename(ui, &button, &format!("Desert: {}", preset.name));
            if button.on_hover_text(preset.title).clicked() {
                take_up(scene, &preset);
            }
        }
        let ripples = ripple_preset();
        let button = ui.button("Ripples");
        rename(ui, &button, &format!("Desert: {}", ripples.name));
        if button.on_hover_text(ripples.title).clicked() {
            look_at_ripples(scene);
        }
    });
}

fn title(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Whether sand, winds and plants of the scene are those of a preset, its size, seed and step apart.
fn is_chosen(scene: &Scene, preset: &DunePreset) -> bool {
    let mut dunes = preset.dunes.clone();
    (dunes.side, dunes.seed, dunes.cell_m) = (scene.dunes.side, scene.dunes.seed, scene.dunes.cell_m);
    scene.desert.kind == DesertKind::Dunes
        && scene.dunes == dunes
        && scene.dune_wind == preset.winds
        && scene.dune_plants == preset.vegetation
}

/// The desert of a preset as it is when it has grown, with the size and the seed of the scene.
fn take_up(scene: &mut Scene, preset: &DunePreset) {
    begin(scene);
    let old = scene.dunes.clone();
    scene.dunes = preset.dunes.clone();
    (scene.dunes.side, scene.dunes.seed, scene.dunes.cell_m) = (old.side, old.seed, old.cell_m);
    (scene.dune_wind, scene.dune_plants) = (preset.winds.clone(), preset.vegetation.clone());
    scene.desert.steps = preset.steps;
    scene.desert.wind_table.clear();
    scene.desert.winds.clear();
    scene.desert.strokes.clear();
}

/// Sand in place of what stands there.
fn begin(scene: &mut Scene) {
    scene.desert.kind = DesertKind::Dunes;
    scene.landscape.kind = LandscapeKind::None;
}

/// The default tile of ripples, and the camera so near that they are seen.
fn look_at_ripples(scene: &mut Scene) {
    begin(scene);
    scene.ripples = RippleParams::default();
    scene.desert.ripple_steps = ripple_preset().steps;
    (scene.camera.altitude_m, scene.camera.pitch_deg) = (1.2, -35.0);
}

/// What dragging on the view does to the sand.
fn brushes(ui: &mut Ui, scene: &mut Scene, tools: &mut DesertTools) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.strong("By hand");
        let offered = [None].into_iter().chain(HandTool::ALL.map(Some));
        for tool in offered {
            let (text, name) = tool.map_or(("Look", "look"), |tool| (brush_title(tool), tool.name()));
            let button = ui.selectable_value(&mut tools.tool, tool, text);
            rename(ui, &button, &format!("Desert: brush {name}"));
        }
        if !scene.desert.strokes.is_empty() {
            let button = ui.button("Clear strokes");
            rename(ui, &button, "Desert: clear strokes");
            if button.clicked() {
                scene.desert.strokes.clear();
                tools.is_full = false;
            }
        }
    });
    if let Err(error) = parse_strokes(&scene.desert.strokes) {
        ui.colored_label(ui.visuals().error_fg_color, format!("{error}. Brushes wait until the strokes are cleared."));
    }
    let Some(tool) = tools.tool else { return };
    for (caption, name, value, range) in [
        ("Radius", "Desert: radius of the brush", &mut tools.radius_m, RADII_M),
        ("Depth", "Desert: depth of the brush", &mut tools.depth_m, DEPTHS_M),
    ] {
        if tool == HandTool::Flatten && caption == "Depth" {
            continue;
        }
        ui.horizontal(|ui| {
            ui.label(caption);
            ui.spacing_mut().slider_width = (ui.available_width() - 80.0).max(60.0);
            let slider = ui.add(Slider::new(value, range).logarithmic(true).max_decimals(2).suffix(" m"));
            rename(ui, &slider, name);
        });
    }
    let full = "No more strokes fit into the scene: clear them, or export the field and start from it.";
    ui.weak(if tools.is_full { full } else { "Drag on the sand in the view; undo takes a stroke back." });
}

fn brush_title(tool: HandTool) -> &'static str {
    match tool {
        HandTool::Add => "Add",
        HandTool::Dig => "Dig",
        HandTool::Flatten => "Flatten",
        HandTool::Walk => "Footprints",
    }
}

/// Back to start, play, step, seed, and how fast.
fn transport(ui: &mut Ui, scene: &mut Scene, playing: &mut DesertClock, progress: Option<&DesertProgress>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        if sign(ui, Sign::Back, "Desert: back to start", "Sand as it lay before the wind.") {
            (playing.is_playing, scene.desert.steps) = (false, 0);
        }
        let (symbol, name) =
            if playing.is_playing { (Sign::Pause, "Desert: pause") } else { (Sign::Play, "Desert: play") };
        if sign(ui, symbol, name, "Lets the wind blow.") {
            playing.is_playing = !playing.is_playing;
        }
        if sign(ui, Sign::Step, "Desert: step", "One step of the wind.") {
            playing.is_playing = false;
            scene.desert.steps = (scene.desert.steps + 1).min(last_step(scene));
        }
        ui.add_space(6.0);
        ui.label(RichText::new(format!("step {}", scene.desert.steps)).monospace());
        ui.add_space(6.0);
        if sign(ui, Sign::Dice, "Desert: another seed", "Other random numbers: other dunes of the same kind.") {
            scene.dunes.seed = another_seed(scene.dunes.seed);
        }
        ui.weak(format!("seed {}", scene.dunes.seed));
    });
    ui.horizontal(|ui| {
        ui.label("Speed");
        ui.spacing_mut().slider_width = (ui.available_width() - 130.0).max(60.0);
        let slider = Slider::new(&mut playing.speed, SPEEDS).logarithmic(true).max_decimals(0).suffix(" steps/s");
        let response = ui.add(slider);
        rename(ui, &response, "Desert: speed");
        response.on_hover_text("Steps of the wind in a second of yours.");
    });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label("Steps on").on_hover_text("Processor and graphics make the same sand, bit for bit.");
        for choice in StepsOn::ALL {
            let button = ui.selectable_value(&mut playing.steps_on, choice, choice.title());
            rename(ui, &button, &format!("Desert: steps on {}", choice.title().to_lowercase()));
        }
    });
    let made = progress.and_then(|progress| progress.report.as_ref()).map(|report| report.step);
    match made {
        Some(_) if playing.is_playing => drop(ui.weak(format!("{:.0} steps/s come out of it.", playing.reached))),
        Some(made) if made != scene.desert.steps => {
            ui.add(egui::ProgressBar::new(share(made, scene.desert.steps)).text(format!("step {made}")));
        }
        _ => drop(ui.weak("")),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a share")]
fn share(made: u32, wanted: u32) -> f32 {
    (f64::from(made) / f64::from(wanted.max(1))).clamp(0.0, 1.0) as f32
}

/// How many steps are made in about as long as a picture takes; more would let the picture wait.
pub(crate) fn steps_at_once(progress: &DesertProgress) -> u32 {
    let report = progress.report.as_ref();
    let step = report.and_then(|report| report.times.step).unwrap_or(SLOW_STEP).max(FAST_STEP);
    let picture = report.map_or(SLOW_STEP, |report| report.times.picture).max(LEAST_TIME);
    #[expect(clippy::cast_possible_truncation, reason = "clamped to a few")]
    let steps = (picture.as_secs_f64() / step.as_secs_f64()).clamp(1.0, 500.0) as u32;
    steps
}

/// The last step that a scene can have.
#[expect(clippy::cast_possible_truncation, reason = "the range is one of whole numbers")]
pub(crate) fn last_step(scene: &Scene) -> u32 {
    let index = scene.desert.position("steps").ok();
    index.map_or(u32::MAX, |index| *scene.desert.info()[index].range.end() as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_scene::Side;

    #[test]
    fn a_preset_keeps_size_and_seed_and_is_an_allowed_scene_that_is_recognised() {
        for preset in dune_presets() {
            let mut scene = Scene::default();
            scene.landscape.kind = LandscapeKind::Mountains;
            (scene.dunes.side, scene.dunes.seed, scene.dunes.cell_m) = (Side::Cells128, 77, 2.0);
            take_up(&mut scene, &preset);
            assert_eq!((scene.dunes.side, scene.dunes.seed), (Side::Cells128, 77), "{}", preset.name);
            assert!(is_chosen(&scene, &preset), "{}", preset.name);
            assert!(scene.check().is_ok(), "{}", preset.name);
            let others = dune_presets().into_iter().filter(|other| is_chosen(&scene, other)).count();
            assert_eq!(others, 1, "{} is not taken for another", preset.name);
        }
        let mut scene = Scene::default();
        look_at_ripples(&mut scene);
        assert!(scene.check().is_ok(), "ripples");
    }
}
