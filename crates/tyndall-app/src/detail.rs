//! The slow tables of light scattered more than once take seconds on a slow machine. They follow from the medium and the
//! ground alone: while those change the app asks for the coarse tables, and for the scene's own once it rests; either are
//! made beside the frames. Whatever does not touch them, as the camera and the sun's place do not, keeps what is there.

use tyndall_scattering::Atmosphere;
use tyndall_scene::{Orders, OrdersDetail, Scene, SkyParams};

/// Remembers which tables the renderer holds.
#[derive(Clone, Debug, Default)]
pub(crate) struct Detail {
    /// The medium and the ground of the fine ones.
    fine_for: Option<Atmosphere>,
}

impl Detail {
    /// The scene as it is to be drawn now: with coarse tables if the fine ones would have to be made first.
    pub(crate) fn quick(&mut self, scene: &Scene) -> Scene {
        let mut quick = scene.clone();
        if scene.sky.orders == Orders::All && self.fine_for.as_ref() != Some(&scene.model()) {
            quick.sky.orders_detail = OrdersDetail::Preview;
            self.fine_for = None;
        }
        quick
    }

    /// The scene itself is drawn.
    pub(crate) fn drawn_fine(&mut self, scene: &Scene) {
        self.fine_for = Some(scene.model());
    }
}

/// Least rows and columns of the sky's table in a reduced picture.
const LEAST_ELEVATIONS: u32 = 96;
const LEAST_AZIMUTHS: u32 = 32;

/// A scene for a picture of reduced resolution, which shows no more of the sky's table than half of its rows and columns.
pub(crate) fn reduced(scene: Scene) -> Scene {
    let mut reduced = scene;
    let SkyParams { table_elevations, table_azimuths, .. } = &mut reduced.sky;
    *table_elevations = (*table_elevations / 2).max(LEAST_ELEVATIONS.min(*table_elevations));
    *table_azimuths = (*table_azimuths / 2).max(LEAST_AZIMUTHS.min(*table_azimuths));
    reduced
}

/// A scene for a small picture, which shows no fine tables.
pub(crate) fn coarse(scene: &Scene) -> Scene {
    let mut coarse = scene.clone();
    coarse.sky.orders_detail = OrdersDetail::Preview;
    coarse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_camera_moves_with_fine_tables_and_the_air_changes_with_coarse_ones() {
        let mut detail = Detail::default();
        let mut scene = Scene::default();
        assert_eq!(detail.quick(&scene), coarse(&scene), "nothing is there yet");
        detail.drawn_fine(&scene);
        scene.camera.heading_deg = 90.0;
        scene.sun.elevation_deg = 3.0;
        assert_eq!(detail.quick(&scene), scene, "the tables are as before");
        scene.atmosphere.ozone_du = 100.0;
        assert_eq!(detail.quick(&scene), coarse(&scene), "new tables");
        scene.atmosphere.ozone_du = 300.0;
        assert_eq!(detail.quick(&scene), coarse(&scene), "the fine ones are gone");
    }

    #[test]
    fn a_reduced_picture_has_a_smaller_table_but_never_a_larger_one() {
        let halved = reduced(Scene::default()).sky;
        assert_eq!((halved.table_elevations, halved.table_azimuths), (160, 48), "half of the default");
        let mut small = Scene::default();
        (small.sky.table_elevations, small.sky.table_azimuths) = (40, 16);
        assert_eq!(reduced(small.clone()), small, "small already");
    }

    #[test]
    fn a_scene_without_higher_orders_is_drawn_as_it_is() {
        let mut scene = Scene::default();
        scene.sky.orders = Orders::Single;
        assert_eq!(Detail::default().quick(&scene), scene, "there are no slow tables");
    }
}
