//! The timings panel: what a frame costs on the GPU, pass by pass.

use egui::{Grid, ScrollArea, Ui};
use egui_plot::{Legend, Line, Plot, PlotPoints};

use crate::engine::{Engine, FrameTimings};

/// Part of the names of passes that fill tables.
const TABLE: &str = "table";

/// Widest the table of passes gets; the plot takes the rest.
const TABLE_PT: f32 = 330.0;

/// Shows the panel.
pub(crate) fn show(ui: &mut Ui, engine: Option<&Engine>, frames: u64) {
    let Some(engine) = engine else {
        ui.weak("There is no renderer.");
        return;
    };
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.set_width(TABLE_PT.min(ui.available_width()));
            ScrollArea::vertical().id_salt("passes").auto_shrink(false).show(ui, |ui| {
                facts(ui, engine, frames);
                ui.add_space(6.0);
                match engine.timings.back() {
                    Some(newest) => passes(ui, newest, &engine.timings),
                    None if engine.gpu.has_timestamps() => drop(ui.weak("No frame has been timed yet.")),
                    None => drop(ui.weak("This adapter cannot time its passes.")),
                }
            });
        });
        plot(ui, engine);
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
    });
}

fn passes<'a>(ui: &mut Ui, newest: &FrameTimings, all: impl IntoIterator<Item = &'a FrameTimings>) {
    let last_tables = all.into_iter().map(tables_ms).filter(|ms| *ms > 0.0).last();
    Grid::new("passes").num_columns(2).striped(true).show(ui, |ui| {
        for pass in &newest.passes {
            ui.label(pass.name);
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

/// One line a pass over the last frames.
fn plot(ui: &mut Ui, engine: &Engine) {
    let mut names: Vec<&'static str> = Vec::new();
    for pass in engine.timings.iter().flat_map(|frame| &frame.passes) {
        if !names.contains(&pass.name) {
            names.push(pass.name);
        }
    }
    let line = |name: &'static str| {
        let points = engine.timings.iter().enumerate().map(|(frame, timings)| {
            let ms = timings.passes.iter().find(|pass| pass.name == name).map_or(0.0, |pass| pass.ms);
            [frame as f64, ms]
        });
        Line::new(name, points.collect::<PlotPoints<'_>>())
    };
    Plot::new("timings")
        .legend(Legend::default())
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .include_y(0.0)
        .y_axis_label("ms")
        .x_axis_label("frame")
        .show(ui, |plot| names.into_iter().for_each(|name| plot.line(line(name))));
}
