//! The view pass: billboards from back to front, C = C att + col (1 - att), by the closed form of a ball's column.
//!
//! The square of a line's distance from a centre c is |c x v|^2 / |v|^2 for a pixel's direction v, and c x v is linear in the
//! place of the pixel: around the centre's own pixel a quadratic form, exact for every place in the picture. Most balls
//! need no more than that. Where a ball reaches the camera, or a surface of the scene, its column ends there.
//!
//! Rows are drawn in bands, each by one thread and with the balls that reach it in their order: the bits do not depend on
//! the number of threads.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use rayon::prelude::*;

use super::column::{COLUMN, column_to, exp_minus};
use super::planes::{ALL_PLANES, LANES, ONCE_PLANES, SplatPlanes};
use super::project::SeenBall;
use super::view::SplatView;
use crate::error::CloudError;
use crate::narrow::narrow;

/// Rows of a band.
const BAND_ROWS: usize = 16;
/// Pixels between those at which a limit is looked up for the balls that it may cut.
const TILE_PX: usize = 16;

/// Which light splats carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SplatOrders {
    /// Light scattered once, as in the paper.
    Single,
    /// Also light scattered often, in a medium thinner by a factor: one less the mean cosine of scattering.
    All {
        /// The factor.
        transport: f64,
    },
}

/// Draws balls, sorted from back to front by [`super::project`]. `limits_m`, one for each pixel from the upper left, are distances
/// along the line of sight behind which nothing is seen.
///
/// # Errors
/// When the view has no pixels, or there are not as many limits as pixels.
pub fn rasterise(
    balls: &[SeenBall],
    view: &SplatView,
    orders: SplatOrders,
    limits_m: Option<&[f32]>,
) -> Result<SplatPlanes, CloudError> {
    view.check()?;
    let [width, height] = view.size_px;
    if let Some(found) = limits_m.map(<[f32]>::len).filter(|found| *found != width * height) {
        let what = "the list of limits of sight".to_owned();
        return Err(CloudError::WrongLength { what, found, expected: width * height });
    }
    let planes = if orders == SplatOrders::Single { ONCE_PLANES } else { ALL_PLANES };
    let mut picture = SplatPlanes::new(view.size_px, planes);
    let stride = picture.stride();
    let raster = Raster::new(view, orders, limits_m, stride);
    let bands = Bands::new(balls, &raster);
    let arch = pulp::Arch::new();
    picture.values_mut().par_chunks_mut(BAND_ROWS * planes * stride).enumerate().for_each(|(band, values)| {
        arch.dispatch(Band { raster: &raster, balls, listed: bands.of(band), first_row: band * BAND_ROWS, values });
    });
    Ok(picture)
}

/// What ends lines of sight within a ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cut {
    /// Nothing.
    Nowhere,
    /// Surfaces of the scene, perhaps.
    BySurfaces,
    /// The camera, which stands in it or beside it.
    ByCamera,
}

/// What all bands share.
struct Raster<'a> {
    size: [usize; 2],
    stride: usize,
    perspective: bool,
    pixel: [f32; 2],
    first: [f32; 2],
    transport: Option<f32>,
    limits_m: Option<&'a [f32]>,
    /// Least limit of each tile.
    least_m: Vec<f32>,
    /// Squares of the places of columns, padded like a row.
    columns2: Vec<f32>,
}

impl<'a> Raster<'a> {
    fn new(view: &SplatView, orders: SplatOrders, limits_m: Option<&'a [f32]>, stride: usize) -> Self {
        let (pixel, first) = (view.pixel(), view.first_pixel());
        let square = |column: usize| (first[0] + pixel[0] * column as f32).powi(2);
        let columns2 = if view.is_perspective() { (0..stride).map(square).collect() } else { vec![0.0; stride] };
        let transport = match orders {
            SplatOrders::Single => None,
            SplatOrders::All { transport } => Some(narrow(transport)),
        };
        let least_m = limits_m.map(|limits| least_of_tiles(limits, view.size_px)).unwrap_or_default();
        let (size, perspective) = (view.size_px, view.is_perspective());
        Self { size, stride, perspective, pixel, first, transport, limits_m, least_m, columns2 }
    }

