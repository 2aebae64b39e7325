//! What the sand amounts to: its budget, heights and slopes, crests, and how long it took.

use std::time::Duration;

use egui::{Color32, CornerRadius, Rect, Sense, Stroke, Ui, pos2, vec2};
use tyndall_dunes::SteppedBy;
use tyndall_render::desert::report::DesertReport;
use tyndall_scene::{DuneModel, Scene};

use super::{cloud_figures::thousands, figure_table::table, plots::short, row::rename};
use crate::desert_clock::DesertClock;

/// Sand that strong, steady winds carry over a metre of a dune field in a year (m^2): the middle of 10 to 50 of
/// the fields that move.
const FLUX_M2_A_YEAR: f64 = 30.0;

/// Height of the meter.
const METER_PT: f32 = 16.0;

/// Colours of sand that was there, that came and that went.
const SAND: Color32 = Color32::from_rgb(194, 150, 92);
const CAME: Color32 = Color32::from_rgb(96, 160, 96);
const WENT: Color32 = Color32::from_rgb(176, 84, 72);

/// Shows the figures.
pub(super) fn show(ui: &mut Ui, report: &DesertReport, scene: &Scene, clock: &DesertClock) {
    years(ui, report, scene, clock);
    ui.add_space(6.0);
    budget(ui, report);
    ui.add_space(6.0);
    ui.strong("The field");
    let [nx, ny] = report.size;
    let [low, high] = report.height_range_m.map(f64::from);
    let step = report.times.step.map_or("none made".to_owned(), |time| format!("{} ms", short(ms(time))));
    let rows = [
        ("Ground", format!("{nx} x {ny} cells of {} m", short(report.cell_m))),
        ("Heights", format!("{} to {} m", short(low), short(high))),
        ("Lee slopes", format!("{:.1}° (95 % are below)", report.slopes.lee_p95_deg)),
        ("Windward", format!("{:.1}° (half are below)", report.slopes.windward_median_deg)),
        ("Heaps", format!("{}, {:.0} % of the ground bare", report.heaps, 100.0 * report.bare_share)),
        ("Steps by", stepped_by(&report.stepped_by)),
        ("Step", format!("{step}, for the picture {} ms", short(ms(report.times.picture)))),
    ];
    table(ui, "figures of the desert", &rows);
}

fn stepped_by(by: &SteppedBy) -> String {
    match by {
        SteppedBy::Processor => "processor".to_owned(),
        SteppedBy::Device => "graphics".to_owned(),
        SteppedBy::ProcessorInstead(reason) => format!("processor: {reason}"),
    }
}

fn ms(time: Duration) -> f64 {
    1e3 * time.as_secs_f64()
}

/// Years that a step stands for in a wind of the stated flux; `None` for sand that moves by another rule.
fn years_a_step(scene: &Scene) -> Option<f64> {
    let dunes = &scene.dunes;
    // Sand hops until it sticks: this far on average, on sand.
    let way_cells = dunes.hop_cells / dunes.drop_on_sand.max(0.01);
    let flux_m2 = dunes.lift * dunes.slab_cells * way_cells * dunes.cell_m.powi(2);
    (dunes.model == DuneModel::Slab).then_some(flux_m2 / FLUX_M2_A_YEAR)
}

/// What the steps are in time.
fn years(ui: &mut Ui, report: &DesertReport, scene: &Scene, clock: &DesertClock) {
    let Some(years) = years_a_step(scene) else { return };
    let passed = duration(years * f64::from(report.step));
    let pace = if clock.is_playing && clock.reached > 0.0 { clock.reached } else { clock.speed };
    let text = format!("{passed} of wind; {} in a second", duration(years * pace));
    let response = ui.label(text);
    response.on_hover_text(format!(
        "In winds that carry {FLUX_M2_A_YEAR:.0} m² of sand over each metre in a year; slabs of {} cells hop {} cells at a time.",
        short(scene.dunes.slab_cells),
        short(scene.dunes.hop_cells),
    ));
}

/// A time for people.
fn duration(years: f64) -> String {
    match years {
        years if years >= 1.0 => format!("{} years", short(years)),
        years if years >= 1.0 / 12.0 => format!("{} months", short(12.0 * years)),
        years => format!("{} days", short(365.25 * years)),
    }
}

