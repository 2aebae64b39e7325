//! Light inside a cloud, cell by cell, for renderers that march: what is left of the sunlight, and what was scattered often.
//!
//! Light that was scattered more than once forgets its direction. It obeys the diffusion equation in a medium whose extinction
//! is the true one times `transport`, one less the mean cosine of scattering (van de Hulst's similarity). For sunlight it is
//! solved on the cells, so that it leaves a lone cloud on all sides. For light of sky and ground each cell is given the exact solution in a level slab as thick as
//! the cloud above and below it, by Eddington's approximation without absorption: what it does not let through it sends back.
//! [`sun_diffusion`] is that slab's for sunlight: of decks, and of single balls.
//!
//! Half-space, overhead sun, isotropic scattering: 4.0 / (4 pi) upwards, 5 % below Chandrasekhar's H function.

use std::f64::consts::PI;

use rayon::prelude::*;
use tyndall_core::grid::Grid3;

use crate::diffusion::diffuse;
use crate::edges::Edges;
use crate::error::{CloudError, in_range};
use crate::narrow::narrow;
use crate::sun_depth::sun_depth;

/// Light in every cell of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudLight {
    /// Optical depth from the cell towards the sun.
    pub sun_depth: Grid3<f32>,
    /// Mean radiance (1/sr) of sunlight scattered more than once, for a sun of irradiance 1.
    pub sun_diffuse: Grid3<f32>,
    /// Share of the sky in the light from sky and ground, 0 to 1; the ground has the rest.
    pub sky_share: Grid3<f32>,
}

/// Light in a grid of extinction (1/m) at the centres of cells of `cell_m`, for a sun in the direction `to_sun` and a
/// `transport` of 1 less the mean cosine of scattering. The neighbours of a wrapped grid throw their shadows.
///
/// # Errors
/// When `to_sun` is zero, or `cell_m` or `transport` is not positive.
pub fn cloud_light(
    extinction: &Grid3<f32>,
    cell_m: f64,
    to_sun: [f64; 3],
    transport: f64,
    edges: Edges,
) -> Result<CloudLight, CloudError> {
    let (sun_depth, sun_diffuse) = sunlight(extinction, cell_m, to_sun, transport, edges)?;
    let depth = |direction| depth_with_neighbours(extinction, direction, edges);
    let scaled = transport * cell_m;
    let (above, below) = (depth([0.0, 0.0, 1.0])?, depth([0.0, 0.0, -1.0])?);
    let level = above.cells().par_iter().zip(below.cells());
    let sky_share =
        level.map(|(above, below)| narrow(sky_share(scaled * f64::from(*above), scaled * f64::from(*below)))).collect();
    let grid = |cells| Grid3::from_cells(extinction.size(), cells).unwrap_or_else(|| extinction.clone());
    Ok(CloudLight { sun_depth, sun_diffuse, sky_share: grid(sky_share) })
}

/// The part [`CloudLight::sun_diffuse`] of [`cloud_light`] alone.
///
/// # Errors
/// As [`cloud_light`].
pub fn sunlight_scattered_often(
    extinction: &Grid3<f32>,
    cell_m: f64,
    to_sun: [f64; 3],
    transport: f64,
    edges: Edges,
) -> Result<Grid3<f32>, CloudError> {
    Ok(sunlight(extinction, cell_m, to_sun, transport, edges)?.1)
}

/// Optical depth towards the sun and sunlight that was scattered often, as [`CloudLight`] has them.
fn sunlight(
    extinction: &Grid3<f32>,
    cell_m: f64,
    to_sun: [f64; 3],
    transport: f64,
    edges: Edges,
) -> Result<(Grid3<f32>, Grid3<f32>), CloudError> {
    in_range("side of a cell", cell_m, (1e-9, 1e9), " m")?;
    in_range("transport", transport, (1e-6, 2.0), "")?;
    let mut depth = depth_with_neighbours(extinction, to_sun, edges)?;
    let scale = narrow(cell_m);
    depth.cells_mut().iter_mut().for_each(|cell| *cell *= scale);
    let diffuse = diffuse_sunlight(extinction, &depth, (scale, narrow(transport)), edges);
    Ok((depth, diffuse))
}

