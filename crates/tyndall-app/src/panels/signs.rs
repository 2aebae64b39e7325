//! Signs on buttons, drawn: the program's fonts have none of them.

use egui::{Color32, CornerRadius, Pos2, Rect, Response, Shape, Stroke, StrokeKind, Ui, Vec2, vec2};

/// What a button does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sign {
    Back,
    Play,
    Pause,
    Step,
    Dice,
}

/// Half the height of a triangle, width of a bar, half the side of a die.
const HALF_PT: f32 = 5.0;
const BAR_PT: f32 = 2.5;
const DIE_PT: f32 = 6.5;

/// Paints a sign in the middle of a button.
pub(super) fn paint(ui: &Ui, button: &Response, sign: Sign) {
    let (painter, centre) = (ui.painter(), button.rect.center());
    let colour = ui.style().interact(button).text_color();
    let bar = |x: f32| {
        let bar = Rect::from_center_size(centre + vec2(x, 0.0), vec2(BAR_PT, 2.0 * HALF_PT));
        painter.rect_filled(bar, CornerRadius::ZERO, colour);
    };
    match sign {
        Sign::Play => drop(painter.add(triangle(centre, HALF_PT, colour))),
        Sign::Pause => [-3.0, 3.0].into_iter().for_each(bar),
        Sign::Back => {
            bar(-5.0);
            painter.add(triangle(centre + vec2(1.5, 0.0), -HALF_PT, colour));
        }
        Sign::Step => {
            bar(5.0);
            painter.add(triangle(centre - vec2(1.5, 0.0), HALF_PT, colour));
        }
        Sign::Dice => {
            let die = Rect::from_center_size(centre, Vec2::splat(2.0 * DIE_PT));
            painter.rect_stroke(die, CornerRadius::same(3), Stroke::new(1.4, colour), StrokeKind::Inside);
            for place in [vec2(-3.0, -3.0), Vec2::ZERO, vec2(3.0, 3.0), vec2(3.0, -3.0), vec2(-3.0, 3.0)] {
                painter.circle_filled(centre + place, 1.3, colour);
            }
        }
    }
}

/// A triangle that points to the right, or to the left where `half` is negative.
fn triangle(centre: Pos2, half: f32, colour: Color32) -> Shape {
    let corners = [vec2(-0.8, -1.0), vec2(1.0, 0.0), vec2(-0.8, 1.0)].map(|corner| centre + half * corner);
    Shape::convex_polygon(corners.to_vec(), colour, Stroke::NONE)
}
