//! The panel of date, time and place: the dial, the lights of the day, the calendar, places, and the time-lapse.

use egui::{
    Align, Button, ComboBox, Grid, Label, Layout, PopupCloseBehavior, RichText, ScrollArea, TextEdit, Ui, vec2,
};
use jiff::Timestamp;
use tyndall_scene::{Scene, SunParams, SunPosition};

use super::{SCROLL_MARGIN, dial, row::rename};
use crate::sun_clock::{
    calendar::{self, Step},
    day::{Day, Level, clock},
    places::{Place, keep_clock},
    playback::{Playback, SPEEDS},
};

/// Sizes of the dial in a narrow and in a wide panel, and the width from which a panel is wide.
const DIAL_PT: egui::Rangef = egui::Rangef { min: 140.0, max: 200.0 };
const WIDE_PT: f32 = 370.0;

/// Height of the list of places.
const PLACES_PT: f32 = 260.0;

/// What the panel remembers.
#[derive(Clone, Debug, Default)]
pub(crate) struct TimePanel {
    pub(crate) playback: Playback,
    search: String,
    /// The day shown, with the date and place that it belongs to.
    day: Option<(SunParams, Option<Day>)>,
}

impl TimePanel {
    /// Shows the panel.
    pub(crate) fn show(&mut self, ui: &mut Ui, scene: &mut Scene) {
        ScrollArea::vertical().auto_shrink(false).content_margin(SCROLL_MARGIN).show(ui, |ui| {
            let day = self.day_of(&scene.sun);
            let size_pt = DIAL_PT.clamp(ui.available_width() * 0.46);
            if ui.available_width() >= WIDE_PT {
                ui.horizontal_top(|ui| {
                    ui.vertical(|ui| show_dial(ui, scene, day.as_ref(), size_pt));
                    ui.add_space(4.0);
                    ui.vertical(|ui| lights(ui, &mut scene.sun, day.as_ref()));
                });
                self.controls(ui, scene);
            } else {
                ui.vertical_centered(|ui| show_dial(ui, scene, day.as_ref(), size_pt));
                self.controls(ui, scene);
                lights(ui, &mut scene.sun, day.as_ref());
            }
        });
    }

    /// The course of the day, computed anew only for another date or place.
    fn day_of(&mut self, sun: &SunParams) -> Option<Day> {
        let key = SunParams {
            year: sun.year,
            month: sun.month,
            day: sun.day,
            utc_offset_h: sun.utc_offset_h,
            latitude_deg: sun.latitude_deg,
            longitude_deg: sun.longitude_deg,
            ..SunParams::default()
        };
        if self.day.as_ref().is_none_or(|(of, _)| *of != key) {
            let day = Day::of(&key);
            self.day = Some((key, day));
        }
        self.day.as_ref().and_then(|(_, day)| day.clone())
    }

    fn controls(&mut self, ui: &mut Ui, scene: &mut Scene) {
        let sun = &mut scene.sun;
        ui.add_space(6.0);
        line(ui, "Place", |ui| self.places(ui, sun));
        line(ui, "Date", |ui| dates(ui, sun));
        line(ui, "Clock", |ui| self.clocks(ui, sun));
        if sun.position == SunPosition::Angles {
            ui.add(Label::new(
                RichText::new("The angles place the sun; anything here lets date and place do it.").weak(),
            ));
        }
        ui.add_space(6.0);
    }

    fn places(&mut self, ui: &mut Ui, sun: &mut SunParams) {
        let here = Place::of(sun).map_or_else(|| coordinates(sun), |place| place.name.to_owned());
        let popup = |ui: &mut Ui| {
            let search = ui.add(TextEdit::singleline(&mut self.search).hint_text("Search places").desired_width(220.0));
            rename(ui, &search, "Search places");
            ScrollArea::vertical().max_height(PLACES_PT).show(ui, |ui| {
                let mut found = Place::search(&self.search).peekable();
                if found.peek().is_none() {
                    ui.weak("No such place; set latitude and longitude in the parameters of the sun.");
                }
                let chosen = found.filter(|place| entry(ui, place)).last();
                if let Some(place) = chosen {
                    place.visit(sun);
                    ui.close();
                }
            });
        };
        let combo = ComboBox::from_id_salt("place")
            .selected_text(here)
            .width(150.0)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .show_ui(ui, popup);
        rename(ui, &combo.response, "Place");
    }

    fn clocks(&mut self, ui: &mut Ui, sun: &mut SunParams) {
        let Playback { is_playing, minutes_per_s } = &mut self.playback;
        let play = ui.button(if *is_playing { "Pause" } else { "Play" });
        if play.on_hover_text("Lets the time run, into the next days too.").clicked() {
            *is_playing = !*is_playing;
        }
        let speed = SPEEDS.iter().find(|(speed, _)| speed >= minutes_per_s).map_or("", |(_, name)| name);
        let combo = ComboBox::from_id_salt("speed").selected_text(speed).width(72.0).show_ui(ui, |ui| {
            for (speed, name) in SPEEDS {
                ui.selectable_value(minutes_per_s, speed, name);
            }
        });
        rename(ui, &combo.response, "Speed");
        let now = ui.button("Now").on_hover_text("The present date and time at this place.");
        if now.clicked() {
            keep_clock(sun, |sun| calendar::set_now(sun, Timestamp::now()));
            sun.position = SunPosition::Date;
        }
    }
}

/// A caption and what stands beside it.
fn line(ui: &mut Ui, caption: &str, contents: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        let size = vec2(42.0, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_size(size);
            ui.label(caption);
        });
        contents(ui);
    });
}

