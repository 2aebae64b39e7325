//! The documentation says what the code says: every function, shader and test that it names exists, every link leads
//! somewhere.

mod equations;
mod links;
mod sources;

use std::path::Path;

use sources::Sources;

fn root() -> &'static Path {
    let this_crate = Path::new(env!("CARGO_MANIFEST_DIR"));
    this_crate.parent().unwrap_or(this_crate)
}

#[test]
fn every_name_in_the_table_of_equations_exists() {
    let name = "docs/equations.md";
    let document = std::fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let faults = equations::faults(name, &document, &Sources::below(root()));
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn every_local_link_leads_to_a_file() {
    let faults = links::faults_below(root()).unwrap();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}
