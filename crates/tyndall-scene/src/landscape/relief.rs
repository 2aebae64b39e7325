//! Terrain: octaves of lattice noise, each damped by the slope that the coarser ones have gathered, so that steep flanks
//! stay smooth and valley floors level as if eroded; crests where the noise is folded. Heights come with their exact
//! gradient. WGSL: `shaders/landscape/relief.wgsl`.

use std::f64::consts::TAU;

use tyndall_core::rng::noise_pcg;

use super::M_PER_KM;
use super::noise::lattice_noise;
use crate::{LandscapeKind, LandscapeParams};

/// Octaves of the noise; the finest is 8192 times finer than the coarsest.
pub const OCTAVES: usize = 13;

/// Turn of each octave against the one before, so that no direction of the lattice shows.
const TURN: [f64; 2] = [0.8, 0.6];

/// Rounding of folded crests, in units of the noise.
const CREST: f64 = 0.06;

/// Height below which valleys level out, relative to the terrain's.
const FLOOR: f64 = 0.06;

/// Depth (m) to which the terrain sinks outside its square, so that the planet covers it.
pub const SINK_M: f64 = 60.0;

/// Share of half the side over which the terrain falls to the planet's level.
pub const MARGIN: f64 = 0.3;

/// A terrain. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief {
    /// Half the side of its square.
    pub half_size_m: f64,
    /// Height of high peaks.
    pub height_m: f64,
    /// Wavelength of the coarsest octave.
    pub wavelength_m: f64,
    /// Amplitude of an octave relative to the one before.
    pub gain: f64,
    /// How much steep slopes damp finer octaves.
    pub damping: f64,
    /// 0 for rounded hills, 1 for folded crests.
    pub ridge: f64,
    /// Height without noise, relative to `height_m`: in the valley (or everywhere), and what the crests add.
    pub base: [f64; 2],
    /// Amplitude of the noise relative to `height_m`, in the same way.
    pub amplitude: [f64; 2],
    /// Half the width of the valley from crest to crest; 0 without a valley.
    pub valley_m: f64,
    /// Key of the random numbers.
    pub key: u32,
}

/// Height of the terrain and its derivatives to the east and the north.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReliefPoint {
    /// Altitude; below 0 the planet covers it.
    pub height_m: f64,
    /// Slope towards the east and the north (m/m).
    pub gradient: [f64; 2],
}

/// A function of the place and its derivatives by x and y.
type WithGradient = (f64, [f64; 2]);

impl Relief {
    /// From its parameters.
    #[must_use]
    pub fn new(params: &LandscapeParams) -> Self {
        let feature_m = params.feature_km * M_PER_KM;
        let common = Self {
            half_size_m: 0.5 * params.size_km * M_PER_KM,
            height_m: params.height_m,
            wavelength_m: feature_m,
            gain: 0.46,
            damping: 0.2,
            ridge: 0.0,
            base: [0.35, 0.0],
            amplitude: [0.55, 0.0],
            valley_m: 0.0,
            key: noise_pcg(params.seed),
        };
        match params.kind {
            LandscapeKind::Mountains => {
                Self { ridge: 0.8, base: [0.30, 0.0], amplitude: [0.72, 0.0], gain: 0.47, damping: 0.12, ..common }
            }
            LandscapeKind::Valley => Self {
                ridge: 0.75,
                gain: 0.47,
                damping: 0.12,
                wavelength_m: 0.55 * feature_m,
                base: [0.05, 0.36],
                amplitude: [0.03, 0.6],
                valley_m: 0.5 * feature_m,
                ..common
            },
            LandscapeKind::None | LandscapeKind::Hills => common,
        }
    }

    /// An altitude that the terrain does not exceed: that of all octaves at their largest, which never meet.
    #[must_use]
    pub fn highest_m(&self) -> f64 {
        let noise = (self.amplitude[0] + self.amplitude[1]) / (1.0 - self.gain);
        self.height_m * (self.base[0] + self.base[1] + noise + FLOOR)
    }

    /// Share of a bend at which the valley's axis begins: a place of the seed's.
    #[must_use]
    pub fn valley_phase(&self) -> f64 {
        f64::from(self.key >> 8) / 16_777_216.0
    }