fn show_dial(ui: &mut Ui, scene: &mut Scene, day: Option<&Day>, size_pt: f32) {
    let below = scene.sun_direction().map_or_else(
        |_no_date| "no such date".to_owned(),
        |sun| {
            let azimuth_deg = sun.azimuth_rad.to_degrees().rem_euclid(360.0);
            format!("{:.1}° {}", sun.elevation_rad.to_degrees(), compass(azimuth_deg))
        },
    );
    if let Some(step_h) = dial::show(ui, size_pt, day, scene.sun.time_h, &below) {
        keep_clock(&mut scene.sun, |sun| calendar::advance(sun, step_h));
    }
}

fn entry(ui: &mut Ui, place: &Place) -> bool {
    let response = ui.selectable_label(false, format!("{}, {}", place.name, place.country));
    rename(ui, &response, &format!("Place: {}", place.name));
    response.clicked()
}

fn dates(ui: &mut Ui, sun: &mut SunParams) {
    ui.spacing_mut().item_spacing.x = 4.0;
    let mut stepper = |ui: &mut Ui, text: &str, name: &str, step: Step| {
        let button = ui.add(Button::new(text).min_size(vec2(24.0, 0.0)));
        rename(ui, &button, name);
        if button.on_hover_text(name).clicked() {
            keep_clock(sun, |sun| calendar::step(sun, step));
        }
        calendar::text(sun)
    };
    stepper(ui, "«", "A month earlier", Step::Months(-1));
    let text = stepper(ui, "‹", "A day earlier", Step::Days(-1));
    let size = vec2(106.0, ui.spacing().interact_size.y);
    ui.add_sized(size, Label::new(text));
    stepper(ui, "›", "A day later", Step::Days(1));
    stepper(ui, "»", "A month later", Step::Months(1));
}

/// Times at which the lights of the day begin and end; a click goes there.
fn lights(ui: &mut Ui, sun: &mut SunParams, day: Option<&Day>) {
    let Some(day) = day else {
        ui.colored_label(ui.visuals().warn_fg_color, calendar::text(sun));
        return;
    };
    let mut wanted_h = None;
    Grid::new("lights").num_columns(4).min_col_width(0.0).spacing([8.0, 3.0]).show(ui, |ui| {
        for level in Level::ALL {
            dial::swatch(ui, level);
            let [rise, set] = level.names();
            ui.label(if level == Level::Sun { "Sun" } else { rise.trim_end_matches(" dawn") });
            match day.stays(level) {
                None => {
                    for (name, time_h) in [rise, set].into_iter().zip(day.crossings_h(level)) {
                        wanted_h = wanted_h.or(time(ui, name, time_h));
                    }
                }
                Some(true) => drop(ui.weak(if level == Level::Sun { "up all day" } else { "all night" })),
                Some(false) => drop(ui.weak("not today")),
            }
            ui.end_row();
        }
        ui.label("");
        ui.label("Noon");
        wanted_h = wanted_h.or(time(ui, "Noon", Some(day.noon.0)));
        ui.weak(format!("{:.1}°", day.noon.1)).on_hover_text("Height of the sun at noon");
        ui.end_row();
    });
    if let Some(time_h) = wanted_h {
        let step_h = time_h - sun.time_h;
        keep_clock(sun, |sun| calendar::advance(sun, step_h));
    }
}

/// A time as a button; its time when it was clicked.
fn time(ui: &mut Ui, name: &str, time_h: Option<f64>) -> Option<f64> {
    let Some(time_h) = time_h else {
        ui.weak("none");
        return None;
    };
    let button = ui.add(Button::new(clock(time_h)).frame_when_inactive(false));
    rename(ui, &button, name);
    button.on_hover_text(format!("{name}: click to go there")).clicked().then_some(time_h)
}

/// Latitude and longitude as people write them.
fn coordinates(sun: &SunParams) -> String {
    let part = |value: f64, letters: [&str; 2]| format!("{:.2}° {}", value.abs(), letters[usize::from(value < 0.0)]);
    format!("{}, {}", part(sun.latitude_deg, ["N", "S"]), part(sun.longitude_deg, ["E", "W"]))
}

/// Point of the compass of an azimuth (deg, 0 to 360).
pub(crate) fn compass(azimuth_deg: f64) -> &'static str {
    const POINTS: [&str; 8] = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];
    #[expect(clippy::cast_possible_truncation, reason = "0 to 8")]
    let point = (azimuth_deg / 45.0).round() as usize;
    POINTS[point % POINTS.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_and_places_are_named_as_on_maps() {
        for (azimuth_deg, point) in [(0.0, "N"), (44.0, "NE"), (181.0, "S"), (350.0, "N"), (290.0, "W")] {
            assert_eq!(compass(azimuth_deg), point, "{azimuth_deg} deg");
        }
        let sun = SunParams { latitude_deg: -33.5, longitude_deg: 18.25, ..SunParams::default() };
        assert_eq!(coordinates(&sun), "33.50° S, 18.25° E", "near Cape Town");
    }

    #[test]
    fn the_day_is_computed_once_for_all_its_hours() {
        let mut panel = TimePanel::default();
        let mut sun = SunParams::default();
        let day = panel.day_of(&sun);
        sun.time_h = 3.0;
        sun.brightness = 2.0;
        assert_eq!(panel.day_of(&sun), day, "the same day");
        sun.latitude_deg = -10.0;
        assert_ne!(panel.day_of(&sun), day, "another place");
    }
}
