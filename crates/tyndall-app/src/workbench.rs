//! What the panels work on, and each panel in its tile.

use egui::{Frame, Margin, Ui, WidgetText};
use egui_tiles::{Behavior, SimplificationOptions, TileId, UiResponse};
use tracing::Level;
use tyndall_scene::{CloudKind, DesertKind, Preset};

use crate::{
    cloud_clock::CloudClock,
    cloud_meter::CloudMeter,
    cloud_tools::CloudTools,
    desert_clock::DesertClock,
    desert_tools::DesertTools,
    document::Document,
    engine::Engine,
    error_meter::{ErrorMeter, Thoroughness},
    export_options::ExportOptions,
    file_dialog::FileDialogs,
    layout::Pane,
    logging::LogBuffer,
    panels::{
        camera, clouds, desert,
        export::{self, Exports},
        gallery::Gallery,
        log, parameters, plots,
        time::TimePanel,
        timings, validate, validate_clouds,
    },
    sky_probe::{Sight, SkyProbe},
    stage::Stage,
    viewport::{self, ViewportOptions},
};

/// Room around the contents of a panel.
const MARGIN: Margin = Margin::same(10);

/// Smallest side of a tile.
const MIN_TILE_PT: f32 = 80.0;

/// Everything that more than one panel needs, and what the panels remember.
pub(crate) struct Workbench {
    pub(crate) document: Document,
    pub(crate) stage: Option<Stage>,
    pub(crate) gallery: Gallery,
    pub(crate) exports: Exports,
    pub(crate) dialogs: FileDialogs,
    pub(crate) log: LogBuffer,
    pub(crate) viewport: ViewportOptions,
    pub(crate) export: ExportOptions,
    /// The preset that was clicked in this frame.
    pub(crate) chosen: Option<Preset>,
    /// Date, time and place, and whether time runs.
    pub(crate) time: TimePanel,
    /// Whether the clouds move.
    pub(crate) clouds: CloudClock,
    /// Whether the wind blows over the desert.
    pub(crate) desert: DesertClock,
    cloud_tools: CloudTools,
    desert_tools: DesertTools,
    probe: SkyProbe,
    meter: ErrorMeter,
    cloud_meter: CloudMeter,
    thoroughness: Thoroughness,
    /// Where the pointer was in the view last.
    cursor: Option<Sight>,
    filter: String,
    level: Level,
}

impl Workbench {
    /// A workbench with a new document.
    pub(crate) fn new(stage: Option<Stage>, log: LogBuffer, viewport: ViewportOptions, export: ExportOptions) -> Self {
        Self {
            document: Document::new(),
            stage,
            gallery: Gallery::default(),
            exports: Exports::default(),
            dialogs: FileDialogs::default(),
            log,
            viewport,
            export,
            chosen: None,
            time: TimePanel::default(),
            clouds: CloudClock::default(),
            desert: DesertClock::default(),
            cloud_tools: CloudTools::default(),
            desert_tools: DesertTools::default(),
            probe: SkyProbe::default(),
            meter: ErrorMeter::default(),
            cloud_meter: CloudMeter::default(),
            thoroughness: Thoroughness::default(),
            cursor: None,
            filter: String::new(),
            level: Level::INFO,
        }
    }

    /// Whether something is being computed beside the frames that a panel or the picture will show.
    pub(crate) fn is_busy(&self) -> bool {
        let stage = self.stage.as_ref();
        stage.is_some_and(|stage| stage.is_building() || stage.awaits_timings()) || self.probe.is_busy()
    }

    /// Whether a brush is on the sand.
    pub(crate) fn is_in_stroke(&self) -> bool {
        self.desert_tools.is_held()
    }

    /// Another document: what moves on its own stops.
    pub(crate) fn replace_document(&mut self, document: Document) {
        self.document = document;
        self.time.playback.is_playing = false;
        self.clouds.is_playing = false;
        self.desert.is_playing = false;
    }

    /// Lets the time of the scene run while it plays.
    pub(crate) fn run_time(&mut self, ctx: &egui::Context) {
        let passed_s = f64::from(ctx.input(|input| input.unstable_dt));
        if self.time.playback.run(&mut self.document.scene_mut().sun, passed_s) {
            ctx.request_repaint();
        }
        self.run_clouds(ctx);
        self.run_desert(ctx);
    }

