//! Deserts to start from.

use crate::DuneError;
use crate::ripples::{RippleBed, RippleParams};
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
    let sparse = DuneParams { noise_cells: 0.1, ..sand(0.4) };
    let wind = |winds: u32, divergence_deg: f64, period_steps: u32| WindParams {
        winds,
        divergence_deg,
        period_steps,
        ..WindParams::default()
    };
    let bare = VegetationParams::default();
    let planted = VegetationParams { enabled: true, ..VegetationParams::default() };
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
        preset("seif", "Long ridges between two winds", sand(1.6), wind(2, 150.0, 100), &bare, 3000),
        preset("star", "Peaks with arms under winds from three sides", sand(1.5), wind(3, 120.0, 90), &bare, 4000),
        preset("nebkha", "Heaps with tails behind clumps of plants", sparse, wind(1, 0.0, 100), &planted, 600),
    ]
}

/// A preset by its name.
#[must_use]
pub fn dune_preset(name: &str) -> Option<DunePreset> {
    dune_presets().into_iter().find(|preset| preset.name == name)
}

/// A bed of ripples to start from.
#[derive(Clone, Debug, PartialEq)]
pub struct RipplePreset {
    /// Short name.
    pub name: &'static str,
    /// What one sees.
    pub title: &'static str,
    /// The bed.
    pub ripples: RippleParams,
    /// Steps until the ripples are grown.
    pub steps: u32,
}

impl RipplePreset {
    /// The bed at step 0.
    ///
    /// # Errors
    /// As [`RippleBed::new`]; the preset as it is given raises none.
    pub fn bed(&self) -> Result<RippleBed, DuneError> {
        RippleBed::new(&self.ripples)
    }
}

/// The tile of ripples that dunes are covered with.
#[must_use]
pub fn ripple_preset() -> RipplePreset {
    RipplePreset {
        name: "ripple-bed",
        title: "Wind ripples, seen from where one stands",
        ripples: RippleParams::default(),
        steps: 1500,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::SandSimulation as _;

    #[test]
    fn every_preset_starts_and_steps() {
        for preset in dune_presets() {
            let mut field = preset.field().unwrap();
            field.step();
            assert_eq!(field.mass_quanta(), field.ledger().expected(), "{}", preset.name);
            assert_eq!(dune_preset(preset.name), Some(preset.clone()), "{} by its name", preset.name);
        }
        ripple_preset().bed().unwrap().step();
        assert_eq!(dune_preset("dune"), None, "no such preset");
    }
}
