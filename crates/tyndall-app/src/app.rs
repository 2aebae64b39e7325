//! The program as the window sees it: one frame after the other.

use std::{collections::VecDeque, fmt, path::PathBuf, time::Duration};

use egui::{CentralPanel, Frame, Key, Modifiers, Panel, Ui, ViewportCommand};
use egui_tiles::Tree;
use tyndall_gpu::AdapterChoice;
use tyndall_scene::Scene;

use crate::{
    action, banner,
    document::Document,
    export_options::ExportOptions,
    layout::{self, Pane},
    logging::LogBuffer,
    menu::{self, MenuState},
    modal::{self, Question},
    recent::Recent,
    recovery::Session,
    stage::Stage,
    theme,
    viewport::ViewportOptions,
    workbench::Workbench,
};

/// Name of what is stored between runs.
const STORAGE_KEY: &str = "tyndall";

/// Time after which a change counts as come to rest; a little longer than the undo history takes.
const REST: Duration = Duration::from_millis(520);

/// What the program starts with.
#[derive(Clone, Debug, Default)]
pub struct AppOptions {
    /// Scene to open.
    pub scene: Option<PathBuf>,
    /// Folder for what survives a crash; nothing survives without one.
    pub data_dir: Option<PathBuf>,
    /// The log that the log panel shows.
    pub log: LogBuffer,
    /// Adapter that [`crate::run`] takes.
    pub adapter: AdapterChoice,
}

/// What is remembered between runs, besides what egui remembers itself.
#[derive(Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
struct Memory {
    recent: Recent,
    viewport: ViewportOptions,
    export: ExportOptions,
    panels: Option<Tree<Pane>>,
}

/// The desktop program.
pub struct App {
    pub(crate) bench: Workbench,
    pub(crate) panels: Tree<Pane>,
    pub(crate) recent: Recent,
    /// The first one is shown.
    pub(crate) questions: VecDeque<Question>,
    pub(crate) session: Option<Session>,
    pub(crate) full_viewport: bool,
    /// The user has agreed to close.
    pub(crate) closing: bool,
    title: String,
    /// Scene and whether it was unsaved when it was last kept for recovery.
    kept: Option<(Scene, bool)>,
}

impl fmt::Debug for App {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("App").field("document", &self.bench.document).finish_non_exhaustive()
    }
}

impl App {
    /// The program in a new window.
    #[must_use]
    pub fn new(context: &eframe::CreationContext<'_>, options: AppOptions) -> Self {
        theme::install(&context.egui_ctx);
        let stored = context.storage.and_then(|storage| eframe::get_value::<Memory>(storage, STORAGE_KEY));
        let Memory { recent, viewport, export, panels } = stored.unwrap_or_default();
        let stage = context.wgpu_render_state.clone().map(|state| Stage::new(state, &context.egui_ctx));
        let mut app = Self {
            bench: Workbench::new(stage, options.log, viewport, export),
            panels: panels.filter(layout::is_complete).unwrap_or_else(layout::default_tree),
            recent,
            questions: VecDeque::new(),
            session: None,
            full_viewport: false,
            closing: false,
            title: String::new(),
            kept: None,
        };
        app.start_session(options.data_dir);
        match options.scene {
            Some(path) => app.open(&path),
            None => app.start_with_first_preset(),
        }
        app
    }

