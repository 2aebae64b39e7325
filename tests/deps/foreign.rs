//! Crates that must not know certain foreign packages, so that who uses one simulation need not build a renderer.

use crate::graph::Graph;

/// Packages of graphics drivers, windows and user interface.
const GRAPHICS: [&str; 8] = ["wgpu", "wgpu-core", "wgpu-hal", "wgpu-types", "naga", "winit", "egui", "eframe"];

/// Crates that compute without any of them.
const WITHOUT_GRAPHICS: [&str; 8] = [
    "tyndall-core",
    "tyndall-scattering",
    "tyndall-clouds",
    "tyndall-dunes",
    "tyndall-scene",
    "tyndall-io",
    "tyndall-shaders",
    "xtask",
];

/// User interface, which the app alone knows.
const INTERFACE: [&str; 6] = ["egui", "eframe", "egui-wgpu", "egui-winit", "winit", "rfd"];

/// The app, and the tests that drive it.
const WITH_INTERFACE: [&str; 2] = ["tyndall-app", "tyndall-tests"];

/// Programs and tests; libraries have typed errors.
const WITH_ANYHOW: [&str; 5] = ["tyndall-app", "tyndall-cli", "tyndall-benches", "tyndall-tests", "xtask"];

/// Ways from packages without graphics to graphics.
fn graphics_below(graph: &Graph) -> Vec<String> {
    let pairs = WITHOUT_GRAPHICS.iter().flat_map(|package| GRAPHICS.iter().map(move |foreign| (package, foreign)));
    pairs.filter_map(|(package, foreign)| graph.way(package, foreign)).map(|way| way.join(" -> ")).collect()
}

/// Ways from any member but the app to the user interface.
fn interface_outside_the_app(graph: &Graph) -> Vec<String> {
    let members = graph.members.iter().filter(|member| !WITH_INTERFACE.contains(&member.as_str()));
    let pairs = members.flat_map(|member| INTERFACE.iter().map(move |foreign| (member, foreign)));
    pairs.filter_map(|(member, foreign)| graph.way(member, foreign)).map(|way| way.join(" -> ")).collect()
}

/// Libraries that name `anyhow` themselves.
fn untyped_errors(graph: &Graph) -> Vec<&String> {
    let libraries = graph.members.iter().filter(|member| !WITH_ANYHOW.contains(&member.as_str()));
    libraries.filter(|member| graph.edges.get(*member).is_some_and(|named| named.contains("anyhow"))).collect()
}

#[test]
fn crates_below_the_gpu_have_no_graphics_in_their_tree() {
    let graph = Graph::of_workspace();
    for package in WITHOUT_GRAPHICS {
        assert!(graph.members.contains(package), "{package} is no package of this workspace; the list is out of date");
    }
    let ways = graphics_below(graph);
    assert!(ways.is_empty(), "these crates must build without graphics:\n{}", ways.join("\n"));
}

#[test]
fn only_the_app_knows_the_user_interface() {
    let graph = Graph::of_workspace();
    assert!(graph.way("tyndall-app", "egui").is_some(), "the app has egui; the list is out of date");
    let ways = interface_outside_the_app(graph);
    assert!(ways.is_empty(), "the user interface belongs to tyndall-app alone:\n{}", ways.join("\n"));
}

#[test]
fn libraries_have_typed_errors() {
    let libraries = untyped_errors(Graph::of_workspace());
    assert!(libraries.is_empty(), "anyhow is for programs and tests, but these name it: {libraries:?}");
}

#[test]
fn a_planted_way_to_graphics_is_found() {
    let graph = Graph::of_lines("tyndall-scene: glam helper\nhelper: wgpu-types\nglam:\nwgpu-types:");
    assert_eq!(graphics_below(&graph), ["tyndall-scene -> helper -> wgpu-types"], "through another package");
}

#[test]
fn a_planted_user_interface_is_found() {
    let graph = Graph::of_lines("tyndall-app: egui\ntyndall-cli: tyndall-widgets\ntyndall-widgets: egui\negui:");
    let ways = interface_outside_the_app(&graph);
    assert!(ways.contains(&"tyndall-cli -> tyndall-widgets -> egui".to_owned()), "{ways:?}");
    assert!(ways.iter().all(|way| !way.starts_with("tyndall-app")), "the app may: {ways:?}");
}

#[test]
fn a_planted_anyhow_in_a_library_is_found() {
    let graph = Graph::of_lines("tyndall-io: anyhow\ntyndall-cli: anyhow\nanyhow:");
    assert_eq!(untyped_errors(&graph), ["tyndall-io"], "the program may");
}
