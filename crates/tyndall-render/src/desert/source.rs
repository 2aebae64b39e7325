//! The bed and the tile of ripples that frames show, asked for again when what they follow from has changed.

use std::sync::Arc;

use tyndall_core::array::NamedArrays;
use tyndall_core::table_store::TableStore;
use tyndall_dunes::DuneStepper;
use tyndall_scene::Scene;

use super::bed::Bed;
use super::building::Making;
use super::maker::{BedRequest, MadeBed};
use super::report::DesertReport;
use super::ripple_tile::RippleTile;
use super::shared_stepper::SharedStepper;
use crate::RenderError;
use crate::sky::TableBuilding;

/// How the desert stands after a frame.
#[derive(Clone, Debug, Default)]
pub struct DesertProgress {
    /// Whether the sand shown is not yet that of the scene.
    pub building: bool,
    /// Figures of the sand shown; `None` without any.
    pub report: Option<Arc<DesertReport>>,
    /// The bed shown, to find places on it; `None` without one.
    pub bed: Option<Arc<Bed>>,
}

/// Bed and ripples of the last scene.
#[derive(Debug, Default)]
pub(super) struct BedSource {
    making: Making,
    building: TableBuilding,
    /// Whether beds follow each other quickly.
    is_quick: bool,
    store: Option<Arc<dyn TableStore>>,
    start: Option<NamedArrays>,
    stepper: Option<SharedStepper>,
    shown: Option<(BedRequest, MadeBed)>,
    /// What could not be made, and why.
    refused: Option<(BedRequest, Arc<RenderError>)>,
    revisions: [u64; 2],
    progress: DesertProgress,
}

impl BedSource {
    /// Chooses who makes beds; what is shown stays.
    pub(super) fn set_building(&mut self, building: TableBuilding) {
        self.building = building;
        self.begin();
    }

    /// Others who make beds; those before are not heard any longer.
    fn begin(&mut self) {
        self.making = Making::new(self.building.clone());
        self.making.set_store(self.store.clone());
        self.making.start_from(self.start.clone());
        self.pass_on_stepper();
    }

    /// Chooses who makes steps; the processor unless chosen.
    pub(super) fn set_stepper(&mut self, device: Option<Box<dyn DuneStepper>>) {
        self.stepper = device.map(SharedStepper::new);
        self.pass_on_stepper();
    }

    fn pass_on_stepper(&mut self) {
        self.making.set_stepper(self.stepper.clone().map(|device| Box::new(device) as _));
    }

    /// Chooses a state that fields start from in place of step 0; what was made from another is forgotten.
    pub(super) fn start_from(&mut self, state: Option<NamedArrays>) {
        self.start = state;
        self.begin();
        (self.shown, self.refused) = (None, None);
    }

    /// Chooses where fields are kept between runs.
    pub(super) fn set_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        self.store.clone_from(&store);
        self.making.set_store(store);
    }

    /// Chooses whether beds are soon followed by others and may be a little less exact.
    pub(super) fn set_quick(&mut self, is_quick: bool) {
        self.is_quick = is_quick;
    }

    /// Whether beds are soon followed by others.
    pub(super) fn is_quick(&self) -> bool {
        self.is_quick
    }

    /// Takes what the scene needs: the bed before, where a thread is still at this one.
    pub(super) fn update(&mut self, scene: &Scene) -> Result<(), RenderError> {
        let Some(request) = BedRequest::of(scene, self.is_quick) else {
            self.making.cancel();
            (self.shown, self.progress) = (None, DesertProgress::default());
            return Ok(());
        };
        let is_refused = self.refused.as_ref().is_some_and(|(refused, _)| *refused == request);
        if let Some((request, made)) = self.making.next((!self.shows(&request) && !is_refused).then_some(&request)) {
            match made {
                Ok(made) => self.show(request, made),
                Err(error) => self.refused = Some((request, Arc::new(error))),
            }
        }
        let made = self.shown.as_ref().map(|(_, made)| made);
        self.progress = DesertProgress {
            building: !self.shows(&request),
            report: made.map(|made| Arc::clone(&made.report)),
            bed: made.map(|made| Arc::clone(&made.bed)),
        };
        if let Some((_, error)) = self.refused.as_ref().filter(|(refused, _)| *refused == request) {
            self.progress.building = false;
            return Err(RenderError::Refused(Arc::clone(error)));
        }
        Ok(())
    }

    /// Whether a request is shown, and not only what was made on the way to it.
    fn shows(&self, request: &BedRequest) -> bool {
        let is_done = |(shown, made): &(BedRequest, MadeBed)| shown == request && made.report.step == shown.steps();
        self.shown.as_ref().is_some_and(is_done)
    }

    fn show(&mut self, request: BedRequest, made: MadeBed) {
        let known = self.shown.as_ref().is_some_and(|(_, before)| Arc::ptr_eq(&before.tile, &made.tile));
        self.revisions = [self.revisions[0] + 1, self.revisions[1] + u64::from(!known)];
        self.shown = Some((request, made));
    }

    /// How it stands since the last update.
    pub(super) fn progress(&self) -> &DesertProgress {
        &self.progress
    }

    /// The bed shown.
    pub(super) fn bed(&self) -> Option<&Bed> {
        self.shown.as_ref().map(|(_, made)| &*made.bed)
    }

    /// Its ripples.
    pub(super) fn tile(&self) -> Option<&RippleTile> {
        self.shown.as_ref().map(|(_, made)| &*made.tile)
    }

    /// Numbers that change with the bed and with the ripples.
    pub(super) fn revisions(&self) -> [u64; 2] {
        self.revisions
    }
}
