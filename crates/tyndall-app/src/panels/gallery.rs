//! The gallery: the scenes that come with Tyndall, each with a small picture of itself.

use egui::{Image, Label, RichText, Role, ScrollArea, Sense, TextureId, Ui, UiBuilder, WidgetInfo, vec2};
use egui_wgpu::wgpu;
use tyndall_render::FrameTarget;
use tyndall_scene::{Preset, Scene, presets};

use crate::{detail::coarse, stage::Stage};

/// Size of the pictures.
const SIZE_PX: [u32; 2] = [192, 108];
const SIZE_PT: egui::Vec2 = vec2(192.0, 108.0);

/// Presets and the pictures drawn so far.
pub(crate) struct Gallery {
    entries: Vec<Entry>,
}

struct Entry {
    preset: Preset,
    scene: Option<Scene>,
    picture: Picture,
}

enum Picture {
    /// Not yet drawn.
    Due,
    /// The target keeps the texture alive.
    Drawn(TextureId, #[expect(dead_code, reason = "owns the texture that egui shows")] Box<FrameTarget>),
    /// The scene or the GPU refused.
    Failed,
}

impl Default for Gallery {
    fn default() -> Self {
        let entry = |preset: Preset| {
            let scene = preset.load().ok().map(|file| file.scene);
            Entry { preset, scene, picture: Picture::Due }
        };
        Self { entries: presets().into_iter().map(entry).collect() }
    }
}

impl Gallery {
    /// Forgets the pictures, as their device is gone.
    pub(crate) fn forget(&mut self, stage: &Stage) {
        for entry in &mut self.entries {
            if let Picture::Drawn(texture, _) = entry.picture {
                stage.state().renderer.write().free_texture(&texture);
            }
            entry.picture = Picture::Due;
        }
    }

    /// Shows the gallery; the preset that was clicked.
    pub(crate) fn show(&mut self, ui: &mut Ui, stage: &mut Stage) -> Option<Preset> {
        self.draw_next(ui, stage);
        let cards = |ui: &mut Ui| {
            ui.spacing_mut().item_spacing = vec2(12.0, 12.0);
            let clicked = self.entries.iter().filter(|entry| card(ui, entry)).last();
            clicked.map(|entry| entry.preset.clone())
        };
        let list = |ui: &mut Ui| ui.horizontal_wrapped(cards).inner;
        ScrollArea::vertical().auto_shrink(false).show(ui, list).inner
    }

    /// Draws one picture a frame, so that the window stays awake.
    fn draw_next(&mut self, ui: &Ui, stage: &mut Stage) {
        // The view comes first, and its timings must not be mixed up with those of thumbnails.
        if !stage.is_done() {
            return;
        }
        let Some(entry) = self.entries.iter_mut().find(|entry| matches!(entry.picture, Picture::Due)) else { return };
        entry.picture = match entry.scene.as_ref().and_then(|scene| draw(stage, scene)) {
            Some((texture, target)) => Picture::Drawn(texture, Box::new(target)),
            None => Picture::Failed,
        };
        ui.ctx().request_repaint();
    }
}

fn draw(stage: &mut Stage, scene: &Scene) -> Option<(TextureId, FrameTarget)> {
    if stage.problem().is_some_and(|problem| problem.rebuild) {
        return None;
    }
    let engine = stage.engine_mut()?;
    let drawn = engine.target(SIZE_PX).and_then(|mut target| {
        engine.draw_aside(&coarse(scene), &mut target)?;
        Ok(target)
    });
    match drawn {
        Ok(target) => {
            let state = stage.state();
            let (view, filter) = (target.picture().view(), wgpu::FilterMode::Linear);
            let texture = state.renderer.write().register_native_texture(&state.device, view, filter);
            Some((texture, target))
        }
        Err(problem) => {
            stage.report(problem);
            None
        }
    }
}

/// Picture and title; whether it was clicked.
fn card(ui: &mut Ui, entry: &Entry) -> bool {
    let builder = UiBuilder::new().id_salt(entry.preset.name).sense(Sense::click());
    let card = ui.scope_builder(builder, |ui| {
        ui.vertical(|ui| {
            ui.set_width(SIZE_PT.x);
            ui.spacing_mut().item_spacing.y = 4.0;
            match &entry.picture {
                Picture::Drawn(texture, _) => {
                    ui.add(Image::new((*texture, SIZE_PT)).corner_radius(4).alt_text(entry.preset.title.as_str()));
                }
                Picture::Due | Picture::Failed => {
                    let (rect, _) = ui.allocate_exact_size(SIZE_PT, Sense::empty());
                    ui.painter().rect_filled(rect, 4.0, ui.visuals().extreme_bg_color);
                }
            }
            ui.add(Label::new(RichText::new(&entry.preset.title).strong()).selectable(false));
        });
    });
    let response = card.response;
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Preset: {}", entry.preset.title)));
    if response.hovered() || response.has_focus() {
        let stroke = egui::Stroke::new(2.0, ui.visuals().selection.bg_fill);
        ui.painter().rect_stroke(response.rect.expand(4.0), 6.0, stroke, egui::StrokeKind::Outside);
    }
    let description = entry.scene.as_ref().map(|scene| scene.description.clone()).unwrap_or_default();
    response.on_hover_text(description).clicked()
}
