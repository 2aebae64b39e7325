//! Heights of the landscape: pure functions of place and seed.
//!
//! Nothing is stored, so that a mesh of any fineness, a camera that stands on the ground and the shaders (same functions
//! in f32, `shaders/landscape`) all see the same hills. [`relief`] has the terrain.
//!
//! Not done: rivers, erosion by simulation, overhangs.

pub mod noise;
pub mod relief;

use crate::{LandscapeKind, LandscapeParams};
use relief::Relief;

const M_PER_KM: f64 = 1000.0;

/// A landscape, ready to be asked for heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Landscape {
    /// The bare planet.
    None,
    /// Terrain.
    Relief(Relief),
}

impl Landscape {
    /// From its parameters.
    #[must_use]
    pub fn new(params: &LandscapeParams) -> Self {
        match params.kind {
            LandscapeKind::None => Self::None,
            LandscapeKind::Hills | LandscapeKind::Mountains | LandscapeKind::Valley => {
                Self::Relief(Relief::new(params))
            }
        }
    }

    /// Altitude (m) of what one stands on at a place (m) east and north of the scene's origin: the terrain, and 0
    /// outside the landscape.
    #[must_use]
    pub fn ground_m(&self, x_m: f64, y_m: f64) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Relief(relief) => relief.at(x_m, y_m, 0.0).height_m.max(0.0),
        }
    }

    /// Half the side (m) of the square that it fills.
    #[must_use]
    pub fn half_size_m(&self) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Relief(relief) => relief.half_size_m,
        }
    }

    /// An altitude (m) that nothing of it exceeds.
    #[must_use]
    pub fn highest_m(&self) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Relief(relief) => relief.highest_m(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn landscape(kind: LandscapeKind) -> Landscape {
        Landscape::new(&LandscapeParams { kind, ..LandscapeParams::default() })
    }

    #[test]
    fn every_kind_stays_below_its_highest_altitude_and_above_the_planet() {
        for kind in [LandscapeKind::None, LandscapeKind::Hills, LandscapeKind::Mountains, LandscapeKind::Valley] {
            let landscape = landscape(kind);
            let mut highest = 0.0_f64;
            for k in 0..20_000 {
                let (x, y) = (f64::from(k % 141) * 500.0 - 35_000.0, f64::from(k / 141) * 497.0 - 35_000.0);
                let ground = landscape.ground_m(x, y);
                assert!((0.0..=landscape.highest_m()).contains(&ground), "{kind:?} ({x}, {y}): {ground}");
                highest = highest.max(ground);
            }
            assert!(highest >= 0.35 * landscape.highest_m(), "{kind:?}: {highest} of {}", landscape.highest_m());
        }
    }

    #[test]
    fn outside_its_square_there_is_the_bare_planet() {
        for kind in [LandscapeKind::Hills, LandscapeKind::Valley] {
            for (x, y) in [(31e3, 0.0), (0.0, -30.1e3), (50e3, 50e3)] {
                assert!(landscape(kind).ground_m(x, y).abs() < 1e-12, "{kind:?} ({x}, {y})");
            }
        }
    }

    #[test]
    fn another_seed_is_another_landscape() {
        for kind in [LandscapeKind::Hills, LandscapeKind::Mountains, LandscapeKind::Valley] {
            let params = |seed| LandscapeParams { kind, seed, ..LandscapeParams::default() };
            let heights = |seed| {
                let landscape = Landscape::new(&params(seed));
                (0..100).map(|k| landscape.ground_m(40.0 * f64::from(k), 930.0)).collect::<Vec<_>>()
            };
            assert!(heights(1) != heights(2), "{kind:?}");
            assert!(heights(1) == heights(1), "{kind:?} is a function of its seed");
        }
    }
}
