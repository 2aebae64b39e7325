//! The paper's final light buffer: what the balls leave of the sunlight on a level plane below them.

use rayon::prelude::*;
use tyndall_core::grid::Grid2;

use super::bins::{Bins, Disc, DiscGroup, LightAxes};
use super::column::column;
use super::depths::middle;
use crate::error::{CloudError, in_range};
use crate::metaballs::Metaball;

/// A level rectangle on which shadows fall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowPlane {
    /// Corner with the least east and north (m), and altitude (m).
    pub corner_m: [f64; 3],
    /// Sides to the east and to the north (m).
    pub sides_m: [f64; 2],
    /// Texels to the east and to the north.
    pub texels: [usize; 2],
}

/// Optical depth of all balls between the light and the middle of each texel of a plane below them: the negative logarithm
/// of the light buffer. Rows go to the north.
///
/// # Errors
/// When the direction is zero or not finite, or the plane has no texels.
pub fn shadow_map(balls: &[Metaball], to_light: [f64; 3], plane: &ShadowPlane) -> Result<Grid2<f32>, CloudError> {
    let length = to_light.iter().map(|part| part * part).sum::<f64>().sqrt();
    in_range("length of the direction to the light", length, (1e-100, 1e100), "")?;
    for (what, count) in [("texels to the east", plane.texels[0]), ("texels to the north", plane.texels[1])] {
        in_range(what, count as f64, (1.0, 32_768.0), "")?;
    }
    let axes = LightAxes::new(middle(balls), to_light.map(|part| part / length));
    let discs: Vec<_> = balls.iter().map(|ball| axes.disc(ball)).collect();
    let bins = Bins::new(&discs);
    let mut map = Grid2::filled(plane.texels, 0.0_f32);
    map.cells_mut().par_chunks_exact_mut(plane.texels[0]).enumerate().for_each(|(row, texels)| {
        for (column_index, texel) in texels.iter_mut().enumerate() {
            let place = |axis: usize, index: usize| {
                plane.corner_m[axis] + plane.sides_m[axis] * (index as f64 + 0.5) / plane.texels[axis] as f64
            };
            let [u, v, _] =
                axes.place([place(0, column_index), place(1, row), plane.corner_m[2]].map(crate::narrow::narrow));
            let depth = |disc: Disc| {
                let apart = [(disc.place[0] - u) * disc.per_radius, (disc.place[1] - v) * disc.per_radius];
                disc.peak * column(1.0 - apart[0] * apart[0] - apart[1] * apart[1])
            };
            *texel = bins.near([u, v]).iter().flat_map(DiscGroup::discs).map(depth).sum();
        }
    });
    Ok(map)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shadow_lies_where_the_light_puts_it_and_holds_the_balls_mass() {
        let ball = Metaball { centre_m: [500.0, 400.0, 1000.0], radius_m: 120.0, extinction_per_m: 0.01 };
        let plane = ShadowPlane { corner_m: [-500.0, -500.0, 0.0], sides_m: [2000.0; 2], texels: [400; 2] };
        let map = shadow_map(&[ball], [0.3, 0.0, 1.0], &plane).unwrap();
        let mut sums = [0.0_f64; 3];
        for (index, depth) in map.cells().iter().enumerate() {
            let place = |index: usize| -500.0 + 5.0 * (index as f64 + 0.5);
            sums[0] += f64::from(*depth);
            sums[1] += f64::from(*depth) * place(index % 400);
            sums[2] += f64::from(*depth) * place(index / 400);
        }
        assert!((sums[1] / sums[0] - 200.0).abs() < 0.5, "300 m to the west: {}", sums[1] / sums[0]);
        assert!((sums[2] / sums[0] - 400.0).abs() < 0.5, "as far north: {}", sums[2] / sums[0]);
        // A slanted beam spreads the same mass over more of the ground.
        let mass = sums[0] * 25.0 / f64::hypot(1.0, 0.3);
        assert!((mass / ball.mass_m2() - 1.0).abs() < 1e-3, "{mass} m2 of {}", ball.mass_m2());
    }

    #[test]
    fn a_plane_without_texels_is_refused() {
        let plane = ShadowPlane { corner_m: [0.0; 3], sides_m: [1.0; 2], texels: [4, 0] };
        let text = shadow_map(&[], [0.0, 0.0, 1.0], &plane).unwrap_err().to_string();
        assert!(text.starts_with("texels to the north = 0 is outside"), "{text}");
    }
}
