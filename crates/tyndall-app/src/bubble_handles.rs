//! Bubbles of humid air in the view: wire ellipsoids whose middle and half axes are dragged.

use egui::{Color32, CursorIcon, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, vec2};
use glam::{DVec3, UVec2};
use tyndall_clouds::ellipsoid_list::PlacedEllipsoid;
use tyndall_scene::{Scene, camera::CameraFrame};

use crate::{
    cloud_tools::{CloudTools, base_altitude_m, centre_now_m, list_bubbles},
    panels::row::rename,
};

/// Bubbles with wires, the nearest ones; and those of them with handles.
const MOST_WIRES: usize = 40;
const MOST_HANDLES: usize = 8;

/// Pieces of a circle.
const PIECES: usize = 40;

/// Size of a handle, and of the place where it is taken hold of.
const HANDLE_PT: f32 = 4.5;
const GRASP_PT: f32 = 16.0;

/// Least half axis (m).
const LEAST_RADIUS_M: f64 = 20.0;

/// Colours of wires and of handles.
const WIRE: Color32 = Color32::from_rgba_premultiplied(150, 110, 30, 150);
const HANDLE: Color32 = Color32::from_rgb(255, 214, 90);
const OUTLINE: Color32 = Color32::from_black_alpha(160);

/// What a handle changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Centre,
    Radius(usize),
}

/// The view, to project with.
pub(crate) struct Eye {
    frame: CameraFrame,
    rect: Rect,
    scale: f32,
}

impl Eye {
    /// Of a scene's camera in a rectangle of the window; directions are found to a part of a point.
    pub(crate) fn new(scene: &Scene, rect: Rect) -> Self {
        Self { frame: CameraFrame::new(&scene.grounded().camera), rect, scale: 64.0 }
    }

    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    fn size(&self) -> UVec2 {
        let size = self.rect.size() * self.scale;
        UVec2::new(size.x.round() as u32, size.y.round() as u32).max(UVec2::ONE)
    }

    /// Where a place (m) is seen; `None` behind the camera.
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    pub(crate) fn point(&self, place: DVec3) -> Option<Pos2> {
        let away = place - self.frame.position;
        let found = match self.frame.orthographic_m {
            None => self.frame.point_px(away.try_normalize()?, self.size())?,
            Some(width_m) => {
                let per_m = f64::from(self.size().x) / width_m;
                let across = glam::dvec2(away.dot(self.frame.right), -away.dot(self.frame.up)) * per_m;
                across + self.size().as_dvec2() / 2.0
            }
        };
        Some(self.rect.min + vec2(found.x as f32, found.y as f32) / self.scale)
    }

    /// Start (m) and direction of the line of sight through a point.
    pub(crate) fn sight(&self, point: Pos2) -> (DVec3, DVec3) {
        let offset = (point - self.rect.min) * self.scale;
        let pixel = glam::dvec2(f64::from(offset.x), f64::from(offset.y));
        (self.frame.eye(pixel, self.size()), self.frame.ray(pixel, self.size()))
    }

    /// Where the line of sight through a point meets an altitude (m east and north); `None` when it does not.
    pub(crate) fn at_altitude(&self, point: Pos2, altitude_m: f64) -> Option<[f64; 2]> {
        let (eye, direction) = self.sight(point);
        let distance = (altitude_m - eye.z) / direction.z;
        let place = eye + direction * distance;
        (distance.is_finite() && distance > 0.0).then_some([place.x, place.y])
    }
}

/// Paints or erases where the pointer meets the condensation level.
pub(crate) fn paint(ui: &Ui, response: &egui::Response, scene: &mut Scene, tools: &mut CloudTools) {
    let eye = Eye::new(scene, response.rect);
    let pointer =
        response.interact_pointer_pos().filter(|_| response.dragged() || response.is_pointer_button_down_on());
    let Some(place_m) = pointer.and_then(|pointer| eye.at_altitude(pointer, base_altitude_m(scene))) else { return };
    // Beyond the grid the sky repeats, and so far away a brush covers less than a pixel.
    let time_s = f64::from(ui.input(|input| input.stable_dt)).min(0.1);
    tools.paint(scene, place_m, time_s);
    ui.ctx().request_repaint();
}