    /// Columns and rows that a ball may cover, the last ones excluded.
    fn span(&self, ball: &SeenBall) -> [usize; 4] {
        let [left, bottom, right, top] = ball.extent;
        let [width, height] = self.size;
        let place = |share: f32, count: usize| share * count as f32;
        [
            whole(place(0.5 + 0.5 * left, width) - 0.5),
            whole(place(0.5 - 0.5 * top, height) - 0.5),
            whole(place(0.5 + 0.5 * right, width) + 1.0).min(width),
            whole(place(0.5 - 0.5 * bottom, height) + 1.0).min(height),
        ]
    }

    /// What may end lines of sight within the ball.
    fn cut(&self, ball: &SeenBall, [left, top, right, bottom]: [usize; 4]) -> Cut {
        if ball.centre_m[2] <= 1.001 * ball.radius_m {
            return Cut::ByCamera;
        }
        if self.limits_m.is_none() {
            return Cut::Nowhere;
        }
        let farthest = if self.perspective { ball.distance_m } else { ball.centre_m[2] } + ball.radius_m;
        let tiles = self.size[0].div_ceil(TILE_PX);
        let is_limited = (top / TILE_PX..=(bottom - 1) / TILE_PX).any(|row| {
            let row = &self.least_m[row * tiles..][..tiles];
            row[left / TILE_PX..=(right - 1) / TILE_PX].iter().any(|least| *least < farthest)
        });
        if is_limited { Cut::BySurfaces } else { Cut::Nowhere }
    }
}

fn least_of_tiles(limits: &[f32], [width, height]: [usize; 2]) -> Vec<f32> {
    let [across, down] = [width, height].map(|side| side.div_ceil(TILE_PX));
    let mut least = vec![f32::INFINITY; across * down];
    for (row, limits) in limits.chunks_exact(width).enumerate() {
        for (tile, limits) in limits.chunks(TILE_PX).enumerate() {
            let least = &mut least[row / TILE_PX * across + tile];
            *least = limits.iter().copied().fold(*least, f32::min);
        }
    }
    least
}

/// The balls of each band, in their order.
struct Bands {
    starts: Vec<usize>,
    listed: Vec<u32>,
}

impl Bands {
    fn new(balls: &[SeenBall], raster: &Raster<'_>) -> Self {
        let count = raster.size[1].div_ceil(BAND_ROWS);
        let bands = |ball: &SeenBall| {
            let [left, top, right, bottom] = raster.span(ball);
            let is_empty = left >= right || top >= bottom;
            if is_empty { 0..0 } else { top / BAND_ROWS..(bottom - 1) / BAND_ROWS + 1 }
        };
        let mut starts = vec![0; count + 1];
        for ball in balls {
            bands(ball).for_each(|band| starts[band + 1] += 1);
        }
        for band in 0..count {
            starts[band + 1] += starts[band];
        }
        let mut listed = vec![0; starts[count]];
        let mut next = starts.clone();
        for (index, ball) in (0..).zip(balls) {
            for band in bands(ball) {
                listed[next[band]] = index;
                next[band] += 1;
            }
        }
        Self { starts, listed }
    }

    fn of(&self, band: usize) -> &[u32] {
        &self.listed[self.starts[band]..self.starts[band + 1]]
    }
}

/// One band.
struct Band<'a> {
    raster: &'a Raster<'a>,
    balls: &'a [SeenBall],
    listed: &'a [u32],
    first_row: usize,
    values: &'a mut [f32],
}

impl pulp::WithSimd for Band<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        let raster = self.raster;
        let planes = if raster.transport.is_some() { ALL_PLANES } else { ONCE_PLANES };
        let row_values = planes * raster.stride;
        let rows = self.values.len() / row_values;
        for index in self.listed {
            let ball = &self.balls[*index as usize];
            let span = raster.span(ball);
            let from = span[1].max(self.first_row);
            let to = span[3].min(self.first_row + rows);
            let cut = raster.cut(ball, span);
            let form = Form::new(ball, raster);
            for row in from..to {
                let values = &mut self.values[(row - self.first_row) * row_values..][..row_values];
                match cut {
                    Cut::Nowhere => draw_row(ball, raster, &form.row(ball, raster, row), span, values),
                    Cut::BySurfaces => draw_limited(ball, raster, &form.row(ball, raster, row), row, span, values),
                    Cut::ByCamera => draw_cut(ball, raster, row, span[0]..span[2], values),
                }
            }
        }
    }
}

/// The quadratic form of a ball: u |v|^2 = |v|^2 - (a x^2 + 2 b x y + c y^2), x and y from the centre's place in the picture.
struct Form {
    centre: [f32; 2],
    a: f32,
    b: f32,
    c: f32,
}

