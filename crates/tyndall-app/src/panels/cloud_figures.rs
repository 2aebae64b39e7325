//! What the clouds amount to: figures, humidity against the percolation threshold, the raggedness of their outlines, and
//! cover over time.

use egui::{Color32, CornerRadius, Rangef, Rect, Sense, Stroke, Ui, pos2, vec2};
use egui_plot::{HoverPosition, Line, Plot, PlotPoints, VLine};
use tyndall_clouds::statistics::PERCOLATION_HUMIDITY;
use tyndall_render::clouds::CloudReport;
use tyndall_scene::Scene;

use super::{
    figure_table::table,
    plots::{few, quiet, short},
    row::rename,
};

/// Dimension of the outlines of clouds in satellite pictures (Lovejoy 1982).
const SATELLITE_DIMENSION: f64 = 1.35;

/// Height of the plot and of a gauge.
const PLOT_PT: f32 = 96.0;
const GAUGE_PT: f32 = 14.0;

/// Colour of what is measured against.
const REFERENCE: Color32 = Color32::from_rgb(220, 170, 60);

/// Shows the figures.
pub(super) fn show(ui: &mut Ui, report: &CloudReport, scene: &Scene) {
    figures(ui, report, scene);
    ui.add_space(4.0);
    let statistics = &report.statistics;
    let gauge = Gauge {
        name: "Humid cells",
        value: Some(statistics.percolation * PERCOLATION_HUMIDITY),
        range: Rangef::new(0.0, 0.5),
        reference: PERCOLATION_HUMIDITY,
        reference_name: "percolation",
        hint: "Share of humid cells where there is vapour or cloud. Clouds stay apart below the threshold and join above.",
    };
    gauge.show(ui);
    let gauge = Gauge {
        name: "Outline dimension",
        value: report.dimension.map(|(dimension, _)| dimension),
        range: Rangef::new(1.0, 2.0),
        reference: SATELLITE_DIMENSION,
        reference_name: "satellite clouds",
        hint: "D of perimeter ~ area^(D/2) over the clouds seen from below: 1 for smooth outlines, 1.35 in satellite pictures.",
    };
    gauge.show(ui);
    ui.add_space(4.0);
    ui.weak("Cover, %, over time, min");
    cover(ui, report);
}

fn figures(ui: &mut Ui, report: &CloudReport, scene: &Scene) {
    let (statistics, grid) = (&report.statistics, &scene.cloud_grid);
    let altitude = |cells: u32| short(grid.floor_m + f64::from(cells) * grid.cell_m);
    let heights = format!("{} to {} m", altitude(statistics.base_cells), altitude(statistics.top_cells));
    let step = report.times.step.map_or("none made".to_owned(), |time| format!("{} ms", short(ms(time))));
    let dimension = match report.dimension {
        Some((dimension, error)) => format!("{dimension:.2} ± {error:.2}, {} clouds", report.clouds),
        None => format!("{} clouds are too few", report.clouds),
    };
    let rows = [
        ("Cover", format!("{:.0} %, {heights}", 100.0 * statistics.cover)),
        ("Cells", format!("{}, {} balls", thousands(report.cells), thousands(report.balls as u64))),
        ("Outlines", dimension),
        ("Step", format!("{step}, number {}", report.steps)),
        ("Light", format!("{} ms", short(ms(report.times.light)))),
    ];
    table(ui, "figures of clouds", &rows);
}

fn ms(time: std::time::Duration) -> f64 {
    1e3 * time.as_secs_f64()
}

/// A number in groups of three digits.
pub(super) fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// A number on a bar with a mark to compare with.
struct Gauge {
    name: &'static str,
    value: Option<f64>,
    range: Rangef,
    reference: f64,
    reference_name: &'static str,
    hint: &'static str,
}

impl Gauge {
    fn show(&self, ui: &mut Ui) {
        let value = self.value.map_or("none".to_owned(), |value| format!("{value:.2}"));
        ui.horizontal(|ui| {
            ui.weak(format!("{}  {value}", self.name));
            ui.weak("·");
            ui.colored_label(REFERENCE, format!("{} {:.2}", self.reference_name, self.reference));
        });
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), GAUGE_PT), Sense::hover());
        rename(ui, &response, &format!("{}: {value}", self.name));
        let bar = rect.shrink2(vec2(0.0, 3.0));
        ui.painter().rect_filled(bar, CornerRadius::same(3), ui.visuals().extreme_bg_color);
        if let Some(value) = self.value {
            let filled = Rect::from_min_max(bar.min, pos2(self.place(bar, value), bar.max.y));
            ui.painter().rect_filled(filled, CornerRadius::same(3), ui.visuals().selection.bg_fill);
        }
        ui.painter().vline(self.place(bar, self.reference), rect.y_range(), Stroke::new(2.0, REFERENCE));
        response.on_hover_text(self.hint);
    }

    #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
    fn place(&self, bar: Rect, value: f64) -> f32 {
        egui::remap_clamp(value as f32, self.range, bar.x_range())
    }
}

/// Cover over time, the moment shown marked.
fn cover(ui: &mut Ui, report: &CloudReport) {
    let accent = ui.visuals().selection.bg_fill;
    let points: PlotPoints<'_> = report.cover.iter().map(|(time_s, cover)| [time_s / 60.0, 100.0 * cover]).collect();
    quiet(Plot::new("cover over time"))
        .height(PLOT_PT)
        .include_y(0.0)
        .include_y(10.0)
        .x_grid_spacer(|input| few(input.bounds))
        .y_grid_spacer(|input| few(input.bounds))
        .x_axis_formatter(|mark, _| short(mark.value))
        .y_axis_formatter(|mark, _| short(mark.value))
        .label_formatter(|hover| match hover {
            HoverPosition::NearDataPoint { position, .. } => {
                Some(format!("{:.1} min\n{:.1} %", position.x, position.y))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
        .show(ui, |plot| {
            plot.vline(VLine::new("end of the warm-up", 0.0).stroke(Stroke::new(1.0, REFERENCE)));
            plot.line(Line::new("cover", points).color(accent).width(1.8));
        });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_numbers_are_read_in_threes() {
        for (number, text) in [(7, "7"), (1000, "1 000"), (2_097_152, "2 097 152"), (123_456, "123 456")] {
            assert_eq!(thousands(number), text, "{number}");
        }
    }
}
