//! The wind over height as two plots whose nodes are dragged: how fast it is and where it comes from.

use egui::{CursorIcon, Ui};
use egui_plot::{HLine, Line, LineStyle, Plot, PlotPoint, PlotPoints, PlotResponse, Points};
use tyndall_core::ParamSet as _;
use tyndall_scene::{CloudWindParams, Scene};

use super::{
    plots::{few, quiet, short},
    row::rename,
    time::compass,
};

/// Height of the plots.
const PLOT_PT: f32 = 130.0;

/// Distance (points) within which a node is taken hold of.
const GRASP_PT: f32 = 18.0;

/// Points of a curve between floor and ceiling.
const PIECES: u32 = 32;

/// A height at which the wind is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Node {
    Floor,
    Middle,
    Ceiling,
}

/// What a plot shows along its horizontal axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    /// Speed (m/s).
    Speed,
    /// Direction from which the wind blows (deg).
    From,
}

/// Shows the plots.
pub(super) fn show(ui: &mut Ui, scene: &mut Scene) {
    let middle = ui.checkbox(&mut scene.cloud_wind.middle, "A node in between");
    rename(ui, &middle, "Wind: a node in between");
    if middle.changed() && scene.cloud_wind.middle {
        put_on_the_line(&mut scene.cloud_wind);
    }
    let width = 0.5 * (ui.available_width() - ui.spacing().item_spacing.x);
    ui.horizontal_top(|ui| {
        for (quantity, caption) in [(Quantity::Speed, "Speed, m/s"), (Quantity::From, "From, degrees")] {
            ui.vertical(|ui| {
                ui.set_width(width.max(80.0));
                ui.weak(caption);
                plot(ui, scene, quantity);
            });
        }
    });
}

/// A new node where the wind is already.
fn put_on_the_line(wind: &mut CloudWindParams) {
    wind.middle = false;
    let [east, north] = wind_m_s(wind, wind.middle_share);
    wind.middle_speed_m_s = east.hypot(north);
    wind.middle_from_deg = (-east).atan2(-north).to_degrees().rem_euclid(360.0);
    wind.middle = true;
}

fn plot(ui: &mut Ui, scene: &mut Scene, quantity: Quantity) {
    let (floor_m, height_m) =
        (scene.cloud_grid.floor_m, f64::from(scene.cloud_grid.cells_up) * scene.cloud_grid.cell_m);
    let altitude = |share: f64| floor_m + share * height_m;
    let (accent, weak) = (ui.visuals().selection.bg_fill, ui.visuals().weak_text_color());
    let nodes = nodes(&scene.cloud_wind);
    let knots: Vec<[f64; 2]> = nodes.iter().map(|node| knot(&scene.cloud_wind, *node, quantity)).collect();
    let name = if quantity == Quantity::Speed { "wind speed" } else { "wind direction" };
    let response =
        axes(quiet(Plot::new(name)), quantity).include_y(altitude(0.0)).include_y(altitude(1.0)).show(ui, |plot| {
            for share in [0.0, 1.0] {
                plot.hline(
                    HLine::new("floor or ceiling", altitude(share)).color(weak).style(LineStyle::dotted_dense()),
                );
            }
            for piece in curve(&scene.cloud_wind, quantity) {
                let points: PlotPoints<'_> = piece.into_iter().map(|[x, share]| [x, altitude(share)]).collect();
                plot.line(Line::new("wind", points).color(accent).width(1.8).allow_hover(false));
            }
            let points: PlotPoints<'_> = knots.iter().map(|[x, share]| [*x, altitude(*share)]).collect();
            plot.points(Points::new("nodes", points).color(accent).radius(5.0));
        });
    rename(ui, &response.response, &format!("Wind: {}", name.trim_start_matches("wind ")));
    let at_px: Vec<_> = knots
        .iter()
        .map(|[x, share]| response.transform.position_from_point(&PlotPoint::new(*x, altitude(*share))))
        .collect();
    if let Some((node, [x, altitude_m])) = dragged(ui, &response, &nodes, &at_px) {
        pull(&mut scene.cloud_wind, node, quantity, [x, (altitude_m - floor_m) / height_m]);
    }
}