/// The form along a row: a (x - centre)^2 + slope (x - centre) + rest, and the part of |v|^2 that the row gives.
struct RowForm {
    a: f32,
    slope: f32,
    rest: f32,
    /// Columns from the centre's place to column 0, times the pixel's width.
    start: f32,
    step: f32,
    row2: f32,
    /// Optical depth towards the sun above or below the centre.
    sun_depth: f32,
}

impl Form {
    #[inline(always)]
    fn new(ball: &SeenBall, raster: &Raster<'_>) -> Self {
        let [x, y, z] = ball.centre_m;
        let scale = 1.0 / (ball.radius_m * ball.radius_m);
        if raster.perspective {
            let (a, b, c) = ((z * z + y * y) * scale, -x * y * scale, (z * z + x * x) * scale);
            return Self { centre: [x / z, y / z], a, b, c };
        }
        Self { centre: [x, y], a: scale, b: 0.0, c: scale }
    }

    #[inline(always)]
    fn row(&self, ball: &SeenBall, raster: &Raster<'_>, row: usize) -> RowForm {
        let place = raster.first[1] - raster.pixel[1] * row as f32;
        let y = place - self.centre[1];
        RowForm {
            a: self.a,
            slope: 2.0 * self.b * y,
            rest: self.c * y * y,
            start: raster.first[0] - self.centre[0],
            step: raster.pixel[0],
            row2: if raster.perspective { 1.0 + place * place } else { 1.0 },
            sun_depth: ball.sun_depth + ball.slope[1] * y,
        }
    }
}

/// What a ball does to pixels next to each other.
struct Group {
    /// Share of light that passes.
    left: [f32; LANES],
    /// The same of light that may be scattered on its way.
    left_thin: [f32; LANES],
    /// Sunlight on what is seen of the ball.
    direct: [f32; LANES],
}

impl Group {
    #[inline(always)]
    fn new(ball: &SeenBall, form: &RowForm, column: usize, columns2: &[f32; LANES], transport: Option<f32>) -> Self {
        let mut depth = [0.0; LANES];
        let mut group = Self { left: [0.0; LANES], left_thin: [1.0; LANES], direct: [0.0; LANES] };
        let start = form.start + form.step * column as f32;
        for lane in 0..LANES {
            let x = start + form.step * lane as f32;
            let distance2 = (form.a * x + form.slope) * x + form.rest;
            let u = (1.0 - distance2 / (form.row2 + columns2[lane])).max(0.0);
            depth[lane] = ball.peak * (u * u * u.sqrt()) * (COLUMN[0] + COLUMN[1] * u);
            group.direct[lane] = exp_minus((form.sun_depth + ball.slope[0] * x).max(0.0));
        }
        for (left, depth) in group.left.iter_mut().zip(&depth) {
            *left = exp_minus(*depth);
        }
        if let Some(transport) = transport {
            for (left, depth) in group.left_thin.iter_mut().zip(&depth) {
                *left = exp_minus(transport * depth);
            }
        }
        group
    }
}

/// Lays a ball's light over a plane; rows are padded by a whole group of pixels.
#[inline(always)]
fn lay_over(plane: &mut [f32], column: usize, left: &[f32; LANES], own: &[f32; LANES]) {
    let Some(values) = plane[column..].first_chunk_mut::<LANES>() else { return };
    for lane in 0..LANES {
        values[lane] = values[lane] * left[lane] + own[lane] * (1.0 - left[lane]);
    }
}

/// A row of a ball.
#[inline(always)]
fn draw_row(ball: &SeenBall, raster: &Raster<'_>, form: &RowForm, span: [usize; 4], values: &mut [f32]) {
    let mut column = span[0];
    while column < span[2] {
        draw_group(ball, raster, form, column, values);
        column += LANES;
    }
}

/// Pixels of a ball next to each other.
#[inline(always)]
fn draw_group(ball: &SeenBall, raster: &Raster<'_>, form: &RowForm, column: usize, values: &mut [f32]) {
    let stride = raster.stride;
    let often = [0.0, 0.0, 0.0, ball.forward, ball.diffuse, ball.sky, 0.0];
    let (direct, rest) = values.split_at_mut(stride);
    let (distance, rest) = rest.split_at_mut(stride);
    let (transmittance, rest) = rest.split_at_mut(stride);
    let Some(columns2) = raster.columns2[column..].first_chunk() else { return };
    let group = Group::new(ball, form, column, columns2, raster.transport);
    lay_over(direct, column, &group.left, &group.direct);
    lay_over(distance, column, &group.left, &[ball.distance_m; LANES]);
    lay_over(transmittance, column, &group.left, &[0.0; LANES]);
    for (plane, own) in rest.chunks_exact_mut(stride).zip(&often[ONCE_PLANES..]) {
        lay_over(plane, column, &group.left_thin, &[*own; LANES]);
    }
}

