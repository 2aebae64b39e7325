//! The picture in the viewport: drawn when the scene or the size has changed, coarser while something moves, in full
//! resolution once it rests, and not at all otherwise.

use std::time::Duration;

use egui::TextureId;
use egui_wgpu::{RenderState, wgpu};
use tyndall_render::FrameTarget;
use tyndall_scene::{ImageParams, Scene};

use crate::{
    detail::{self, Detail},
    engine::{Engine, Problem},
    preview::{Preview, reduced},
    steps_on::StepsOn,
};

/// Longest frames (ms) while something moves, and while it is sand, which the processor moves beside the frames.
const MOVING_MS: f64 = 60.0;
const MOVING_SAND_MS: f64 = 30.0;

/// Rest after which a preview is replaced by the full picture.
const REST_S: f64 = 0.15;

/// How often the window asks for timings that are on their way, and how many times.
const TIMINGS_EVERY: Duration = Duration::from_millis(40);
const TIMINGS_TRIES: u32 = 50;

/// Time of a simulation after which a sign tells of it; shorter ones would make it flicker.
const SIGN_AFTER_S: f64 = 0.25;

/// What the picture depends on.
#[derive(Clone, Debug, PartialEq)]
struct Wanted {
    scene: Scene,
    view_px: [u32; 2],
}

/// Targets, the texture that egui shows, and what was drawn last.
pub(crate) struct Stage {
    state: RenderState,
    /// Woken when a table has come.
    ctx: egui::Context,
    engine: Result<Engine, Problem>,
    /// Target in full resolution, and that of previews.
    targets: [Option<FrameTarget>; 2],
    texture: Option<TextureId>,
    /// What was drawn last, or tried.
    tried: Option<Wanted>,
    /// The scene as it was drawn last, and the divisor of its resolution.
    drawn: Option<(Scene, u32)>,
    /// Which of the targets is shown.
    shown: Option<usize>,
    /// Why the picture shown is not that of the scene.
    problem: Option<Problem>,
    preview: Preview,
    detail: Detail,
    refine_at_s: Option<f64>,
    timings_tries: u32,
    ev100: Option<f64>,
    frames: u64,
    /// Since when clouds have been simulated without a pause.
    simulating_since_s: Option<f64>,
    /// Whether the wind blows over sand, or a hand is on it.
    is_sand_under_way: bool,
    /// Who makes the steps of dunes.
    steps_on: StepsOn,
}

impl Stage {
    /// A stage on the window's device.
    pub(crate) fn new(state: RenderState, ctx: &egui::Context) -> Self {
        let engine = Engine::new(&state, ctx, StepsOn::default());
        let problem = engine.as_ref().err().cloned();
        Self {
            state,
            ctx: ctx.clone(),
            engine,
            targets: [None, None],
            texture: None,
            tried: None,
            drawn: None,
            shown: None,
            problem,
            preview: Preview::default(),
            detail: Detail::default(),
            refine_at_s: None,
            timings_tries: 0,
            ev100: None,
            frames: 0,
            simulating_since_s: None,
            is_sand_under_way: false,
            steps_on: StepsOn::default(),
        }
    }

    /// Chooses whether sand is under way, so that what is drawn of it is soon drawn anew.
    pub(crate) fn set_sand_under_way(&mut self, is_under_way: bool) {
        self.is_sand_under_way = is_under_way;
    }

    /// Chooses who makes the steps of dunes.
    pub(crate) fn set_steps_on(&mut self, steps_on: StepsOn) {
        if self.steps_on != steps_on {
            self.steps_on = steps_on;
            if let Ok(engine) = &mut self.engine {
                engine.set_steps_on(steps_on);
            }
        }
    }

    /// The renderer, unless it could not be made.
    pub(crate) fn engine(&self) -> Option<&Engine> {
        self.engine.as_ref().ok()
    }

    /// Why the picture is not that of the scene.
    pub(crate) fn problem(&self) -> Option<&Problem> {
        self.problem.as_ref()
    }

    /// Takes note of a problem that something else has met.
    pub(crate) fn report(&mut self, problem: Problem) {
        tracing::error!("{}", problem.text);
        self.problem = Some(problem);
    }

    /// Texture and size of the picture, when there is one.
    pub(crate) fn picture(&self) -> Option<(TextureId, [u32; 2])> {
        Some((self.texture?, self.shown_target()?.size_px()))
    }

    /// Exposure of the picture, when it has been read.
    pub(crate) fn ev100(&self) -> Option<f64> {
        self.ev100
    }

