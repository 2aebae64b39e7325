//! Gauss-Legendre quadrature with four nodes a panel, and the running integral at the nodes themselves.

/// Nodes of a panel, on 0 to 1.
pub const NODES: [f64; 4] =
    [0.069_431_844_202_973_71, 0.330_009_478_207_571_9, 0.669_990_521_792_428_1, 0.930_568_155_797_026_3];

/// Weights of [`NODES`]; their sum is 1.
pub const WEIGHTS: [f64; 4] =
    [0.173_927_422_568_726_93, 0.326_072_577_431_273_1, 0.326_072_577_431_273_1, 0.173_927_422_568_726_93];

/// Running integrals: row i holds the weights of the four node values in the integral from the panel's start to node i
/// (the Butcher matrix of the Gauss collocation method of order 8). Exact for cubics.
pub const RUNNING: [[f64; 4]; 4] = [
    [0.086_963_711_284_363_46, -0.026_604_180_084_998_794, 0.012_627_462_689_404_725, -0.003_555_149_685_795_683],
    [0.188_118_117_499_868_07, 0.163_036_288_715_636_54, -0.027_880_428_602_470_895, 0.006_735_500_594_538_155],
    [0.167_191_921_974_188_77, 0.353_953_006_033_743_97, 0.163_036_288_715_636_54, -0.014_190_694_931_141_143],
    [0.177_482_572_254_522_61, 0.313_445_114_741_868_35, 0.352_676_757_516_271_86, 0.086_963_711_284_363_46],
];

/// The integral of `f` from `a` to `b` with four nodes in each of `panels` equal panels.
pub fn integrate(a: f64, b: f64, panels: usize, mut f: impl FnMut(f64) -> f64) -> f64 {
    let [integral] = integrate_many(a, b, panels, |x| [f(x)]);
    integral
}

/// The integrals of several functions that share their work, as [`integrate`].
pub fn integrate_many<const N: usize>(a: f64, b: f64, panels: usize, mut f: impl FnMut(f64) -> [f64; N]) -> [f64; N] {
    let width = (b - a) / panels as f64;
    let mut sums = [0.0; N];
    for panel in 0..panels {
        let start = a + panel as f64 * width;
        for (node, weight) in NODES.into_iter().zip(WEIGHTS) {
            for (sum, value) in sums.iter_mut().zip(f(start + node * width)) {
                *sum += weight * value;
            }
        }
    }
    sums.map(|sum| sum * width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_is_exact_for_polynomials_of_degree_seven() {
        for degree in 0..8 {
            let value = integrate(0.0, 1.0, 1, |x| x.powi(degree));
            assert!((value - 1.0 / f64::from(degree + 1)).abs() < 1e-15, "degree {degree}: {value}");
        }
    }

    #[test]
    fn running_integrals_are_exact_for_cubics() {
        for degree in 0..4 {
            for (row, end) in RUNNING.iter().zip(NODES) {
                let value: f64 = row.iter().zip(NODES).map(|(weight, node)| weight * node.powi(degree)).sum();
                let want = end.powi(degree + 1) / f64::from(degree + 1);
                assert!((value - want).abs() < 1e-15, "degree {degree} to {end}: {value} {want}");
            }
        }
    }
}
