//! The row of a parameter that is text: label, a line to edit, and a button that brings the default back.

use egui::{Label, RichText, Sense, TextEdit, Ui, vec2};
use tyndall_core::{ParamSet, TextInfo};

use super::row;

/// Shows text `index` of a group; `no_effect` says why it changes nothing at present.
pub(crate) fn show(ui: &mut Ui, group: &str, set: &mut dyn ParamSet, index: usize, no_effect: Option<&str>) {
    let info = &set.text_info()[index];
    let mut text = set.text(index).to_owned();
    let name = format!("{group}: {}", info.label());
    let row = |ui: &mut Ui| {
        ui.add_enabled_ui(no_effect.is_none(), |ui| {
            let width = row::LABEL_PT.clamp(ui.available_width() * row::LABEL_SHARE);
            let size = vec2(width, ui.spacing().interact_size.y);
            let label = Label::new(RichText::new(info.label())).truncate().selectable(false).sense(Sense::CLICK);
            let label = ui.add_sized(size, label);
            if label.on_hover_ui(|ui| tooltip(ui, group, info, no_effect)).double_clicked() {
                info.default.clone_into(&mut text);
            }
            let edit = TextEdit::singleline(&mut text).desired_width(ui.available_width()).hint_text("none");
            let edit = ui.add(edit);
            row::rename(ui, &edit, &name);
            edit.on_hover_ui(|ui| tooltip(ui, group, info, no_effect));
        });
    };
    ui.push_id((group, info.name), |ui| ui.horizontal(row));
    if text != set.text(index)
        && let Ok(text) = info.check(&text)
    {
        set.put_text_unchecked(index, text);
    }
}

fn tooltip(ui: &mut Ui, group: &str, info: &TextInfo, no_effect: Option<&str>) {
    ui.set_max_width(ui.spacing().tooltip_width);
    if let Some(reason) = no_effect {
        ui.colored_label(ui.visuals().warn_fg_color, format!("No effect at present. {reason}"));
    }
    ui.strong(info.label());
    ui.label(info.doc);
    ui.label(format!("Source: {}", info.source));
    ui.monospace(format!("{group}.{}", info.name));
}
