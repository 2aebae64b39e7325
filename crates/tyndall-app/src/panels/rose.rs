//! The winds as a rose: an arrow for each, dragged at its tip, with the crests that they should make and those that there are.

use egui::{Color32, CursorIcon, Painter, Pos2, Sense, Shape, Stroke, Ui, Vec2, vec2};
use tyndall_core::ParamSet as _;
use tyndall_dunes::by_hand::{MOST_WINDS, winds_to_text};
use tyndall_dunes::crest_theory::{
    bed_instability_deg, crest_difference_deg, elongation_deg, gross_bedform_normal_deg,
};
use tyndall_dunes::wind::{Wind, WindSchedule};
use tyndall_render::desert::report::{DesertReport, drift};
use tyndall_scene::Scene;

use super::{figure_table::table, row::rename};

/// Side of the rose, radius of the longest arrow in halves of it.
const ROSE_PT: f32 = 190.0;
const LONGEST: f32 = 0.84;

/// Distance (points) within which a tip is taken hold of.
const GRASP_PT: f32 = 14.0;

/// Longest arrow in shares of the strongest wind.
const MOST_SHARE: f64 = 1.0;

/// Colours of the predicted crests, of the measured ones and of the drift.
const PREDICTED: Color32 = Color32::from_rgb(220, 170, 60);
const MEASURED: Color32 = Color32::from_rgb(120, 200, 140);
const DRIFT: Color32 = Color32::from_rgb(210, 110, 90);

/// Coherence from which crests have a direction.
const COHERENT: f64 = 0.15;

/// Shows the rose and what follows from it; `report` has what was measured.
pub(super) fn show(ui: &mut Ui, scene: &mut Scene, report: Option<&DesertReport>) {
    let is_measured = !scene.desert.wind_table.is_empty();
    let shown: &[Wind] = report.map_or(&[], |report| &report.winds);
    let mut winds = if is_measured { shown.to_vec() } else { winds_of(scene) };
    buttons(ui, scene, &mut winds, is_measured);
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(ROSE_PT), Sense::click_and_drag());
    rename(ui, &response, "Desert: wind rose");
    let rose = Rose { centre: rect.center(), radius: 0.5 * ROSE_PT };
    if !is_measured && let Some(pulled) = rose.pulled(ui, &response, &winds) {
        winds = pulled;
        put(scene, &winds);
    }
    rose.paint(ui, &winds, report);
    response.on_hover_text("Arrows point where winds blow to; drag a tip. North is up.");
    readouts(ui, &winds, report);
    strength(ui, scene);
}

/// The winds of the scene's own parameters.
fn winds_of(scene: &Scene) -> Vec<Wind> {
    let by_hand = tyndall_dunes::by_hand::parse_winds(&scene.desert.winds).unwrap_or_default();
    if by_hand.is_empty() {
        let schedule = WindSchedule::from_params(&scene.dune_wind);
        return schedule.map(|schedule| schedule.winds().to_vec()).unwrap_or_default();
    }
    by_hand
}

/// Writes winds into the scene: one stays a direction, more become a list by hand.
fn put(scene: &mut Scene, winds: &[Wind]) {
    match winds {
        [one] => {
            scene.desert.winds.clear();
            (scene.dune_wind.winds, scene.dune_wind.direction_deg) = (1, one.toward_deg.round());
        }
        winds => scene.desert.winds = winds_to_text(winds),
    }
}

fn buttons(ui: &mut Ui, scene: &mut Scene, winds: &mut Vec<Wind>, is_measured: bool) {
    ui.horizontal_wrapped(|ui| {
        ui.strong("Wind");
        if is_measured {
            ui.weak("of the table of measurements");
            return;
        }
        let add = ui.add_enabled(winds.len() < MOST_WINDS, egui::Button::new("Add"));
        rename(ui, &add, "Desert: add a wind");
        if add.on_hover_text("Another wind, in the widest gap.").clicked() {
            winds.push(Wind { toward_deg: widest_gap_deg(winds), share: 1.0 });
            put(scene, winds);
        }
        let remove = ui.add_enabled(winds.len() > 1, egui::Button::new("Remove"));
        rename(ui, &remove, "Desert: remove a wind");
        if remove.on_hover_text("The last wind.").clicked() {
            winds.pop();
            put(scene, winds);
        }
        if !scene.desert.winds.is_empty() {
            let clear = ui.button("As parameters");
            rename(ui, &clear, "Desert: winds of the parameters");
            if clear.on_hover_text("Back to the winds of the group dune wind.").clicked() {
                scene.desert.winds.clear();
                *winds = winds_of(scene);
            }
        }
    });
}