    /// Lets the wind blow over the desert while it plays.
    fn run_desert(&mut self, ctx: &egui::Context) {
        let scene = self.document.scene_mut();
        self.desert.is_playing &= scene.desert.kind == DesertKind::Dunes;
        let is_ready = self.stage.as_ref().is_none_or(Stage::takes_sand);
        let progress = self.stage.as_ref().and_then(Stage::engine).map(Engine::desert);
        let most = progress.map_or(1, desert::steps_at_once);
        let ends = (most, desert::last_step(scene));
        self.desert.run(&mut scene.desert.steps, ends, ctx.input(|input| input.time), is_ready);
        if self.desert.is_playing && is_ready {
            ctx.request_repaint();
        }
    }

    /// Lets the time of the clouds run while they play.
    fn run_clouds(&mut self, ctx: &egui::Context) {
        let scene = self.document.scene_mut();
        self.clouds.is_playing &= scene.clouds.kind == CloudKind::Automaton;
        let is_ready = self.stage.as_ref().is_none_or(Stage::takes_clouds);
        let last_s = clouds::last_time_s(scene);
        self.clouds.run(&mut scene.clouds.time_s, last_s, ctx.input(|input| input.time), is_ready);
    }

    /// The viewport alone.
    pub(crate) fn show_viewport(&mut self, ui: &mut Ui) {
        let Some(stage) = &mut self.stage else {
            ui.label("This window has no graphics device.");
            return;
        };
        stage.set_steps_on(self.desert.steps_on);
        stage.set_sand_under_way(self.desert.is_playing || self.desert_tools.is_held());
        let is_playing = self.time.playback.is_playing || self.clouds.is_playing || self.desert.is_playing;
        let pointed = viewport::show(
            ui,
            stage,
            self.document.scene_mut(),
            (&self.viewport, &mut self.cloud_tools, &mut self.desert_tools),
            is_playing,
        );
        self.cursor = pointed.or(self.cursor);
    }

    fn show_pane(&mut self, ui: &mut Ui, pane: Pane) {
        let Self { document, stage, exports, dialogs, .. } = self;
        match pane {
            Pane::Viewport => self.show_viewport(ui),
            Pane::Parameters => parameters::show(ui, document.scene_mut(), &mut self.filter),
            Pane::Camera => camera::show(ui, document.scene_mut(), &mut self.viewport),
            Pane::Time => self.time.show(ui, document.scene_mut()),
            Pane::Clouds => {
                let progress = stage.as_ref().and_then(Stage::engine).map(Engine::clouds);
                clouds::show(ui, document.scene_mut(), (&mut self.clouds, &mut self.cloud_tools), progress);
            }
            Pane::Desert => {
                let progress = stage.as_ref().and_then(Stage::engine).map(Engine::desert);
                desert::show(ui, document.scene_mut(), (&mut self.desert, &mut self.desert_tools), progress);
            }
            Pane::Export => export::show(ui, document, &mut self.export, exports, dialogs),
            Pane::Gallery => self.chosen = stage.as_ref().and_then(|stage| self.gallery.show(ui, stage)),
            Pane::Plots => {
                let at_rest = stage.as_ref().is_none_or(|stage| !stage.is_moving());
                plots::show(ui, &mut self.probe, document.scene(), self.cursor, at_rest);
            }
            Pane::Accuracy => {
                let gpu = stage.as_ref().and_then(Stage::engine).map(|engine| &engine.gpu);
                let clouds = (gpu, self.thoroughness);
                validate_clouds::show(ui, &mut self.cloud_meter, clouds, document.scene());
                validate::show(ui, &mut self.meter, &mut self.thoroughness, document.scene());
            }
            Pane::Timings => {
                let frames = stage.as_ref().map_or(0, Stage::frames);
                timings::show(ui, stage.as_ref().and_then(Stage::engine), frames);
            }
            Pane::Log => log::show(ui, &self.log, &mut self.level),
        }
    }
}

impl Behavior<Pane> for Workbench {
    fn pane_ui(&mut self, ui: &mut Ui, _tile: TileId, pane: &mut Pane) -> UiResponse {
        ui.push_id(*pane, |ui| {
            if *pane == Pane::Viewport {
                self.show_pane(ui, *pane);
            } else {
                Frame::new().inner_margin(MARGIN).show(ui, |ui| self.show_pane(ui, *pane));
            }
        });
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> WidgetText {
        pane.title().into()
    }

    fn gap_width(&self, _style: &egui::Style) -> f32 {
        4.0
    }

    fn tab_bar_height(&self, _style: &egui::Style) -> f32 {
        28.0
    }

    fn tab_title_spacing(&self, _visuals: &egui::Visuals) -> f32 {
        14.0
    }

    fn min_size(&self) -> f32 {
        MIN_TILE_PT
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }
}
