//! The camera panel: views, what dragging does, and the camera's parameters.

use egui::{Align, Layout, ScrollArea, Ui, vec2};
use tyndall_scene::Scene;

use super::{SCROLL_MARGIN, group};
use crate::{
    navigation::{DragTool, View},
    viewport::ViewportOptions,
};

/// Width of the words before a line.
const CAPTION_PT: f32 = 64.0;

/// Shows the panel.
pub(crate) fn show(ui: &mut Ui, scene: &mut Scene, options: &mut ViewportOptions) {
    ScrollArea::vertical().auto_shrink(false).content_margin(SCROLL_MARGIN).show(ui, |ui| {
        views(ui, scene, "Heading", &View::HEADINGS);
        views(ui, scene, "Look at", &View::TARGETS);
        ui.horizontal_wrapped(|ui| {
            caption(ui, "Dragging");
            ui.selectable_value(&mut options.tool, DragTool::Look, "turns the view")
                .on_hover_text("Turns the camera where it stands.");
            ui.selectable_value(&mut options.tool, DragTool::Orbit, "orbits")
                .on_hover_text("Moves the camera around what it looks at. The middle button always does.");
        });
        ui.horizontal_wrapped(|ui| {
            caption(ui, "Show");
            ui.checkbox(&mut options.show_figures, "Figures");
            ui.checkbox(&mut options.show_sun, "Sun");
            ui.checkbox(&mut options.show_frame, "Export frame");
        });
        ui.add_space(6.0);
        group::show(ui, scene, group::CAMERA, "");
    });
}

/// A line of buttons.
fn views(ui: &mut Ui, scene: &mut Scene, name: &str, views: &[View]) {
    ui.horizontal_wrapped(|ui| {
        caption(ui, name);
        for view in views {
            if ui.button(view.label()).clicked() {
                view.apply(scene);
            }
        }
    });
}

/// Words before a line, all of the same width.
fn caption(ui: &mut Ui, text: &str) {
    let size = vec2(CAPTION_PT, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_size(size);
        ui.label(text);
    });
}
