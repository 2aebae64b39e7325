//! What the tests of this crate share.

/// Runs `work` on that many threads.
pub(crate) fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started").install(work)
}

/// Numbers of a CSV table, without comments and the line of names; an empty cell is NaN.
pub(crate) fn rows_of(table: &str) -> Vec<Vec<f64>> {
    let lines = table.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()).collect()
}

/// Share of the variance of y that a straight line in x explains.
pub(crate) fn r_squared(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let cov = |f: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>();
    let (xy, xx, yy) = (cov(&|p| (p.0 - x) * (p.1 - y)), cov(&|p| (p.0 - x).powi(2)), cov(&|p| (p.1 - y).powi(2)));
    xy * xy / (xx * yy)
}
