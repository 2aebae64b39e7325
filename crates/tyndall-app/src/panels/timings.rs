//! The timings panel: what a frame costs on the GPU, pass by pass.

use std::collections::VecDeque;

use egui::{Color32, Grid, ScrollArea, Sense, Ui, Visuals, ecolor::Hsva, vec2};
use egui_plot::{Line, Plot, PlotPoints};
use tyndall_render::sky::TableProgress;

use crate::engine::{Engine, FrameTimings};

/// Part of the names of passes that fill tables.
const TABLE: &str = "table";

/// Widths of the facts and of the table of passes; the plot takes the rest.
const FACTS_PT: f32 = 250.0;
const PASSES_PT: f32 = 240.0;

/// Shows the panel.
pub(crate) fn show(ui: &mut Ui, engine: Option<&Engine>, frames: u64) {
    let Some(engine) = engine else {
        ui.weak("There is no renderer.");
        return;
    };
    ui.horizontal_top(|ui| {
        column(ui, "facts", FACTS_PT, |ui| facts(ui, engine, frames));
        column(ui, "passes", PASSES_PT, |ui| match engine.timings.back() {
            Some(newest) => passes(ui, newest, &engine.timings),
            None if engine.gpu.has_timestamps() => drop(ui.weak("No frame has been timed yet.")),
            None => drop(ui.weak("This adapter cannot time its passes.")),
        });
        plot(ui, engine);
    });
}

fn column(ui: &mut Ui, name: &str, width: f32, contents: impl FnOnce(&mut Ui)) {
    ui.vertical(|ui| {
        ui.set_width(width.min(ui.available_width()));
        ScrollArea::vertical().id_salt(name).auto_shrink(false).show(ui, contents);
    });
}

fn facts(ui: &mut Ui, engine: &Engine, frames: u64) {
    Grid::new("facts").num_columns(2).show(ui, |ui| {
        let mut fact = |name: &str, value: String| {
            ui.weak(name);
            ui.add(egui::Label::new(value).truncate());
            ui.end_row();
        };
        fact("Adapter", engine.gpu.adapter().name.clone());
        let mib = |bytes: u64| bytes as f64 / f64::from(1 << 20);
        let (used, most) = (engine.gpu.used_memory_bytes(), engine.gpu.max_memory_bytes());
        fact("Memory", format!("{:.1} of {:.0} MiB", mib(used), mib(most)));
        fact("Start", format!("{:.0} ms for all pipelines", engine.start_ms));
        fact("Frames drawn", frames.to_string());
        fact("Sky table", table_state(&engine.tables()));
        let last = engine.tables().last_ms.map_or_else(|| "none yet".to_owned(), |ms| format!("{ms:.0} ms"));
        fact("Table rebuild", last);
    });
}

/// How the table of all orders of scattering stands.
fn table_state(tables: &TableProgress) -> String {
    match (tables.building, tables.done) {
        (false, _) => "up to date".to_owned(),
        (true, Some(done)) => format!("building, {:.0} %", 100.0 * done),
        (true, None) => "building...".to_owned(),
    }
}

fn passes(ui: &mut Ui, newest: &FrameTimings, all: &VecDeque<FrameTimings>) {
    let last_tables = all.iter().map(tables_ms).rfind(|ms| *ms > 0.0);
    Grid::new("passes").num_columns(2).show(ui, |ui| {
        let names = pass_names(all);
        for pass in &newest.passes {
            let position = names.iter().position(|name| *name == pass.name).unwrap_or_default();
            ui.horizontal(|ui| {
                let (rect, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::empty());
                ui.painter().rect_filled(rect, 2.0, colour(ui.visuals(), position));
                ui.label(pass.name);
            });
            ui.monospace(format!("{:8.2} ms", pass.ms));
            ui.end_row();
        }
        ui.strong(format!("Frame {} x {}", newest.size_px[0], newest.size_px[1]));
        ui.monospace(format!("{:8.2} ms", newest.total_ms()));
        ui.end_row();
        if let Some(ms) = last_tables {
            ui.label("Tables, last rebuilt");
            ui.monospace(format!("{ms:8.2} ms"));
            ui.end_row();
        }
    });
}

/// Time of the passes that fill tables; 0 when none had to.
fn tables_ms(frame: &FrameTimings) -> f64 {
    frame.passes.iter().filter(|pass| pass.name.contains(TABLE)).map(|pass| pass.ms).sum()
}

/// Names of all passes of the frames, in the order in which they first came.
fn pass_names(all: &VecDeque<FrameTimings>) -> Vec<&'static str> {
    let mut names = Vec::new();
    for pass in all.iter().flat_map(|frame| &frame.passes) {
        if !names.contains(&pass.name) {
            names.push(pass.name);
        }
    }
    names
}

/// Colour of a pass in plot and table: even steps around the circle of hues, which no number of passes exhausts.
fn colour(visuals: &Visuals, position: usize) -> Color32 {
    const GOLDEN_TURN: f32 = 0.618_034;
    let (saturation, value) = if visuals.dark_mode { (0.6, 0.9) } else { (0.85, 0.7) };
    Hsva::new((0.58 + position as f32 * GOLDEN_TURN).fract(), saturation, value, 1.0).into()
}

/// One line a pass over the last frames, in the colours of the table.
fn plot(ui: &mut Ui, engine: &Engine) {
    let visuals = ui.visuals().clone();
    let line = |(position, name): (usize, &'static str)| {
        let points = engine.timings.iter().enumerate().map(|(frame, timings)| {
            let ms = timings.passes.iter().find(|pass| pass.name == name).map_or(0.0, |pass| pass.ms);
            [frame as f64, ms]
        });
        Line::new(name, points.collect::<PlotPoints<'_>>()).color(colour(&visuals, position)).width(1.6)
    };
    Plot::new("timings")
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .include_y(0.0)
        .y_axis_label("ms")
        .show(ui, |plot| pass_names(&engine.timings).into_iter().enumerate().for_each(|pass| plot.line(line(pass))));
}
