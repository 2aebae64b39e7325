//! All that users choose of a field of dunes, in the groups of a scene.

use std::fmt::Write as _;

use tyndall_core::ParamSet;

use crate::DuneError;
use crate::slab::{AbrasionParams, ClassicParams, DuneField, DuneParams, VegetationParams};
use crate::wind::{WindParams, WindSchedule};

/// Everything that a field of dunes is made from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DesertParams {
    /// The sand.
    pub dunes: DuneParams,
    /// The rule of Onoue and Nishita, where the sand follows it.
    pub classic: ClassicParams,
    /// The winds.
    pub wind: WindParams,
    /// The plants.
    pub plants: VegetationParams,
    /// The rock under the sand.
    pub rock: AbrasionParams,
}

impl DesertParams {
    /// The groups with their names in scene files.
    #[must_use]
    pub fn groups(&self) -> [(&'static str, &dyn ParamSet); 5] {
        [
            ("dunes", &self.dunes),
            ("dune_classic", &self.classic),
            ("dune_wind", &self.wind),
            ("dune_plants", &self.plants),
            ("dune_rock", &self.rock),
        ]
    }

    /// The field at step 0, on level ground.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn field(&self) -> Result<DuneField, DuneError> {
        let mut field = DuneField::new(&self.dunes)?;
        field.set_classic(&self.classic)?;
        field.set_winds(WindSchedule::from_params(&self.wind)?);
        field.set_vegetation(&self.plants)?;
        field.set_abrasion(&self.rock, None)?;
        Ok(field)
    }

    /// Hash of the parameters that steps follow from: equal ones take one state to the same next state. The width of a
    /// cell, which steps do not know, and the sand at the start do not count.
    #[must_use]
    pub fn step_hash(&self) -> u64 {
        let mut text = String::new();
        for (group, set) in self.groups() {
            for (index, info) in set.info().iter().enumerate().filter(|(_, info)| !NOT_STEPPED.contains(&info.name)) {
                // Adding zero turns -0 into 0, which is equal to it. Writing to a String cannot fail.
                let _ = writeln!(text, "{group}.{}={}", info.name, info.format(set.get(index) + 0.0));
            }
        }
        crate::hash::fnv1a(text.as_bytes())
    }
}

/// Parameters that no step depends on.
const NOT_STEPPED: [&str; 3] = ["cell_m", "sand_cells", "noise_cells"];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SandSimulation as _;
    use crate::side::Side;
    use crate::slab::DuneModel;

    #[test]
    fn every_group_reaches_the_field() {
        let hash = |change: fn(&mut DesertParams)| {
            let mut params = DesertParams::default();
            (params.dunes.side, params.dunes.sand_cells, params.rock.rate) = (Side::Cells64, 0.3, 1.0);
            change(&mut params);
            let mut field = params.field().unwrap();
            field.run(40);
            field.state_hash()
        };
        let plain = hash(|_| ());
        assert_eq!(plain, hash(|_| ()), "the same again");
        assert_ne!(plain, hash(|params| params.dunes.seed = 2), "seed");
        assert_ne!(plain, hash(|params| params.wind.direction_deg = 90.0), "wind");
        assert_ne!(plain, hash(|params| (params.plants.enabled, params.plants.cover) = (true, 0.3)), "plants");
        assert_ne!(plain, hash(|params| params.rock.enabled = true), "rock");
        let classic = hash(|params| params.dunes.model = DuneModel::Classic);
        let thick = hash(|params| {
            (params.dunes.model, params.classic.layer_cells) = (DuneModel::Classic, 0.2);
        });
        assert!(plain != classic && classic != thick, "the classic rule and its layer");
    }

    #[test]
    fn the_hash_counts_what_steps_follow_from_and_nothing_else() {
        let base = DesertParams::default().step_hash();
        let with = |change: fn(&mut DesertParams)| {
            let mut params = DesertParams::default();
            change(&mut params);
            params.step_hash()
        };
        assert_eq!(with(|params| params.dunes.cell_m = 3.0), base, "metres");
        assert_eq!(with(|params| params.dunes.sand_cells = 5.0), base, "the sand of the start");
        assert_ne!(with(|params| params.wind.winds = 2), base, "winds");
        assert_ne!(with(|params| params.dunes.seed = 2), base, "seed");
    }
}