/// A row of a ball before the camera that a surface cuts: pixels whose surface lies behind it are drawn as if there were none,
/// and those whose surface lies before it not at all.
#[inline(always)]
fn draw_limited(
    ball: &SeenBall,
    raster: &Raster<'_>,
    form: &RowForm,
    row: usize,
    span: [usize; 4],
    values: &mut [f32],
) {
    let Some(limits) = raster.limits_m.map(|limits| &limits[row * raster.size[0]..][..raster.size[0]]) else { return };
    let middle_m = if raster.perspective { ball.distance_m } else { ball.centre_m[2] };
    // A little more than the ball, against rounding.
    let [nearest_m, farthest_m] = [-1.001, 1.001].map(|share| middle_m + share * ball.radius_m);
    let mut column = span[0];
    while column < span[2] {
        let end = (column + LANES).min(span[2]);
        let (mut least, mut most) = (f32::INFINITY, f32::NEG_INFINITY);
        for limit in &limits[column..end] {
            (least, most) = (least.min(*limit), most.max(*limit));
        }
        // A whole group also draws beyond the ball's box, where it has nothing to draw.
        if least > farthest_m {
            draw_group(ball, raster, form, column, values);
        } else if most > nearest_m {
            draw_cut(ball, raster, row, column..end, values);
        }
        column += LANES;
    }
}

/// Pixels of a row of a ball that the camera stands in, or that a surface cuts.
#[inline(never)]
fn draw_cut(ball: &SeenBall, raster: &Raster<'_>, row: usize, columns: std::ops::Range<usize>, values: &mut [f32]) {
    let centre = Form::new(ball, raster).centre;
    for column in columns {
        let limit_m = raster.limits_m.map_or(f32::INFINITY, |limits| limits[row * raster.size[0] + column]);
        let place = [raster.first[0] + raster.pixel[0] * column as f32, raster.first[1] - raster.pixel[1] * row as f32];
        let depth = cut_depth(ball, place, raster.perspective, limit_m);
        let left = exp_minus(depth);
        let left_thin = raster.transport.map_or(1.0, |transport| exp_minus(transport * depth));
        // At the camera the centre has no place in the picture, and there is no slope.
        let slope =
            |axis: usize| if ball.slope[axis] == 0.0 { 0.0 } else { ball.slope[axis] * (place[axis] - centre[axis]) };
        let direct = exp_minus((ball.sun_depth + slope(0) + slope(1)).max(0.0));
        let own = [direct, ball.distance_m, 0.0, ball.forward, ball.diffuse, ball.sky, 0.0];
        for ((index, plane), own) in values.chunks_exact_mut(raster.stride).enumerate().zip(own) {
            let left = if index < ONCE_PLANES { left } else { left_thin };
            plane[column] = plane[column] * left + own * (1.0 - left);
        }
    }
}

/// Optical depth of a ball between the camera and a limit (m), on the line of sight through a place of the picture.
fn cut_depth(ball: &SeenBall, [x, y]: [f32; 2], perspective: bool, limit_m: f32) -> f32 {
    let [cx, cy, cz] = ball.centre_m;
    let per_radius = 1.0 / ball.radius_m;
    let (distance2, along) = if perspective {
        let inverse2 = 1.0 / (1.0 + x * x + y * y);
        let across = [cy - cz * y, cz * x - cx, cx * y - cy * x];
        let square: f32 = across.iter().map(|part| part * part).sum();
        (square * inverse2, (cx * x + cy * y + cz) * inverse2.sqrt())
    } else {
        ((cx - x).powi(2) + (cy - y).powi(2), cz)
    };
    let u = 1.0 - distance2 * per_radius * per_radius;
    if u <= 0.0 {
        return 0.0;
    }
    let end = ((limit_m - along) * per_radius).min(2.0);
    let start = (-along * per_radius).max(-2.0);
    ball.peak * (column_to(u, end) - column_to(u, start)).max(0.0)
}

/// The whole part of a number of pixels, 0 for what is below.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "negative numbers are meant to saturate")]
fn whole(pixels: f32) -> usize {
    pixels as usize
}

#[cfg(test)]
#[path = "raster_tests.rs"]
mod tests;
