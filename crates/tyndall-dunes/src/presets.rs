//! Deserts to start from.

use crate::DuneError;
use crate::slab::{DuneField, DuneParams, VegetationParams};
use crate::wind::{WindParams, WindSchedule};

/// A desert by name.
#[derive(Clone, Debug, PartialEq)]
pub struct DunePreset {
    /// Short name, for command lines and files.
    pub name: &'static str,
    /// What one sees.
    pub title: &'static str,
    /// The sand.
    pub dunes: DuneParams,
    /// The winds.
    pub winds: WindParams,
    /// The plants.
    pub vegetation: VegetationParams,
    /// Steps until the desert looks like its name.
    pub steps: u32,
}

impl DunePreset {
    /// The field at step 0.
    ///
    /// # Errors
    /// As [`DuneField::new`]; the presets as they are given raise none.
    pub fn field(&self) -> Result<DuneField, DuneError> {
        let mut field = DuneField::new(&self.dunes)?;
        field.set_winds(WindSchedule::from_params(&self.winds)?);
        field.set_vegetation(&self.vegetation)?;
        Ok(field)
    }
}

/// All presets, in the order in which they are offered.
#[must_use]
pub fn dune_presets() -> Vec<DunePreset> {
    let sand = |sand_cells: f64| DuneParams { sand_cells, ..DuneParams::default() };
    let wind = |winds: u32, divergence_deg: f64, period_steps: u32| WindParams {
        winds,
        divergence_deg,
        period_steps,
        ..WindParams::default()
    };
    let bare = VegetationParams::default();
    let planted = VegetationParams { enabled: true, cover: 0.004, ..VegetationParams::default() };
    let preset = |name, title, dunes, winds, vegetation: &VegetationParams, steps| DunePreset {
        name,
        title,
        dunes,
        winds,
        vegetation: vegetation.clone(),
        steps,
    };
    vec![
        preset("transverse", "Long crests across one wind, much sand", sand(3.0), wind(1, 0.0, 100), &bare, 3000),
        preset("barchan", "Crescents on bare ground, little sand", sand(0.7), wind(1, 0.0, 100), &bare, 4000),
        preset("seif", "Long ridges along two winds", sand(0.8), wind(2, 130.0, 60), &bare, 4000),
        preset("star", "Peaks with arms under winds from all sides", sand(3.0), wind(3, 120.0, 1200), &bare, 6000),
        preset("nebkha", "Heaps of sand held by plants", sand(0.6), wind(1, 0.0, 100), &planted, 1500),
    ]
}

/// A preset by its name.
#[must_use]
pub fn dune_preset(name: &str) -> Option<DunePreset> {
    dune_presets().into_iter().find(|preset| preset.name == name)
}
