//! The media of an atmosphere as a random walk meets them: those that do something, with columns by direct quadrature.
//!
//! No table stands between the walk and the profiles, so that its result can judge the tables. A ray is cut where it
//! crosses *levels*, altitudes between which every density changes by a factor e^2 at most and has no kink; four Gauss
//! nodes in each piece then give columns to 1e-5.

use crate::Atmosphere;
use crate::atmosphere::MEDIUM_COUNT;
use crate::medium::{Medium, Profile};
use crate::optical_length::Columns;
use crate::quadrature::{NODES, WEIGHTS};

/// Levels of an exponential profile in scale heights. Above the last a density no longer counts.
const EXPONENTIAL_LEVELS: [f64; 8] = [2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0];

/// Media that scatter or absorb, and the levels of their densities.
#[derive(Clone, Debug)]
pub(super) struct Layers {
    pub(super) radius_m: f64,
    pub(super) media: Vec<Medium>,
    /// a (2R + a) of each level's altitude a, ascending (m^2).
    levels_m2: Vec<f64>,
}

/// A straight line from altitude `h_m` with zenith cosine `mu`, in the quantities that quadratures need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    radius_m: f64,
    /// Distance of the start beyond the line's point closest to the centre (m).
    along_m: f64,
    /// h (2R + h) of the start (m^2).
    start_m2: f64,
}

impl Line {
    /// Altitude (m) at a distance.
    pub(super) fn altitude_m(&self, t_m: f64) -> f64 {
        let q = self.start_m2 + t_m * (2.0 * self.along_m + t_m);
        q / (self.radius_m + (self.radius_m * self.radius_m + q).sqrt())
    }
}

impl Layers {
    pub(super) fn new(atmosphere: &Atmosphere) -> Self {
        let acts = |medium: &&Medium| {
            medium.scattering_per_m.iter().chain(&medium.absorption_per_m).any(|coefficient| *coefficient > 0.0)
        };
        let media: Vec<Medium> = atmosphere.media.iter().filter(acts).cloned().collect();
        let mut altitudes_m: Vec<f64> = media.iter().flat_map(|medium| levels_m(medium.profile)).collect();
        altitudes_m.retain(|altitude_m| 0.0 < *altitude_m && *altitude_m < atmosphere.top_altitude_m);
        altitudes_m.sort_by(f64::total_cmp);
        altitudes_m.dedup_by(|next, before| *next - *before < 0.002 * *before);
        let radius_m = atmosphere.planet_radius_m;
        let levels_m2 = altitudes_m.into_iter().map(|a| a * (2.0 * radius_m + a)).collect();
        Self { radius_m, media, levels_m2 }
    }

    pub(super) fn line(&self, h_m: f64, mu: f64) -> Line {
        let radius_m = self.radius_m;
        Line { radius_m, along_m: (radius_m + h_m) * mu, start_m2: h_m * (2.0 * radius_m + h_m) }
    }

    /// Densities of the media at an altitude.
    pub(super) fn densities(&self, altitude_m: f64) -> Columns {
        let mut densities = [0.0; MEDIUM_COUNT];
        for (density, medium) in densities.iter_mut().zip(&self.media) {
            *density = medium.profile.density(altitude_m.max(0.0));
        }
        densities
    }

    /// Calls `visit` with the ends of each piece of a line up to `length_m`, in order.
    pub(super) fn for_each_piece(&self, line: &Line, length_m: f64, mut visit: impl FnMut(f64, f64)) {
        let lowest_m2 = line.start_m2 - line.along_m * line.along_m;
        let mut from_m = 0.0;
        let mut cut = |t_m: f64| {
            if t_m > from_m && t_m < length_m {
                visit(from_m, t_m);
                from_m = t_m;
            }
        };
        // Where the line passes a level: twice, at equal distances before and after its lowest point.
        let half_chord = |level_m2: f64| (level_m2 - lowest_m2).max(0.0).sqrt();
        let descends = line.along_m < 0.0;
        if descends {
            let first_above = self.levels_m2.partition_point(|level_m2| *level_m2 < line.start_m2);
            for level_m2 in self.levels_m2[..first_above].iter().rev().filter(|level_m2| **level_m2 > lowest_m2) {
                cut(-line.along_m - half_chord(*level_m2));
            }
            cut(-line.along_m);
        }
        let lowest_passed_m2 = if descends { lowest_m2 } else { line.start_m2 };
        let first = self.levels_m2.partition_point(|level_m2| *level_m2 <= lowest_passed_m2);
        for level_m2 in &self.levels_m2[first..] {
            cut(-line.along_m + half_chord(*level_m2));
        }
        visit(from_m, length_m);
    }

