//! Look of the program: neutral greys that leave the judgement of colours to the picture, one accent, roomy rows.

use egui::{Color32, CornerRadius, FontId, Margin, Stroke, Style, TextStyle, Theme, Visuals, vec2};

/// Colours that differ between the themes.
struct Palette {
    panel: Color32,
    recess: Color32,
    raised: Color32,
    hovered: Color32,
    line: Color32,
    text: Color32,
    strong: Color32,
    accent: Color32,
    on_accent: Color32,
}

const DARK: Palette = Palette {
    panel: Color32::from_rgb(32, 33, 36),
    recess: Color32::from_rgb(22, 23, 25),
    raised: Color32::from_rgb(52, 54, 58),
    hovered: Color32::from_rgb(66, 69, 74),
    line: Color32::from_rgb(58, 60, 64),
    text: Color32::from_rgb(200, 202, 206),
    strong: Color32::from_rgb(244, 245, 247),
    accent: Color32::from_rgb(62, 116, 176),
    on_accent: Color32::WHITE,
};

const LIGHT: Palette = Palette {
    panel: Color32::from_rgb(246, 246, 247),
    recess: Color32::from_rgb(255, 255, 255),
    raised: Color32::from_rgb(225, 227, 230),
    hovered: Color32::from_rgb(210, 214, 220),
    line: Color32::from_rgb(205, 207, 211),
    text: Color32::from_rgb(58, 61, 66),
    strong: Color32::from_rgb(12, 14, 18),
    accent: Color32::from_rgb(150, 190, 232),
    on_accent: Color32::from_rgb(10, 30, 54),
};

const RADIUS: CornerRadius = CornerRadius::same(4);

/// Gives both themes their looks. Which of them is shown follows the system until the user chooses.
pub(crate) fn install(ctx: &egui::Context) {
    ctx.style_mut_of(Theme::Dark, |style| apply(style, Visuals::dark(), &DARK));
    ctx.style_mut_of(Theme::Light, |style| apply(style, Visuals::light(), &LIGHT));
}

fn apply(style: &mut Style, base: Visuals, palette: &Palette) {
    style.visuals = visuals(base, palette);
    style.spacing.item_spacing = vec2(8.0, 5.0);
    style.spacing.button_padding = vec2(8.0, 3.0);
    style.spacing.interact_size.y = 22.0;
    style.spacing.window_margin = Margin::same(14);
    style.spacing.menu_margin = Margin::same(6);
    style.spacing.tooltip_width = 380.0;
    style.spacing.combo_width = 120.0;
    style.explanation_tooltips = false;
    for (text_style, size) in
        [(TextStyle::Body, 13.5), (TextStyle::Button, 13.5), (TextStyle::Small, 11.5), (TextStyle::Heading, 18.0)]
    {
        style.text_styles.insert(text_style, FontId::proportional(size));
    }
    style.text_styles.insert(TextStyle::Monospace, FontId::monospace(12.5));
}

fn visuals(mut visuals: Visuals, palette: &Palette) -> Visuals {
    visuals.panel_fill = palette.panel;
    visuals.window_fill = palette.panel;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.extreme_bg_color = palette.recess;
    visuals.faint_bg_color = palette.panel.lerp_to_gamma(palette.raised, 0.35);
    visuals.code_bg_color = palette.recess;
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.menu_corner_radius = CornerRadius::same(6);
    visuals.slider_trailing_fill = true;
    visuals.indent_has_left_vline = false;
    visuals.selection.bg_fill = palette.accent;
    visuals.selection.stroke = Stroke::new(1.0, palette.on_accent);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, palette.line);
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, palette.text);
    for (widget, fill, text) in [
        (&mut widgets.inactive, palette.raised, palette.text),
        (&mut widgets.hovered, palette.hovered, palette.strong),
        (&mut widgets.active, palette.accent, palette.strong),
        (&mut widgets.open, palette.raised, palette.strong),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = RADIUS;
        widget.expansion = 0.0;
    }
    // Whoever goes through the inputs by keyboard must see where they are.
    widgets.active.bg_stroke = Stroke::new(1.5, palette.accent.lerp_to_gamma(palette.strong, 0.4));
    widgets.hovered.bg_stroke = Stroke::new(1.0, palette.line);
    visuals
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contrast ratio of WCAG 2.1.
    fn contrast(a: Color32, b: Color32) -> f32 {
        let luminance = |colour: Color32| {
            let [r, g, b, _] = egui::Rgba::from(colour).to_array();
            0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
        };
        let (a, b) = (luminance(a), luminance(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn text_is_readable_on_everything_it_stands_on() {
        for palette in [&DARK, &LIGHT] {
            for (text, ground) in [
                (palette.text, palette.panel),
                (palette.text, palette.recess),
                (palette.text, palette.raised),
                (palette.strong, palette.hovered),
                (palette.on_accent, palette.accent),
            ] {
                let ratio = contrast(text, ground);
                // WCAG 2.1, level AA.
                assert!(ratio >= 4.5, "{text:?} on {ground:?}: {ratio}");
            }
        }
    }
}
