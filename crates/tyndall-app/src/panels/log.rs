//! The log panel.

use egui::{Color32, ComboBox, RichText, ScrollArea, TextStyle, Ui};
use tracing::Level;

use super::row::rename;
use crate::logging::LogBuffer;

const LEVELS: [Level; 4] = [Level::ERROR, Level::WARN, Level::INFO, Level::DEBUG];

/// Shows the panel; `level` is the least serious level shown.
pub(crate) fn show(ui: &mut Ui, log: &LogBuffer, level: &mut Level) {
    let entries = log.entries(*level);
    ui.horizontal(|ui| {
        let combo = ComboBox::from_id_salt("log level").selected_text(name(*level)).show_ui(ui, |ui| {
            for choice in LEVELS {
                ui.selectable_value(level, choice, name(choice));
            }
        });
        rename(ui, &combo.response, "Log level");
        if ui.button("Copy").on_hover_text("Copies the lines shown.").clicked() {
            let lines: Vec<_> = entries.iter().map(ToString::to_string).collect();
            ui.ctx().copy_text(lines.join("\n"));
        }
        if ui.button("Clear").clicked() {
            log.clear();
        }
    });
    if entries.is_empty() {
        ui.weak("Nothing to report.");
        return;
    }
    let height = ui.text_style_height(&TextStyle::Monospace);
    ScrollArea::both().auto_shrink(false).stick_to_bottom(true).show_rows(ui, height, entries.len(), |ui, rows| {
        for entry in &entries[rows] {
            let text = RichText::new(entry.to_string().replace('\n', " ")).monospace();
            ui.add(egui::Label::new(text.color(colour(ui, entry.level))).extend());
        }
    });
}

fn colour(ui: &Ui, level: Level) -> Color32 {
    match level {
        Level::ERROR => ui.visuals().error_fg_color,
        Level::WARN => ui.visuals().warn_fg_color,
        Level::INFO => ui.visuals().text_color(),
        _ => ui.visuals().weak_text_color(),
    }
}

fn name(level: Level) -> &'static str {
    match level {
        Level::ERROR => "Errors",
        Level::WARN => "Warnings",
        Level::INFO => "Messages",
        _ => "Everything",
    }
}
