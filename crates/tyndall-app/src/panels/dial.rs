//! The time-of-day dial: a ring of 24 hours in the colours of its light, with the sun on it. Noon is on top and time runs
//! with the clock; dragging or the arrow keys move the sun along.

use std::f32::consts::TAU;

use egui::{
    Align2, Color32, EventFilter, FontId, Key, Mesh, Modifiers, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui,
    Vec2, WidgetInfo,
    accesskit::{Action, ActionData},
    vec2,
};

use crate::sun_clock::day::{Day, HOURS, Level, clock};

/// Accessible name.
pub(crate) const NAME: &str = "Time of day";

/// Parts of the radius: inner edge of the ring, ends of the marks, circle of the hours' names, size of the sun.
const INNER: f32 = 0.78;
const MARK: f32 = 0.74;
const HOUR_NAMES: f32 = 0.63;
const SUN: f32 = 0.085;

/// Pieces of the ring; a piece is five minutes.
const PIECES: usize = 288;

/// Steps of the keys (h): with Shift, plain, and with Page Up and Page Down.
const FINE_H: f64 = 1.0 / 60.0;
const STEP_H: f64 = 10.0 / 60.0;
const COARSE_H: f64 = 1.0;

/// Colours of the ring by the sun's elevation (deg).
const LIGHTS: [(f64, Color32); 8] = [
    (-18.0, Color32::from_rgb(13, 17, 38)),
    (-12.0, Color32::from_rgb(24, 33, 72)),
    (-6.0, Color32::from_rgb(52, 68, 128)),
    (-1.5, Color32::from_rgb(176, 108, 104)),
    (1.0, Color32::from_rgb(240, 160, 84)),
    (8.0, Color32::from_rgb(236, 205, 140)),
    (20.0, Color32::from_rgb(140, 186, 226)),
    (60.0, Color32::from_rgb(96, 156, 218)),
];

const SUN_UP: Color32 = Color32::from_rgb(255, 222, 110);
const SUN_DOWN: Color32 = Color32::from_rgb(150, 156, 176);
const OUTLINE: Color32 = Color32::from_rgb(20, 22, 28);

/// Shows the dial in a square; a step of the time (h) that the user asks for, which may lead over midnight.
pub(crate) fn show(ui: &mut Ui, size_pt: f32, day: Option<&Day>, time_h: f64, below: &str) -> Option<f64> {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(size_pt), Sense::click_and_drag());
    describe(ui, &response, time_h);
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    let painter = Dial { centre: rect.center(), radius: 0.5 * size_pt - 3.0 };
    painter.paint(ui, &response, day, time_h, below);
    let response = response.on_hover_text("Drag, or use the arrow keys: 10 minutes, with Shift 1 minute, Page 1 hour.");
    painter.dragged_h(&response, time_h).or_else(|| keys_h(ui, &response)).or_else(|| {
        let wanted_h = asked_h(ui, &response)?;
        Some(wanted_h.clamp(0.0, HOURS) - time_h)
    })
}

/// The time (h) that a screen reader asks for.
fn asked_h(ui: &Ui, response: &Response) -> Option<f64> {
    ui.input(|input| {
        let values = input.accesskit_action_requests(response.id, Action::SetValue).filter_map(|request| {
            let Some(ActionData::NumericValue(value)) = request.data else { return None };
            Some(value)
        });
        values.last()
    })
}

/// What screen readers say, and the keys that belong to the dial while it has the focus.
fn describe(ui: &Ui, response: &Response, time_h: f64) {
    response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), time_h, NAME));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_role(Role::Slider);
        node.set_value(clock(time_h));
        node.set_min_numeric_value(0.0);
        node.set_max_numeric_value(HOURS);
        node.set_numeric_value_step(STEP_H);
        node.add_action(Action::SetValue);
    });
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
}

/// The step (h) of the keys pressed while the dial has the focus.
fn keys_h(ui: &Ui, response: &Response) -> Option<f64> {
    if !response.has_focus() {
        return None;
    }
    let pressed = |modifiers: Modifiers, key: Key| {
        let times = ui.input_mut(|input| input.count_and_consume_key(modifiers, key));
        i32::try_from(times).map_or(0.0, f64::from)
    };
    let mut step_h = 0.0;
    for (modifiers, size_h) in [(Modifiers::SHIFT, FINE_H), (Modifiers::NONE, STEP_H)] {
        for (key, sign) in [(Key::ArrowRight, 1.0), (Key::ArrowUp, 1.0), (Key::ArrowLeft, -1.0), (Key::ArrowDown, -1.0)]
        {
            step_h += sign * size_h * pressed(modifiers, key);
        }
    }
    step_h += COARSE_H * (pressed(Modifiers::NONE, Key::PageUp) - pressed(Modifiers::NONE, Key::PageDown));
    (step_h != 0.0).then_some(step_h)
}

/// Where the dial is.
struct Dial {
    centre: Pos2,
    radius: f32,
}

