//! What the user does to vapour by hand: painting and erasing on the map of the scene, and moving bubbles.
//!
//! Everything is kept in the scene's texts `cloud_vapour.painted` and `cloud_vapour.ellipsoids`, so that undo and files have
//! it. Paint and bubbles drift with the wind; what is pointed at is where they are now.

use tyndall_clouds::{
    ellipsoid_list::{PlacedEllipsoid, ellipsoids_to_text, parse_ellipsoids},
    painted_map::{PaintedMap, brush},
    vapour::bubbles,
};
use tyndall_core::{grid::Grid2, params::MAX_TEXT_BYTES};
use tyndall_scene::{CloudKind, CloudParams, Scene};

use crate::panels::wind::wind_m_s;

/// What dragging on the view or the map does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum CloudTool {
    /// What it does without clouds.
    #[default]
    None,
    /// Brings vapour.
    Paint,
    /// Takes vapour away.
    Erase,
    /// Moves and stretches bubbles.
    Bubbles,
}

/// The tool and the brush.
#[derive(Clone, Debug)]
pub(crate) struct CloudTools {
    pub(crate) tool: CloudTool,
    /// Radius of the brush (m).
    pub(crate) radius_m: f64,
    /// Change of the level in the middle of the brush per second.
    pub(crate) strength: f64,
    /// The text that was painted last, and its levels before they were rounded.
    stroke: Option<(String, Grid2<f64>)>,
    /// The bubbles of a layout that was asked for last: making them takes a while.
    known: Option<(CloudParams, Vec<PlacedEllipsoid>)>,
}

impl Default for CloudTools {
    fn default() -> Self {
        Self { tool: CloudTool::None, radius_m: 800.0, strength: 2.0, stroke: None, known: None }
    }
}

impl CloudTools {
    /// Whether dragging paints or erases in this scene.
    pub(crate) fn paints(&self, scene: &Scene) -> bool {
        scene.clouds.kind == CloudKind::Automaton && matches!(self.tool, CloudTool::Paint | CloudTool::Erase)
    }

    /// Whether bubbles are shown and moved in this scene.
    pub(crate) fn moves_bubbles(&self, scene: &Scene) -> bool {
        scene.clouds.kind == CloudKind::Automaton && self.tool == CloudTool::Bubbles
    }

    /// Paints or erases for a while (s) around a place (m east and north of the grid's middle).
    pub(crate) fn paint(&mut self, scene: &mut Scene, place_m: [f64; 2], time_s: f64) {
        let text = &scene.cloud_vapour.painted;
        let known = self.stroke.take().filter(|(painted, _)| painted == text);
        let Some(mut levels) = known.map(|(_, levels)| levels).or_else(|| Some(PaintedMap::parse(text).ok()?.levels()))
        else {
            return;
        };
        let amount = self.strength * time_s * if self.tool == CloudTool::Erase { -1.0 } else { 1.0 };
        let (side_m, drift) = (side_m(scene), drift_m(scene, 0.0));
        let share = |axis: usize, metres: f64| (metres - drift[axis]) / side_m[axis] + 0.5;
        brush(
            &mut levels,
            [0, 1].map(|axis| share(axis, place_m[axis])),
            side_m.map(|side| self.radius_m / side),
            amount,
        );
        scene.cloud_vapour.painted = PaintedMap::from_levels(&levels).to_text();
        self.stroke = Some((scene.cloud_vapour.painted.clone(), levels));
    }

    /// The bubbles as they were at the start of the simulation: those listed, or else the pattern's.
    pub(crate) fn bubbles(&mut self, scene: &Scene) -> &[PlacedEllipsoid] {
        let Some(params) = scene.cloud_params() else { return &[] };
        let known = self.known.take().filter(|(known, _)| *known == params);
        let make = || {
            let listed = parse_ellipsoids(&params.vapour.ellipsoids).unwrap_or_default();
            let of_pattern = || bubbles(&params).iter().map(|one| PlacedEllipsoid::from_cells(one, &params)).collect();
            let all = if listed.is_empty() { of_pattern() } else { listed };
            (params.clone(), all)
        };
        &self.known.insert(known.unwrap_or_else(make)).1
    }
}

