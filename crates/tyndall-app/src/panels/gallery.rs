//! The gallery: the scenes that come with Tyndall in chapters, each with a small picture of itself.

use egui::{
    Image, Label, RichText, Role, ScrollArea, Sense, TextureHandle, TextureOptions, Ui, UiBuilder, WidgetInfo, vec2,
};
use tyndall_scene::{Preset, Scene, presets};

use crate::{
    chapters::Chapter,
    stage::Stage,
    thumbnails::{SIZE_PX, Thumbnails},
};

/// Size of the pictures on the screen.
const SIZE_PT: egui::Vec2 = vec2(SIZE_PX[0] as f32, SIZE_PX[1] as f32);

/// Presets and the pictures drawn so far.
pub(crate) struct Gallery {
    entries: Vec<Entry>,
    thumbnails: Option<Thumbnails>,
}

struct Entry {
    preset: Preset,
    scene: Option<Scene>,
    chapter: Chapter,
    picture: Picture,
}

enum Picture {
    /// Not yet drawn.
    Due,
    /// Drawn and given to egui.
    Drawn(TextureHandle),
    /// The scene or the GPU refused.
    Failed,
}

impl Default for Gallery {
    fn default() -> Self {
        let entry = |preset: Preset| {
            let scene = preset.load().ok().map(|file| file.scene);
            let chapter = scene.as_ref().map_or(Chapter::Day, Chapter::of);
            Entry { preset, scene, chapter, picture: Picture::Due }
        };
        Self { entries: presets().into_iter().map(entry).collect(), thumbnails: None }
    }
}

impl Gallery {
    /// Forgets the pictures, as their device is gone.
    pub(crate) fn forget(&mut self) {
        self.thumbnails = None;
        self.entries.iter_mut().for_each(|entry| entry.picture = Picture::Due);
    }

    /// Shows the gallery; the preset that was clicked.
    pub(crate) fn show(&mut self, ui: &mut Ui, stage: &Stage) -> Option<Preset> {
        self.take_drawn(ui.ctx());
        self.order_next(ui.ctx(), stage);
        let list = |ui: &mut Ui| {
            let chapters = Chapter::ALL.into_iter().map(|chapter| self.chapter(ui, chapter));
            chapters.flatten().last()
        };
        ScrollArea::vertical().auto_shrink(false).show(ui, list).inner
    }

    fn chapter(&self, ui: &mut Ui, chapter: Chapter) -> Option<Preset> {
        let mut entries = self.entries.iter().filter(|entry| entry.chapter == chapter).peekable();
        entries.peek()?;
        ui.label(RichText::new(chapter.title()).weak());
        let cards = |ui: &mut Ui| {
            ui.spacing_mut().item_spacing = vec2(12.0, 12.0);
            entries.filter(|entry| card(ui, entry)).last().map(|entry| entry.preset.clone())
        };
        let clicked = ui.horizontal_wrapped(cards).inner;
        ui.add_space(6.0);
        clicked
    }

    /// Gives egui the texture of the picture that has come.
    fn take_drawn(&mut self, ctx: &egui::Context) {
        let Some((index, picture)) = self.thumbnails.as_mut().and_then(Thumbnails::take) else { return };
        let entry = &mut self.entries[index];
        entry.picture = picture.map_or(Picture::Failed, |picture| {
            Picture::Drawn(ctx.load_texture(entry.preset.name, picture, TextureOptions::LINEAR))
        });
    }

    /// Asks for one picture at a time, and only while the view is at rest: it comes first.
    fn order_next(&mut self, ctx: &egui::Context, stage: &Stage) {
        if !stage.is_done() || stage.problem().is_some_and(|problem| problem.rebuild) {
            return;
        }
        let Some(engine) = stage.engine() else { return };
        let due = self.entries.iter_mut().enumerate().find(|(_, entry)| matches!(entry.picture, Picture::Due));
        let Some((index, entry)) = due else {
            // Nothing more to draw: the renderer's memory is free again.
            self.thumbnails = None;
            return;
        };
        let Some(scene) = &entry.scene else {
            entry.picture = Picture::Failed;
            return;
        };
        if self.thumbnails.is_none() {
            let ctx = ctx.clone();
            self.thumbnails = Thumbnails::start(engine.gpu.adapter().into(), move || ctx.request_repaint()).ok();
        }
        match &mut self.thumbnails {
            Some(thumbnails) => thumbnails.order(index, scene),
            None => entry.picture = Picture::Failed,
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
                Picture::Drawn(texture) => {
                    ui.add(Image::new((texture.id(), SIZE_PT)).corner_radius(4).alt_text(entry.preset.title.as_str()));
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
