//! A line above the panels while the picture is not that of the scene.

use egui::{Panel, Ui};

use crate::engine::Problem;

/// Text of the button.
const REBUILD: &str = "Rebuild";

/// Shows the line; whether the renderer is to be made anew.
pub(crate) fn show(ui: &mut Ui, problem: &Problem) -> bool {
    Panel::top("banner").show(ui, |ui| contents(ui, problem)).inner
}

/// Whether the renderer is to be rebuilt.
fn contents(ui: &mut Ui, problem: &Problem) -> bool {
    ui.add_space(4.0);
    let inner = ui.horizontal_wrapped(|ui| {
        if !problem.rebuild {
            ui.colored_label(ui.visuals().warn_fg_color, format!("Not drawn: {}", problem.text));
            return false;
        }
        ui.colored_label(ui.visuals().error_fg_color, format!("No picture: {}", problem.text));
        ui.label("The scene is kept.");
        ui.button(REBUILD).on_hover_text("Makes everything on the GPU anew.").clicked()
    });
    ui.add_space(4.0);
    inner.inner
}