/// Mean radiance of sunlight that was scattered so often that it forgot its direction: what the beam loses in a medium
/// thinner by `transport` spreads from there.
fn diffuse_sunlight(
    extinction: &Grid3<f32>,
    sun_depth: &Grid3<f32>,
    (cell_m, transport): (f32, f32),
    edges: Edges,
) -> Grid3<f32> {
    let mut thickness = extinction.clone();
    thickness.cells_mut().par_iter_mut().for_each(|cell| *cell *= transport * cell_m);
    let mut source = sun_depth.clone();
    source.cells_mut().par_iter_mut().zip(thickness.cells()).for_each(|(cell, thickness)| {
        if *thickness <= 0.0 {
            *cell = 0.0;
            return;
        }
        // The mean of the beam over the cell, where it falls off from one end to the other.
        let half = 0.5 * thickness;
        let mean = if half > 1e-3 { half.sinh() / half } else { 1.0 };
        *cell = thickness * (-transport * *cell).exp() * mean.min(4.0);
    });
    diffuse(&thickness, &source, edges)
}

/// Mean radiance (1/sr) of sunlight scattered more than once, or once without a trace of its direction, in a slab across the
/// rays: `before` and `behind` are scaled optical depths towards and away from a sun of irradiance 1. What was scattered once
/// is left out: it is `exp(-before)` / (4 pi).
#[must_use]
pub fn sun_diffusion(before: f64, behind: f64) -> f64 {
    let thickness = before + behind;
    let through = (-thickness).exp();
    let net = (1.0 + through + 1.5 * (1.0 - through)) / (2.0 + 1.5 * thickness);
    let at_top = (1.0 - net) / (2.0 * PI);
    (at_top - 0.75 / PI * (net * before - (1.0 - (-before).exp()))).max(0.0)
}

/// Share of the light from above in the mean radiance within a level slab, between scaled optical depths.
#[must_use]
pub fn sky_share(above: f64, below: f64) -> f64 {
    1.0 - (0.5 + 0.75 * above) / (1.0 + 0.75 * (above + below))
}

/// [`sun_depth`], in a wrapped grid with as many of its neighbours' cells as rays cross.
fn depth_with_neighbours(grid: &Grid3<f32>, direction: [f64; 3], edges: Edges) -> Result<Grid3<f32>, CloudError> {
    let [nx, ny, nz] = grid.size();
    let level = direction[0].hypot(direction[1]);
    if edges == Edges::Open || level <= 1e-9 {
        return sun_depth(grid, direction);
    }
    let margin = |part: f64, count: usize| {
        let cells = (nz as f64 * part.abs() / direction[2].abs().max(1e-6)).ceil() + 3.0;
        whole(cells.min(count as f64))
    };
    let [east, north] = [margin(direction[0], nx), margin(direction[1], ny)];
    let size = [nx + 2 * east, ny + 2 * north, nz];
    let mut wide = Grid3::filled(size, 0.0);
    wide.cells_mut().par_chunks_exact_mut(size[0]).enumerate().for_each(|(row, cells)| {
        let (y, z) = (row % size[1], row / size[1]);
        let source = (z * ny + (y + ny - north) % ny) * nx;
        for (x, cell) in cells.iter_mut().enumerate() {
            *cell = grid.cells()[source + (x + nx - east) % nx];
        }
    });
    let wide = sun_depth(&wide, direction)?;
    let mut depth = Grid3::filled(grid.size(), 0.0);
    depth.cells_mut().par_chunks_exact_mut(nx).enumerate().for_each(|(row, cells)| {
        let (y, z) = (row % ny, row / ny);
        cells.copy_from_slice(&wide.cells()[(z * size[1] + y + north) * size[0] + east..][..nx]);
    });
    Ok(depth)
}