    /// Whether the picture is complete and measured, so that the graphics may be used for something else.
    pub(crate) fn is_done(&self) -> bool {
        self.shown.is_some() && self.refine_at_s.is_none() && !self.awaits_timings() && !self.is_building()
    }

    /// Whether a table of the sky or clouds are being made that the picture will show by and by.
    pub(crate) fn is_building(&self) -> bool {
        self.problem.is_none() && self.engine().is_some_and(Engine::is_building)
    }

    /// Whether clouds are being simulated that the picture does not show yet.
    pub(crate) fn is_simulating(&self) -> bool {
        self.problem.is_none() && self.engine().is_some_and(|engine| engine.clouds().building)
    }

    /// Whether the next moment of the clouds can be asked for: those before are there, if not yet shown.
    pub(crate) fn takes_clouds(&self) -> bool {
        !self.is_simulating() || self.engine().is_some_and(Engine::has_news)
    }

    /// Whether the next step of the desert can be asked for: those before are there, if not yet shown.
    pub(crate) fn takes_sand(&self) -> bool {
        let is_simulating = self.problem.is_none() && self.engine().is_some_and(|engine| engine.desert().building);
        !is_simulating || self.engine().is_some_and(Engine::has_news)
    }

    /// Whether clouds have been simulated for so long that the user should know; asks to be asked again where that is near.
    pub(crate) fn is_simulating_long(&mut self, ctx: &egui::Context) -> bool {
        let now_s = ctx.input(|input| input.time);
        let is_simulating = self.is_simulating();
        let since_s = *self.simulating_since_s.get_or_insert(now_s);
        if !is_simulating {
            self.simulating_since_s = None;
            return false;
        }
        let left_s = since_s + SIGN_AFTER_S - now_s;
        if left_s > 0.0 {
            ctx.request_repaint_after(Duration::from_secs_f64(left_s));
        }
        left_s <= 0.0
    }

    /// Whether the window will wake up for the timings of the picture.
    pub(crate) fn awaits_timings(&self) -> bool {
        self.timings_tries > 0 && self.engine().is_some_and(Engine::awaits_timings)
    }

    /// Whether a picture is shown that a finer one will replace as soon as the user lets go.
    pub(crate) fn is_moving(&self) -> bool {
        self.refine_at_s.is_some()
    }

    /// Frames drawn so far.
    pub(crate) fn frames(&self) -> u64 {
        self.frames
    }

    /// The picture shown, row 0 on top.
    pub(crate) fn read(&self) -> Result<Vec<[u8; 4]>, Problem> {
        let none = || Problem { text: "there is no picture yet".to_owned(), rebuild: false, lost: false };
        match (&self.engine, self.shown_target()) {
            (Ok(engine), Some(target)) => engine.read(target),
            (Err(problem), _) => Err(problem.clone()),
            (_, None) => Err(none()),
        }
    }

    /// Drops everything on the GPU and makes it anew.
    pub(crate) fn rebuild(&mut self) {
        self.targets = [None, None];
        (self.tried, self.drawn, self.shown, self.refine_at_s) = (None, None, None, None);
        self.detail = Detail::default();
        // The old one gives its memory back first.
        self.engine = Err(Problem { text: String::new(), rebuild: true, lost: false });
        self.engine = Engine::new(&self.state, &self.ctx, self.steps_on);
        self.problem = self.engine.as_ref().err().cloned();
    }

    /// Draws what is needed for a view of this size. `moving` is whether the user is at it, by pointer or keyboard, and
    /// `is_playing` whether it moves by itself.
    pub(crate) fn present(
        &mut self,
        ctx: &egui::Context,
        scene: &Scene,
        view_px: [u32; 2],
        (moving, is_playing): (bool, bool),
    ) {
        if self.problem.as_ref().is_some_and(|problem| problem.rebuild) {
            return;
        }
        let now_s = ctx.input(|input| input.time);
        if is_playing && self.refine_at_s.is_some() {
            // What plays is at rest between two of its moments only.
            self.refine_at_s = Some(now_s + REST_S);
        }
        let moving = moving || is_playing;
        let wanted = Wanted { scene: picture_of(scene), view_px };
        if self.tried.as_ref() != Some(&wanted) {
            let divisor = if moving { self.preview.divisor(view_px, self.frame_ms()) } else { 1 };
            let quick = self.detail.quick(scene);
            let quick = if divisor > 1 { detail::reduced(quick) } else { quick };
            let is_preview = divisor > 1 || quick != *scene || self.is_sand_under_way;
            self.refine_at_s = is_preview.then_some(now_s + REST_S);
            self.tried = Some(wanted);
            self.tell_sand(self.is_sand_under_way);
            self.draw(&quick, view_px, divisor);
        } else if self.refine_at_s.is_some_and(|at_s| now_s >= at_s) {
            self.refine_at_s = None;
            self.detail.drawn_fine(scene);
            self.tell_sand(false);
            self.draw(scene, view_px, 1);
        } else if self.engine().is_some_and(Engine::has_news)
            && let Some((drawn, divisor)) = self.drawn.clone()
        {
            self.draw(&drawn, view_px, divisor);
        }
        if self.engine().is_some_and(Engine::has_news) {
            ctx.request_repaint();
        }
        if let Some(at_s) = self.refine_at_s {
            ctx.request_repaint_after(Duration::from_secs_f64((at_s - now_s).max(0.0)));
        }
        self.await_timings(ctx);
    }

