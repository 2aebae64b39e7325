//! Figures with their names.

use egui::{Grid, Ui};

/// Figures in two columns.
pub(super) fn table(ui: &mut Ui, name: &str, rows: &[(&str, String)]) {
    Grid::new(name).num_columns(2).spacing([10.0, 2.0]).show(ui, |ui| {
        for (caption, text) in rows {
            ui.weak(*caption);
            ui.label(text);
            ui.end_row();
        }
    });
}