/// The whole part of a number of cells.
#[expect(clippy::cast_possible_truncation, reason = "at most a side of the grid")]
fn whole(cells: f64) -> usize {
    cells as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slab_lets_through_or_sends_back_all_of_the_light() {
        for thickness in [0.1, 1.0, 5.0, 40.0] {
            // Diffuse flux out of a face is twice that of Marshak's condition: pi times the mean radiance, doubled.
            let up = 2.0 * PI * sun_diffusion(0.0, thickness);
            let down = 2.0 * PI * sun_diffusion(thickness, 0.0) + (-thickness).exp();
            assert!((up + down - 1.0).abs() < 1e-12, "thickness {thickness}: {up} + {down}");
            assert!(thickness < 40.0 || up > 0.9, "thick clouds are white: {up}");
        }
    }

    #[test]
    fn the_net_flux_of_direct_and_diffuse_light_is_the_same_at_every_depth() {
        let (thickness, step) = (6.0, 1e-4);
        let net = |depth: f64| {
            let slope = (sun_diffusion(depth + step, thickness - depth - step)
                - sun_diffusion(depth - step, thickness - depth + step))
                / (2.0 * step);
            (-depth).exp() - 4.0 * PI / 3.0 * slope
        };
        for depth in [0.5, 1.5, 3.0, 5.5] {
            assert!((net(depth) - net(1.0)).abs() < 1e-6, "depth {depth}: {} {}", net(depth), net(1.0));
        }
    }

    #[test]
    fn sky_and_ground_share_evenly_in_the_middle_and_the_sky_rules_at_the_top() {
        assert!((sky_share(3.0, 3.0) - 0.5).abs() < 1e-12, "the middle");
        assert!((sky_share(0.0, 0.0) - 0.5).abs() < 1e-12, "without a cloud");
        assert!(sky_share(0.0, 50.0) > 0.98 && sky_share(50.0, 0.0) < 0.02, "faces of a thick cloud");
    }

    #[test]
    fn neighbours_of_a_wrapped_grid_throw_shadows_and_those_of_an_open_one_do_not() {
        let size = [16, 12, 8];
        let mut extinction = Grid3::filled(size, 0.0);
        // A lid at the ceiling over the eastern edge, and the sun in the west, 45 degrees high.
        (0..12).for_each(|y| extinction[[15, y, 7]] = 1.0);
        let depth = |edges| cloud_light(&extinction, 1.0, [-1.0, 0.0, 1.0], 0.15, edges).unwrap().sun_depth[[3, 6, 3]];
        assert!(depth(Edges::Open) < 1e-6, "nothing lies between");
        assert!((depth(Edges::Wrap) - 2.0_f32.sqrt()).abs() < 0.05, "the lid of the neighbour: {}", depth(Edges::Wrap));
    }

    #[test]
    fn a_wrapped_deck_is_the_same_everywhere() {
        let extinction = Grid3::filled([12, 12, 6], 0.3);
        let light = cloud_light(&extinction, 1.0, [0.6, -0.3, 0.4], 0.15, Edges::Wrap).unwrap();
        // Interpolating twice, into the sum and out of it, moves the deck's top by up to a quarter of a cell.
        let allowed = 0.25 * 0.3 * (0.61_f32).sqrt() / 0.4;
        for z in 0..6 {
            let cells = &light.sun_depth.cells()[144 * z..][..144];
            let spread = cells.iter().fold(0.0, |most, cell| f32::max(most, (cell - cells[0]).abs()));
            assert!(spread < allowed, "height {z}: {spread} of {}", cells[0]);
        }
    }

    #[test]
    fn a_sun_without_direction_and_an_impossible_phase_are_refused() {
        let grid = Grid3::filled([2, 2, 2], 0.0);
        assert!(cloud_light(&grid, 1.0, [0.0; 3], 0.2, Edges::Open).is_err(), "no direction");
        assert!(cloud_light(&grid, 1.0, [0.0, 0.0, 1.0], 0.0, Edges::Open).is_err(), "scattering straight on");
    }
}