/// Draws the bubbles and follows the handles; whether one is held.
pub(crate) fn show(ui: &mut Ui, rect: Rect, scene: &mut Scene, tools: &mut CloudTools) -> bool {
    let eye = Eye::new(scene, rect);
    let mut bubbles = tools.bubbles(scene).to_vec();
    let nearest = nearest(&eye, scene, &bubbles);
    let mut held = None;
    for (order, &index) in nearest.iter().enumerate() {
        let Some(bubble) = bubbles.get(index) else { continue };
        let centre = DVec3::from(centre_now_m(scene, bubble));
        wires(ui, &eye, centre, bubble);
        if order < MOST_HANDLES {
            held = held.or(handles(ui, &eye, centre, (index, bubble)));
        }
    }
    let Some((index, part, delta)) = held else { return false };
    if let Some(bubble) = bubbles.get_mut(index) {
        pull(&eye, DVec3::from(centre_now_m(scene, bubble)), bubble, part, delta);
        if !list_bubbles(scene, &bubbles) {
            // Only so many fit into a scene: those near the camera stay.
            let kept: Vec<_> = nearest.iter().filter_map(|index| bubbles.get(*index)).copied().collect();
            list_bubbles(scene, &kept);
        }
    }
    true
}

/// The bubbles in front of the camera, the nearest first.
fn nearest(eye: &Eye, scene: &Scene, bubbles: &[PlacedEllipsoid]) -> Vec<usize> {
    let place = |bubble| DVec3::from(centre_now_m(scene, bubble));
    let mut seen: Vec<_> = bubbles.iter().enumerate().map(|(index, bubble)| (index, place(bubble))).collect();
    seen.retain(|(_, place)| eye.point(*place).is_some_and(|point| eye.rect.expand(80.0).contains(point)));
    seen.sort_by(|a, b| a.1.distance(eye.frame.position).total_cmp(&b.1.distance(eye.frame.position)));
    seen.truncate(MOST_WIRES);
    seen.into_iter().map(|(index, _)| index).collect()
}

/// Three circles of an ellipsoid; only the part above the base supplies vapour, but all of it is drawn.
fn wires(ui: &Ui, eye: &Eye, centre: DVec3, bubble: &PlacedEllipsoid) {
    let axes = axes(bubble);
    let painter = ui.painter_at(eye.rect);
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        let mut piece = Vec::new();
        for step in 0..=PIECES {
            let (sine, cosine) = (std::f64::consts::TAU * step as f64 / PIECES as f64).sin_cos();
            match eye.point(centre + axes[a] * cosine + axes[b] * sine) {
                Some(point) => piece.push(point),
                None => drop(painter.add(Shape::line(std::mem::take(&mut piece), Stroke::new(1.2, WIRE)))),
            }
        }
        painter.add(Shape::line(piece, Stroke::new(1.2, WIRE)));
    }
}

fn axes(bubble: &PlacedEllipsoid) -> [DVec3; 3] {
    let [east, north, up] = bubble.radii_m;
    [DVec3::X * east, DVec3::Y * north, DVec3::Z * up]
}

/// Draws the handles of a bubble; the one that is being dragged and by how much.
fn handles(
    ui: &mut Ui,
    eye: &Eye,
    centre: DVec3,
    (index, bubble): (usize, &PlacedEllipsoid),
) -> Option<(usize, Part, Vec2)> {
    let ends = axes(bubble).map(|axis| centre + axis);
    let parts = [Part::Centre, Part::Radius(0), Part::Radius(1), Part::Radius(2)];
    let mut held = None;
    for (part, place) in parts.into_iter().zip([centre, ends[0], ends[1], ends[2]]) {
        let Some(point) = eye.point(place).filter(|point| eye.rect.contains(*point)) else { continue };
        let id = ui.scope_id().with(("bubble", index, part_name(part)));
        let response = ui.interact(Rect::from_center_size(point, Vec2::splat(GRASP_PT)), id, Sense::drag());
        rename(ui, &response, &format!("Bubble {}: {}", index + 1, part_name(part)));
        let lit = response.hovered() || response.dragged();
        let radius = if part == Part::Centre { HANDLE_PT + 1.5 } else { HANDLE_PT };
        let colour = if lit { Color32::WHITE } else { HANDLE };
        ui.painter().circle(point, radius, colour, Stroke::new(1.0, OUTLINE));
        let delta = drag_delta(ui, &response);
        if delta != Vec2::ZERO {
            held = Some((index, part, delta));
        }
        response.on_hover_cursor(CursorIcon::Grab);
    }
    held
}

/// How far a drag has gone since the last frame, the frame of its end included: where frames take long, much of the way is
/// in that one.
pub(crate) fn drag_delta(ui: &Ui, response: &egui::Response) -> Vec2 {
    if response.drag_stopped() { ui.input(|input| input.pointer.delta()) } else { response.drag_delta() }
}