/// The middle of the widest gap between winds (deg).
fn widest_gap_deg(winds: &[Wind]) -> f64 {
    let mut angles: Vec<f64> = winds.iter().map(|wind| wind.toward_deg.rem_euclid(360.0)).collect();
    angles.sort_by(f64::total_cmp);
    let Some(first) = angles.first().copied() else { return 0.0 };
    let ends = angles.iter().skip(1).copied().chain([first + 360.0]);
    let gaps = angles.iter().zip(ends).map(|(from, to)| (to - from, from + 0.5 * (to - from)));
    gaps.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, middle)| middle.rem_euclid(360.0))
}

/// How much sand a step moves.
fn strength(ui: &mut Ui, scene: &mut Scene) {
    let Ok(index) = scene.dunes.position("lift") else { return };
    let info = &scene.dunes.info()[index];
    let mut lift = scene.dunes.lift;
    ui.horizontal(|ui| {
        ui.label("Strength");
        ui.spacing_mut().slider_width = (ui.available_width() - 80.0).max(60.0);
        let slider = ui.add(egui::Slider::new(&mut lift, info.range.clone()).max_decimals(2));
        rename(ui, &slider, "Desert: strength of the wind");
        slider.on_hover_text(info.doc);
    });
    scene.dunes.lift = lift;
}

fn readouts(ui: &mut Ui, winds: &[Wind], report: Option<&DesertReport>) {
    let sum = drift(winds);
    let class = match sum.variability {
        share if share < 0.3 => "low: winds cancel",
        share if share < 0.8 => "intermediate",
        _ => "high: nearly one wind",
    };
    let total: f64 = winds.iter().map(|wind| wind.share).sum();
    let mut rows = vec![
        ("Drift", format!("{total:.2} in all, {:.2} towards {:.0}°", total * sum.variability, sum.toward_deg)),
        ("RDP/DP", format!("{:.2}, {class}", sum.variability)),
    ];
    let predicted = bed_instability_deg(winds);
    if let Some(crest_deg) = predicted {
        let gross =
            gross_bedform_normal_deg(winds).map_or(String::new(), |gross| format!(" ({gross:.0}° gross normal)"));
        rows.push(("Crests to be", format!("{crest_deg:.0}°{gross}")));
    }
    if let Some(toward_deg) = elongation_deg(winds) {
        rows.push(("Scarce sand", format!("grows long towards {toward_deg:.0}°")));
    }
    if let Some(crests) = report.map(|report| report.crests) {
        let off = predicted.map(|predicted| format!(", {:.0}° off", crest_difference_deg(predicted, crests.angle_deg)));
        let text = if crests.coherence < COHERENT {
            format!("no direction (coherence {:.2})", crests.coherence)
        } else {
            format!("{:.0}°{}", crests.angle_deg, off.unwrap_or_default())
        };
        rows.push(("Crests that are", text));
    }
    table(ui, "readouts of the wind", &rows);
}

/// Where the rose is.
struct Rose {
    centre: Pos2,
    radius: f32,
}

impl Rose {
    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    fn at(&self, toward_deg: f64, share: f64) -> Pos2 {
        let (sine, cosine) = toward_deg.to_radians().sin_cos();
        let length = f64::from(self.radius * LONGEST) * share;
        self.centre + vec2((length * cosine) as f32, (-length * sine) as f32)
    }

    /// The tips of the arrows: the strongest wind's is at the rim.
    fn tips(&self, winds: &[Wind]) -> Vec<Pos2> {
        let most = strongest(winds);
        winds.iter().map(|wind| self.at(wind.toward_deg, MOST_SHARE * wind.share / most)).collect()
    }

    /// The winds with the tip that is held where the pointer is.
    fn pulled(&self, ui: &Ui, response: &egui::Response, winds: &[Wind]) -> Option<Vec<Wind>> {
        let tips = self.tips(winds);
        let nearest = |pointer: Pos2| {
            let near = tips.iter().enumerate().map(|(index, tip)| (index, tip.distance(pointer)));
            near.filter(|(_, far)| *far <= GRASP_PT).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
        };
        if response.hover_pos().is_some_and(|pointer| nearest(pointer).is_some()) {
            ui.ctx().set_cursor_icon(CursorIcon::Grab);
        }
        let memory = response.id.with("held");
        if response.drag_started() {
            // The scale stays while a tip is held, or else the longest arrow could not be made shorter.
            let origin = ui.input(|input| input.pointer.press_origin());
            let held = origin.and_then(nearest).map(|index| (index, strongest(winds)));
            ui.data_mut(|data| data.insert_temp(memory, held));
        }
        let (index, most) = ui.data(|data| data.get_temp::<Option<(usize, f64)>>(memory)).flatten()?;
        let pointer = response.interact_pointer_pos().filter(|_| response.dragged())?;
        let arm = pointer - self.centre;
        let mut pulled = winds.to_vec();
        let wind = pulled.get_mut(index)?;
        wind.toward_deg = f64::from(-arm.y).atan2(f64::from(arm.x)).to_degrees().rem_euclid(360.0).round();
        if winds.len() > 1 {
            wind.share = (most * f64::from(arm.length() / (self.radius * LONGEST))).clamp(0.05, 1.2 * most);
        }
        Some(pulled)
    }