    /// The scene being edited.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        self.bench.document.scene()
    }

    /// Title of the window.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Width and height of exported pictures in pixels.
    #[must_use]
    pub fn export_size_px(&self) -> [u32; 2] {
        [self.scene().image.width_px, self.scene().image.height_px]
    }

    /// Width and height of the picture in the viewport, and its bytes; waits for the GPU.
    ///
    /// # Errors
    /// A sentence that says why there is none.
    pub fn picture(&self) -> Result<([u32; 2], Vec<[u8; 4]>), String> {
        let stage = self.bench.stage.as_ref().ok_or("the window has no graphics device")?;
        let bytes = stage.read().map_err(|problem| problem.text)?;
        let (_, size_px) = stage.picture().ok_or("there is no picture")?;
        Ok((size_px, bytes))
    }

    /// Pictures drawn so far, previews included.
    #[must_use]
    pub fn frames_drawn(&self) -> u64 {
        self.bench.stage.as_ref().map_or(0, Stage::frames)
    }

    /// Whether something is still being computed beside the frames, so that the picture will change by itself.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.bench.is_busy()
    }

    fn start_session(&mut self, data_dir: Option<PathBuf>) {
        let Some(folder) = data_dir else { return };
        match Session::start(&folder) {
            Ok((session, leftovers)) => {
                self.session = Some(session);
                self.questions.extend(leftovers.into_iter().map(Question::Recover));
            }
            Err(error) => tracing::warn!(%error, folder = %folder.display(), "changes do not survive a crash"),
        }
    }

    /// A picture says more than an empty document.
    fn start_with_first_preset(&mut self) {
        let first = tyndall_scene::presets().first().and_then(|preset| Document::from_preset(preset).ok());
        if let Some(document) = first {
            self.bench.document = document;
        }
    }

    fn input(&mut self, ctx: &egui::Context) {
        if self.questions.is_empty() {
            for action in action::pressed(ctx) {
                self.perform(ctx, action);
            }
            if self.full_viewport && ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
                self.perform(ctx, action::Action::FullViewport);
            }
        }
        let dropped = ctx.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            self.request(ctx, modal::Next::Open(path));
        }
        while let Some((purpose, path)) = self.bench.dialogs.chosen() {
            self.take_file(ctx, purpose, path);
        }
        if ctx.input(|input| input.viewport().close_requested()) {
            self.close_requested(ctx);
        }
    }

    fn show(&mut self, ui: &mut Ui) {
        if self.full_viewport {
            CentralPanel::no_frame().show(ui, |ui| self.bench.show_viewport(ui));
            return;
        }
        let state = MenuState { document: &self.bench.document, recent: &self.recent };
        if let Some(choice) = Panel::top("menu").show(ui, |ui| menu::show(ui, &state)).inner {
            self.follow(ui.ctx(), choice);
        }
        if let Some(problem) = self.bench.stage.as_ref().and_then(Stage::problem).cloned()
            && banner::show(ui, &problem)
        {
            self.rebuild(&problem);
        }
        CentralPanel::no_frame().show(ui, |ui| self.panels.ui(&mut self.bench, ui));
        if let Some(preset) = self.bench.chosen.take() {
            self.request(ui.ctx(), modal::Next::Preset(preset));
        }
    }

    fn ask(&mut self, ctx: &egui::Context) {
        let Some(question) = self.questions.pop_front() else { return };
        match modal::show(ctx, question, &self.recent, &self.bench.dialogs) {
            Ok(answer) => {
                self.answer(ctx, answer);
                ctx.request_repaint();
            }
            Err(question) => self.questions.push_front(question),
        }
    }

    /// Undo points, recovery, title: what follows from a change once it rests.
    fn follow_up(&mut self, ctx: &egui::Context) {
        let now_s = ctx.input(|input| input.time);
        // A stroke is undone as a whole, even one that has paused.
        if self.bench.is_in_stroke() || self.bench.document.watch(now_s) {
            ctx.request_repaint_after(REST);
        } else {
            self.keep_for_recovery();
        }
        let dirty = self.bench.document.is_dirty();
        let title = format!("{}{} - Tyndall", if dirty { "*" } else { "" }, self.bench.document.name());
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
        let stage = self.bench.stage.as_ref();
        if stage.is_some_and(|stage| !stage.is_up_to_date(self.bench.document.scene())) {
            ctx.request_repaint();
        }
    }

    /// Writes the recovery file if something has changed since the last time.
    pub(crate) fn keep_for_recovery(&mut self) {
        let Some(session) = &mut self.session else { return };
        let document = &self.bench.document;
        let dirty = document.is_dirty();
        if self.kept.as_ref().is_some_and(|(scene, was_dirty)| scene == document.scene() && *was_dirty == dirty) {
            return;
        }
        if let Err(error) = session.keep(document) {
            tracing::warn!(%error, "unsaved changes cannot be kept for recovery");
        }
        self.kept = Some((document.scene().clone(), dirty));
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        self.input(&ctx);
        self.bench.run_time(&ctx);
        self.show(ui);
        drop_hint(&ctx);
        self.ask(&ctx);
        self.follow_up(&ctx);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        let memory = Memory {
            recent: self.recent.clone(),
            viewport: self.bench.viewport.clone(),
            export: self.bench.export.clone(),
            panels: Some(self.panels.clone()),
        };
        eframe::set_value(storage, STORAGE_KEY, &memory);
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}

/// Says what happens when the file above the window is let go.
fn drop_hint(ctx: &egui::Context) {
    if ctx.input(|input| input.raw.hovered_files.is_empty()) {
        return;
    }
    egui::Area::new(egui::Id::unique("drop hint")).order(egui::Order::Tooltip).fixed_pos(ctx.content_rect().min).show(
        ctx,
        |ui| {
            let frame = Frame::NONE.fill(egui::Color32::from_black_alpha(180));
            frame.show(ui, |ui| {
                ui.set_min_size(ctx.content_rect().size());
                ui.centered_and_justified(|ui| {
                    ui.label(egui::RichText::new("Drop to open the scene").heading().color(egui::Color32::WHITE))
                });
            });
        },
    );
}
