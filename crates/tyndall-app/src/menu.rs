//! The menu bar.

use egui::{Button, MenuBar, RichText, ThemePreference, Ui};
use tyndall_scene::presets;

use crate::{
    action::Action,
    app::App,
    layout::{self, Pane},
    modal::Next,
};

/// Shows the bar and carries out what is chosen.
pub(crate) fn show(ui: &mut Ui, app: &mut App) {
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| file(ui, app));
        ui.menu_button("Edit", |ui| {
            entries(ui, app, &[Action::Undo, Action::Redo, Action::Reset]);
            ui.separator();
            entries(ui, app, &[Action::CopyCommand, Action::CopyScene]);
        });
        ui.menu_button("View", |ui| view(ui, app));
        ui.menu_button("Help", |ui| {
            entries(ui, app, &[Action::Help]);
            ui.separator();
            ui.weak(concat!("Tyndall ", env!("CARGO_PKG_VERSION")));
        });
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let document = &app.bench.document;
            let text = RichText::new(document.name());
            let text = if document.is_dirty() { text.strong() } else { text.weak() };
            let path =
                document.path().map_or_else(|| "Not saved as a file yet.".to_owned(), |p| p.display().to_string());
            let label = ui.add(egui::Label::new(text).truncate()).on_hover_text(path);
            if document.is_dirty() {
                let dot = label.rect.left_center() - egui::vec2(9.0, 0.0);
                ui.painter().circle_filled(dot, 3.5, ui.visuals().warn_fg_color);
            }
        });
    });
}

fn file(ui: &mut Ui, app: &mut App) {
    entries(ui, app, &[Action::New, Action::Open]);
    ui.menu_button("Open recent", |ui| {
        if app.recent.paths().is_empty() {
            ui.weak("None yet");
        }
        for path in app.recent.paths().to_vec() {
            if ui.button(path.display().to_string()).clicked() {
                app.request(ui.ctx(), Next::Open(path));
            }
        }
    });
    ui.menu_button("Open preset", |ui| {
        for preset in presets() {
            if ui.button(&preset.title).clicked() {
                app.request(ui.ctx(), Next::Preset(preset));
            }
        }
    });
    ui.separator();
    entries(ui, app, &[Action::Save, Action::SaveAs]);
    ui.separator();
    entries(ui, app, &[Action::Render]);
    ui.separator();
    entries(ui, app, &[Action::Quit]);
}

fn view(ui: &mut Ui, app: &mut App) {
    for pane in Pane::ALL {
        if ui.button(pane.title()).clicked() {
            layout::activate(&mut app.panels, pane);
        }
    }
    ui.separator();
    entries(ui, app, &[Action::FullViewport, Action::ResetLayout]);
    ui.separator();
    theme(ui);
    ui.separator();
    egui::gui_zoom::zoom_menu_buttons(ui);
}

fn theme(ui: &mut Ui) {
    let mut chosen = ui.ctx().options(|options| options.theme_preference);
    for (theme, name) in [
        (ThemePreference::System, "Theme of the system"),
        (ThemePreference::Dark, "Dark theme"),
        (ThemePreference::Light, "Light theme"),
    ] {
        ui.radio_value(&mut chosen, theme, name);
    }
    ui.ctx().set_theme(chosen);
}

fn entries(ui: &mut Ui, app: &mut App, actions: &[Action]) {
    for action in actions {
        let keys = action.shortcuts().first().map(|shortcut| ui.ctx().format_shortcut(shortcut));
        let button = Button::new(action.label()).shortcut_text(keys.unwrap_or_default());
        if ui.add_enabled(app.is_possible(*action), button).clicked() {
            app.perform(ui.ctx(), *action);
        }
    }
}