    /// Longest frame (ms) that a preview may take.
    fn frame_ms(&self) -> f64 {
        // A software adapter leaves the sand less of the processor.
        if self.is_sand_under_way { MOVING_SAND_MS } else { MOVING_MS }
    }

    fn tell_sand(&mut self, is_under_way: bool) {
        if let Ok(engine) = &mut self.engine {
            engine.set_sand_under_way(is_under_way);
        }
    }

    /// Whether the picture of this scene has been drawn or tried.
    pub(crate) fn is_up_to_date(&self, scene: &Scene) -> bool {
        let rebuild = self.problem.as_ref().is_some_and(|problem| problem.rebuild);
        rebuild || self.tried.as_ref().is_none_or(|tried| tried.scene == picture_of(scene))
    }

    fn shown_target(&self) -> Option<&FrameTarget> {
        self.targets[self.shown?].as_ref()
    }

    fn draw(&mut self, scene: &Scene, view_px: [u32; 2], divisor: u32) {
        self.frames += 1;
        self.drawn = Some((scene.clone(), divisor));
        self.problem = self.try_draw(scene, view_px, divisor).err();
        if let Some(problem) = &self.problem {
            tracing::error!("{}", problem.text);
        }
    }

    fn try_draw(&mut self, scene: &Scene, view_px: [u32; 2], divisor: u32) -> Result<(), Problem> {
        let Ok(engine) = &mut self.engine else { return Ok(()) };
        let slot = usize::from(divisor > 1);
        let size_px = reduced(view_px, divisor);
        if self.targets[slot].as_ref().is_none_or(|target| target.size_px() != size_px) {
            // The old one gives its memory back first.
            self.targets[slot] = None;
            self.targets[slot] = Some(engine.target(size_px)?);
            self.shown = self.shown.filter(|shown| *shown != slot);
        }
        let Some(target) = &mut self.targets[slot] else { return Ok(()) };
        engine.draw(scene, target, divisor)?;
        self.timings_tries = TIMINGS_TRIES;
        if self.shown != Some(slot) {
            self.shown = Some(slot);
            self.show(slot);
        }
        Ok(())
    }

    /// Gives egui the texture of a target; always under the same name, as every new one would stay in memory.
    fn show(&mut self, slot: usize) {
        let Some(target) = &self.targets[slot] else { return };
        let (device, view, filter) = (&self.state.device, target.picture().view(), wgpu::FilterMode::Linear);
        let mut painter = self.state.renderer.write();
        match self.texture {
            Some(texture) => painter.update_egui_texture_from_wgpu_texture(device, view, filter, texture),
            None => self.texture = Some(painter.register_native_texture(device, view, filter)),
        }
    }

    /// Timings come a little after the picture; until then the window wakes up a few times more.
    fn await_timings(&mut self, ctx: &egui::Context) {
        if !self.awaits_timings() {
            return;
        }
        let Ok(engine) = &mut self.engine else { return };
        match engine.poll_timings() {
            Ok(false) => {
                self.timings_tries -= 1;
                ctx.request_repaint_after(TIMINGS_EVERY);
            }
            Ok(true) => {
                if let Some(newest) = engine.timings.back() {
                    self.preview.learn(newest.divisor, newest.size_px, newest.total_ms());
                }
                // The frame is done, so that reading does not wait for it.
                self.ev100 = engine.read_ev100().ok();
                ctx.request_repaint();
            }
            Err(problem) => self.report(problem),
        }
    }
}

/// The scene less what the viewport's picture does not depend on.
fn picture_of(scene: &Scene) -> Scene {
    Scene { title: String::new(), description: String::new(), image: ImageParams::default(), ..scene.clone() }
}
