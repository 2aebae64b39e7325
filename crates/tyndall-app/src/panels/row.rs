//! One parameter as a row: name, input, number, reset. Everything in it comes from the parameter's declaration.

use std::f32::consts::FRAC_PI_2;

use egui::{
    Align, Button, Checkbox, ComboBox, DragValue, Label, Layout, Rangef, Response, RichText, Sense, Slider,
    SliderClamping, Stroke, Ui, Vec2, vec2,
};
use tyndall_core::{ParamInfo, ParamKind, ParamSet, Scale};

/// Widths of the columns in a wide panel, and the least they shrink to in a narrow one; the slider takes the rest.
pub(crate) const LABEL_PT: Rangef = Rangef { min: 76.0, max: 132.0 };
const NUMBER_PT: Rangef = Rangef { min: 62.0, max: 92.0 };
const RESET_PT: f32 = 20.0;
const MIN_SLIDER_PT: f32 = 24.0;

/// Shares of the panel's width that names and numbers get between these limits.
pub(crate) const LABEL_SHARE: f32 = 0.36;
const NUMBER_SHARE: f32 = 0.26;

/// Dragging a number over this many points covers the range of a linear parameter.
const POINTS_PER_RANGE: f64 = 500.0;

/// Change of a number on a logarithmic scale per point, as a share of its value.
const LOG_SHARE_PER_POINT: f64 = 0.01;

/// Decades that a logarithmic slider spans when its range starts at 0.
const LOG_DECADES_FROM_ZERO: f64 = 1e-6;

/// Digits behind the point of the numbers; beyond them no parameter changes a picture.
const MAX_DECIMALS: usize = 4;

/// Accessible name of a parameter's input: unique in the whole window.
#[must_use]
pub fn input_name(group: &str, info: &ParamInfo) -> String {
    format!("{group}: {}", info.label())
}

/// Shows parameter `index` of a group; `no_effect` says why it changes nothing at present.
pub(crate) fn show(ui: &mut Ui, group: &str, set: &mut dyn ParamSet, index: usize, no_effect: Option<&str>) {
    let info = &set.info()[index];
    let before = set.get(index);
    let mut value = before;
    let changed = before.total_cmp(&info.default).is_ne();
    let name = input_name(group, info);
    ui.push_id((group, info.name), |ui| {
        let row = |ui: &mut Ui| {
            ui.add_enabled_ui(no_effect.is_none(), |ui| {
                let label = label(ui, info, changed);
                if label.double_clicked() {
                    value = info.default;
                }
                tooltip(label, group, info, no_effect);
                let input = input(ui, info, &name, &mut value);
                tooltip(input, group, info, no_effect);
            });
            reset(ui, &name, info, changed, &mut value);
        };
        ui.horizontal(row);
    });
    // What an input gives is within the range; the check guards against rounding past its end.
    if value.total_cmp(&before).is_ne()
        && let Ok(value) = info.check(value)
    {
        set.set_unchecked(index, value);
    }
}

fn label(ui: &mut Ui, info: &ParamInfo, changed: bool) -> Response {
    let text = info.label();
    let text = if changed { RichText::new(text).strong() } else { RichText::new(text) };
    let width = LABEL_PT.clamp(ui.available_width() * LABEL_SHARE);
    let size = vec2(width, ui.spacing().interact_size.y);
    let column = Layout::left_to_right(Align::Center);
    let inner = ui.allocate_ui_with_layout(size, column, |ui| {
        ui.set_min_size(size);
        // Not a stop of the Tab key: the input beside it is.
        ui.add(Label::new(text).truncate().selectable(false).sense(Sense::CLICK))
    });
    if changed {
        let dot = inner.response.rect.left_center() - vec2(6.0, 0.0);
        ui.painter().circle_filled(dot, 2.5, ui.visuals().selection.bg_fill);
    }
    inner.inner
}

fn input(ui: &mut Ui, info: &ParamInfo, name: &str, value: &mut f64) -> Response {
    match info.kind {
        ParamKind::Real | ParamKind::Integer => number(ui, info, name, value),
        ParamKind::Toggle => toggle(ui, name, value),
        ParamKind::Choice(names) => choice(ui, names, name, value),
    }
}

