//! The arrows between our own crates.

use std::collections::BTreeSet;

use crate::graph::Graph;

/// For each crate the crates it stands on; what those stand on is allowed too. Tests and benches may use anything.
const ARROWS: &[(&str, &[&str])] = &[
    ("tyndall-core", &[]),
    ("tyndall-shaders", &[]),
    ("tyndall-assets", &[]),
    ("tyndall-scattering", &["tyndall-core"]),
    ("tyndall-clouds", &["tyndall-core"]),
    ("tyndall-dunes", &["tyndall-core"]),
    ("tyndall-io", &["tyndall-core"]),
    ("tyndall-scene", &["tyndall-core", "tyndall-scattering", "tyndall-clouds", "tyndall-dunes", "tyndall-assets"]),
    ("tyndall-gpu", &["tyndall-shaders", "tyndall-core"]),
    ("tyndall-gpu-sim", &["tyndall-gpu", "tyndall-dunes"]),
    ("tyndall-render", &["tyndall-gpu", "tyndall-scene", "tyndall-io"]),
    ("tyndall-cli", &["tyndall-render", "tyndall-io"]),
    ("tyndall-app", &["tyndall-render", "tyndall-io", "tyndall-gpu-sim"]),
    ("tyndall", &["tyndall-render", "tyndall-io", "tyndall-gpu-sim"]),
    ("xtask", &[]),
];

/// Packages that may use any crate and that none may use.
const ANYTHING: [&str; 2] = ["tyndall-tests", "tyndall-benches"];

/// All crates that `package` may name: those of its arrows, and what they stand on.
fn allowed(package: &str) -> BTreeSet<&'static str> {
    let direct = ARROWS.iter().find(|(name, _)| *name == package).map_or(&[][..], |(_, arrows)| *arrows);
    direct.iter().flat_map(|name| allowed(name).into_iter().chain([*name])).collect()
}

/// Dependencies between members that no arrow allows, and members that the table does not know.
fn violations(graph: &Graph) -> Vec<String> {
    let mut found = Vec::new();
    for member in graph.members.iter().filter(|member| !ANYTHING.contains(&member.as_str())) {
        if ARROWS.iter().all(|(name, _)| name != member) {
            found.push(format!("{member} has no line in ARROWS of tests/deps/arrows.rs"));
        }
        let named = graph.edges.get(member).into_iter().flatten();
        for dependency in named.filter(|name| graph.members.contains(*name)) {
            if !allowed(member).contains(dependency.as_str()) {
                found.push(format!("{member} -> {dependency} is no arrow of the architecture"));
            }
        }
    }
    found
}

/// Members that can be reached from themselves.
fn circles(graph: &Graph) -> Vec<String> {
    graph.members.iter().filter_map(|member| graph.way(member, member)).map(|way| way.join(" -> ")).collect()
}

#[test]
fn crates_depend_on_each_other_only_along_the_arrows() {
    let found = violations(Graph::of_workspace());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn no_crate_depends_on_itself_by_way_of_others() {
    let found = circles(Graph::of_workspace());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn the_arrows_themselves_lead_downwards() {
    for (index, (package, arrows)) in ARROWS.iter().enumerate() {
        for arrow in *arrows {
            let below = ARROWS[..index].iter().any(|(name, _)| name == arrow);
            assert!(below, "{package} -> {arrow}: the table goes from the bottom up");
        }
    }
}

#[test]
fn a_planted_arrow_upwards_is_found() {
    let graph = Graph::of_lines("tyndall-core: tyndall-scene\ntyndall-scene:\ntyndall-io: tyndall-core");
    assert_eq!(violations(&graph), ["tyndall-core -> tyndall-scene is no arrow of the architecture"], "that one");
}

#[test]
fn an_arrow_past_a_crate_to_what_it_stands_on_is_allowed() {
    let graph = Graph::of_lines(
        "tyndall-cli: tyndall-core tyndall-gpu\ntyndall-core:\ntyndall-gpu: tyndall-shaders\ntyndall-shaders:",
    );
    assert_eq!(violations(&graph), Vec::<String>::new(), "the program stands on both");
}

#[test]
fn a_crate_that_nobody_gave_arrows_is_found() {
    let found = violations(&Graph::of_lines("tyndall-rain:"));
    assert_eq!(found, ["tyndall-rain has no line in ARROWS of tests/deps/arrows.rs"], "the line to add");
}

#[test]
fn a_planted_circle_is_found() {
    let graph = Graph::of_lines("tyndall-io: tyndall-scene\ntyndall-scene: tyndall-io\ntyndall-core:");
    assert_eq!(circles(&graph).len(), 2, "seen from both");
}
