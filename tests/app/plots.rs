//! The plots of the sky.

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::harness::{Program, click, quick_scene, run, start_with_scene};

/// Points at a place of the view, as shares of its width and height.
fn point(program: &mut Program, x: f32, y: f32) {
    let view = program.get_by_role_and_label(Role::Image, "Viewport").rect();
    program.hover_at(view.min + egui::vec2(x, y) * view.size());
    run(program);
}

fn luminance(program: &Program) -> f64 {
    let mut labels = program.get_all_by_label_contains(" cd/m²").filter_map(|node| node.accesskit_node().value());
    labels.find_map(|label| label.trim_end_matches(" cd/m²").parse().ok()).expect("a number")
}

#[test]
fn the_light_under_the_pointer_is_told() {
    let mut program = start_with_scene(quick_scene());
    click(&mut program, "Plots");
    assert!(program.query_by_label_contains("Point at the view").is_some(), "nothing is pointed at yet");
    // The parameters have one of that name too.
    let directions = program.query_all_by_label("Direction").count();
    point(&mut program, 0.5, 0.1);
    let near_sun = luminance(&program);
    point(&mut program, 0.5, 0.4);
    let below = luminance(&program);
    // The view's upper edge is a few degrees from the sun.
    assert!(below > 100.0 && near_sun > 1.3 * below, "the sky is brightest at the sun: {near_sun} and {below} cd/m2");
    assert_eq!(program.query_all_by_label("Direction").count(), directions + 1, "where it comes from");
}