    /// Height at a place; octaves finer than twice `footprint_m` are left out gently.
    #[must_use]
    pub fn at(&self, x_m: f64, y_m: f64, footprint_m: f64) -> ReliefPoint {
        let (mask, mask_slope) = self.mask(x_m, y_m);
        let (crest, crest_slope) = self.crest(x_m, y_m);
        let (noise, noise_slope) = self.octaves(x_m, y_m, footprint_m);
        let amplitude = self.amplitude[0] + self.amplitude[1] * crest;
        let (shape, rise) = above_floor(self.base[0] + self.base[1] * crest + amplitude * noise);
        let gradient = [0, 1].map(|k| {
            let shape_slope = (self.base[1] + self.amplitude[1] * noise) * crest_slope[k] + amplitude * noise_slope[k];
            self.height_m * (mask_slope[k] * shape + mask * rise * shape_slope) + mask_slope[k] * SINK_M
        });
        ReliefPoint { height_m: self.height_m * mask * shape - (1.0 - mask) * SINK_M, gradient }
    }

    /// 1 inside, 0 at the edge of the square and outside.
    fn mask(&self, x_m: f64, y_m: f64) -> WithGradient {
        let margin_m = MARGIN * self.half_size_m;
        let side = |at_m: f64| {
            let (value, slope) = smoothstep((self.half_size_m - at_m.abs()) / margin_m);
            (value, -at_m.signum() * slope / margin_m)
        };
        let ((x, x_slope), (y, y_slope)) = (side(x_m), side(y_m));
        (x * y, [x_slope * y, x * y_slope])
    }

    /// 0 on the floor of the valley, 1 on its crests and beyond; 0 without a valley.
    fn crest(&self, x_m: f64, y_m: f64) -> WithGradient {
        if self.valley_m <= 0.0 {
            return (0.0, [0.0; 2]);
        }
        let phase = self.valley_phase();
        let angle = TAU * (y_m / (8.0 * self.valley_m) + phase);
        let bend_m = 0.5 * self.valley_m;
        let from_axis = x_m - bend_m * (angle.sin() - (TAU * phase).sin());
        let turn = -bend_m * TAU / (8.0 * self.valley_m) * angle.cos();
        let (value, slope) = smoothstep((from_axis.abs() / self.valley_m - 0.22) / 0.78);
        let slope = slope * from_axis.signum() / (0.78 * self.valley_m);
        (value, [slope, slope * turn])
    }

    /// Sum of the octaves, about -1 to 1, and its derivatives (1/m).
    fn octaves(&self, x_m: f64, y_m: f64, footprint_m: f64) -> WithGradient {
        let mut point = [x_m / self.wavelength_m, y_m / self.wavelength_m];
        // The columns are the derivatives of the octave's coordinates.
        let mut frame = [[1.0, 0.0], [0.0, 1.0]];
        let (mut amplitude, mut wavelength_m) = (1.0, self.wavelength_m);
        let (mut sum, mut sum_slope) = (0.0, [0.0; 2]);
        let (mut slope, mut bend) = ([0.0; 2], [0.0; 3]);
        for octave in 0..OCTAVES {
            let seen = detail_seen(wavelength_m, footprint_m);
            if seen <= 0.0 {
                break;
            }
            #[expect(clippy::cast_possible_truncation, reason = "a small number")]
            let noise =
                lattice_noise(point[0], point[1], self.key.wrapping_add((octave as u32).wrapping_mul(0x9E37_79B9)));
            let (value, first, second) = fold(noise.value, self.ridge);
            let strength = amplitude * seen;
            let [gx, gy] = noise.gradient;
            let here = [0, 1].map(|k| strength * first * (frame[0][k] * gx + frame[1][k] * gy));
            let [hxx, hxy, hyy] = noise.hessian;
            let inner =
                [first * hxx + second * gx * gx, first * hxy + second * gx * gy, first * hyy + second * gy * gy];
            let curvature = |i: usize, j: usize| {
                strength
                    * (frame[0][i] * (inner[0] * frame[0][j] + inner[1] * frame[1][j])
                        + frame[1][i] * (inner[1] * frame[0][j] + inner[2] * frame[1][j]))
            };
            let damped = 1.0 / (1.0 + self.damping * (slope[0] * slope[0] + slope[1] * slope[1]));
            let change = -2.0 * self.damping * damped * damped * strength * value;
            sum += strength * value * damped;
            sum_slope[0] += here[0] * damped + change * (bend[0] * slope[0] + bend[1] * slope[1]);
            sum_slope[1] += here[1] * damped + change * (bend[1] * slope[0] + bend[2] * slope[1]);
            bend = [bend[0] + curvature(0, 0), bend[1] + curvature(0, 1), bend[2] + curvature(1, 1)];
            slope = [slope[0] + here[0], slope[1] + here[1]];

            let [c, s] = TURN.map(|part| 2.0 * part);
            point = [c * point[0] + s * point[1] + 0.37, c * point[1] - s * point[0] + 0.71];
            frame = [0, 1].map(|row| {
                [0, 1].map(
                    |k| if row == 0 { c * frame[0][k] + s * frame[1][k] } else { c * frame[1][k] - s * frame[0][k] },
                )
            });
            amplitude *= self.gain;
            wavelength_m *= 0.5;
        }
        (sum, sum_slope.map(|slope| slope / self.wavelength_m))
    }
}