fn axes(plot: Plot<'_>, quantity: Quantity) -> Plot<'_> {
    let plot = plot
        .height(PLOT_PT)
        .include_x(0.0)
        .show_x(false)
        .show_y(false)
        .y_grid_spacer(|input| few(input.bounds))
        .x_grid_spacer(|input| few(input.bounds))
        .y_axis_formatter(|mark, _| short(mark.value))
        .label_formatter(|_| None);
    match quantity {
        Quantity::Speed => plot.include_x(12.0).x_axis_formatter(|mark, _| short(mark.value)),
        Quantity::From => plot
            .include_x(360.0)
            .x_grid_spacer(|_| {
                (0..=4).map(|i| egui_plot::GridMark { value: 90.0 * f64::from(i), step_size: 90.0 }).collect()
            })
            .x_axis_formatter(|mark, _| compass(mark.value.rem_euclid(360.0)).to_owned()),
    }
}

/// The node that is held, and where the pointer has it.
fn dragged<R>(ui: &Ui, plot: &PlotResponse<R>, nodes: &[Node], at: &[egui::Pos2]) -> Option<(Node, [f64; 2])> {
    let response = &plot.response;
    let nearest = |pointer: egui::Pos2| {
        let distances = at.iter().map(|place| place.distance(pointer)).enumerate();
        distances
            .filter(|(_, distance)| *distance <= GRASP_PT)
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(index, _)| index)
    };
    if response.hover_pos().is_some_and(|pointer| nearest(pointer).is_some()) {
        ui.ctx().set_cursor_icon(CursorIcon::Grab);
    }
    let memory = response.id.with("held");
    if response.drag_started() {
        let held = ui.input(|input| input.pointer.press_origin()).and_then(nearest);
        ui.data_mut(|data| data.insert_temp(memory, held));
    }
    let held = ui.data(|data| data.get_temp::<Option<usize>>(memory)).flatten();
    let pointer = response.interact_pointer_pos().filter(|_| response.dragged())?;
    let point = plot.transform.value_from_position(pointer);
    Some((*nodes.get(held?)?, [point.x, point.y]))
}

fn nodes(wind: &CloudWindParams) -> Vec<Node> {
    let middle = wind.middle.then_some(Node::Middle);
    [Some(Node::Floor), middle, Some(Node::Ceiling)].into_iter().flatten().collect()
}

/// The quantity at a node and the node's share of the height.
fn knot(wind: &CloudWindParams, node: Node, quantity: Quantity) -> [f64; 2] {
    let (speed_m_s, from_deg, share) = match node {
        Node::Floor => (wind.floor_speed_m_s, wind.floor_from_deg, 0.0),
        Node::Middle => (wind.middle_speed_m_s, wind.middle_from_deg, wind.middle_share),
        Node::Ceiling => (wind.ceiling_speed_m_s, wind.ceiling_from_deg, 1.0),
    };
    [if quantity == Quantity::Speed { speed_m_s } else { from_deg }, share]
}

/// Moves a node to a value of the quantity and, in the middle, to a share of the height; within what is allowed.
fn pull(wind: &mut CloudWindParams, node: Node, quantity: Quantity, [value, share]: [f64; 2]) {
    let part = match node {
        Node::Floor => "floor",
        Node::Middle => "middle",
        Node::Ceiling => "ceiling",
    };
    let (name, value) = match quantity {
        Quantity::Speed => (format!("{part}_speed_m_s"), (10.0 * value).round() / 10.0),
        Quantity::From => (format!("{part}_from_deg"), value.round()),
    };
    put(wind, &name, value);
    if node == Node::Middle {
        put(wind, "middle_share", (100.0 * share).round() / 100.0);
    }
}

