//! The viewport panel: the picture, what is drawn over it, and the pointer on it.

use egui::{Align2, Color32, CornerRadius, FontId, Pos2, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};
use glam::UVec2;
use tyndall_scene::{Scene, camera::CameraFrame};

use crate::{
    bubble_handles,
    cloud_tools::CloudTools,
    desert_tools::DesertTools,
    engine::Engine,
    navigation::{DragTool, navigate},
    sand_brush,
    sky_probe::Sight,
    stage::Stage,
};

/// Accessible name of the picture.
pub(crate) const NAME: &str = "Viewport";

/// Largest side of the picture; more than any screen has.
const MAX_SIDE_PX: f32 = 8192.0;

/// Pixels a point where directions are computed: sizes in points are no whole numbers.
const SIGHT_SCALE: f32 = 64.0;

/// Shade below text and marks, so that they are readable on sky and ground.
const SHADE: Color32 = Color32::from_black_alpha(140);

/// What the user has chosen for the viewport.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub(crate) struct ViewportOptions {
    /// What dragging does.
    pub(crate) tool: DragTool,
    /// Whether a ring marks the sun.
    pub(crate) show_sun: bool,
    /// Whether the frame of the exported picture is shown.
    pub(crate) show_frame: bool,
    /// Whether a line of figures is shown.
    pub(crate) show_figures: bool,
}

impl Default for ViewportOptions {
    fn default() -> Self {
        Self { tool: DragTool::Look, show_sun: false, show_frame: false, show_figures: true }
    }
}

/// Shows the picture and moves the camera; where the pointer points. `is_playing` is whether something else moves.
pub(crate) fn show(
    ui: &mut Ui,
    stage: &mut Stage,
    scene: &mut Scene,
    (options, tools, sand): (&ViewportOptions, &mut CloudTools, &mut DesertTools),
    is_playing: bool,
) -> Option<Sight> {
    let size_pt = ui.available_size().max(Vec2::splat(1.0));
    let (rect, response) = ui.allocate_exact_size(size_pt, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, ui.is_enabled(), NAME));
    let filter = egui::EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }

    let bed = stage.engine().map(Engine::desert).and_then(|desert| desert.bed.clone());
    let primary_down = ui.input(|input| input.pointer.primary_down());
    let flying = if tools.paints(scene) && primary_down && response.is_pointer_button_down_on() {
        bubble_handles::paint(ui, &response, scene, tools);
        false
    } else if sand_brush::show(ui, &response, scene, sand, bed.as_deref()) && sand.active(scene).is_some() {
        false
    } else {
        navigate(ui, &response, &mut scene.camera, options.tool)
    };
    if flying {
        ui.ctx().request_repaint();
    }
    let moving = flying || ui.input(|input| input.pointer.any_down() || input.smooth_scroll_delta() != Vec2::ZERO);
    stage.present(ui.ctx(), scene, size_px(ui, size_pt), (moving, is_playing));

    match stage.picture() {
        Some((texture, _)) => egui::Image::new((texture, size_pt)).paint_at(ui, rect),
        None => drop(ui.painter().rect_filled(rect, CornerRadius::ZERO, ui.visuals().extreme_bg_color)),
    }
    overlay(ui, rect, stage, scene, options);
    if tools.moves_bubbles(scene) {
        bubble_handles::show(ui, rect, scene, tools);
    }
    if let (Some(bed), Some(_), Some(pointer)) = (&bed, sand.active(scene), response.hover_pos()) {
        sand_brush::ring(ui, rect, scene, sand, bed, pointer);
    }
    if stage.is_simulating_long(ui.ctx()) && !is_playing {
        label(ui, rect.right_top() + vec2(-10.0, 10.0), Align2::RIGHT_TOP, "Simulating clouds...");
    }
    if response.has_focus() {
        ui.painter().rect_stroke(rect, 0.0, Stroke::new(1.0, ui.visuals().selection.bg_fill), egui::StrokeKind::Inside);
    }
    response.hover_pos().map(|pointer| sight(scene, pointer - rect.min, size_pt))
}

