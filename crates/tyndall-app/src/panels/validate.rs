//! The error meter's panel: how far the sky of this scene is from the truth, in per cent.

use egui::{Color32, Grid, ProgressBar, RichText, ScrollArea, Ui, vec2};
use egui_plot::{HoverPosition, MarkerShape, Plot, PlotPoints, Points};
use tyndall_scattering::validate::{Band, Report, Statistics};
use tyndall_scene::{Orders, Scene};

use super::plots::{few, quiet, short};
use crate::error_meter::{self, ErrorMeter, Subject, Thoroughness};
use crate::meter;

/// A comparison of skies that has come to its end.
type Outcome = meter::Outcome<Subject, Report>;

/// Width of the table; the plot takes the rest.
const TABLE_PT: f32 = 480.0;

/// Shows the panel.
pub(crate) fn show(ui: &mut Ui, meter: &mut ErrorMeter, thoroughness: &mut Thoroughness, scene: &Scene) {
    ui.horizontal_wrapped(|ui| controls(ui, meter, thoroughness, scene));
    if let Some(error) = meter.error() {
        ui.colored_label(ui.visuals().error_fg_color, error);
    }
    let Some(outcome) = meter.outcome() else {
        ui.weak("Compares the tables that pictures are made from with random walks of light through this scene's air.");
        return;
    };
    ui.add_space(4.0);
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.set_width(TABLE_PT.min(ui.available_width()));
            ScrollArea::both().id_salt("table of errors").auto_shrink(false).show(ui, |ui| table(ui, outcome, scene));
        });
        if ui.available_width() > 120.0 {
            ui.vertical(|ui| {
                ui.strong("Error of luminance, %, over the height of view");
                plot(ui, outcome);
            });
        }
    });
}

fn controls(ui: &mut Ui, meter: &mut ErrorMeter, thoroughness: &mut Thoroughness, scene: &Scene) {
    if let Some(done) = meter.progress() {
        ui.add(ProgressBar::new(done).desired_width(220.0).show_percentage());
        if ui.button("Stop").clicked() {
            meter.cancel();
        }
        return;
    }
    let Some(subject) = Subject::of(scene) else {
        ui.weak("The date does not exist: there is no sun.");
        return;
    };
    if ui.button("Compare").on_hover_text("Runs beside the frames; the window stays awake.").clicked() {
        let ctx = ui.ctx().clone();
        error_meter::start(meter, subject, *thoroughness, move || ctx.request_repaint());
    }
    for choice in Thoroughness::ALL {
        let (name, hint) = choice.label();
        ui.selectable_value(thoroughness, choice, name).on_hover_text(hint);
    }
    if scene.sky.orders == Orders::Single {
        ui.colored_label(
            ui.visuals().warn_fg_color,
            "Pictures of this scene leave out light scattered more than once.",
        );
    }
}

fn table(ui: &mut Ui, outcome: &Outcome, scene: &Scene) {
    Grid::new("bands").num_columns(7).spacing([14.0, 3.0]).striped(true).show(ui, |ui| {
        for name in ["Part of the sky", "Views", "Median", "95th", "Worst", "Bias", "Noise"] {
            ui.weak(name);
        }
        ui.end_row();
        for band in &outcome.report.bands {
            let name = band.band.map_or("all", Band::name);
            let text = RichText::new(name);
            ui.horizontal(|ui| {
                if let Some(band) = band.band {
                    let (rect, _) = ui.allocate_exact_size(vec2(10.0, 10.0), egui::Sense::empty());
                    ui.painter().rect_filled(rect, 2.0, colour(band));
                }
                ui.label(if band.band.is_none() { text.strong() } else { text });
            });
            ui.label(band.directions.to_string());
            figures(ui, &band.spectrum);
            ui.end_row();
        }
    });
    let whole = outcome.report.whole();
    ui.weak(format!(
        "Spectral radiance, eight wavelengths; luminance: median {:.2} %, bias {:+.2} %. Took {:.1} s.",
        whole.luminance.median_pct, whole.luminance.bias_pct, outcome.seconds
    ));
    if Subject::of(scene).as_ref() != Some(&outcome.subject) {
        ui.colored_label(ui.visuals().warn_fg_color, "The scene has changed since.");
    }
}

fn figures(ui: &mut Ui, statistics: &Statistics) {
    let Statistics { median_pct, p95_pct, worst_pct, bias_pct, noise_pct, .. } = *statistics;
    for value in [median_pct, p95_pct, worst_pct] {
        ui.monospace(format!("{value:5.2} %"));
    }
    ui.monospace(format!("{bias_pct:+5.2} %"));
    ui.monospace(format!("{noise_pct:5.2} %"));
}

/// A point for each direction, in the colour of its part of the sky.
fn plot(ui: &mut Ui, outcome: &Outcome) {
    let points = |band: Band| -> PlotPoints<'_> {
        let rows = outcome.report.rows.iter().filter(|row| row.direction.band == band);
        let elevation_deg = |view_zenith: f64| 90.0 - view_zenith.to_degrees();
        rows.map(|row| [elevation_deg(row.direction.view_zenith), row.luminance.error_pct()]).collect()
    };
    quiet(Plot::new("error of each direction"))
        .x_grid_spacer(|input| few(input.bounds))
        .y_grid_spacer(|input| few(input.bounds))
        .y_axis_formatter(|mark, _| short(mark.value))
        .include_y(-1.0)
        .include_y(1.0)
        .x_axis_formatter(|mark, _| format!("{:.0}°", mark.value))
        .label_formatter(|hover| match hover {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                Some(format!("{plot_name}, {:.1}° high\n{:+.2} %", position.x, position.y))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
        .show(ui, |plot| {
            for band in Band::ALL {
                let shown = Points::new(band.name(), points(band)).color(colour(band)).radius(3.0);
                plot.points(shown.shape(MarkerShape::Circle));
            }
        });
}

fn colour(band: Band) -> Color32 {
    match band {
        Band::Zenith => Color32::from_rgb(92, 138, 220),
        Band::Middle => Color32::from_rgb(84, 178, 196),
        Band::Horizon => Color32::from_rgb(222, 132, 72),
        Band::Aureole => Color32::from_rgb(226, 188, 66),
        Band::Ground => Color32::from_rgb(150, 118, 92),
    }
}
