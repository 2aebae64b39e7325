//! Means over the cells around.

use tyndall_dunes::Edges;

/// Weights of five taps.
const KERNEL: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];

/// Means over about `stride` cells on each side; rows, then columns.
#[must_use]
pub fn blur(values: &[f32], [nx, ny]: [usize; 2], edges: Edges, stride: usize) -> Vec<f32> {
    let index = |at: usize, tap: usize, count: usize| match edges {
        Edges::Periodic => (at + tap * stride + 2 * stride * count - 2 * stride) % count,
        Edges::Open => (at + tap * stride).saturating_sub(2 * stride).min(count - 1),
    };
    let cells = || (0..ny).flat_map(move |y| (0..nx).map(move |x| (x, y)));
    let weighted =
        |value: &dyn Fn(usize) -> f32| KERNEL.iter().enumerate().map(|(tap, weight)| weight * value(tap)).sum();
    let rows: Vec<f32> = cells().map(|(x, y)| weighted(&|tap| values[y * nx + index(x, tap, nx)])).collect();
    cells().map(|(x, y)| weighted(&|tap| rows[index(y, tap, ny) * nx + x])).collect()
}
