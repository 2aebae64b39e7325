//! Smooth noise on a lattice with its first and second derivatives. WGSL: `shaders/common/lattice.wgsl`.

use tyndall_core::rng::noise_pcg;

/// Value of the noise at a point, and how it changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// The noise, -1 to 1.
    pub value: f64,
    /// Derivatives by x and y.
    pub gradient: [f64; 2],
    /// Second derivatives: xx, xy, yy.
    pub hessian: [f64; 3],
}

/// Random number of a lattice point, -1 to 1.
#[must_use]
pub fn lattice_value(x: i32, y: i32, key: u32) -> f64 {
    let word = noise_pcg(x.cast_unsigned().wrapping_add(noise_pcg(y.cast_unsigned().wrapping_add(key))));
    f64::from(word >> 8) / 8_388_608.0 - 1.0
}

/// Noise between the lattice points by the quintic blend of Perlin 2002, whose second derivatives are continuous.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "landscapes end long before the lattice does")]
pub fn lattice_noise(x: f64, y: f64, key: u32) -> Noise {
    let (cell_x, cell_y) = (x.floor(), y.floor());
    let (i, j) = (cell_x as i32, cell_y as i32);
    let [a, b, c, d] =
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| lattice_value(i.wrapping_add(dx), j.wrapping_add(dy), key));
    let (u, v) = (lattice_blend(x - cell_x), lattice_blend(y - cell_y));
    let (along_x, along_y, across) = (b - a, c - a, a - b - c + d);
    Noise {
        value: a + along_x * u[0] + along_y * v[0] + across * u[0] * v[0],
        gradient: [u[1] * (along_x + across * v[0]), v[1] * (along_y + across * u[0])],
        hessian: [u[2] * (along_x + across * v[0]), u[1] * v[1] * across, v[2] * (along_y + across * u[0])],
    }
}

/// The quintic blend and its two derivatives at 0 to 1.
#[must_use]
pub fn lattice_blend(t: f64) -> [f64; 3] {
    [
        t * t * t * (t * (6.0 * t - 15.0) + 10.0),
        30.0 * t * t * (t - 1.0) * (t - 1.0),
        60.0 * t * (t * (2.0 * t - 3.0) + 1.0),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivatives_are_those_of_finite_differences() {
        let step = 1e-5;
        for k in 0..200 {
            let (x, y) = (0.37 * f64::from(k) - 20.1, 11.2 - 0.23 * f64::from(k));
            let at = |dx: f64, dy: f64| lattice_noise(x + dx, y + dy, 7);
            let here = at(0.0, 0.0);
            let dx = (at(step, 0.0).value - at(-step, 0.0).value) / (2.0 * step);
            let dy = (at(0.0, step).value - at(0.0, -step).value) / (2.0 * step);
            assert!((here.gradient[0] - dx).abs() < 1e-6 && (here.gradient[1] - dy).abs() < 1e-6, "{k}: {here:?}");
            let dxx = (at(step, 0.0).gradient[0] - at(-step, 0.0).gradient[0]) / (2.0 * step);
            let dxy = (at(0.0, step).gradient[0] - at(0.0, -step).gradient[0]) / (2.0 * step);
            let dyy = (at(0.0, step).gradient[1] - at(0.0, -step).gradient[1]) / (2.0 * step);
            // The blend's third derivative is 60 at the lattice's lines.
            let near = here.hessian.iter().zip([dxx, dxy, dyy]).all(|(got, want)| (got - want).abs() < 2e-3);
            assert!(near, "{k}: {:?} {dxx} {dxy} {dyy}", here.hessian);
        }
    }

    #[test]
    fn lattice_values_fill_their_range_evenly() {
        let values: Vec<f64> = (0..10_000).map(|k| lattice_value(k % 100 - 50, k / 100, 3)).collect();
        let mean = values.iter().sum::<f64>() / 1e4;
        let variance = values.iter().map(|v| v * v).sum::<f64>() / 1e4;
        // Five standard errors of a uniform distribution over -1 to 1.
        assert!(mean.abs() < 0.029 && (variance - 1.0 / 3.0).abs() < 0.015, "{mean} {variance}");
    }
}
