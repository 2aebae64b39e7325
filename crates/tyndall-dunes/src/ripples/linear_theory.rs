//! Growth of small ripples by the rule of Nishimori and Ouchi, in closed form.
//!
//! A flat bed with a wave of wavenumber k along the wind. With a hop of fractional length split over its two nearest
//! cells, `l` the whole part of L0 and D, q, b as in [`super::RippleParams`], one step multiplies the wave by
//!
//! `G(k) = [1 - (2D/3) (1 - cos k)] [1 + q b (exp(-i k (l+1)) - exp(-i k l))]`.
//!
//! At a whole L0 troughs hop over l - 1 or l cells and crests over l or l + 1; the mean of both makes the last bracket
//! `1 - i q b sin(k) exp(-i k l)`.
//!
//! Ripples exist if and only if some |G(k)| is above 1. Derived here from the rule; [`super::split_bed`] agrees with it.

use super::RippleParams;

/// The numbers of the rule that the linear theory needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRule {
    /// Hop over a flat bed, L0 (cells).
    pub hop_cells: f64,
    /// Hop length for a cell of height, b (1).
    pub hop_per_height: f64,
    /// Layer, q (cells).
    pub layer_cells: f64,
    /// Creep, D (1).
    pub creep: f64,
}

/// Wavenumbers that are tried when the fastest wave is looked for.
const WAVENUMBERS: u32 = 4000;

impl LinearRule {
    /// The numbers of these parameters.
    #[must_use]
    pub fn of(params: &RippleParams) -> Self {
        Self {
            hop_cells: params.hop_cells,
            hop_per_height: params.hop_per_height,
            layer_cells: params.layer_cells,
            creep: params.creep,
        }
    }

    /// G(k) as [real part, imaginary part], for a wavenumber k (1/cell).
    #[must_use]
    pub fn growth(&self, k: f64) -> [f64; 2] {
        let whole = self.hop_cells.floor();
        let creep = 1.0 - 2.0 * self.creep / 3.0 * (1.0 - k.cos());
        let gain = self.layer_cells * self.hop_per_height;
        let (far, near, share) =
            if self.hop_cells > whole { (whole + 1.0, whole, 1.0) } else { (whole + 1.0, whole - 1.0, 0.5) };
        let real = 1.0 + share * gain * ((k * far).cos() - (k * near).cos());
        let imaginary = share * gain * ((k * near).sin() - (k * far).sin());
        [creep * real, creep * imaginary]
    }

    /// |G(k)|: above 1 the wave grows.
    #[must_use]
    pub fn growth_factor(&self, k: f64) -> f64 {
        let [real, imaginary] = self.growth(k);
        real.hypot(imaginary)
    }

    /// How far a wave moves downwind in a step (cells), -arg(G) / k.
    #[must_use]
    pub fn drift_cells_per_step(&self, k: f64) -> f64 {
        let [real, imaginary] = self.growth(k);
        -imaginary.atan2(real) / k
    }

    /// The fastest wave: [wavenumber (1/cell), growth factor]; wavelengths from 2 to 314 cells.
    #[must_use]
    pub fn fastest(&self) -> [f64; 2] {
        let wave = |index: u32| {
            let k = 0.02 + (std::f64::consts::PI - 0.02) * f64::from(index) / f64::from(WAVENUMBERS);
            [k, self.growth_factor(k)]
        };
        (0..=WAVENUMBERS).map(wave).max_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or([std::f64::consts::PI, 0.0])
    }

    /// Whether a flat bed ripples.
    #[must_use]
    pub fn ripples(&self) -> bool {
        self.fastest()[1] > 1.0
    }

    /// The thinnest layer q (cells) that makes a flat bed ripple, or `None` when one of 10 cells does not.
    #[must_use]
    pub fn onset_layer_cells(&self) -> Option<f64> {
        let with = |layer_cells: f64| Self { layer_cells, ..*self };
        let (mut low, mut high) = (0.0, 10.0);
        if !with(high).ripples() {
            return None;
        }
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if with(middle).ripples() { high = middle } else { low = middle }
        }
        Some(high)
    }

    /// The shortest hop over a flat bed that makes it ripple (cells): the lower end of the wind's critical range.
    #[must_use]
    pub fn onset_hop_cells(&self) -> Option<f64> {
        (0..=64_u32).map(f64::from).find(|&hop_cells| Self { hop_cells, ..*self }.ripples())
    }
}

/// What a wind makes of a flat bed; section 5.1 of the paper knows ripples within a critical range only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// The wind is too weak: creep smooths the bed.
    Smooth,
    /// Ripples grow.
    Rippled,
    /// The wind is too strong: grains stay in the air and the bed is planed.
    Planed,
}

/// The regime of these parameters.
#[must_use]
pub fn regime(params: &RippleParams) -> Regime {
    if params.hop_cells > params.planed_above_cells {
        Regime::Planed
    } else if LinearRule::of(params).ripples() {
        Regime::Rippled
    } else {
        Regime::Smooth
    }
}
