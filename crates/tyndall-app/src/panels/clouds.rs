//! The panel of the clouds: time, presets of vapour, what the sky amounts to, and the wind.

use egui::{Button, RichText, ScrollArea, Slider, Ui, vec2};
use tyndall_clouds::VapourPattern;
use tyndall_core::ParamSet as _;
use tyndall_render::clouds::CloudProgress;
use tyndall_scene::{CloudKind, CloudParams, Scene};

use super::{
    SCROLL_MARGIN, cloud_figures,
    row::rename,
    signs::{self, Sign},
    sky_map, wind,
};
use crate::{
    cloud_clock::{CloudClock, SPEEDS, clock, next_step_s},
    cloud_tools::CloudTools,
};

/// Least side of a button with a sign.
const SIGN_PT: f32 = 26.0;

/// Shows the panel; `progress` is how the clouds of the viewport stand.
pub(crate) fn show(
    ui: &mut Ui,
    scene: &mut Scene,
    (clock, tools): (&mut CloudClock, &mut CloudTools),
    progress: Option<&CloudProgress>,
) {
    ScrollArea::vertical().auto_shrink(false).content_margin(SCROLL_MARGIN).show(ui, |ui| {
        presets(ui, scene);
        let none = match scene.clouds.kind {
            CloudKind::None => "There are no clouds in this scene; a sky above brings some.",
            CloudKind::File => "The clouds come from a file and stand still; a sky above brings others.",
            CloudKind::Automaton => "",
        };
        if !none.is_empty() {
            ui.add_space(4.0);
            ui.weak(none);
            return;
        }
        ui.add_space(6.0);
        transport(ui, scene, clock);
        ui.add_space(6.0);
        sky_map::show(ui, scene, tools);
        ui.add_space(6.0);
        let Some(progress) = progress else { return };
        let sign = if progress.building && !clock.is_playing { "Simulating..." } else { "" };
        ui.horizontal(|ui| {
            ui.strong("The sky");
            ui.weak(sign);
        });
        match &progress.report {
            Some(report) => cloud_figures::show(ui, report, scene),
            None => drop(ui.weak("No figures yet.")),
        }
        ui.add_space(6.0);
        ui.strong("Wind over height");
        wind::show(ui, scene);
    });
}

/// A button for each kind of sky.
fn presets(ui: &mut Ui, scene: &mut Scene) {
    ui.strong("Vapour");
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for &pattern in VapourPattern::ALL {
            let is_chosen = scene.clouds.kind != CloudKind::None && scene.cloud_vapour.pattern == pattern;
            let button = ui.add(Button::selectable(is_chosen, title(pattern)));
            rename(ui, &button, &format!("Vapour: {}", pattern.name()));
            if button.on_hover_text(hint(pattern)).clicked() {
                take_up(scene, pattern);
            }
        }
    });
}

fn title(pattern: VapourPattern) -> &'static str {
    match pattern {
        VapourPattern::CumulusField => "Cumulus",
        VapourPattern::Stratocumulus => "Stratocumulus",
        VapourPattern::Towering => "Towers",
        VapourPattern::SeaOfClouds => "Sea",
        VapourPattern::FairWeather => "Fair",
    }
}

fn hint(pattern: VapourPattern) -> &'static str {
    match pattern {
        VapourPattern::CumulusField => "Bubbles of rising air with flat bases, many and of several sizes.",
        VapourPattern::Stratocumulus => "A thin layer in closed cells, with narrow gaps.",
        VapourPattern::Towering => "A few stacks of bubbles, one above the other.",
        VapourPattern::SeaOfClouds => "A whole layer with swells, to be seen from above.",
        VapourPattern::FairWeather => "Small bubbles far from each other.",
    }
}

