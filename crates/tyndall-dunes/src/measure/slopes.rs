//! Slopes of a bed.

use super::HeightGrid;

/// Slopes along a wind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindSlopes {
    /// 95th percentile of the slopes that fall downwind (deg).
    pub lee_p95_deg: f64,
    /// Median of the slopes that rise downwind, where sand lies higher than one cell (deg).
    pub windward_median_deg: f64,
}

/// Least slope that counts as one (1).
const LEVEL: f64 = 0.02;

/// Slopes along +x turned by `wind_deg`, by central differences.
#[must_use]
pub fn wind_slopes(grid: &HeightGrid, wind_deg: f64) -> WindSlopes {
    let (sin, cos) = wind_deg.to_radians().sin_cos();
    let (mut lee, mut windward) = (Vec::new(), Vec::new());
    for [x, y] in grid.cells() {
        let [dx, dy] = grid.gradient(x, y);
        let slope = dx * cos + dy * sin;
        if slope < -LEVEL {
            lee.push(-slope);
        } else if slope > LEVEL && grid.at(x, y) > 1.0 {
            windward.push(slope);
        }
    }
    WindSlopes { lee_p95_deg: quantile_deg(&mut lee, 0.95), windward_median_deg: quantile_deg(&mut windward, 0.5) }
}

/// The slope below which the given share of all slopes lies (deg); 0 when there is none.
fn quantile_deg(slopes: &mut [f64], share: f64) -> f64 {
    slopes.sort_by(f64::total_cmp);
    let rank = (share * slopes.len() as f64) as usize;
    slopes.get(rank.min(slopes.len().saturating_sub(1))).map_or(0.0, |slope| slope.atan().to_degrees())
}

/// The steepest slope between any cell and its four and its diagonal neighbours: [four, diagonal] (deg).
#[must_use]
pub fn steepest_deg(grid: &HeightGrid) -> [f64; 2] {
    let rise = |steps: &[[isize; 2]]| {
        let at = |[x, y]: [isize; 2]| steps.iter().map(move |[dx, dy]| (grid.at(x, y) - grid.at(x + dx, y + dy)).abs());
        grid.cells().flat_map(at).fold(0.0, f64::max)
    };
    let (four, diagonal) = (rise(&[[1, 0], [0, 1]]), rise(&[[1, 1], [1, -1]]));
    [four.atan().to_degrees(), (diagonal / std::f64::consts::SQRT_2).atan().to_degrees()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ridge_has_the_slopes_it_was_made_with() {
        let ridge = |x: usize| if x < 48 { 2.0 + 0.2 * x as f32 } else { 2.0 + 0.2 * 48.0 - 0.6 * (x - 48) as f32 };
        let grid = HeightGrid::new([64, 16], (0..1024).map(|index| ridge(index % 64)).collect()).unwrap();
        let slopes = wind_slopes(&grid, 0.0);
        assert!((slopes.lee_p95_deg - 0.6f64.atan().to_degrees()).abs() < 0.01, "{slopes:?}");
        assert!((slopes.windward_median_deg - 0.2f64.atan().to_degrees()).abs() < 0.01, "{slopes:?}");
        let steepest = steepest_deg(&grid)[0];
        assert!((steepest - 0.6f64.atan().to_degrees()).abs() < 0.01, "{steepest} deg");
        let against = wind_slopes(&grid, 180.0);
        assert!((against.lee_p95_deg - 0.2f64.atan().to_degrees()).abs() < 0.01, "turned wind: {against:?}");
    }
}
