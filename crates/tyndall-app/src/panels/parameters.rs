//! The parameters panel: all groups but those with panels of their own, and a search field.

use egui::{Key, ScrollArea, TextEdit, Ui};
use tyndall_scene::Scene;

use super::{SCROLL_MARGIN, group, row};

/// Shows the panel; `filter` is the text of the search field.
pub(crate) fn show(ui: &mut Ui, scene: &mut Scene, filter: &mut String) {
    let search = ui.add(TextEdit::singleline(filter).hint_text("Search parameters").desired_width(f32::INFINITY));
    row::rename(ui, &search, "Search parameters");
    if search.has_focus() && ui.input(|input| input.key_pressed(Key::Escape)) {
        filter.clear();
    }
    ui.add_space(4.0);
    ScrollArea::vertical().auto_shrink(false).content_margin(SCROLL_MARGIN).show(ui, |ui| {
        let names: Vec<_> = group::names(scene).filter(|name| ![group::CAMERA, group::IMAGE].contains(name)).collect();
        for name in names {
            group::show(ui, scene, name, filter);
        }
    });
}