/// The preset of a pattern, on the ground that the scene's grid covers in cells, with its seed and its paint.
fn take_up(scene: &mut Scene, pattern: VapourPattern) {
    let CloudParams { mut grid, mut vapour, wind, matter } = pattern.preset();
    vapour.painted.clone_from(&scene.cloud_vapour.painted);
    let old = &scene.cloud_grid;
    (grid.cells_east, grid.cells_north, grid.seed, grid.edges) = (old.cells_east, old.cells_north, old.seed, old.edges);
    grid.warm_up_steps = old.warm_up_steps;
    (scene.cloud_grid, scene.cloud_vapour, scene.cloud_wind, scene.cloud_matter) = (grid, vapour, wind, matter);
    scene.clouds.kind = CloudKind::Automaton;
}

/// Back to start, play, step, seed, and how fast.
fn transport(ui: &mut Ui, scene: &mut Scene, playing: &mut CloudClock) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        if sign(ui, Sign::Back, "Clouds: back to start", "The end of the warm-up.") {
            scene.clouds.time_s = 0.0;
        }
        let (symbol, name) =
            if playing.is_playing { (Sign::Pause, "Clouds: pause") } else { (Sign::Play, "Clouds: play") };
        if sign(ui, symbol, name, "Lets the clouds form, drift and vanish.") {
            playing.is_playing = !playing.is_playing;
        }
        if sign(ui, Sign::Step, "Clouds: step", "To the end of the automaton's next step.") {
            playing.is_playing = false;
            let next_s = next_step_s(scene.clouds.time_s, scene.cloud_grid.step_s);
            scene.clouds.time_s = next_s.min(last_time_s(scene));
        }
        ui.add_space(6.0);
        ui.label(RichText::new(clock(scene.clouds.time_s)).monospace());
        ui.add_space(6.0);
        if sign(ui, Sign::Dice, "Clouds: another seed", "Other random numbers: another sky of the same kind.") {
            scene.cloud_grid.seed = another_seed(scene.cloud_grid.seed);
        }
        ui.weak(format!("seed {}", scene.cloud_grid.seed));
    });
    ui.horizontal(|ui| {
        ui.label("Speed");
        ui.spacing_mut().slider_width = (ui.available_width() - 96.0).max(60.0);
        let slider = Slider::new(&mut playing.speed, SPEEDS).logarithmic(true).max_decimals(0).suffix(" s/s");
        let response = ui.add(slider);
        rename(ui, &response, "Clouds: speed");
        response.on_hover_text("Seconds of the clouds in a second of yours.");
    });
}

/// A button with a sign; whether it was clicked.
pub(super) fn sign(ui: &mut Ui, sign: Sign, name: &str, hint: &str) -> bool {
    let button = ui.add(Button::new("").min_size(vec2(SIGN_PT, SIGN_PT)));
    rename(ui, &button, name);
    signs::paint(ui, &button, sign);
    button.on_hover_text(hint).clicked()
}

/// The last moment (s) that a scene can have.
pub(crate) fn last_time_s(scene: &Scene) -> f64 {
    let index = scene.clouds.position("time_s").ok();
    index.map_or(f64::INFINITY, |index| *scene.clouds.info()[index].range.end())
}

/// Looks random and comes back to no seed before all others were there.
pub(super) fn another_seed(seed: u32) -> u32 {
    // A full-period generator modulo 10000 (Hull and Dobell), so that seeds stay short.
    (seed % 10_000 * 7_421 + 2_113) % 10_000
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_come_back_only_after_all_the_others() {
        let mut seed = another_seed(1);
        let mut count = 1;
        while seed != 1 {
            seed = another_seed(seed);
            count += 1;
            assert!(count <= 10_000, "a cycle without the first seed");
        }
        assert_eq!(count, 10_000, "different seeds");
    }

    #[test]
    fn a_preset_keeps_the_ground_and_the_seed_and_is_an_allowed_scene() {
        for &pattern in VapourPattern::ALL {
            let mut scene = Scene::default();
            (scene.cloud_grid.cells_east, scene.cloud_grid.seed) = (48, 77);
            take_up(&mut scene, pattern);
            assert_eq!((scene.cloud_grid.cells_east, scene.cloud_grid.seed), (48, 77), "{pattern:?}");
            assert_eq!((scene.clouds.kind, scene.cloud_vapour.pattern), (CloudKind::Automaton, pattern));
            assert!(scene.check().is_ok(), "{pattern:?}");
        }
    }
}
