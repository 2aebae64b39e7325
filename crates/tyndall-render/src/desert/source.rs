//! The bed and the tile of ripples of a scene, made again when what they follow from has changed.

use std::path::PathBuf;
use std::sync::Arc;

use tyndall_core::table_store::TableStore;
use tyndall_dunes::{DesertParams, DesertSimulation};
use tyndall_scene::{DesertSceneParams, RippleParams, Scene};

use super::bed::Bed;
use super::kept;
use super::ripple_tile::RippleTile;
use crate::RenderError;
use crate::desert_inputs::desert_inputs;

/// What a bed follows from.
type Wanted = (DesertParams, DesertSceneParams, PathBuf);

/// Bed and ripples of the last scene.
#[derive(Debug, Default)]
pub(super) struct BedSource {
    store: Option<Arc<dyn TableStore>>,
    simulation: Option<DesertSimulation>,
    bed: Option<(Wanted, Bed)>,
    tile: Option<((RippleParams, u32), RippleTile)>,
    revisions: [u64; 2],
}

impl BedSource {
    /// Chooses where fields are kept between runs.
    pub(super) fn set_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        self.store = store;
    }

    /// Makes what the scene needs.
    pub(super) fn update(&mut self, scene: &Scene) -> Result<(), RenderError> {
        let Some(params) = scene.dune_params() else {
            (self.bed, self.tile) = (None, None);
            return Ok(());
        };
        let wanted = (params, scene.desert.clone(), scene.folder.to_path_buf());
        if self.bed.as_ref().is_none_or(|(held, _)| *held != wanted) {
            let simulation = self.simulate(scene, &wanted.0)?;
            let bed = Bed::new(&simulation)?;
            (self.simulation, self.bed) = (Some(simulation), Some((wanted, bed)));
            self.revisions[0] += 1;
        }
        let wanted = (scene.ripples.clone(), scene.desert.ripple_steps);
        if self.tile.as_ref().is_none_or(|(held, _)| *held != wanted) {
            let tile = RippleTile::new(&wanted.0, wanted.1)?;
            self.tile = Some((wanted, tile));
            self.revisions[1] += 1;
        }
        Ok(())
    }

    /// The field at the scene's step: the last one goes on, a kept one is taken, or it starts anew.
    fn simulate(&mut self, scene: &Scene, params: &DesertParams) -> Result<DesertSimulation, RenderError> {
        let (inputs, steps) = (desert_inputs(scene)?, scene.desert.steps);
        let goes_on = |known: &DesertSimulation| {
            known.params() == params && known.inputs() == &inputs && known.step_count() <= steps
        };
        if let Some(mut known) = self.simulation.take().filter(goes_on) {
            known.advance(steps - known.step_count());
            return Ok(known);
        }
        let kept = self.store.as_deref().zip(kept::key(params, &inputs, steps));
        if let Some((store, key)) = &kept
            && let Some(simulation) = kept::load(*store, key, (params, &inputs, steps))?
        {
            return Ok(simulation);
        }
        let mut simulation = DesertSimulation::cold(params, &inputs)?;
        simulation.advance(steps);
        if let Some((store, key)) = kept {
            kept::store(store, &key, &simulation);
        }
        Ok(simulation)
    }

    /// The bed of the last scene.
    pub(super) fn bed(&self) -> Option<&Bed> {
        self.bed.as_ref().map(|(_, bed)| bed)
    }

    /// Its ripples.
    pub(super) fn tile(&self) -> Option<&RippleTile> {
        self.tile.as_ref().map(|(_, tile)| tile)
    }

    /// Numbers that change with the bed and with the ripples.
    pub(super) fn revisions(&self) -> [u64; 2] {
        self.revisions
    }
}
