//! Questions and messages that stand before everything else.

use std::path::PathBuf;

use egui::{Context, Frame, Grid, Id, Key, Modal, RichText, ScrollArea, TextEdit, Ui};
use tyndall_scene::Preset;

use crate::{
    action::Action,
    file_dialog::{FileDialogs, Purpose},
    panels::row::rename,
    recent::Recent,
    recovery::Leftover,
};

/// Widest a message gets.
const WIDTH_PT: f32 = 560.0;

/// Highest the help gets before it scrolls.
const HELP_PT: f32 = 620.0;

/// Room around a message.
const MARGIN_PT: i8 = 18;

/// What replaces the document once the user agrees to lose its changes.
#[derive(Clone, Debug)]
pub(crate) enum Next {
    New,
    Open(PathBuf),
    Preset(Preset),
    Quit,
}

/// A question or message.
#[derive(Debug)]
pub(crate) enum Question {
    /// Something went wrong; title and report.
    Error { title: String, report: String },
    /// Changes would be lost.
    Unsaved { name: String, next: Next },
    /// Which scene to open.
    Open { path: String, fresh: bool },
    /// Where to save; what comes after.
    SaveAs { path: String, fresh: bool, next: Option<Next> },
    /// A crash has left a scene.
    Recover(Leftover),
    /// Keys and mouse.
    Help,
}

/// What the user decided.
#[derive(Debug)]
pub(crate) enum Answer {
    /// Nothing but closing.
    Close,
    /// Save first, then go on.
    SaveThen(Next),
    /// Lose the changes and go on.
    Discard(Next),
    /// Open this file.
    Open(PathBuf),
    /// Save to this file, then go on.
    Save(PathBuf, Option<Next>),
    /// Take the scene that a crash left.
    Recover(Leftover),
    /// Remove it.
    Forget(Leftover),
}

/// Shows a question until it is answered: either the question again, or the answer.
pub(crate) fn show(
    ctx: &Context,
    question: Question,
    recent: &Recent,
    dialogs: &FileDialogs,
) -> Result<Answer, Question> {
    let frame = Frame::popup(&ctx.global_style()).inner_margin(MARGIN_PT);
    let modal = Modal::new(Id::unique("question")).frame(frame).show(ctx, |ui| {
        ui.set_max_width(WIDTH_PT);
        ui.spacing_mut().item_spacing.y = 8.0;
        contents(ui, question, recent, dialogs)
    });
    let closed = modal.should_close();
    match modal.inner {
        // Answering a recovery takes more than a click beside it.
        Err(question) if closed && !matches!(question, Question::Recover(_)) => Ok(Answer::Close),
        other => other,
    }
}

fn contents(ui: &mut Ui, question: Question, recent: &Recent, dialogs: &FileDialogs) -> Result<Answer, Question> {
    match question {
        Question::Error { title, report } => error(ui, title, report),
        Question::Unsaved { name, next } => unsaved(ui, name, next),
        Question::Open { path, fresh } => open(ui, path, fresh, recent, dialogs),
        Question::SaveAs { path, fresh, next } => save_as(ui, path, fresh, next, dialogs),
        Question::Recover(leftover) => recover(ui, leftover),
        Question::Help => help(ui),
    }
}

fn error(ui: &mut Ui, title: String, report: String) -> Result<Answer, Question> {
    ui.heading(&title);
    // A sentence, then an excerpt of the file whose columns must stay in line.
    let (sentence, excerpt) = report.trim_end().split_once('\n').unwrap_or((report.trim_end(), ""));
    ui.label(sentence.trim_start_matches("error: "));
    if !excerpt.is_empty() {
        ScrollArea::both().max_height(300.0).show(ui, |ui| {
            ui.add(egui::Label::new(RichText::new(excerpt).monospace()).extend());
        });
    }
    let copy = |ui: &mut Ui| {
        let close = ui.button("Close").clicked();
        if ui.button("Copy").clicked() {
            ui.ctx().copy_text(report.clone());
        }
        close
    };
    if ui.horizontal(copy).inner { Ok(Answer::Close) } else { Err(Question::Error { title, report }) }
}

fn unsaved(ui: &mut Ui, name: String, next: Next) -> Result<Answer, Question> {
    ui.heading("Save the changes?");
    ui.label(format!("{name} has changes that are not saved."));
    let (save, discard, cancel) = ui
        .horizontal(|ui| {
            let save = ui.button("Save").clicked();
            let discard = ui.button("Discard").clicked();
            (save, discard, ui.button("Cancel").clicked())
        })
        .inner;
    match (save, discard, cancel) {
        (true, ..) => Ok(Answer::SaveThen(next)),
        (_, true, _) => Ok(Answer::Discard(next)),
        (.., true) => Ok(Answer::Close),
        _ => Err(Question::Unsaved { name, next }),
    }
}

