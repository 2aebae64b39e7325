//! The map of the vapour from above: paint, bubbles and the camera, north on top.

use egui::{Color32, Mesh, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, vec2};
use tyndall_clouds::painted_map::{PAINTED_SIDE, PaintedMap};
use tyndall_scene::{CameraParams, Scene};

use super::row::rename;
use crate::bubble_handles::drag_delta;
use crate::cloud_tools::{CloudTool, CloudTools, centre_now_m, drift_m, list_bubbles, side_m};

/// Largest side of the map.
const MAP_PT: f32 = 260.0;

/// Bubbles that are drawn at most.
const MOST_BUBBLES: usize = 600;

/// Colours of no vapour, of the pattern's and of as much as there can be.
const DRY: Color32 = Color32::from_rgb(112, 84, 56);
const NEUTRAL: Color32 = Color32::from_rgb(46, 66, 92);
const WET: Color32 = Color32::from_rgb(226, 232, 240);

/// Range of the brush's radius (m) and strength (levels a second).
const RADII_M: std::ops::RangeInclusive<f64> = 50.0..=20_000.0;
const STRENGTHS: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// Longest time (s) that a frame paints; a window that was asleep must not blot.
const MAX_STROKE_S: f64 = 0.1;

/// Shows the tools and the map.
pub(super) fn show(ui: &mut Ui, scene: &mut Scene, tools: &mut CloudTools) {
    buttons(ui, scene, tools);
    if tools.paints(scene) {
        brush(ui, tools);
    }
    let [width_m, depth_m] = side_m(scene);
    let width = ui.available_width().min(MAP_PT);
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    let size = vec2(width, (f64::from(width) * depth_m / width_m).clamp(40.0, 400.0) as f32);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    rename(ui, &response, "Map of the vapour");
    let map = Map { rect, side_m: [width_m, depth_m] };
    map.paint(&ui.painter_at(rect), scene, tools);
    let pointer = response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on());
    if let Some(pointer) = pointer.filter(|_| tools.paints(scene)) {
        let time_s = f64::from(ui.input(|input| input.stable_dt)).min(MAX_STROKE_S);
        tools.paint(scene, map.place_m(pointer), time_s);
        ui.ctx().request_repaint();
    }
    if tools.moves_bubbles(scene) {
        map.drag_bubble(ui, &response, scene, tools);
    }
    let hint = match tools.tool {
        CloudTool::Bubbles => "Drag a bubble; in the view its size can be changed too.",
        CloudTool::Paint | CloudTool::Erase => "Drag here or in the view.",
        CloudTool::None => "Vapour from above; north is up.",
    };
    ui.weak(hint);
}

fn buttons(ui: &mut Ui, scene: &mut Scene, tools: &mut CloudTools) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (tool, text, name) in [
            (CloudTool::None, "Look", "Clouds: look"),
            (CloudTool::Paint, "Paint", "Clouds: paint vapour"),
            (CloudTool::Erase, "Erase", "Clouds: erase vapour"),
            (CloudTool::Bubbles, "Bubbles", "Clouds: move bubbles"),
        ] {
            let button = ui.selectable_value(&mut tools.tool, tool, text);
            rename(ui, &button, name);
        }
        let vapour = &mut scene.cloud_vapour;
        for (text, name, kept) in [
            ("Clear paint", "Clouds: clear paint", &mut vapour.painted),
            ("Pattern's bubbles", "Clouds: bubbles of the pattern", &mut vapour.ellipsoids),
        ] {
            if !kept.is_empty() {
                let button = ui.button(text);
                rename(ui, &button, name);
                if button.clicked() {
                    kept.clear();
                }
            }
        }
    });
}

fn brush(ui: &mut Ui, tools: &mut CloudTools) {
    for (caption, name, value, range, unit) in [
        ("Radius", "Clouds: radius of the brush", &mut tools.radius_m, RADII_M, " m"),
        ("Strength", "Clouds: strength of the brush", &mut tools.strength, STRENGTHS, ""),
    ] {
        ui.horizontal(|ui| {
            ui.label(caption);
            ui.spacing_mut().slider_width = (ui.available_width() - 90.0).max(60.0);
            let slider = ui.add(egui::Slider::new(value, range).logarithmic(true).max_decimals(1).suffix(unit));
            rename(ui, &slider, name);
        });
    }
}

/// Where the map is and what it covers.
struct Map {
    rect: Rect,
    side_m: [f64; 2],
}

impl Map {
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    fn point(&self, [east, north]: [f64; 2]) -> Pos2 {
        let share = vec2((east / self.side_m[0] + 0.5) as f32, (0.5 - north / self.side_m[1]) as f32);
        self.rect.min + share * self.rect.size()
    }

    fn place_m(&self, point: Pos2) -> [f64; 2] {
        let share = (point - self.rect.min) / self.rect.size();
        [(f64::from(share.x) - 0.5) * self.side_m[0], (0.5 - f64::from(share.y)) * self.side_m[1]]
    }

    fn points_per_m(&self) -> f64 {
        f64::from(self.rect.width()) / self.side_m[0]
    }

