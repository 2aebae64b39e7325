//! The bed and the tile of ripples of a scene, made again when what they follow from has changed.

use tyndall_dunes::{DesertParams, DesertSource};
use tyndall_scene::{DesertKind, DesertSceneParams, RippleParams, Scene};

use super::bed::Bed;
use super::ripple_tile::RippleTile;
use crate::RenderError;
use crate::desert_inputs::desert_inputs;

/// What a bed follows from.
type Wanted = (DesertParams, DesertSceneParams, std::path::PathBuf);

/// Bed and ripples of the last scene.
#[derive(Debug, Default)]
pub(super) struct BedSource {
    fields: DesertSource,
    bed: Option<(Wanted, Bed)>,
    tile: Option<((RippleParams, u32), RippleTile)>,
    revisions: [u64; 2],
}

impl BedSource {
    /// Makes what the scene needs.
    pub(super) fn update(&mut self, scene: &Scene) -> Result<(), RenderError> {
        let Some(params) = scene.dune_params().filter(|_| scene.desert.kind != DesertKind::None) else {
            (self.bed, self.tile) = (None, None);
            return Ok(());
        };
        let wanted = (params, scene.desert.clone(), scene.folder.to_path_buf());
        if self.bed.as_ref().is_none_or(|(held, _)| *held != wanted) {
            let inputs = desert_inputs(scene)?;
            let simulation = self.fields.at_unless(&wanted.0, &inputs, scene.desert.steps, &|_| false)?;
            self.bed = simulation.map(Bed::new).transpose()?.map(|bed| (wanted, bed));
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