fn part_name(part: Part) -> &'static str {
    match part {
        Part::Centre => "middle",
        Part::Radius(0) => "half axis east",
        Part::Radius(1) => "half axis north",
        Part::Radius(_) => "half axis up",
    }
}

/// Moves what a handle stands for by a way on the screen: the middle along its altitude, an axis along itself.
fn pull(eye: &Eye, centre: DVec3, bubble: &mut PlacedEllipsoid, part: Part, delta: Vec2) {
    match part {
        Part::Centre => {
            let to = eye.point(centre).and_then(|point| eye.at_altitude(point + delta, centre.z));
            if let Some([east, north]) = to {
                bubble.centre_m[0] += east - centre.x;
                bubble.centre_m[1] += north - centre.y;
            }
        }
        Part::Radius(axis) => {
            let end = centre + axes(bubble)[axis];
            let unit = axes(bubble)[axis].normalize();
            let Some((from, to)) = eye.point(end).zip(eye.point(end + unit * 10.0)) else { return };
            let per_10_m = to - from;
            let along = f64::from(delta.dot(per_10_m)) / f64::from(per_10_m.length_sq()).max(1e-9);
            // Seen from its end an axis has no length on the screen: there a drag may not change it a lot.
            let change_m = (10.0 * along).clamp(-0.5 * bubble.radii_m[axis], bubble.radii_m[axis]);
            bubble.radii_m[axis] = (bubble.radii_m[axis] + change_m).max(LEAST_RADIUS_M);
        }
    }
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    fn eye() -> Eye {
        let mut scene = Scene::default();
        scene.camera.pitch_deg = 30.0;
        Eye::new(&scene, Rect::from_min_size(pos2(40.0, 30.0), vec2(800.0, 500.0)))
    }

    #[test]
    fn a_point_and_its_place_at_an_altitude_lead_to_each_other() {
        let eye = eye();
        let place = DVec3::new(300.0, 2500.0, 1150.0);
        let point = eye.point(place).expect("in front of the camera");
        let [east, north] = eye.at_altitude(point, 1150.0).expect("above the camera");
        // Points are found to a 64th.
        assert!((east - 300.0).abs() < 2.0 && (north - 2500.0).abs() < 5.0, "{east} {north}");
        assert!(eye.at_altitude(point, -100.0).is_none(), "the line of sight goes up");
        assert!(eye.point(DVec3::new(0.0, -500.0, 100.0)).is_none(), "behind the camera");
    }

    #[test]
    fn an_orthographic_view_projects_by_its_width() {
        let mut scene = Scene::default();
        scene.camera.projection = tyndall_scene::CameraProjection::Orthographic;
        (scene.camera.width_m, scene.camera.pitch_deg) = (4000.0, 20.0);
        let eye = Eye::new(&scene, Rect::from_min_size(pos2(0.0, 0.0), vec2(800.0, 500.0)));
        let place = DVec3::new(1000.0, 900.0, 600.0);
        let point = eye.point(place).expect("seen");
        assert!((point.x - 600.0).abs() < 0.1, "a quarter of the width to the right: {point:?}");
        let [east, north] = eye.at_altitude(point, 600.0).expect("the line of sight rises");
        assert!((east - 1000.0).abs() < 1.0 && (north - 900.0).abs() < 1.0, "{east} {north}");
    }

    #[test]
    fn the_middle_follows_the_pointer_and_an_axis_its_end() {
        let (eye, mut bubble) =
            (eye(), PlacedEllipsoid { centre_m: [0.0, 2500.0, 0.0], radii_m: [400.0, 300.0, 500.0] });
        let centre = DVec3::new(0.0, 2500.0, 1150.0);
        let before = eye.point(centre).expect("seen");
        pull(&eye, centre, &mut bubble, Part::Centre, vec2(30.0, -10.0));
        let after = eye.point(DVec3::new(bubble.centre_m[0], bubble.centre_m[1], 1150.0)).expect("seen");
        assert!((after - before - vec2(30.0, -10.0)).length() < 0.3, "{:?}", after - before);
        pull(&eye, centre, &mut bubble, Part::Radius(0), vec2(40.0, 0.0));
        assert!(bubble.radii_m[0] > 500.0 && (bubble.radii_m[1] - 300.0).abs() < 1e-9, "{bubble:?}");
        pull(&eye, centre, &mut bubble, Part::Radius(0), vec2(-9000.0, 0.0));
        assert!(bubble.radii_m[0] >= LEAST_RADIUS_M, "{bubble:?}");
    }
}
