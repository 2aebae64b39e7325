//! The error meter of clouds: how far their picture is from random walks, beside the bounds that it is built for.

use egui::{Grid, ProgressBar, Ui};
use tyndall_gpu::Gpu;
use tyndall_render::clouds::comparison::CloudVerdict;
use tyndall_render::clouds::reference::CloudAccuracy;
use tyndall_scene::Scene;

use crate::cloud_meter::{self, CloudMeter, CloudSubject};
use crate::error_meter::Thoroughness;

/// Shows a row of controls, and what came of the last comparison; nothing for a scene without clouds.
pub(crate) fn show(
    ui: &mut Ui,
    meter: &mut CloudMeter,
    (gpu, thoroughness): (Option<&Gpu>, Thoroughness),
    scene: &Scene,
) {
    let (Some(subject), Some(gpu)) = (CloudSubject::of(scene), gpu) else { return };
    let is_of_scene = meter.outcome().is_none_or(|outcome| outcome.subject == subject);
    ui.horizontal_wrapped(|ui| {
        if let Some(done) = meter.progress() {
            ui.add(ProgressBar::new(done).desired_width(220.0).show_percentage());
            if ui.button("Stop").clicked() {
                meter.cancel();
            }
            return;
        }
        let hint = "Draws the clouds from the scene's camera in sunlight alone, without turbulence and repetition, and \
                    follows light through the same cells at random.";
        if ui.button("Compare clouds").on_hover_text(hint).clicked() {
            let ctx = ui.ctx().clone();
            let drawn = (gpu.adapter().into(), subject);
            cloud_meter::start(meter, drawn, thoroughness, move || ctx.request_repaint());
        }
    });
    if let Some(error) = meter.error() {
        ui.colored_label(ui.visuals().error_fg_color, error);
    }
    let Some(outcome) = meter.outcome() else { return };
    match &outcome.report {
        CloudVerdict::Judged(accuracy) => figures(ui, accuracy, outcome.seconds),
        CloudVerdict::NoSunlight => drop(ui.weak("The sun gives no light to judge clouds in.")),
        CloudVerdict::OutOfView => drop(ui.weak("No cloud in sunlight is in the camera's view.")),
        CloudVerdict::NoClouds | CloudVerdict::Stopped => {}
    }
    if !is_of_scene {
        ui.colored_label(ui.visuals().warn_fg_color, "The clouds have changed since.");
    }
}

fn figures(ui: &mut Ui, accuracy: &CloudAccuracy, seconds: f64) {
    let rows = [
        ("Clouds: mean over that of the walks", format!("{:.3}", accuracy.mean_ratio)),
        ("PSNR", format!("{:.1} dB", accuracy.psnr_db)),
        ("FLIP", format!("{:.4}", accuracy.flip)),
        ("Relative square error", format!("{:.4}", accuracy.relative_square)),
        ("Correlation", format!("{:.3}", accuracy.correlation)),
        ("Noise of the walks' mean", format!("{:.2} %", 100.0 * accuracy.noise)),
    ];
    Grid::new("figures of clouds").num_columns(4).spacing([14.0, 2.0]).show(ui, |ui| {
        for pair in rows.chunks(2) {
            for (caption, text) in pair {
                ui.weak(*caption);
                ui.label(text);
            }
            ui.end_row();
        }
    });
    ui.weak(format!(
        "Means of 4 x 4 pixels; PSNR and FLIP of single pixels, with the noise of the walks in them. Took {seconds:.1} s."
    ));
}