/// Sets a parameter to the nearest value that it takes.
fn put(wind: &mut CloudWindParams, name: &str, value: f64) {
    if let Ok(index) = wind.position(name) {
        let range = &wind.info()[index].range;
        let value = value.clamp(*range.start(), *range.end());
        wind.set_unchecked(index, value);
    }
}

/// Wind east and north (m/s) at a share of the height: linear between nodes, as the simulation has it.
pub(crate) fn wind_m_s(wind: &CloudWindParams, share: f64) -> [f64; 2] {
    let nodes = nodes(wind);
    let vector = |node: Node| {
        let [speed_m_s, height] = knot(wind, node, Quantity::Speed);
        let (sine, cosine) = knot(wind, node, Quantity::From)[0].to_radians().sin_cos();
        (height, [-sine * speed_m_s, -cosine * speed_m_s])
    };
    let pair = nodes.windows(2).map(|pair| (vector(pair[0]), vector(pair[1]))).find(|(_, (top, _))| share <= *top);
    let Some(((low, below), (high, above))) = pair else { return vector(Node::Ceiling).1 };
    let part = (share - low) / (high - low);
    [0, 1].map(|axis| below[axis] + part * (above[axis] - below[axis]))
}

/// The curve as [value, share of the height], in pieces: a direction that passes north goes on at the other side.
fn curve(wind: &CloudWindParams, quantity: Quantity) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    for step in 0..=PIECES {
        let share = f64::from(step) / f64::from(PIECES);
        let [east, north] = wind_m_s(wind, share);
        let value = match quantity {
            Quantity::Speed => east.hypot(north),
            Quantity::From => (-east).atan2(-north).to_degrees().rem_euclid(360.0),
        };
        let last = pieces.last().and_then(|piece| piece.last()).copied();
        if last.is_some_and(|[before, _]| quantity == Quantity::From && (before - value).abs() > 180.0) {
            pieces.push(Vec::new());
        }
        if let Some(piece) = pieces.last_mut() {
            piece.push([value, share]);
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_node_changes_no_wind() {
        let mut wind = CloudWindParams { floor_from_deg: 350.0, ceiling_from_deg: 40.0, ..CloudWindParams::default() };
        let before: Vec<_> = (0..=10).map(|i| wind_m_s(&wind, 0.1 * f64::from(i))).collect();
        wind.middle_share = 0.3;
        put_on_the_line(&mut wind);
        for (i, old) in (0..).zip(&before) {
            let new = wind_m_s(&wind, 0.1 * f64::from(i));
            assert!((new[0] - old[0]).hypot(new[1] - old[1]) < 1e-9, "{new:?} {old:?}");
        }
        assert!(wind.middle, "there is a node now");
    }

    #[test]
    fn nodes_stay_within_what_is_allowed() {
        let mut scene = Scene::default();
        scene.cloud_wind.middle = true;
        for node in [Node::Floor, Node::Middle, Node::Ceiling] {
            for quantity in [Quantity::Speed, Quantity::From] {
                for place in [[-1e9, -7.0], [1e9, 7.0]] {
                    pull(&mut scene.cloud_wind, node, quantity, place);
                    assert!(scene.check().is_ok(), "{node:?} {quantity:?}: {:?}", scene.cloud_wind);
                }
            }
        }
        pull(&mut scene.cloud_wind, Node::Middle, Quantity::Speed, [7.04, 0.613]);
        let wind = &scene.cloud_wind;
        assert!((wind.middle_speed_m_s - 7.0).abs() < 1e-9 && (wind.middle_share - 0.61).abs() < 1e-9, "{wind:?}");
    }

    #[test]
    fn a_direction_over_north_is_drawn_in_two_pieces() {
        let wind = CloudWindParams { floor_from_deg: 350.0, ceiling_from_deg: 20.0, ..CloudWindParams::default() };
        let pieces = curve(&wind, Quantity::From);
        assert_eq!(pieces.len(), 2, "{pieces:?}");
        assert_eq!(curve(&wind, Quantity::Speed).len(), 1, "speeds have no seam");
    }
}
