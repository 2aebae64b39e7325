//! What the user does to sand by hand: strokes of brushes on the view, kept in the scene's text `desert.strokes`, so that
//! undo and files have them.

use tyndall_core::params::MAX_TEXT_BYTES;
use tyndall_dunes::by_hand::{HandStroke, HandTool, parse_strokes, strokes_to_text};
use tyndall_scene::{DesertKind, Scene};

/// Distance between the points of a stroke, in radii, for brushes and for feet.
const POINTS_APART: f64 = 0.5;
const FEET_APART: f64 = 3.0;

/// Share of the relief that a touch flattens.
const FLATTENED: f64 = 0.5;

/// The tool and the brush.
#[derive(Clone, Debug)]
pub(crate) struct DesertTools {
    /// What dragging on the view does; `None` for what it does without a desert.
    pub(crate) tool: Option<HandTool>,
    /// Radius of the brush (m).
    pub(crate) radius_m: f64,
    /// Depth of a touch (m).
    pub(crate) depth_m: f64,
    /// Whether the last stroke did not fit into the scene.
    pub(crate) is_full: bool,
    /// Whether a stroke is under way.
    is_held: bool,
}

impl Default for DesertTools {
    fn default() -> Self {
        Self { tool: None, radius_m: 8.0, depth_m: 0.5, is_full: false, is_held: false }
    }
}

impl DesertTools {
    /// The tool, where there is sand for it.
    pub(crate) fn active(&self, scene: &Scene) -> Option<HandTool> {
        self.tool.filter(|_| scene.desert.kind == DesertKind::Dunes)
    }

    /// Radius (m) of what the tool touches: half a foot's width for feet.
    pub(crate) fn touched_radius_m(&self) -> f64 {
        // A foot is 2.6 times as long as wide.
        if self.tool == Some(HandTool::Walk) { self.radius_m / 2.6 } else { self.radius_m }
    }

    /// Goes on with a stroke, or begins one, at a place (m east and north of the field's middle).
    pub(crate) fn stroke(&mut self, scene: &mut Scene, place_m: [f64; 2]) {
        let Some(tool) = self.active(scene) else { return };
        let Ok(mut strokes) = parse_strokes(&scene.desert.strokes) else { return };
        let radius_m = round(self.touched_radius_m());
        if let Some(last) = strokes.last_mut().filter(|last| self.is_held && last.tool == tool) {
            let apart_m = last.radius_m * if tool == HandTool::Walk { FEET_APART } else { POINTS_APART };
            let is_far = |at: &[f64; 2]| (at[0] - place_m[0]).hypot(at[1] - place_m[1]) >= apart_m;
            if !last.path_m.last().is_none_or(is_far) {
                return;
            }
            last.path_m.push(place_m);
        } else {
            let amount = if tool == HandTool::Flatten { FLATTENED } else { round(self.depth_m) };
            let step = scene.desert.steps;
            strokes.push(HandStroke { step, tool, radius_m, amount, path_m: vec![place_m] });
        }
        self.is_held = true;
        let text = strokes_to_text(&strokes);
        self.is_full = text.len() > MAX_TEXT_BYTES;
        if !self.is_full {
            scene.desert.strokes = text;
        }
    }

    /// Whether a stroke is under way.
    pub(crate) fn is_held(&self) -> bool {
        self.is_held
    }

    /// Ends a stroke.
    pub(crate) fn let_go(&mut self) {
        self.is_held = false;
    }
}

/// To three digits, so that texts are short.
fn round(value: f64) -> f64 {
    let scale = 10_f64.powf(2.0 - value.abs().max(1e-9).log10().floor());
    (value * scale).round() / scale
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sandy() -> Scene {
        let mut scene = Scene::default();
        scene.desert.kind = DesertKind::Dunes;
        scene.desert.steps = 40;
        scene
    }

    #[test]
    fn a_drag_is_one_stroke_and_the_next_press_another() {
        let mut scene = sandy();
        let mut tools = DesertTools { tool: Some(HandTool::Dig), ..DesertTools::default() };
        for east_m in [0.0, 1.0, 2.0, 5.0, 9.0] {
            tools.stroke(&mut scene, [east_m, 3.0]);
        }
        tools.let_go();
        tools.stroke(&mut scene, [20.0, 0.0]);
        assert_eq!(scene.desert.strokes, "40 dig 8 0.5 0 3 5 3 9 3; 40 dig 8 0.5 20 0", "points half a radius apart");
        tools.tool = None;
        tools.stroke(&mut scene, [50.0, 0.0]);
        assert!(!scene.desert.strokes.contains("50"), "no tool, no stroke: {}", scene.desert.strokes);
    }

    #[test]
    fn a_full_list_keeps_what_it_has_and_says_so() {
        let mut scene = sandy();
        let mut tools = DesertTools { tool: Some(HandTool::Add), ..DesertTools::default() };
        for index in 0..2000 {
            tools.stroke(&mut scene, [10.0 * f64::from(index), 0.0]);
        }
        assert!(tools.is_full && scene.desert.strokes.len() <= MAX_TEXT_BYTES, "{}", scene.desert.strokes.len());
        assert!(scene.check().is_ok(), "an allowed scene");
    }
}