fn open(
    ui: &mut Ui,
    mut path: String,
    fresh: bool,
    recent: &Recent,
    dialogs: &FileDialogs,
) -> Result<Answer, Question> {
    ui.heading("Open scene");
    let entered = path_field(ui, &mut path, fresh);
    let mut chosen = entered.then(|| PathBuf::from(path.trim()));
    if !recent.paths().is_empty() {
        ui.weak("Recent");
        for known in recent.paths() {
            if ui.selectable_label(false, known.display().to_string()).clicked() {
                chosen = Some(known.clone());
            }
        }
    }
    let cancelled = ui
        .horizontal(|ui| {
            if ui.button("Open").clicked() {
                chosen = Some(PathBuf::from(path.trim()));
            }
            if ui.button("Browse...").clicked() {
                dialogs.start(ui.ctx(), Purpose::OpenScene, path.as_ref());
            }
            ui.button("Cancel").clicked()
        })
        .inner;
    match chosen.filter(|path| !path.as_os_str().is_empty()) {
        _ if cancelled => Ok(Answer::Close),
        Some(path) => Ok(Answer::Open(path)),
        None => Err(Question::Open { path, fresh: false }),
    }
}

fn save_as(
    ui: &mut Ui,
    mut path: String,
    fresh: bool,
    next: Option<Next>,
    dialogs: &FileDialogs,
) -> Result<Answer, Question> {
    ui.heading("Save scene");
    let mut save = path_field(ui, &mut path, fresh);
    let file = PathBuf::from(path.trim());
    if file.is_file() {
        ui.colored_label(ui.visuals().warn_fg_color, "This file exists and will be replaced.");
    }
    let cancelled = ui
        .horizontal(|ui| {
            save |= ui.button("Save").clicked();
            if ui.button("Browse...").clicked() {
                dialogs.start(ui.ctx(), Purpose::SaveScene, path.as_ref());
            }
            ui.button("Cancel").clicked()
        })
        .inner;
    if cancelled {
        Ok(Answer::Close)
    } else if save && !file.as_os_str().is_empty() {
        Ok(Answer::Save(file, next))
    } else {
        Err(Question::SaveAs { path, fresh: false, next })
    }
}

/// The field that a keyboard and a system without file dialogs need; whether Enter was pressed in it.
fn path_field(ui: &mut Ui, path: &mut String, fresh: bool) -> bool {
    let field = ui.add(TextEdit::singleline(path).hint_text("Path of the file").desired_width(WIDTH_PT));
    rename(ui, &field, "Path of the file");
    if fresh {
        field.request_focus();
    }
    field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter))
}

fn recover(ui: &mut Ui, leftover: Leftover) -> Result<Answer, Question> {
    ui.heading("Recover unsaved changes?");
    let of = leftover.path.as_ref().map_or_else(|| "a new scene".to_owned(), |path| path.display().to_string());
    ui.label(format!("Tyndall ended unexpectedly with unsaved changes to {of}."));
    let (recover, forget) = ui.horizontal(|ui| (ui.button("Recover").clicked(), ui.button("Discard").clicked())).inner;
    match (recover, forget) {
        (true, _) => Ok(Answer::Recover(leftover)),
        (_, true) => Ok(Answer::Forget(leftover)),
        _ => Err(Question::Recover(leftover)),
    }
}

/// What the mouse does, and keys that are no commands.
const GESTURES: [(&str, &str); 9] = [
    ("Drag", "look around, or orbit (see Camera)"),
    ("Middle drag", "orbit"),
    ("Right drag", "look around while flying"),
    ("Wheel", "field of view"),
    ("W A S D, Q E", "fly, down and up; Shift is faster"),
    ("Arrows", "turn, when the view has the focus"),
    ("Tab, Shift+Tab", "next and previous input"),
    ("Double click on a name", "back to the default"),
    ("Ctrl + and -, Ctrl 0", "size of the interface"),
];

fn help(ui: &mut Ui) -> Result<Answer, Question> {
    ui.heading("Keyboard and mouse");
    ScrollArea::vertical().max_height(HELP_PT).show(ui, |ui| {
        Grid::new("shortcuts").num_columns(2).spacing([24.0, 4.0]).show(ui, |ui| {
            for action in Action::ALL.iter().filter(|action| !action.shortcuts().is_empty()) {
                let keys: Vec<_> =
                    action.shortcuts().iter().map(|shortcut| ui.ctx().format_shortcut(shortcut)).collect();
                ui.strong(keys.join(", "));
                ui.label(action.label());
                ui.end_row();
            }
            for (gesture, effect) in GESTURES {
                ui.strong(gesture);
                ui.label(effect);
                ui.end_row();
            }
        });
    });
    if ui.button("Close").clicked() { Ok(Answer::Close) } else { Err(Question::Help) }
}