fn number(ui: &mut Ui, info: &ParamInfo, name: &str, value: &mut f64) -> Response {
    let (low, high) = (*info.range.start(), *info.range.end());
    let is_log = info.scale == Scale::Log;
    let whole = info.kind == ParamKind::Integer;
    let decimals = if whole { 0 } else { MAX_DECIMALS };
    let spacing = ui.spacing().item_spacing.x;
    let number_pt = NUMBER_PT.clamp(ui.max_rect().width() * NUMBER_SHARE);
    let slider_pt = ui.available_width() - number_pt - RESET_PT - 2.0 * spacing;
    ui.spacing_mut().slider_width = slider_pt.max(MIN_SLIDER_PT);
    let mut slider = Slider::new(value, low..=high)
        .show_value(false)
        .logarithmic(is_log)
        .clamping(SliderClamping::Edits)
        .smallest_positive(if low > 0.0 { low } else { high * LOG_DECADES_FROM_ZERO });
    if whole {
        slider = slider.integer();
    }
    let slider = ui.add(slider);
    rename(ui, &slider, name);

    let speed = if is_log { value.abs() * LOG_SHARE_PER_POINT } else { (high - low) / POINTS_PER_RANGE };
    let number = DragValue::new(value)
        .range(low..=high)
        .clamp_existing_to_range(false)
        .speed(if whole { speed.max(0.05) } else { speed })
        .max_decimals(decimals)
        .suffix(info.unit_suffix())
        .min_size(vec2(number_pt, ui.spacing().interact_size.y));
    let number = ui.add(number);
    rename(ui, &number, &format!("{name} (number)"));
    slider | number
}

fn toggle(ui: &mut Ui, name: &str, value: &mut f64) -> Response {
    let mut on = *value != 0.0;
    let response = ui.add(Checkbox::without_text(&mut on));
    if response.changed() {
        *value = f64::from(u8::from(on));
    }
    rename(ui, &response, name);
    response
}

fn choice(ui: &mut Ui, names: &[&str], name: &str, value: &mut f64) -> Response {
    let chosen = names.iter().enumerate().find(|(index, _)| *index as f64 >= *value).map_or("", |(_, name)| name);
    let spacing = ui.spacing().item_spacing.x;
    let width = ui.available_width() - RESET_PT - spacing;
    let combo = ComboBox::from_id_salt("choice").width(width).selected_text(chosen).show_ui(ui, |ui| {
        for (index, option) in names.iter().enumerate() {
            let response = ui.selectable_label(*option == chosen, *option);
            rename(ui, &response, &format!("{name} = {option}"));
            if response.clicked() {
                *value = index as f64;
            }
        }
    });
    rename(ui, &combo.response, name);
    combo.response
}

/// A button where there is something to reset, and its space where there is not, so that the columns stay in line.
fn reset(ui: &mut Ui, name: &str, info: &ParamInfo, changed: bool, value: &mut f64) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if !changed {
            return;
        }
        let response = ui.add(Button::new("").frame_when_inactive(false).min_size(vec2(RESET_PT, RESET_PT)));
        rename(ui, &response, &format!("Reset {name}"));
        arrow_back(ui, &response);
        let default = format!("Back to {}{}", info.format(info.default), info.unit_suffix());
        if response.on_hover_text(default).clicked() {
            *value = info.default;
        }
    });
}

/// Three quarters of a circle against the clock, with a head.
fn arrow_back(ui: &Ui, button: &Response) {
    let stroke = Stroke::new(1.4, ui.style().interact(button).text_color());
    let (centre, radius) = (button.rect.center(), 4.6);
    let point = |quarter_turns: f32| centre + radius * Vec2::angled(quarter_turns * FRAC_PI_2);
    let arc = (0..=18).map(|step| point(-1.0 + step as f32 / 6.0)).collect();
    ui.painter().line(arc, stroke);
    let tip = point(-1.0);
    ui.painter().line(vec![tip + vec2(3.2, -3.2), tip, tip + vec2(3.2, 3.2)], stroke);
}

/// What screen readers say and tests look for.
pub(crate) fn rename(ui: &Ui, response: &Response, name: &str) {
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(name));
}

fn tooltip(response: Response, group: &str, info: &ParamInfo, no_effect: Option<&str>) {
    let contents = |ui: &mut Ui| {
        ui.set_max_width(ui.spacing().tooltip_width);
        if let Some(reason) = no_effect {
            ui.colored_label(ui.visuals().warn_fg_color, format!("No effect at present. {reason}"));
        }
        ui.strong(info.label());
        ui.label(info.doc);
        let scale = if info.scale == Scale::Log { ", logarithmic" } else { "" };
        ui.label(format!("Takes {}{scale}.", info.expected()));
        ui.label(format!("Default: {}{}", info.format(info.default), info.unit_suffix()));
        ui.label(format!("Source: {}", info.source));
        ui.monospace(format!("{group}.{}", info.name));
    };
    response.on_hover_ui(contents).on_disabled_hover_ui(contents);
}
