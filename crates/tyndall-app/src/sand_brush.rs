//! The brush in the view: where the line of sight meets the sand, the ring around that place, strokes.

use egui::{Color32, Pos2, Rect, Shape, Stroke, Ui};
use glam::DVec3;
use tyndall_dunes::Edges;
use tyndall_render::desert::bed::Bed;
use tyndall_scene::Scene;

use crate::{bubble_handles::Eye, desert_tools::DesertTools};

/// Most steps along a line of sight, and its end in sides of the field.
const MOST_STEPS: u32 = 4000;
const REACH_SIDES: f64 = 6.0;

/// Pieces of the ring.
const PIECES: u32 = 48;

/// Colours of the ring.
const RING: Color32 = Color32::from_rgb(255, 226, 150);
const OUTLINE: Color32 = Color32::from_black_alpha(140);

/// Shows the brush at the pointer and follows it while it is pressed; whether it is.
pub(crate) fn show(
    ui: &Ui,
    response: &egui::Response,
    scene: &mut Scene,
    tools: &mut DesertTools,
    bed: Option<&Bed>,
) -> bool {
    let pressed = ui.input(|input| input.pointer.primary_down()) && response.is_pointer_button_down_on();
    if !pressed {
        tools.let_go();
    }
    let pointer = response.interact_pointer_pos().filter(|_| pressed).or_else(|| response.hover_pos());
    if let (Some(bed), Some(pointer), Some(_)) = (bed, pointer, tools.active(scene))
        && let Some(place) = Eye::over(scene, response.rect, bed).place(bed, pointer)
        && pressed
    {
        tools.stroke(scene, within(bed, place));
        ui.ctx().request_repaint();
    }
    pressed
}

/// Draws the ring around the place that the pointer is at.
pub(crate) fn ring(ui: &Ui, rect: Rect, scene: &Scene, tools: &DesertTools, bed: &Bed, pointer: Pos2) {
    let eye = Eye::over(scene, rect, bed);
    let Some(middle) = eye.place(bed, pointer) else { return };
    let mut pieces = vec![Vec::new()];
    for index in 0..=PIECES {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(index) / f64::from(PIECES)).sin_cos();
        let radius_m = tools.touched_radius_m();
        let (x, y) = (middle[0] + radius_m * cosine, middle[1] + radius_m * sine);
        match (eye.point(DVec3::new(x, y, bed.at(x, y)[0])), pieces.last_mut()) {
            (Some(point), Some(piece)) => piece.push(point),
            _ => pieces.push(Vec::new()),
        }
    }
    for (width, colour) in [(4.0, OUTLINE), (1.6, RING)] {
        for piece in &pieces {
            ui.painter_at(rect).add(Shape::line(piece.clone(), Stroke::new(width, colour)));
        }
    }
}

impl Eye {
    /// Of a camera that stands on the sand.
    fn over(scene: &Scene, rect: Rect, bed: &Bed) -> Self {
        let mut scene = scene.clone();
        scene.camera.altitude_m += bed.at(scene.camera.x_m, scene.camera.y_m)[0];
        Self::new(&scene, rect)
    }

    /// Where the line of sight through a point meets the sand (m east and north); `None` where it does not.
    fn place(&self, bed: &Bed, point: Pos2) -> Option<[f64; 2]> {
        let (eye, direction) = self.sight(point);
        let over = |distance_m: f64| {
            let at = eye + direction * distance_m;
            at.z - bed.at(at.x, at.y)[0]
        };
        let side_m = bed.cell_m * bed.heights.size()[0].max(bed.heights.size()[1]) as f64;
        let mut distance_m = 0.0;
        for _ in 0..MOST_STEPS {
            let height_m = over(distance_m);
            if height_m <= 0.0 {
                break;
            }
            // Slopes stay below 45 degrees, so that a step of half the height ends above the sand.
            let next_m = distance_m + (0.5 * height_m).max(0.1 * bed.cell_m);
            if over(next_m) <= 0.0 {
                let at = eye + direction * bisect(distance_m, next_m, over);
                return Some([at.x, at.y]);
            }
            distance_m = next_m;
            if distance_m > REACH_SIDES * side_m {
                break;
            }
        }
        None
    }
}

fn bisect(mut above: f64, mut below: f64, over: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..30 {
        let middle = 0.5 * (above + below);
        if over(middle) > 0.0 { above = middle } else { below = middle }
    }
    below
}

/// The place (m) within the field that repeats there.
fn within(bed: &Bed, place_m: [f64; 2]) -> [f64; 2] {
    if bed.edges == Edges::Open {
        return place_m;
    }
    let size = bed.heights.size();
    [0, 1].map(|axis| {
        let side_m = bed.cell_m * size[axis] as f64;
        (place_m[axis] + 0.5 * side_m).rem_euclid(side_m) - 0.5 * side_m
    })
}