/// Writes a list of bubbles into the scene; false when it is too long for a text.
pub(crate) fn list_bubbles(scene: &mut Scene, bubbles: &[PlacedEllipsoid]) -> bool {
    let text = ellipsoids_to_text(bubbles);
    let fits = text.len() <= MAX_TEXT_BYTES;
    if fits {
        scene.cloud_vapour.ellipsoids = text;
    }
    fits
}

/// Sides of the grid east and north (m).
pub(crate) fn side_m(scene: &Scene) -> [f64; 2] {
    let grid = &scene.cloud_grid;
    [grid.cells_east, grid.cells_north].map(|cells| f64::from(cells) * grid.cell_m)
}

/// Altitude (m) of the condensation level.
pub(crate) fn base_altitude_m(scene: &Scene) -> f64 {
    scene.cloud_grid.floor_m + scene.cloud_vapour.base_m
}

/// How far the air at a height above the condensation level (m) has drifted since the start of the simulation (m).
pub(crate) fn drift_m(scene: &Scene, height_m: f64) -> [f64; 2] {
    let grid = &scene.cloud_grid;
    let share = (scene.cloud_vapour.base_m + height_m) / (f64::from(grid.cells_up) * grid.cell_m);
    let time_s = scene.clouds.time_s + f64::from(grid.warm_up_steps) * grid.step_s;
    wind_m_s(&scene.cloud_wind, share.clamp(0.0, 1.0)).map(|speed| speed * time_s)
}

/// Where the middle of a bubble is now (m): within the grid, which it leaves on one side and enters on the other.
pub(crate) fn centre_now_m(scene: &Scene, bubble: &PlacedEllipsoid) -> [f64; 3] {
    let (side_m, drift) = (side_m(scene), drift_m(scene, bubble.centre_m[2]));
    let [east, north] = [0, 1].map(|axis| {
        let half = 0.5 * side_m[axis];
        (bubble.centre_m[axis] + drift[axis] + half).rem_euclid(side_m[axis]) - half
    });
    [east, north, base_altitude_m(scene) + bubble.centre_m[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloudy() -> Scene {
        let mut scene = Scene::default();
        scene.clouds.kind = CloudKind::Automaton;
        scene
    }

    #[test]
    fn a_slow_stroke_paints_as_much_as_a_quick_one() {
        let paint = |steps: u32| {
            let mut scene = cloudy();
            let mut tools = CloudTools { tool: CloudTool::Paint, ..CloudTools::default() };
            (0..steps).for_each(|_| tools.paint(&mut scene, [300.0, -200.0], 0.4 / f64::from(steps)));
            scene.cloud_vapour.painted
        };
        assert_eq!(paint(1), paint(40), "less than a level at a time adds up too");
        assert!(!paint(1).is_empty(), "something is painted");
    }

    #[test]
    fn what_was_painted_is_erased_where_it_has_drifted() {
        let mut scene = cloudy();
        let mut tools = CloudTools { tool: CloudTool::Paint, ..CloudTools::default() };
        tools.paint(&mut scene, [0.0, 0.0], 0.25);
        let before = drift_m(&scene, 0.0);
        scene.clouds.time_s = 1000.0;
        let after = drift_m(&scene, 0.0);
        tools.tool = CloudTool::Erase;
        tools.paint(&mut scene, [after[0] - before[0], after[1] - before[1]], 0.25);
        assert!(scene.cloud_vapour.painted.is_empty(), "nothing is left: {}", scene.cloud_vapour.painted);
    }

    #[test]
    fn bubbles_are_listed_where_the_simulation_has_them() {
        let mut scene = cloudy();
        let mut tools = CloudTools::default();
        let first: Vec<_> = tools.bubbles(&scene).iter().take(20).copied().collect();
        assert!(list_bubbles(&mut scene, &first), "short enough");
        let listed = tools.bubbles(&scene).to_vec();
        assert_eq!(listed.len(), 20, "{}", scene.cloud_vapour.ellipsoids);
        // Lists are written to the metre.
        let away = (listed[3].centre_m[0] - first[3].centre_m[0]).abs();
        assert!(away <= 0.5, "{away} m");
        assert!(!list_bubbles(&mut scene, &vec![listed[0]; 400]), "too long for a text");
    }
}
