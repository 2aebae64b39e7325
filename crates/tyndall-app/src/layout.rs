//! Which panels there are and how they are tiled.

use egui_tiles::{Container, Linear, LinearDir, Tile, Tiles, Tree};

/// A panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub(crate) enum Pane {
    Viewport,
    Parameters,
    Camera,
    Time,
    Clouds,
    Desert,
    Export,
    Gallery,
    Plots,
    Accuracy,
    Timings,
    Log,
}

impl Pane {
    /// All, in the order of the menu.
    pub(crate) const ALL: [Self; 12] = [
        Self::Viewport,
        Self::Parameters,
        Self::Camera,
        Self::Time,
        Self::Clouds,
        Self::Desert,
        Self::Export,
        Self::Gallery,
        Self::Plots,
        Self::Accuracy,
        Self::Timings,
        Self::Log,
    ];

    /// Title of the tab.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Viewport => "Viewport",
            Self::Parameters => "Parameters",
            Self::Camera => "Camera",
            Self::Time => "Date and place",
            Self::Clouds => "Clouds",
            Self::Desert => "Desert",
            Self::Export => "Export",
            Self::Gallery => "Gallery",
            Self::Plots => "Plots",
            Self::Accuracy => "Accuracy",
            Self::Timings => "Timings",
            Self::Log => "Log",
        }
    }
}

/// Share of the width for the view and what is below it, and of that the share of the view's height.
const VIEW_WIDTH: f32 = 0.71;
const VIEW_HEIGHT: f32 = 0.77;
/// Share of the height for the parameters; the camera and the export are below.
const PARAMETERS_HEIGHT: f32 = 0.55;

/// The panels as they are at first.
pub(crate) fn default_tree() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let tabs = |tiles: &mut Tiles<Pane>, panes: &[Pane]| {
        let panes = panes.iter().map(|pane| tiles.insert_pane(*pane)).collect();
        tiles.insert_tab_tile(panes)
    };
    let view = tabs(&mut tiles, &[Pane::Viewport]);
    let below = tabs(&mut tiles, &[Pane::Gallery, Pane::Plots, Pane::Accuracy, Pane::Timings, Pane::Log]);
    let parameters = tabs(&mut tiles, &[Pane::Parameters]);
    let camera = tabs(&mut tiles, &[Pane::Camera, Pane::Time, Pane::Clouds, Pane::Desert, Pane::Export]);
    let split = |tiles: &mut Tiles<Pane>, dir, parts, share| {
        let linear = Linear::new_binary(dir, parts, share);
        tiles.insert_new(Tile::Container(Container::Linear(linear)))
    };
    let left = split(&mut tiles, LinearDir::Vertical, [view, below], VIEW_HEIGHT);
    let right = split(&mut tiles, LinearDir::Vertical, [parameters, camera], PARAMETERS_HEIGHT);
    let root = split(&mut tiles, LinearDir::Horizontal, [left, right], VIEW_WIDTH);
    Tree::new(egui::Id::unique("panels"), root, tiles)
}

/// Whether a tree from an earlier session has every panel exactly once.
pub(crate) fn is_complete(tree: &Tree<Pane>) -> bool {
    let count =
        |pane: Pane| tree.tiles.tiles().filter(|tile| matches!(tile, Tile::Pane(found) if *found == pane)).count();
    Pane::ALL.into_iter().all(|pane| count(pane) == 1)
}

/// Shows a panel's tab.
pub(crate) fn activate(tree: &mut Tree<Pane>, pane: Pane) {
    if let Some(tile) = tree.tiles.find_pane(&pane) {
        tree.set_visible(tile, true);
        tree.make_active(|id, _| id == tile);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_layout_has_every_panel_once() {
        assert!(is_complete(&default_tree()), "{:?}", default_tree());
    }

    #[test]
    fn a_layout_that_lost_a_panel_is_not_complete() {
        let mut tree = default_tree();
        let log = tree.tiles.find_pane(&Pane::Log).unwrap();
        tree.remove_recursively(log);
        assert!(!is_complete(&tree), "{tree:?}");
    }
}
