//! The error meter.

use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use tyndall_scene::{OrdersDetail, Scene};

use crate::harness::{click, quick_scene, set_slider, start_with_scene};

/// Longest time that a quick comparison may take on a busy computer.
const PATIENCE: Duration = Duration::from_mins(3);

#[test]
fn the_sky_is_compared_with_random_walks_part_by_part() {
    let mut scene = Scene::default();
    scene.sky.orders_detail = OrdersDetail::Preview;
    let mut program = start_with_scene(scene);
    click(&mut program, "Accuracy");
    click(&mut program, "Compare");
    let started = Instant::now();
    while program.query_by_label("all").is_none() {
        assert!(started.elapsed() < PATIENCE, "no report in time");
        std::thread::sleep(Duration::from_millis(50));
        program.run();
    }
    for part in ["zenith", "horizon", "aureole"] {
        assert!(program.query_by_label(part).is_some(), "errors of the {part}");
    }
    assert!(program.query_by_label_contains("changed since").is_none(), "it is this scene's");
    set_slider(&mut program, "sun: Elevation", 12.0);
    assert!(program.query_by_label_contains("changed since").is_some(), "another sun");
}

#[test]
fn a_comparison_can_be_stopped() {
    let mut program = start_with_scene(Scene::default());
    click(&mut program, "Accuracy");
    click(&mut program, "Thorough");
    program.get_by_role_and_label(Role::Button, "Compare").click_accesskit();
    program.run();
    program.run();
    click(&mut program, "Stop");
    assert!(program.query_by_role_and_label(Role::Button, "Compare").is_some(), "ready for another one");
}

#[test]
fn clouds_are_compared_with_random_walks_through_their_cells() {
    let mut scene = quick_scene();
    for (path, text) in [
        ("clouds.kind", "automaton"),
        ("cloud_grid.cells_east", "32"),
        ("cloud_grid.cells_north", "32"),
        ("cloud_grid.cells_up", "16"),
        ("cloud_grid.warm_up_steps", "20"),
        ("cloud_vapour.cover", "0.6"),
        ("camera.pitch_deg", "50"),
    ] {
        scene.set_text(path, text).expect("the parameter exists");
    }
    let mut program = start_with_scene(scene);
    click(&mut program, "Accuracy");
    click(&mut program, "Compare clouds");
    let started = Instant::now();
    while program.query_by_label("PSNR").is_none() {
        assert!(started.elapsed() < PATIENCE, "no figures in time");
        std::thread::sleep(Duration::from_millis(50));
        program.run();
    }
    for figure in ["FLIP", "Correlation", "Clouds: mean over that of the walks"] {
        assert!(program.query_by_label(figure).is_some(), "{figure} is told");
    }
    assert!(program.query_by_label_contains("clouds have changed").is_none(), "they are this scene's");
    set_slider(&mut program, "sun: Elevation", 12.0);
    assert!(program.query_by_label_contains("clouds have changed").is_some(), "another sun");
}