    /// Columns (m) of a piece of a line.
    pub(super) fn piece_columns(&self, line: &Line, from_m: f64, to_m: f64) -> Columns {
        let width_m = to_m - from_m;
        let mut columns = [0.0; MEDIUM_COUNT];
        for (node, weight) in NODES.into_iter().zip(WEIGHTS) {
            let densities = self.densities(line.altitude_m(from_m + node * width_m));
            for (column, density) in columns.iter_mut().zip(densities) {
                *column += weight * width_m * density;
            }
        }
        columns
    }

    /// Optical depth of scattering alone of these columns (m) at wavelength `k`.
    pub(super) fn scattering_depth(&self, columns: &Columns, k: usize) -> f64 {
        self.media.iter().zip(columns).map(|(medium, column)| medium.scattering_per_m[k] * column).sum()
    }

    /// Scattering coefficient (1/m) at these densities.
    pub(super) fn scattering_per_m(&self, densities: &Columns, k: usize) -> f64 {
        self.scattering_depth(densities, k)
    }

    /// Transmittance of these columns (m) at wavelength `k`.
    pub(super) fn transmittance(&self, columns: &Columns, k: usize) -> f64 {
        let depth: f64 =
            self.media.iter().zip(columns).map(|(medium, column)| medium.extinction_per_m(k) * column).sum();
        (-depth).exp()
    }

    /// Columns (m) along a line.
    pub(super) fn columns(&self, line: &Line, length_m: f64) -> Columns {
        let mut sum = [0.0; MEDIUM_COUNT];
        self.for_each_piece(line, length_m, |from_m, to_m| {
            let piece = self.piece_columns(line, from_m, to_m);
            sum.iter_mut().zip(piece).for_each(|(sum, column)| *sum += column);
        });
        sum
    }
}

/// Levels of an even layer in shares of its height: its light changes where its density does not.
const EVEN_LEVELS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Levels of a log-normal layer in widths from its median.
const LOG_NORMAL_LEVELS: [f64; 9] = [-4.0, -3.0, -2.0, -1.2, -0.4, 0.4, 1.2, 2.0, 3.5];

/// Altitudes (m) that a profile wants as levels.
fn levels_m(profile: Profile) -> Vec<f64> {
    match profile {
        Profile::Exponential { scale_height_m } | Profile::Background { scale_height_m, .. } => {
            EXPONENTIAL_LEVELS.map(|level| level * scale_height_m).to_vec()
        }
        Profile::Stretched { scale_m, power } => {
            EXPONENTIAL_LEVELS.map(|level| level.powf(1.0 / power) * scale_m).to_vec()
        }
        Profile::LogNormal { median_m, width } => {
            LOG_NORMAL_LEVELS.map(|level| median_m * (level * width).exp()).to_vec()
        }
        Profile::Layer { top_m, scale_height_m } => {
            let above = EXPONENTIAL_LEVELS.map(|level| top_m + level * scale_height_m);
            EVEN_LEVELS.map(|level| level * top_m).into_iter().chain(above).collect()
        }
        Profile::Tent { centre_m, half_width_m } => vec![centre_m - half_width_m, centre_m, centre_m + half_width_m],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{distance_to_ground, distance_to_top};
    use crate::optical_length::columns_along;
    use crate::params::{AtmosphereParams, GroundParams};

    #[test]
    fn columns_equal_the_fine_quadrature_up_down_and_along_the_limb() {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        let layers = Layers::new(&atmosphere);
        let (radius_m, top_m) = (atmosphere.planet_radius_m, atmosphere.top_altitude_m);
        for (h_m, mu) in
            [(0.0, 1.0), (0.0, 0.0), (2.0, 0.05), (9e3, -0.03), (9e3, -0.9), (1e5, -0.17), (1e5, -0.13), (45e3, 0.3)]
        {
            let length_m =
                distance_to_ground(radius_m, h_m, mu).unwrap_or_else(|| distance_to_top(radius_m, top_m, h_m, mu));
            let want = columns_along(&atmosphere, h_m, mu, length_m);
            let got = layers.columns(&layers.line(h_m, mu), length_m);
            // The haze is absent.
            for (medium, (got, want)) in got.into_iter().zip(want).take(layers.media.len()).enumerate() {
                assert!((got - want).abs() <= 5e-5 * want + 1e-6, "{h_m} {mu} medium {medium}: {got} {want}");
            }
        }
    }

    #[test]
    fn media_without_effect_are_left_out() {
        let params = AtmosphereParams { ozone_du: 0.0, ..AtmosphereParams::default() };
        let layers = Layers::new(&Atmosphere::new(&params, &GroundParams::default()));
        assert_eq!(layers.media.len(), 2, "air and aerosol");
    }
}