/// Where the sand came from and went to, to the quantum.
fn budget(ui: &mut Ui, report: &DesertReport) {
    let ledger = &report.ledger;
    let missing = report.sand_quanta - ledger.expected();
    ui.horizontal(|ui| {
        ui.strong("Sand budget");
        match missing {
            0 => drop(ui.colored_label(CAME, "exact")),
            off => drop(ui.colored_label(WENT, format!("{} quanta off", thousands_signed(off)))),
        }
    });
    meter(ui, report);
    let came = ledger.entered + ledger.brushed_on + ledger.abraded;
    let went = ledger.left + ledger.brushed_off;
    let amount = |quanta: i64| format!("{} m³", thousands_signed(volume_m3(report, quanta)));
    let mut rows = vec![("Now", amount(report.sand_quanta)), ("At the start", amount(ledger.start))];
    for (name, quanta) in [
        ("Came in", ledger.entered),
        ("Blown out", -ledger.left),
        ("Put down by hand", ledger.brushed_on),
        ("Taken away by hand", -ledger.brushed_off),
        ("Worn off rock", ledger.abraded),
    ] {
        if quanta != 0 {
            rows.push((name, amount(quanta)));
        }
    }
    if came == 0 && went == 0 {
        rows.push(("In and out", "nothing: the edges are closed".to_owned()));
    }
    table(ui, "budget of the desert", &rows);
}

#[expect(clippy::cast_possible_truncation, reason = "rounded for people")]
fn volume_m3(report: &DesertReport, quanta: i64) -> i64 {
    report.volume_m3(quanta).round() as i64
}

/// A whole number in groups of three digits, with its sign.
fn thousands_signed(number: i64) -> String {
    format!("{}{}", if number < 0 { "-" } else { "" }, thousands(number.unsigned_abs()))
}

/// A bar: sand from the start that is still there, what came, what went.
fn meter(ui: &mut Ui, report: &DesertReport) {
    let ledger = &report.ledger;
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), METER_PT), Sense::hover());
    rename(ui, &response, &format!("Sand budget: {} quanta", report.sand_quanta));
    let bar = rect.shrink2(vec2(0.0, 2.0));
    ui.painter().rect_filled(bar, CornerRadius::same(3), ui.visuals().extreme_bg_color);
    let came = ledger.entered + ledger.brushed_on + ledger.abraded;
    let went = ledger.left + ledger.brushed_off;
    let all = (ledger.start + came).max(1);
    let mut from = 0;
    for (amount, colour) in [((ledger.start - went).max(0), SAND), (came, CAME), (went, WENT)] {
        let [left, right] = [from, from + amount].map(|edge| place(bar, edge, all));
        let piece = Rect::from_min_max(pos2(left, bar.min.y), pos2(right, bar.max.y));
        ui.painter().rect_filled(piece, CornerRadius::same(3), colour);
        from += amount;
    }
    ui.painter().vline(place(bar, ledger.start, all), rect.y_range(), Stroke::new(1.5, ui.visuals().text_color()));
    response.on_hover_text(format!(
        "{} quanta of 1/256 of a cell are counted, and the ledger expects {}. Sand, what came, what went; the line is the start.",
        thousands_signed(report.sand_quanta),
        thousands_signed(ledger.expected())
    ));
}

#[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
fn place(bar: Rect, amount: i64, all: i64) -> f32 {
    bar.min.x + bar.width() * ((amount as f64 / all as f64).clamp(0.0, 1.0) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_the_default_field_are_days_and_grow_with_the_cells() {
        let mut scene = Scene::default();
        let days = 365.25 * years_a_step(&scene).expect("slabs");
        // 0.25 of the cells lose 0.083 m that go 8.3 m: 0.17 m^2, and 30 m^2 are a year.
        assert!((days - 2.1).abs() < 0.05, "{days} days");
        scene.dunes.cell_m = 2.0;
        let more = 365.25 * years_a_step(&scene).expect("slabs");
        assert!((more - 4.0 * days).abs() < 1e-9, "{more} days");
        scene.dunes.model = DuneModel::Classic;
        assert_eq!(years_a_step(&scene), None, "layers have no stated flux");
    }

    #[test]
    fn times_and_amounts_are_read_by_people() {
        for (years, text) in [(12.0, "12 years"), (0.5, "6 months"), (0.01, "3.65 days")] {
            assert_eq!(duration(years), text, "{years} years");
        }
        assert_eq!(thousands_signed(-1_234_567), "-1 234 567", "with a sign");
    }
}
