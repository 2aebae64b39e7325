//! What the commands and the answers do.

use std::path::{Path, PathBuf};

use egui::{Context, ViewportCommand};
use tyndall_scene::SceneError;

use crate::{
    action::Action,
    app::App,
    document::Document,
    engine::Problem,
    file_dialog::Purpose,
    layout::{self, Pane},
    menu::Choice,
    modal::{Answer, Next, Question},
    panels::export::Exports,
};

impl App {
    /// Carries a command out.
    pub(crate) fn perform(&mut self, ctx: &Context, action: Action) {
        match action {
            Action::New => self.request(ctx, Next::New),
            Action::Open => self.questions.push_back(Question::Open { path: String::new(), fresh: true }),
            Action::Save => self.save_then(ctx, None),
            Action::SaveAs => self.ask_where(None),
            Action::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Action::Undo => self.bench.document.undo(),
            Action::Redo => self.bench.document.redo(),
            Action::Reset => self.bench.document.reset(),
            Action::CopyCommand => ctx.copy_text(Exports::command_line(&self.bench.document, &self.bench.export)),
            Action::CopyScene => ctx.copy_text(self.bench.document.to_text()),
            Action::Render => {
                layout::activate(&mut self.panels, Pane::Export);
                self.bench.exports.start(ctx, &self.bench.document, &self.bench.export);
            }
            Action::FullViewport => {
                self.full_viewport = !self.full_viewport;
                ctx.send_viewport_cmd(ViewportCommand::Fullscreen(self.full_viewport));
            }
            Action::ResetLayout => self.panels = layout::default_tree(),
            Action::Help => self.questions.push_back(Question::Help),
        }
        ctx.request_repaint();
    }

    /// Does what was chosen in the menu.
    pub(crate) fn follow(&mut self, ctx: &Context, choice: Choice) {
        match choice {
            Choice::Act(action) => self.perform(ctx, action),
            Choice::Request(next) => self.request(ctx, next),
            Choice::Activate(pane) => layout::activate(&mut self.panels, pane),
        }
    }

    /// Makes the renderer anew. A lost device takes the window's own graphics along, which only a new start brings back.
    pub(crate) fn rebuild(&mut self, problem: &Problem) {
        let Some(stage) = &mut self.bench.stage else { return };
        if !problem.lost {
            stage.rebuild();
            self.bench.gallery.forget();
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

    /// Replaces the document, after asking when changes would be lost.
    pub(crate) fn request(&mut self, ctx: &Context, next: Next) {
        if self.bench.document.is_dirty() {
            self.questions.push_back(Question::Unsaved { name: self.bench.document.name(), next });
        } else {
            self.proceed(ctx, next);
        }
    }

    /// Opens a scene file; the document stays when that fails.
    pub(crate) fn open(&mut self, path: &Path) {
        match Document::open(path) {
            Ok(document) => {
                self.recent.add(path);
                self.bench.replace_document(document);
                tracing::info!(path = %path.display(), "scene opened");
            }
            Err(error) => {
                self.recent.remove(path);
                self.report("The scene cannot be opened", &error);
            }
        }
    }

    /// The window is asked to close.
    pub(crate) fn close_requested(&mut self, ctx: &Context) {
        if self.closing || !self.bench.document.is_dirty() {
            return;
        }
        let stage = self.bench.stage.as_ref();
        if stage.and_then(|stage| stage.problem()).is_some_and(|problem| problem.lost) {
            // The window can no longer ask; the next start will.
            self.keep_for_recovery();
            self.session.iter_mut().for_each(crate::recovery::Session::leave);
            return;
        }
        ctx.send_viewport_cmd(ViewportCommand::CancelClose);
        if !self.questions.iter().any(|question| matches!(question, Question::Unsaved { next: Next::Quit, .. })) {
            self.request(ctx, Next::Quit);
        }
    }

    /// A file chosen in one of the system's dialogs.
    pub(crate) fn take_file(&mut self, ctx: &Context, purpose: Purpose, file: PathBuf) {
        match (purpose, self.questions.front_mut()) {
            (Purpose::OpenScene, Some(Question::Open { .. })) => {
                self.questions.pop_front();
                self.request(ctx, Next::Open(file));
            }
            (Purpose::SaveScene, Some(Question::SaveAs { path, .. })) => *path = file.display().to_string(),
            (Purpose::Export(kind), _) => {
                self.bench.export.kind = kind;
                *self.bench.export.path_mut() = file.display().to_string();
            }
            // The question was closed while the dialog was open.
            _ => {}
        }
    }

    /// Does what the user decided.
    pub(crate) fn answer(&mut self, ctx: &Context, answer: Answer) {
        match answer {
            Answer::Close => {}
            Answer::SaveThen(next) => self.save_then(ctx, Some(next)),
            Answer::Discard(next) => self.proceed(ctx, next),
            Answer::Open(path) => self.request(ctx, Next::Open(path)),
            Answer::Save(path, next) => self.save_as(ctx, &path, next),
            Answer::Recover(leftover) => match Document::recovered(&leftover.text, leftover.path.clone()) {
                Ok(document) => {
                    self.bench.replace_document(document);
                    // Under this program's name first: a crash in between must not lose it.
                    self.keep_for_recovery();
                    leftover.remove();
                }
                Err(error) => self.report("The scene cannot be recovered", &error),
            },
            Answer::Forget(leftover) => leftover.remove(),
        }
    }

    fn proceed(&mut self, ctx: &Context, next: Next) {
        match next {
            Next::New => self.bench.replace_document(Document::new()),
            Next::Open(path) => self.open(&path),
            Next::Preset(preset) => match Document::from_preset(&preset) {
                Ok(document) => self.bench.replace_document(document),
                Err(error) => self.report("The preset cannot be opened", &error),
            },
            Next::Quit => {
                self.closing = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    fn save_then(&mut self, ctx: &Context, next: Option<Next>) {
        match self.bench.document.path().map(Path::to_owned) {
            Some(path) => self.save_as(ctx, &path, next),
            None => self.ask_where(next),
        }
    }

    fn ask_where(&mut self, next: Option<Next>) {
        let document = &self.bench.document;
        let named = document.path().map(Path::to_owned);
        let path = named.unwrap_or_else(|| PathBuf::from(format!("{}.toml", document.file_stem())));
        let path = std::path::absolute(&path).unwrap_or(path).display().to_string();
        self.questions.push_back(Question::SaveAs { path, fresh: true, next });
    }

    fn save_as(&mut self, ctx: &Context, path: &Path, next: Option<Next>) {
        match self.bench.document.save_as(path) {
            Ok(()) => {
                tracing::info!(path = %path.display(), "scene saved");
                self.recent.add(path);
                if let Some(next) = next {
                    self.proceed(ctx, next);
                }
            }
            Err(error) => self.report("The scene cannot be saved", &error),
        }
    }

    fn report(&mut self, title: &str, error: &SceneError) {
        tracing::error!(%error, "{title}");
        self.questions.push_back(Question::Error { title: title.to_owned(), report: error.report() });
    }
}
