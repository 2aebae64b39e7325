//! The plots panel: the sky's spectrum under the pointer, and its luminance along the meridian of the sun.

use egui::{Color32, Grid, Sense, Stroke, Ui, vec2};
use egui_plot::{GridMark, HoverPosition, Line, Plot, PlotPoints, Points, VLine};
use tyndall_core::spectrum::{WAVELENGTHS_NM, chromaticity, rec709_from_xyz};
use tyndall_scene::Scene;

use super::time::compass;
use crate::sky_probe::{Answer, Question, Sample, Sight, SkyProbe};

/// Widths of the figures; the plots share the rest.
const FIGURES_PT: f32 = 190.0;
const GAP_PT: f32 = 12.0;

/// Least luminance (cd/m^2) that the logarithmic axis shows: that of a starless night.
const LEAST_CD_M2: f64 = 1e-6;

/// Shows the panel; `at_rest` is whether the view has come to rest, so that there is time to compute.
pub(crate) fn show(ui: &mut Ui, probe: &mut SkyProbe, scene: &Scene, cursor: Option<Sight>, at_rest: bool) {
    let Some(question) = Question::new(scene, cursor) else {
        ui.weak("There is no sky to plot: the observer is outside of the atmosphere.");
        return;
    };
    if at_rest {
        let ctx = ui.ctx().clone();
        probe.ask(question, move || ctx.request_repaint());
    }
    let Some(answer) = probe.answer() else {
        ui.weak("Computing...");
        return;
    };
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.set_width(FIGURES_PT.min(ui.available_width()));
            figures(ui, answer);
        });
        let width = (0.5 * (ui.available_width() - GAP_PT)).max(80.0);
        ui.vertical(|ui| {
            ui.set_width(width);
            ui.strong("Spectrum under the pointer, mW/m²/sr/nm over nm");
            spectrum(ui, answer.cursor.as_ref());
        });
        ui.vertical(|ui| {
            ui.set_width(ui.available_width());
            ui.strong("Luminance along the sun's meridian, cd/m²");
            meridian(ui, answer);
        });
    });
}

fn figures(ui: &mut Ui, answer: &Answer) {
    let Some(sample) = &answer.cursor else {
        ui.weak("Point at the view to see the light that comes from there.");
        return;
    };
    let [x, y] = chromaticity(sample.xyz);
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(28.0, 28.0), Sense::empty());
        ui.painter().rect_filled(rect, 4.0, colour(sample.xyz));
        ui.vertical(|ui| {
            ui.strong(format!("{} cd/m²", short(sample.xyz[1])));
            ui.label(format!("x {x:.4}  y {y:.4}"));
        });
    });
    Grid::new("figures").num_columns(2).spacing([10.0, 2.0]).show(ui, |ui| {
        let azimuth_deg = sample.sight.azimuth_rad.to_degrees().rem_euclid(360.0);
        ui.weak("Direction");
        ui.label(format!("{azimuth_deg:.1}° {}", compass(azimuth_deg)));
        ui.end_row();
        ui.weak("Height");
        ui.label(format!("{:.2}°", sample.sight.elevation_rad.to_degrees()));
        ui.end_row();
        ui.weak("Computed in");
        ui.label(format!("{:.0} ms", answer.ms));
        ui.end_row();
    });
    ui.weak("Sunlight in the air; no discs, no landscape.");
}