    fn paint(&self, painter: &Painter, scene: &Scene, tools: &mut CloudTools) {
        painter.add(Shape::mesh(self.levels(scene)));
        let shown = tools.moves_bubbles(scene);
        let stroke = Stroke::new(1.0, Color32::from_white_alpha(if shown { 200 } else { 70 }));
        for bubble in tools.bubbles(scene).iter().take(MOST_BUBBLES) {
            let [east, north, _] = centre_now_m(scene, bubble);
            #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
            let [a, b] = [0, 1].map(|axis| (bubble.radii_m[axis] * self.points_per_m()) as f32);
            painter.add(Shape::ellipse_stroke(self.point([east, north]), vec2(a, b), stroke));
        }
        self.camera(painter, &scene.camera);
    }

    /// The levels of the painted map where they have drifted, as squares.
    fn levels(&self, scene: &Scene) -> Mesh {
        let mut mesh = Mesh::default();
        let map = PaintedMap::parse(&scene.cloud_vapour.painted).unwrap_or_default();
        let drift = drift_m(scene, 0.0);
        let square = self.rect.size() / PAINTED_SIDE as f32;
        for (x, y) in (0..PAINTED_SIDE).flat_map(|y| (0..PAINTED_SIDE).map(move |x| (x, y))) {
            let share = |axis: usize, index: usize| {
                (index as f64 + 0.5) / PAINTED_SIDE as f64 - drift[axis] / self.side_m[axis]
            };
            let level = if map.is_blank() { 1.0 } else { map.at([share(0, x), share(1, y)]) };
            let corner = self.rect.left_bottom() + vec2(x as f32, -(y as f32) - 1.0) * square;
            mesh.add_colored_rect(Rect::from_min_size(corner, square), colour(level));
        }
        mesh
    }

    /// An arrow from where the camera stands to where it looks.
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    fn camera(&self, painter: &Painter, camera: &CameraParams) {
        let place = self.point([camera.x_m, camera.y_m]);
        let (sine, cosine) = camera.heading_deg.to_radians().sin_cos();
        let ahead = vec2(sine as f32, -cosine as f32);
        let aside = vec2(-ahead.y, ahead.x);
        let corners = [place + 9.0 * ahead, place - 5.0 * ahead + 5.0 * aside, place - 5.0 * ahead - 5.0 * aside];
        let stroke = Stroke::new(1.0, Color32::from_black_alpha(160));
        painter.add(Shape::convex_polygon(corners.to_vec(), Color32::from_rgb(226, 150, 62), stroke));
    }

    /// Moves the bubble that the pointer took hold of.
    fn drag_bubble(&self, ui: &Ui, response: &egui::Response, scene: &mut Scene, tools: &mut CloudTools) {
        let memory = response.id.with("bubble");
        if response.drag_started() {
            let pressed = ui.input(|input| input.pointer.press_origin());
            let held = pressed.and_then(|pointer| self.nearest(pointer, scene, tools));
            ui.data_mut(|data| data.insert_temp(memory, held));
        }
        let held = ui.data(|data| data.get_temp::<Option<usize>>(memory)).flatten();
        let delta = drag_delta(ui, response);
        let Some(index) = held.filter(|_| delta != Vec2::ZERO) else { return };
        let mut bubbles = tools.bubbles(scene).to_vec();
        let Some(bubble) = bubbles.get_mut(index) else { return };
        bubble.centre_m[0] += f64::from(delta.x) / self.points_per_m();
        bubble.centre_m[1] -= f64::from(delta.y) / self.points_per_m();
        list_bubbles(scene, &bubbles);
    }

    fn nearest(&self, pointer: Pos2, scene: &Scene, tools: &mut CloudTools) -> Option<usize> {
        let [east, north] = self.place_m(pointer);
        let away = |bubble: &tyndall_clouds::ellipsoid_list::PlacedEllipsoid| {
            let centre = centre_now_m(scene, bubble);
            ((east - centre[0]) / bubble.radii_m[0]).hypot((north - centre[1]) / bubble.radii_m[1])
        };
        let all = tools.bubbles(scene).iter().map(away).enumerate();
        all.filter(|(_, away)| *away <= 1.0).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "0 to 2")]
fn colour(level: f64) -> Color32 {
    if level < 1.0 { DRY.lerp_to_gamma(NEUTRAL, level as f32) } else { NEUTRAL.lerp_to_gamma(WET, level as f32 - 1.0) }
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn places_and_points_lead_to_each_other_and_north_is_up() {
        let map = Map { rect: Rect::from_min_size(pos2(10.0, 20.0), vec2(200.0, 100.0)), side_m: [8e3, 4e3] };
        for place in [[0.0, 0.0], [-4e3, 2e3], [1234.0, -987.0]] {
            let found = map.place_m(map.point(place));
            assert!((found[0] - place[0]).abs() < 0.01 && (found[1] - place[1]).abs() < 0.01, "{found:?} {place:?}");
        }
        assert!(map.point([0.0, 1e3]).y < map.point([0.0, 0.0]).y, "north is up");
    }
}