/// Share of an octave that is seen under a footprint: all from four footprints a wave, none below two.
fn detail_seen(wavelength_m: f64, footprint_m: f64) -> f64 {
    if footprint_m <= 0.0 { 1.0 } else { (0.5 * wavelength_m / footprint_m - 1.0).clamp(0.0, 1.0) }
}

/// A height that levels out above 0, as sediment fills the floors of valleys, and its derivative.
fn above_floor(height: f64) -> (f64, f64) {
    let round = height.hypot(FLOOR);
    (0.5 * (height + round), 0.5 * (1.0 + height / round))
}

/// Noise partly folded into crests, with its first two derivatives by the noise.
fn fold(value: f64, ridge: f64) -> (f64, f64, f64) {
    let round = value.hypot(CREST);
    let round_minus = CREST * CREST / (round * round * round);
    (value + ridge * (1.0 - 2.0 * round - value), 1.0 - ridge - 2.0 * ridge * value / round, -2.0 * ridge * round_minus)
}

/// 3t^2 - 2t^3 between 0 and 1, and its derivative.
fn smoothstep(t: f64) -> (f64, f64) {
    let t = t.clamp(0.0, 1.0);
    (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds() -> [Relief; 3] {
        [LandscapeKind::Hills, LandscapeKind::Mountains, LandscapeKind::Valley]
            .map(|kind| Relief::new(&LandscapeParams { kind, ..LandscapeParams::default() }))
    }

    #[test]
    fn the_gradient_is_that_of_finite_differences() {
        for relief in kinds() {
            for k in 0..300 {
                let (x, y) = (173.0 * f64::from(k) - 27_000.0, 29_000.0 - 191.0 * f64::from(k));
                // Without the finest octaves, whose bends a step of a metre cannot follow.
                let at = |dx: f64, dy: f64| relief.at(x + dx, y + dy, 40.0);
                let step = 0.05;
                let want = [
                    (at(step, 0.0).height_m - at(-step, 0.0).height_m) / (2.0 * step),
                    (at(0.0, step).height_m - at(0.0, -step).height_m) / (2.0 * step),
                ];
                let got = at(0.0, 0.0).gradient;
                let near = (0..2).all(|k| (got[k] - want[k]).abs() < 2e-3 * (1.0 + want[k].abs()));
                assert!(near, "({x}, {y}): {got:?} {want:?}");
            }
        }
    }

    #[test]
    fn a_footprint_only_smooths() {
        for relief in kinds() {
            for k in 0..100 {
                let (x, y) = (310.0 * f64::from(k) - 15_000.0, 97.0 * f64::from(k));
                let (fine, coarse) = (relief.at(x, y, 0.0).height_m, relief.at(x, y, 20.0).height_m);
                // Octaves below 80 m: their amplitudes add up to about 6400 m's times 0.48^6.
                assert!((fine - coarse).abs() < 0.03 * relief.height_m, "({x}, {y}): {fine} {coarse}");
            }
        }
    }

    #[test]
    fn the_valley_has_a_level_floor_between_mountains() {
        let relief = Relief::new(&LandscapeParams { kind: LandscapeKind::Valley, ..LandscapeParams::default() });
        let mean =
            |x: f64| (0..200).map(|k| relief.at(x, f64::from(k) * 20.0 - 2000.0, 0.0).height_m).sum::<f64>() / 200.0;
        let (floor, crests) = (mean(0.0), 0.5 * (mean(-4500.0) + mean(4500.0)));
        assert!(floor < 0.15 * relief.height_m && crests > 3.0 * floor, "{floor} {crests}");
    }
}