impl Dial {
    /// The step (h) from where the pointer is held, to the minute, the shorter way around.
    fn dragged_h(&self, response: &Response, time_h: f64) -> Option<f64> {
        let pointer = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked())?;
        let arm = pointer - self.centre;
        if arm.length() < 0.2 * self.radius {
            return None;
        }
        let turns = f64::from(arm.x.atan2(-arm.y) / TAU);
        let minutes = ((turns * HOURS + 0.5 * HOURS).rem_euclid(HOURS) * 60.0).round();
        let step_h = minutes / 60.0 - time_h;
        // The day stays: a drag across midnight goes around the ring, not into another date.
        (step_h.abs() > 1e-9).then_some(step_h)
    }

    fn point(&self, time_h: f64, share: f32) -> Pos2 {
        #[expect(clippy::cast_possible_truncation, reason = "points on a screen")]
        let angle = ((time_h / HOURS - 0.5) as f32) * TAU;
        self.centre + share * self.radius * vec2(angle.sin(), -angle.cos())
    }

    fn paint(&self, ui: &Ui, response: &Response, day: Option<&Day>, time_h: f64, below: &str) {
        let visuals = ui.visuals();
        let painter = ui.painter();
        if let Some(day) = day {
            painter.add(self.ring(day));
            for time_h in Level::ALL.into_iter().flat_map(|level| day.crossings_h(level)).flatten() {
                let stroke = Stroke::new(1.0, Color32::from_black_alpha(90));
                painter.line_segment([self.point(time_h, INNER), self.point(time_h, 1.0)], stroke);
            }
        }
        let line = Stroke::new(1.0, visuals.weak_text_color());
        for hour in 0..24 {
            let start = if hour % 3 == 0 { MARK - 0.02 } else { MARK + 0.015 };
            let time_h = f64::from(hour);
            painter.line_segment([self.point(time_h, start), self.point(time_h, INNER - 0.01)], line);
            if hour % 6 == 0 {
                let font = FontId::proportional(11.0);
                let at = self.point(time_h, HOUR_NAMES);
                painter.text(at, Align2::CENTER_CENTER, hour.to_string(), font, visuals.text_color());
            }
        }
        self.words(ui, time_h, below);
        self.sun(ui, day, time_h);
        if response.has_focus() {
            painter.circle_stroke(self.centre, self.radius + 1.5, Stroke::new(1.5, visuals.selection.bg_fill));
        }
    }

    /// The ring as one mesh with the colours of the light.
    fn ring(&self, day: &Day) -> Shape {
        let mut mesh = Mesh::default();
        for piece in 0..=PIECES {
            let time_h = piece as f64 * HOURS / PIECES as f64;
            let colour = light(day.elevation_deg(time_h));
            for share in [INNER, 1.0] {
                mesh.colored_vertex(self.point(time_h, share), colour);
            }
        }
        #[expect(clippy::cast_possible_truncation, reason = "a few hundred")]
        for piece in 0..PIECES as u32 {
            let first = 2 * piece;
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
        Shape::mesh(mesh)
    }

    fn words(&self, ui: &Ui, time_h: f64, below: &str) {
        let (painter, visuals) = (ui.painter(), ui.visuals());
        let at = self.centre - vec2(0.0, 0.05 * self.radius);
        let font = FontId::proportional(0.3 * self.radius);
        painter.text(at, Align2::CENTER_CENTER, clock(time_h), font, visuals.strong_text_color());
        let at = self.centre + vec2(0.0, 0.19 * self.radius);
        painter.text(at, Align2::CENTER_CENTER, below, FontId::proportional(12.0), visuals.text_color());
    }

    fn sun(&self, ui: &Ui, day: Option<&Day>, time_h: f64) {
        let is_up = day.is_none_or(|day| day.elevation_deg(time_h) > Level::Sun.elevation_deg());
        let at = self.point(time_h, 0.5 * (1.0 + INNER));
        let size = SUN * self.radius;
        ui.painter().circle(at, size, if is_up { SUN_UP } else { SUN_DOWN }, Stroke::new(2.0, OUTLINE));
        ui.painter().circle_stroke(at, size + 1.5, Stroke::new(1.0, Color32::WHITE));
    }
}

/// Colour of the ring for an elevation (deg) of the sun.
fn light(elevation_deg: f64) -> Color32 {
    let [first, .., last] = LIGHTS;
    let clamped = elevation_deg.clamp(first.0, last.0);
    let pair = LIGHTS.windows(2).find(|pair| clamped <= pair[1].0);
    pair.map_or(last.1, |pair| {
        #[expect(clippy::cast_possible_truncation, reason = "a share")]
        let share = ((clamped - pair[0].0) / (pair[1].0 - pair[0].0)) as f32;
        pair[0].1.lerp_to_gamma(pair[1].1, share)
    })
}

/// A strip with the colours of the levels, for the list beside the dial.
pub(crate) fn swatch(ui: &mut Ui, level: Level) {
    let (rect, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::empty());
    ui.painter().rect_filled(
        Rect::from_center_size(rect.center(), vec2(10.0, 10.0)),
        2.0,
        light(level.elevation_deg()),
    );
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    const DIAL: Dial = Dial { centre: pos2(100.0, 100.0), radius: 50.0 };

    #[test]
    fn noon_is_on_top_and_time_runs_with_the_clock() {
        for (time_h, x, y) in [(12.0, 100.0, 50.0), (18.0, 150.0, 100.0), (0.0, 100.0, 150.0), (6.0, 50.0, 100.0)] {
            let found = DIAL.point(time_h, 1.0);
            assert!(found.distance(pos2(x, y)) < 1e-3, "{time_h} h: {found}");
        }
    }

    #[test]
    fn the_ring_is_dark_at_night_and_bright_by_day() {
        let brightness = |elevation_deg: f64| {
            let [r, g, b, _] = light(elevation_deg).to_array();
            u32::from(r) + u32::from(g) + u32::from(b)
        };
        let heights = [-40.0, -18.0, -15.0, -12.0, -9.0, -6.0, -4.0, -1.5];
        for pair in heights.windows(2) {
            assert!(brightness(pair[0]) <= brightness(pair[1]), "{pair:?}");
        }
        assert!(brightness(60.0) > 3 * brightness(-18.0), "day and night");
    }
}