/// The direction that is seen at a point of the view.
fn sight(scene: &Scene, point_pt: Vec2, size_pt: Vec2) -> Sight {
    // Finer than points: the frame takes whole pixels.
    let scaled = size_pt * SIGHT_SCALE;
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    let size = UVec2::new(scaled.x.round() as u32, scaled.y.round() as u32).max(UVec2::ONE);
    let point = glam::dvec2(f64::from(point_pt.x), f64::from(point_pt.y)) * f64::from(SIGHT_SCALE);
    let direction = CameraFrame::new(&scene.camera).ray(point, size);
    Sight { elevation_rad: direction.z.clamp(-1.0, 1.0).asin(), azimuth_rad: direction.x.atan2(direction.y) }
}

#[expect(clippy::cast_possible_truncation, reason = "clamped to a few thousand")]
fn size_px(ui: &Ui, size_pt: Vec2) -> [u32; 2] {
    let size = (size_pt * ui.ctx().pixels_per_point()).round();
    [size.x, size.y].map(|side| side.clamp(1.0, MAX_SIDE_PX) as u32)
}

fn overlay(ui: &Ui, rect: Rect, stage: &Stage, scene: &Scene, options: &ViewportOptions) {
    if options.show_frame {
        frame(ui, rect, scene);
    }
    if options.show_sun {
        sun(ui, rect, scene);
    }
    if options.show_figures && stage.picture().is_some() {
        figures(ui, rect, stage, scene);
    }
}

/// What the exported picture will show of the view: the same height, its own width.
fn frame(ui: &Ui, rect: Rect, scene: &Scene) {
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    let width_over_height = (f64::from(scene.image.width_px) / f64::from(scene.image.height_px)) as f32;
    let width = rect.height() * width_over_height;
    if width >= rect.width() {
        let text = "The exported picture is wider than this view.";
        label(ui, rect.center_top() + vec2(0.0, 10.0), Align2::CENTER_TOP, text);
        return;
    }
    let inner = Rect::from_center_size(rect.center(), vec2(width, rect.height()));
    for side in [Rect::from_min_max(rect.min, inner.left_bottom()), Rect::from_min_max(inner.right_top(), rect.max)] {
        ui.painter().rect_filled(side, CornerRadius::ZERO, SHADE);
    }
}

/// A ring around the sun, or an arrow's worth of words at the edge when it is not in view.
fn sun(ui: &Ui, rect: Rect, scene: &Scene) {
    let Ok(direction) = scene.sun_direction() else { return };
    // Points in place of pixels: the position on the screen is the same.
    let size = UVec2::from(size_px(ui, rect.size()));
    let found = CameraFrame::new(&scene.camera).point_px(direction.unit(), size);
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    let place = found.map(|point| rect.min + vec2(point.x as f32, point.y as f32) / ui.ctx().pixels_per_point());
    match place.filter(|place| rect.contains(*place)) {
        Some(place) => {
            for (width, colour) in [(4.0, SHADE), (1.5, Color32::from_rgb(255, 214, 90))] {
                ui.painter().circle_stroke(place, 14.0, Stroke::new(width, colour));
            }
        }
        None => label(ui, rect.left_top() + vec2(10.0, 10.0), Align2::LEFT_TOP, "The sun is outside the view."),
    }
}

/// One line at the lower edge: exposure, sun, size.
fn figures(ui: &Ui, rect: Rect, stage: &Stage, scene: &Scene) {
    let mut parts = Vec::new();
    if let Some(ev100) = stage.ev100() {
        parts.push(format!("EV100 {ev100:.1}"));
    }
    if let Ok(sun) = scene.sun_direction() {
        let (elevation_deg, azimuth_deg) = (sun.elevation_rad.to_degrees(), sun.azimuth_rad.to_degrees());
        parts.push(format!("sun {elevation_deg:.1}° high in {:.0}°", azimuth_deg.rem_euclid(360.0)));
    }
    if let Some((_, [width, height])) = stage.picture() {
        parts.push(format!("{width} x {height} px"));
    }
    label(ui, rect.left_bottom() + vec2(10.0, -10.0), Align2::LEFT_BOTTOM, &parts.join("    "));
}

fn label(ui: &Ui, at: Pos2, align: Align2, text: &str) {
    let galley = ui.painter().layout_no_wrap(text.to_owned(), FontId::proportional(12.5), Color32::WHITE);
    let text_rect = align.anchor_size(at, galley.size());
    ui.painter().rect_filled(text_rect.expand2(vec2(7.0, 4.0)), CornerRadius::same(4), SHADE);
    ui.painter().galley(pos2(text_rect.min.x, text_rect.min.y), galley, Color32::WHITE);
}
