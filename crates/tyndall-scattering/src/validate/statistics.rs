//! A set of relative errors in a few numbers.

/// What errors amount to; per cent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Values compared.
    pub count: usize,
    /// Half of the errors are smaller.
    pub median_pct: f64,
    /// 95 of 100 errors are smaller.
    pub p95_pct: f64,
    /// The largest error.
    pub worst_pct: f64,
    /// Sum of all values against the sum of the reference's; positive when too bright.
    pub bias_pct: f64,
    /// Median standard error of the reference: errors below it are not the tables'.
    pub noise_pct: f64,
}

/// A value of the tables beside the reference's and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// By the tables.
    pub table: f64,
    /// By Monte-Carlo.
    pub reference: f64,
    /// Standard error of the reference.
    pub standard_error: f64,
}

impl Pair {
    /// Relative error of the tables (per cent); none where both are black.
    #[must_use]
    pub fn error_pct(&self) -> f64 {
        if self.reference > 0.0 { 100.0 * (self.table / self.reference - 1.0) } else { 0.0 }
    }

    fn noise_pct(&self) -> f64 {
        if self.reference > 0.0 { 100.0 * self.standard_error / self.reference } else { 0.0 }
    }
}

impl Statistics {
    /// Of some pairs; zeros for none.
    #[must_use]
    pub fn new(pairs: &[Pair]) -> Self {
        let ascending = |value: &dyn Fn(&Pair) -> f64| {
            let mut values: Vec<f64> = pairs.iter().map(value).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let errors = ascending(&|pair| pair.error_pct().abs());
        let noise = ascending(&Pair::noise_pct);
        let sum = |value: &dyn Fn(&Pair) -> f64| pairs.iter().map(value).sum::<f64>();
        let reference = sum(&|pair| pair.reference);
        Self {
            count: pairs.len(),
            median_pct: at_share(&errors, 50),
            p95_pct: at_share(&errors, 95),
            worst_pct: errors.last().copied().unwrap_or(0.0),
            bias_pct: if reference > 0.0 { 100.0 * (sum(&|pair| pair.table) / reference - 1.0) } else { 0.0 },
            noise_pct: at_share(&noise, 50),
        }
    }
}

/// The value below which `percent` of 100 ascending values lie.
fn at_share(ascending: &[f64], percent: usize) -> f64 {
    let last = ascending.len().saturating_sub(1);
    ascending.get((ascending.len() * percent / 100).min(last)).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_are_those_of_a_known_list() {
        let pairs: Vec<Pair> = (0..100)
            .map(|i| Pair { table: 1.0 + f64::from(i) / 1000.0, reference: 1.0, standard_error: 0.002 })
            .collect();
        let statistics = Statistics::new(&pairs);
        let expected = [(statistics.median_pct, 5.0), (statistics.p95_pct, 9.5), (statistics.worst_pct, 9.9)];
        for (got, want) in expected.into_iter().chain([(statistics.bias_pct, 4.95), (statistics.noise_pct, 0.2)]) {
            assert!((got - want).abs() < 1e-9, "{got} {want}: {statistics:?}");
        }
    }

    #[test]
    fn no_values_and_black_values_have_no_errors() {
        assert_eq!(Statistics::new(&[]), Statistics::default(), "nothing");
        let black = Pair { table: 0.0, reference: 0.0, standard_error: 0.0 };
        assert!(Statistics::new(&[black; 3]).worst_pct.abs() < 1e-12, "black on black");
    }
}
