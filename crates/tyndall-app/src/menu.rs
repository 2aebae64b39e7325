//! The menu bar.

use egui::{Button, MenuBar, RichText, ThemePreference, Ui};
use tyndall_scene::presets;

use crate::{action::Action, document::Document, layout::Pane, modal::Next, recent::Recent};

/// What the bar shows.
pub(crate) struct MenuState<'a> {
    /// The scene being edited.
    pub(crate) document: &'a Document,
    /// Files used lately.
    pub(crate) recent: &'a Recent,
}

/// What was chosen in the bar.
#[derive(Clone, Debug)]
pub(crate) enum Choice {
    /// A command.
    Act(Action),
    /// Another document.
    Request(Next),
    /// A panel to be shown.
    Activate(Pane),
}

impl MenuState<'_> {
    /// Whether a command would do anything now.
    fn is_possible(&self, action: Action) -> bool {
        match action {
            Action::Undo => self.document.has_undo(),
            Action::Redo => self.document.has_redo(),
            _ => true,
        }
    }
}

/// Shows the bar.
pub(crate) fn show(ui: &mut Ui, state: &MenuState<'_>) -> Option<Choice> {
    MenuBar::new().ui(ui, |ui| bar(ui, state)).inner
}

fn bar(ui: &mut Ui, state: &MenuState<'_>) -> Option<Choice> {
    let mut chosen = ui.menu_button("File", |ui| file(ui, state)).inner.flatten();
    let edit = |ui: &mut Ui| {
        let first = entries(ui, state, &[Action::Undo, Action::Redo, Action::Reset]);
        ui.separator();
        first.or(entries(ui, state, &[Action::CopyCommand, Action::CopyScene]))
    };
    chosen = chosen.or(ui.menu_button("Edit", edit).inner.flatten());
    chosen = chosen.or(ui.menu_button("View", |ui| view(ui, state)).inner.flatten());
    let help = |ui: &mut Ui| {
        let chosen = entries(ui, state, &[Action::Help]);
        ui.separator();
        ui.weak(concat!("Tyndall ", env!("CARGO_PKG_VERSION")));
        chosen
    };
    chosen = chosen.or(ui.menu_button("Help", help).inner.flatten());
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| name(ui, state.document));
    chosen
}

/// The document's name at the right end, with a dot while it has unsaved changes.
fn name(ui: &mut Ui, document: &Document) {
    let text = RichText::new(document.name());
    let text = if document.is_dirty() { text.strong() } else { text.weak() };
    let path = document.path().map_or_else(|| "Not saved as a file yet.".to_owned(), |p| p.display().to_string());
    let label = ui.add(egui::Label::new(text).truncate()).on_hover_text(path);
    if document.is_dirty() {
        let dot = label.rect.left_center() - egui::vec2(9.0, 0.0);
        ui.painter().circle_filled(dot, 3.5, ui.visuals().warn_fg_color);
    }
}

fn file(ui: &mut Ui, state: &MenuState<'_>) -> Option<Choice> {
    let mut chosen = entries(ui, state, &[Action::New, Action::Open]);
    ui.menu_button("Open recent", |ui| {
        if state.recent.paths().is_empty() {
            ui.weak("None yet");
        }
        for path in state.recent.paths() {
            if ui.button(path.display().to_string()).clicked() {
                chosen = Some(Choice::Request(Next::Open(path.clone())));
            }
        }
    });
    ui.menu_button("Open preset", |ui| {
        for preset in presets() {
            if ui.button(&preset.title).clicked() {
                chosen = Some(Choice::Request(Next::Preset(preset)));
            }
        }
    });
    for group in [&[Action::Save, Action::SaveAs][..], &[Action::Render], &[Action::Quit]] {
        ui.separator();
        chosen = chosen.or(entries(ui, state, group));
    }
    chosen
}

fn view(ui: &mut Ui, state: &MenuState<'_>) -> Option<Choice> {
    let mut chosen = None;
    for pane in Pane::ALL {
        if ui.button(pane.title()).clicked() {
            chosen = Some(Choice::Activate(pane));
        }
    }
    ui.separator();
    chosen = chosen.or(entries(ui, state, &[Action::FullViewport, Action::ResetLayout]));
    ui.separator();
    theme(ui);
    ui.separator();
    egui::gui_zoom::zoom_menu_buttons(ui);
    chosen
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

fn entries(ui: &mut Ui, state: &MenuState<'_>, actions: &[Action]) -> Option<Choice> {
    let mut chosen = None;
    for action in actions {
        let keys = action.shortcuts().first().map(|shortcut| ui.ctx().format_shortcut(shortcut));
        let button = Button::new(action.label()).shortcut_text(keys.unwrap_or_default());
        if ui.add_enabled(state.is_possible(*action), button).clicked() {
            chosen = Some(Choice::Act(*action));
        }
    }
    chosen
}
