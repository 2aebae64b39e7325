//! The graph of packages as cargo resolves it.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::process::Command;
use std::sync::OnceLock;

use serde_json::Value;

/// Packages and the packages they are built with: normal and build dependencies on this system, not those of tests.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    /// For each package the packages it names itself.
    pub(crate) edges: BTreeMap<String, BTreeSet<String>>,
    /// The packages of this workspace.
    pub(crate) members: BTreeSet<String>,
}

impl Graph {
    /// The graph of this workspace.
    pub(crate) fn of_workspace() -> &'static Self {
        static GRAPH: OnceLock<Graph> = OnceLock::new();
        GRAPH.get_or_init(|| Self::parse(&metadata()).expect("cargo metadata has a documented form"))
    }

    /// Reads the output of `cargo metadata --format-version 1`.
    pub(crate) fn parse(metadata: &str) -> anyhow::Result<Self> {
        let metadata: Value = serde_json::from_str(metadata)?;
        let name_of: BTreeMap<&str, &str> =
            array(&metadata["packages"]).filter_map(|p| Some((p["id"].as_str()?, p["name"].as_str()?))).collect();
        let name = |id: &Value| id.as_str().and_then(|id| name_of.get(id)).map(|name| (*name).to_owned());
        let mut graph =
            Self { members: array(&metadata["workspace_members"]).filter_map(name).collect(), ..Self::default() };
        for node in array(&metadata["resolve"]["nodes"]) {
            let built_with =
                array(&node["deps"]).filter(|dep| array(&dep["dep_kinds"]).any(|kind| kind["kind"] != "dev"));
            let Some(package) = name(&node["id"]) else { continue };
            // Two versions of one package share a name, and so their edges.
            graph.edges.entry(package).or_default().extend(built_with.filter_map(|dep| name(&dep["pkg"])));
        }
        anyhow::ensure!(!graph.members.is_empty() && !graph.edges.is_empty(), "cargo metadata lists no packages");
        Ok(graph)
    }

    /// A graph from `package: dependency dependency` lines; all of its packages are members.
    #[cfg(test)]
    pub(crate) fn of_lines(lines: &str) -> Self {
        let mut graph = Self::default();
        for (package, dependencies) in lines.lines().filter_map(|line| line.trim().split_once(':')) {
            let dependencies = dependencies.split_whitespace().map(str::to_owned).collect();
            graph.edges.insert(package.to_owned(), dependencies);
            graph.members.insert(package.to_owned());
        }
        graph
    }

    /// A shortest way from one package to another along dependencies, both ends included.
    pub(crate) fn way(&self, from: &str, to: &str) -> Option<Vec<String>> {
        let mut came_from: BTreeMap<&str, &str> = BTreeMap::new();
        let mut queue = VecDeque::from([from]);
        while let Some(package) = queue.pop_front() {
            for dependency in self.edges.get(package).into_iter().flatten() {
                if came_from.contains_key(dependency.as_str()) {
                    continue;
                }
                came_from.insert(dependency, package);
                queue.push_back(dependency);
            }
        }
        came_from.contains_key(to).then(|| trace(&came_from, from, to))
    }
}

fn trace(came_from: &BTreeMap<&str, &str>, from: &str, to: &str) -> Vec<String> {
    let mut way = vec![to.to_owned()];
    let mut at = to;
    while let Some(previous) = came_from.get(at) {
        way.push((*previous).to_owned());
        if *previous == from {
            break;
        }
        at = previous;
    }
    way.reverse();
    way
}

fn array(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

/// Locked: what is tested is what `Cargo.lock` says. For the system at hand alone, because packages of other systems need
/// not have been downloaded.
fn metadata() -> String {
    // The network only where a package of the workspace was never built here.
    cargo_metadata(&["--offline"]).or_else(|_offline| cargo_metadata(&[])).unwrap_or_else(|error| panic!("{error}"))
}

fn cargo_metadata(options: &[&str]) -> Result<String, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["metadata", "--format-version=1", "--locked", "--filter-platform=host-tuple"])
        .args(options)
        .output()
        .map_err(|error| format!("cargo cannot be started: {error}"))?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    if output.status.success() {
        Ok(text(&output.stdout))
    } else {
        Err(format!("cargo metadata: {}", text(&output.stderr)))
    }
}

#[test]
fn dependencies_of_tests_are_left_out_and_those_of_builds_are_not() {
    let metadata = r#"{
        "packages": [{"id": "a 1", "name": "a"}, {"id": "b 1", "name": "b"}, {"id": "c 1", "name": "c"}],
        "workspace_members": ["a 1"],
        "resolve": {"nodes": [{"id": "a 1", "deps": [
            {"pkg": "b 1", "dep_kinds": [{"kind": "build", "target": null}]},
            {"pkg": "c 1", "dep_kinds": [{"kind": "dev", "target": null}]}]}]}}"#;
    let graph = Graph::parse(metadata).expect("the documented form");
    assert_eq!(graph.edges["a"], BTreeSet::from(["b".to_owned()]), "c is for tests alone");
    assert!(Graph::parse("{}").is_err(), "an empty answer is no graph without faults");
}

#[test]
fn the_way_to_a_package_is_a_shortest_one() {
    let graph = Graph::of_lines("a: b c\nb: d\nc: wgpu\nd: wgpu\nwgpu:");
    assert_eq!(graph.way("a", "wgpu"), Some(["a", "c", "wgpu"].map(str::to_owned).to_vec()), "not by b and d");
    assert_eq!(graph.way("wgpu", "a"), None, "arrows have a direction");
}
