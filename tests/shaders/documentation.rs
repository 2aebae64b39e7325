//! Words above the functions that all shaders share.

use tyndall_shaders::FILES;

/// Folder of the shared functions.
pub(crate) const SHARED: &str = "common/";

/// Name and line (from 1) of every function that a text declares at the start of a line.
pub(crate) fn functions(text: &str) -> impl Iterator<Item = (&str, usize)> {
    (1..).zip(text.lines()).filter_map(|(number, line)| {
        let name = line.strip_prefix("fn ")?.split(['(', ' ']).next()?;
        Some((name, number))
    })
}

/// Functions without a `///` line directly above.
fn undocumented(file: &str, text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let is_documented = |number: usize| number >= 2 && lines[number - 2].starts_with("///");
    let without = functions(text).filter(|(_, number)| !is_documented(*number));
    without.map(|(name, number)| format!("{file}:{number}: `{name}` has no /// line above it")).collect()
}

/// Shared files that bind something: they could not be tested by themselves.
fn bindings(file: &str, text: &str) -> Vec<String> {
    let bound = (1..).zip(text.lines()).filter(|(_, line)| line.contains("@binding("));
    bound.map(|(number, _)| format!("{file}:{number}: a shared file binds nothing")).collect()
}

fn in_shared_files(rule: fn(&str, &str) -> Vec<String>) -> Vec<String> {
    FILES.iter().filter(|(name, _)| name.starts_with(SHARED)).flat_map(|(name, text)| rule(name, text)).collect()
}

#[test]
fn every_shared_function_has_a_doc_comment() {
    let faults = in_shared_files(undocumented);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn shared_files_are_pure_functions_without_bindings() {
    let faults = in_shared_files(bindings);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn planted_functions_without_words_are_found() {
    let text = "/// Documented.\nfn a() {}\n// A plain comment.\nfn b() {}\n\nfn c(\n    x: f32,\n) {}\n";
    let faults = undocumented("x.wgsl", text);
    assert_eq!(faults.len(), 2, "{faults:?}");
    assert!(faults[0].starts_with("x.wgsl:4: `b`") && faults[1].starts_with("x.wgsl:6: `c`"), "{faults:?}");
}

#[test]
fn a_planted_binding_in_a_shared_file_is_found() {
    let faults = bindings("x.wgsl", "\n@group(0) @binding(0) var<uniform> gain: f32;\n");
    assert_eq!(faults, ["x.wgsl:2: a shared file binds nothing"], "with its line");
}
