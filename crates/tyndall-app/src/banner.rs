//! A line above the panels while the picture is not that of the scene.

use egui::{Panel, Ui};

use crate::{app::App, engine::Problem};

/// Text of the button.
const REBUILD: &str = "Rebuild";

/// Shows the line when there is a problem.
pub(crate) fn show(ui: &mut Ui, app: &mut App) {
    let Some(problem) = app.bench.stage.as_ref().and_then(|stage| stage.problem()).cloned() else { return };
    let rebuild = Panel::top("banner").show(ui, |ui| contents(ui, &problem)).inner;
    if rebuild {
        app.rebuild(&problem);
    }
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

impl App {
    /// Makes the renderer anew. A lost device takes the window's own graphics along, which only a new start brings back.
    fn rebuild(&mut self, problem: &Problem) {
        let Some(stage) = &mut self.bench.stage else { return };
        if !problem.lost {
            stage.rebuild();
            self.bench.gallery.forget(stage);
            return;
        }
        self.keep_for_recovery();
        let kept = match self.session.as_mut() {
            Some(session) if session.scene_path().exists() => {
                session.leave();
                format!("Unsaved changes are in {} and will be offered.", session.scene_path().display())
            }
            _ => "Save the scene first.".to_owned(),
        };
        let text = format!("the window's own graphics are lost too. Restart Tyndall. {kept}");
        if let Some(stage) = &mut self.bench.stage {
            stage.report(Problem { text, ..problem.clone() });
        }
    }
}
