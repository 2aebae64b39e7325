//! Everything that the menus, the keyboard and the help list offer, declared once.

use egui::{Key, KeyboardShortcut, Modifiers};

/// A command of the user.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
    New,
    Open,
    Save,
    SaveAs,
    Quit,
    Undo,
    Redo,
    Reset,
    CopyCommand,
    CopyScene,
    Render,
    FullViewport,
    ResetLayout,
    Help,
}

const fn command(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const fn command_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}

const fn plain(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

impl Action {
    /// All, in the order of the help.
    pub(crate) const ALL: &'static [Self] = &[
        Self::New,
        Self::Open,
        Self::Save,
        Self::SaveAs,
        Self::Render,
        Self::Quit,
        Self::Undo,
        Self::Redo,
        Self::Reset,
        Self::CopyCommand,
        Self::CopyScene,
        Self::FullViewport,
        Self::ResetLayout,
        Self::Help,
    ];

    /// Text of the menu entry.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::New => "New",
            Self::Open => "Open...",
            Self::Save => "Save",
            Self::SaveAs => "Save as...",
            Self::Quit => "Quit",
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::Reset => "Reset all parameters",
            Self::CopyCommand => "Copy as command line",
            Self::CopyScene => "Copy as scene file",
            Self::Render => "Render to file",
            Self::FullViewport => "Full viewport",
            Self::ResetLayout => "Reset panels",
            Self::Help => "Keyboard and mouse",
        }
    }

    /// Keys that give the command, the usual ones first.
    pub(crate) fn shortcuts(self) -> &'static [KeyboardShortcut] {
        const NEW: [KeyboardShortcut; 1] = [command(Key::N)];
        const OPEN: [KeyboardShortcut; 1] = [command(Key::O)];
        const SAVE: [KeyboardShortcut; 1] = [command(Key::S)];
        const SAVE_AS: [KeyboardShortcut; 1] = [command_shift(Key::S)];
        const QUIT: [KeyboardShortcut; 1] = [command(Key::Q)];
        const UNDO: [KeyboardShortcut; 1] = [command(Key::Z)];
        const REDO: [KeyboardShortcut; 2] = [command_shift(Key::Z), command(Key::Y)];
        const RESET: [KeyboardShortcut; 1] = [command(Key::R)];
        const RENDER: [KeyboardShortcut; 1] = [command(Key::Enter)];
        const FULL: [KeyboardShortcut; 1] = [plain(Key::F11)];
        const HELP: [KeyboardShortcut; 1] = [plain(Key::F1)];
        match self {
            Self::New => &NEW,
            Self::Open => &OPEN,
            Self::Save => &SAVE,
            Self::SaveAs => &SAVE_AS,
            Self::Quit => &QUIT,
            Self::Undo => &UNDO,
            Self::Redo => &REDO,
            Self::Reset => &RESET,
            Self::Render => &RENDER,
            Self::FullViewport => &FULL,
            Self::Help => &HELP,
            Self::CopyCommand | Self::CopyScene | Self::ResetLayout => &[],
        }
    }
}

/// The commands whose keys were pressed since the last frame. Those with Shift are asked first: a shortcut with Ctrl alone
/// would take the one with Ctrl and Shift too.
pub(crate) fn pressed(ctx: &egui::Context) -> Vec<Action> {
    let mut all: Vec<_> =
        Action::ALL.iter().flat_map(|action| action.shortcuts().iter().map(|s| (*action, s))).collect();
    all.sort_by_key(|(_, shortcut)| !shortcut.modifiers.shift);
    all.retain(|(_, shortcut)| ctx.input_mut(|input| input.consume_shortcut(shortcut)));
    all.into_iter().map(|(action, _)| action).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_commands_share_a_key_or_a_name() {
        let mut keys: Vec<_> = Action::ALL.iter().flat_map(|action| action.shortcuts()).collect();
        let count = keys.len();
        keys.sort_by_key(|shortcut| format!("{shortcut:?}"));
        keys.dedup();
        assert_eq!(keys.len(), count, "{keys:?}");
        let labels: std::collections::HashSet<_> = Action::ALL.iter().map(|action| action.label()).collect();
        assert_eq!(labels.len(), Action::ALL.len(), "{labels:?}");
    }

    #[test]
    fn a_key_with_two_modifiers_is_not_taken_for_one_with_one() {
        let ctx = egui::Context::default();
        let modifiers = Modifiers::COMMAND | Modifiers::SHIFT;
        let event = egui::Event::Key { key: Key::Z, physical_key: None, pressed: true, repeat: false, modifiers };
        let mut found = Vec::new();
        let input = egui::RawInput { events: vec![event], ..egui::RawInput::default() };
        let mut output = ctx.run_ui(input, |ui| found.extend(pressed(ui.ctx())));
        output.textures_delta.clear();
        assert_eq!(found, [Action::Redo], "Ctrl+Shift+Z");
    }
}