fn spectrum(ui: &mut Ui, sample: Option<&Sample>) {
    let colour = ui.visuals().selection.bg_fill;
    let Some(sample) = sample else { return };
    let points: Vec<[f64; 2]> =
        WAVELENGTHS_NM.into_iter().zip(sample.radiance.map(|l| l * 1e3)).map(Into::into).collect();
    quiet(Plot::new("spectrum"))
        .include_y(0.0)
        .y_grid_spacer(|input| few(input.bounds))
        .y_axis_formatter(|mark, _| short(mark.value))
        .label_formatter(|hover| match hover {
            HoverPosition::NearDataPoint { position, .. } => {
                Some(format!("{:.0} nm\n{:.4} mW/m²/sr/nm", position.x, position.y))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
        .show(ui, |plot| {
            plot.line(Line::new("radiance", PlotPoints::from(points.clone())).color(colour).width(1.8));
            plot.points(Points::new("radiance", PlotPoints::from(points)).color(colour).radius(3.0));
        });
}

fn meridian(ui: &mut Ui, answer: &Answer) {
    let (strong, accent, weak) =
        (ui.visuals().strong_text_color(), ui.visuals().selection.bg_fill, ui.visuals().weak_text_color());
    let curve = |luminance: fn(&crate::sky_probe::MeridianPoint) -> f64| -> PlotPoints<'_> {
        answer.meridian.iter().map(|point| [point.angle_deg, luminance(point).max(LEAST_CD_M2).log10()]).collect()
    };
    let sun_deg = answer.question.sun_angle_deg();
    quiet(Plot::new("meridian"))
        .include_x(0.0)
        .include_x(180.0)
        .x_grid_spacer(|_| angles())
        .y_grid_spacer(|input| decades(input.bounds))
        .x_axis_formatter(|mark, _| angle_name(mark.value))
        .y_axis_formatter(|mark, _| short(10_f64.powf(mark.value)))
        .label_formatter(|hover| match hover {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                Some(format!("{plot_name}\n{:.1}°: {} cd/m²", position.x, short(10_f64.powf(position.y))))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
        .show(ui, |plot| {
            plot.vline(VLine::new("sun", sun_deg).stroke(Stroke::new(1.0, Color32::from_rgb(220, 170, 60))));
            plot.line(Line::new("scattered once", curve(|point| point.once_cd_m2)).color(weak).width(1.2));
            let all = curve(|point| point.luminance_cd_m2);
            plot.line(Line::new("all light", all).color(accent.lerp_to_gamma(strong, 0.2)).width(1.8));
        });
}

/// A plot that shows and does not move.
pub(super) fn quiet(plot: Plot<'_>) -> Plot<'_> {
    plot.allow_drag(false).allow_zoom(false).allow_scroll(false).allow_boxed_zoom(false)
}

fn angles() -> Vec<GridMark> {
    (0..=4).map(|i| GridMark { value: 45.0 * f64::from(i), step_size: 45.0 }).collect()
}

fn angle_name(angle_deg: f64) -> String {
    match angle_deg {
        a if a < 1.0 => "sun side".to_owned(),
        a if (a - 90.0).abs() < 1.0 => "zenith".to_owned(),
        a if a > 179.0 => "far side".to_owned(),
        a => format!("{:.0}°", a.min(180.0 - a)),
    }
}

/// Lines at the powers of ten and, where few of them fit, at 2 and 5 times them.
fn decades((low, high): (f64, f64)) -> Vec<GridMark> {
    #[expect(clippy::cast_possible_truncation, reason = "a few decades")]
    let whole = (low.floor() as i32)..=(high.ceil() as i32);
    let steps: &[f64] = if high - low < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let marks = whole.flat_map(|decade| steps.iter().map(move |step| f64::from(decade) + step.log10()));
    // Names of marks outside of the frame would stand over what is around it.
    marks.filter(|mark| (low..=high).contains(mark)).map(|value| GridMark { value, step_size: 1.0 }).collect()
}

/// Two to five lines at round numbers.
pub(super) fn few((low, high): (f64, f64)) -> Vec<GridMark> {
    let span = high - low;
    if !(span.is_finite() && span > 0.0) {
        return Vec::new();
    }
    let decade = 10_f64.powf(span.log10().floor());
    let step =
        [0.2, 0.5, 1.0].map(|part| part * decade).into_iter().find(|step| span / step <= 5.0).unwrap_or(2.0 * decade);
    let marks = (0..8).map(|i| ((low / step).ceil() + f64::from(i)) * step);
    marks.filter(|mark| (low..=high).contains(mark)).map(|value| GridMark { value, step_size: step }).collect()
}

/// A number as people read it: 4,300 or 0.0021, three digits that count.
pub(super) fn short(value: f64) -> String {
    if value.abs() >= 1e5 || (value != 0.0 && value.abs() < 1e-3) {
        return format!("{value:.0e}");
    }
    let digits = (2.0 - value.abs().max(1e-3).log10().floor()).clamp(0.0, 5.0);
    #[expect(clippy::cast_possible_truncation, reason = "0 to 5")]
    let text = format!("{value:.*}", digits as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// The colour of a light, as bright as a screen shows it.
fn colour(xyz: [f64; 3]) -> Color32 {
    let rgb = rec709_from_xyz(xyz).map(|value| value.max(0.0));
    let brightest = rgb.into_iter().fold(f64::MIN_POSITIVE, f64::max);
    #[expect(clippy::cast_possible_truncation, reason = "shares")]
    let [r, g, b] = rgb.map(|value| (value / brightest) as f32);
    egui::Rgba::from_rgb(r, g, b).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_three_digits() {
        for (value, text) in [(4321.4, "4321"), (12.34, "12.3"), (0.012_34, "0.0123"), (200.0, "200"), (2e-5, "2e-5")] {
            assert_eq!(short(value), text, "{value}");
        }
        assert_eq!(short(0.0), "0", "no light");
        assert_eq!(short(-2.5), "-2.5", "too dark");
        assert_eq!(short(1.6e9), "2e9", "the sun");
    }

    #[test]
    fn every_axis_has_a_few_lines_within_its_frame() {
        for (low, high) in [(0.0, 1.0), (-0.3, 17.2), (0.0, 49.0), (1e-7, 2.3e-6), (-4.0, 96.0)] {
            let marks = few((low, high));
            assert!((2..=6).contains(&marks.len()), "{low} to {high}: {} lines", marks.len());
            assert!(marks.iter().all(|mark| (low..=high).contains(&mark.value)), "{low} to {high}");
        }
        assert!(few((0.0, 0.0)).is_empty() && few((0.0, f64::INFINITY)).is_empty(), "nothing to show");
        assert!(decades((-3.2, 4.1)).iter().all(|mark| (-3.2..=4.1).contains(&mark.value)), "within the frame");
    }

    #[test]
    fn white_light_is_white_and_darkness_is_black() {
        assert_eq!(colour([0.950_47, 1.0, 1.088_83]).to_array()[3], 255, "opaque");
        let [r, g, b, _] = colour([95.047, 100.0, 108.883]).to_array();
        assert!(r > 252 && g > 252 && b > 252, "{r} {g} {b}");
        assert_eq!(colour([0.0; 3]), Color32::BLACK, "no light");
    }
}