    fn paint(&self, ui: &Ui, winds: &[Wind], report: Option<&DesertReport>) {
        let painter = ui.painter();
        let weak = ui.visuals().weak_text_color();
        for share in [0.5, 1.0] {
            painter.circle_stroke(
                self.centre,
                self.radius * LONGEST * share,
                Stroke::new(1.0, weak.gamma_multiply(0.5)),
            );
        }
        for (name, toward_deg) in [("N", 90.0), ("E", 0.0), ("S", 270.0), ("W", 180.0)] {
            let font = egui::FontId::proportional(11.0);
            painter.text(self.at(toward_deg, 1.12), egui::Align2::CENTER_CENTER, name, font, weak);
        }
        if let Some(crest_deg) = bed_instability_deg(winds) {
            let ends = [self.at(crest_deg, 1.0), self.at(crest_deg + 180.0, 1.0)];
            painter.extend(Shape::dashed_line(&ends, Stroke::new(2.5, PREDICTED), 6.0, 4.0));
        }
        if let Some(crests) = report.map(|report| report.crests).filter(|crests| crests.coherence >= COHERENT) {
            let ends = [self.at(crests.angle_deg, 1.0), self.at(crests.angle_deg + 180.0, 1.0)];
            painter.line_segment(ends, Stroke::new(1.6, MEASURED));
        }
        let accent = ui.visuals().selection.bg_fill;
        for tip in self.tips(winds) {
            arrow(painter, self.centre, tip, Stroke::new(2.5, accent));
            painter.circle_filled(tip, 4.5, accent);
        }
        let sum = drift(winds);
        if winds.len() > 1 && sum.variability > 0.02 {
            arrow(painter, self.centre, self.at(sum.toward_deg, sum.variability), Stroke::new(1.6, DRIFT));
        }
        self.legend(painter);
    }

    fn legend(&self, painter: &Painter) {
        let font = egui::FontId::proportional(11.0);
        let corner = self.centre + vec2(self.radius + 8.0, -0.5 * self.radius);
        let lines = [("crests to be", PREDICTED), ("crests that are", MEASURED), ("drift of sand", DRIFT)];
        for (row, (text, colour)) in lines.into_iter().enumerate() {
            let at = corner + vec2(0.0, 16.0 * row as f32);
            painter.text(at, egui::Align2::LEFT_CENTER, text, font.clone(), colour);
        }
    }
}

fn strongest(winds: &[Wind]) -> f64 {
    winds.iter().map(|wind| wind.share).fold(0.0, f64::max).max(1e-6)
}

fn arrow(painter: &Painter, from: Pos2, to: Pos2, stroke: Stroke) {
    painter.line_segment([from, to], stroke);
    let back = (from - to).normalized() * 9.0;
    for side in [0.45, -0.45] {
        painter.line_segment([to, to + egui::emath::Rot2::from_angle(side) * back], stroke);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_wind_is_a_direction_and_more_are_a_list() {
        let mut scene = Scene::default();
        put(&mut scene, &[Wind { toward_deg: 40.2, share: 0.3 }]);
        assert!(scene.desert.winds.is_empty() && scene.dune_wind.winds == 1, "{:?}", scene.dune_wind);
        assert!((scene.dune_wind.direction_deg - 40.0).abs() < 1e-12, "{:?}", scene.dune_wind);
        let two = [Wind { toward_deg: 10.0, share: 1.0 }, Wind { toward_deg: 190.0, share: 0.5 }];
        put(&mut scene, &two);
        assert_eq!((scene.desert.winds.as_str(), winds_of(&scene)), ("10 1; 190 0.5", two.to_vec()), "by hand");
    }

    #[test]
    fn a_new_wind_blows_in_the_widest_gap() {
        let winds =
            |angles: &[f64]| angles.iter().map(|&toward_deg| Wind { toward_deg, share: 1.0 }).collect::<Vec<_>>();
        for (angles, middle) in [(&[0.0][..], 180.0), (&[0.0, 90.0], 225.0), (&[-10.0, 120.0, 170.0], 260.0)] {
            assert!(
                (widest_gap_deg(&winds(angles)) - middle).abs() < 1e-9,
                "{angles:?}: {}",
                widest_gap_deg(&winds(angles))
            );
        }
    }
}
