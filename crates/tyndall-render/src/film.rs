//! The film on the CPU: metering, exposure, tone map and dither of a picture that no GPU has seen. f64 twin of
//! `shaders/frame/{meter,develop}.wgsl`.

use tyndall_core::spectrum::luminance_from_rec709;
use tyndall_scene::{ExposureMode, FilmParams, ToneMap};

use crate::dither::noise_triangular;
use crate::exposure::{ev100_from_gain, gain_from_ev100};
use crate::tone::{tone_aces, tone_agx, tone_look, tone_srgb_encode};

/// Side of the meter's grid.
const METER_GRID: u32 = 96;

/// Range of the meter about the expected exposure (stops).
const METER_LOG2_SPAN: f64 = 24.0;

/// White, relative to the metered mean, as in the meter's shader.
const METERED_SHARE: f64 = 0.125 / 1.2;

/// A picture's film, exposed.
#[derive(Clone, Copy, Debug)]
pub struct ExposedFilm<'a> {
    film: &'a FilmParams,
    /// Exposed value per radiance [1/(cd/m^2)].
    gain: f64,
}

impl<'a> ExposedFilm<'a> {
    /// Exposes for a picture in linear Rec.709 (cd/m^2), row 0 on top; `expected_ev100` is the exposure that a first guess
    /// gives.
    #[must_use]
    pub fn new(film: &'a FilmParams, expected_ev100: f64, rgba: &[[f32; 4]], size_px: [u32; 2]) -> Self {
        let pre_exposure = gain_from_ev100(expected_ev100);
        let compensation = film.compensation_ev.exp2();
        let gain = match film.exposure {
            ExposureMode::Manual => gain_from_ev100(film.ev100),
            ExposureMode::Auto => METERED_SHARE / metered_log2(rgba, size_px, pre_exposure).exp2() * pre_exposure,
        };
        Self { film, gain: gain * compensation }
    }

    /// Exposure value at ISO 100.
    #[must_use]
    pub fn ev100(&self) -> f64 {
        ev100_from_gain(self.gain)
    }

    /// Display values 0..1 of a pixel, dithered for a picture of `levels` steps.
    #[must_use]
    pub fn develop(&self, radiance: [f32; 4], pixel: [u32; 2], levels: f64) -> [f64; 3] {
        let [r, g, b, _] = radiance.map(f64::from);
        let exposed = [r, g, b].map(|value| value * self.gain);
        let shown = match self.film.tone_map {
            ToneMap::AgX => tone_agx(exposed),
            ToneMap::Aces => tone_aces(exposed).map(tone_srgb_encode),
            ToneMap::None => exposed.map(tone_srgb_encode),
        };
        let shown = tone_look(shown, self.film.contrast, self.film.saturation);
        let noise = |channel: u32| if self.film.dither { noise_triangular(pixel, channel) / levels } else { 0.0 };
        [0, 1, 2].map(|channel| (shown[channel as usize] + noise(channel)).clamp(0.0, 1.0))
    }
}

/// Mean log2 of the pre-exposed luminance over a grid of pixels, heavier towards the centre.
#[expect(clippy::cast_possible_truncation, reason = "pixel indices")]
fn metered_log2(rgba: &[[f32; 4]], size_px: [u32; 2], pre_exposure: f64) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for index in 0..METER_GRID * METER_GRID {
        let unit = [index % METER_GRID, index / METER_GRID].map(|i| (f64::from(i) + 0.5) / f64::from(METER_GRID));
        let [x, y] = [0, 1].map(|axis| ((unit[axis] * f64::from(size_px[axis])) as u32).min(size_px[axis] - 1));
        let Some(pixel) = rgba.get(y as usize * size_px[0] as usize + x as usize) else { continue };
        let [r, g, b, _] = pixel.map(|value| f64::from(value).max(0.0) * pre_exposure);
        let log2 = luminance_from_rec709([r, g, b]).max(1e-12).log2().clamp(-METER_LOG2_SPAN, METER_LOG2_SPAN);
        let weight = 1.0 - 0.35 * unit.map(|u| (2.0 * u - 1.0).powi(2)).iter().sum::<f64>();
        sum += weight * log2;
        weights += weight;
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_grey_picture_is_metered_as_its_own_exposure() {
        let film = FilmParams { compensation_ev: 0.0, ..FilmParams::default() };
        // An average of 0.125 x 2^EV is metered as EV; a wrong first guess does not matter.
        let grey = [[1000.0_f32, 1000.0, 1000.0, 1.0]; 64];
        for guess in [5.0, 13.0] {
            let exposed = ExposedFilm::new(&film, guess, &grey, [8, 8]);
            assert!((exposed.ev100() - (1000.0_f64 / 0.125).log2()).abs() < 1e-4, "{}", exposed.ev100());
        }
    }

    #[test]
    fn a_manual_exposure_is_what_was_asked_for_and_white_is_white() {
        let film = FilmParams {
            exposure: ExposureMode::Manual,
            ev100: 10.0,
            compensation_ev: 0.0,
            tone_map: ToneMap::None,
            contrast: 1.0,
            saturation: 1.0,
            dither: false,
        };
        let exposed = ExposedFilm::new(&film, 3.0, &[], [0, 0]);
        assert!((exposed.ev100() - 10.0).abs() < 1e-12, "{}", exposed.ev100());
        let [white, black] = [1.2 * 1024.0, 0.0].map(|light: f32| exposed.develop([light; 4], [0, 0], 255.0));
        assert!(white.iter().all(|value| *value > 0.999) && black.iter().all(|value| *value < 1e-9), "{white:?}");
    }
}
