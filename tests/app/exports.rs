//! The export panel's commands.

use egui::{OutputCommand, accesskit::Role};
use egui_kittest::kittest::Queryable as _;

use crate::harness::{Program, click, quick_scene, run, set_slider, start_with_scene, type_into};

/// The command line that the panel copies.
fn copied(program: &mut Program) -> String {
    program.get_by_role_and_label(Role::Button, "Copy as command line").click_accesskit();
    program.step();
    let commands = program.output().platform_output.commands.iter();
    let mut texts = commands.filter_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    texts.next_back().expect("a copied text")
}

/// Opens a list and chooses.
fn choose(program: &mut Program, list: &str, choice: &str) {
    program.get_by_role_and_label(Role::ComboBox, list).click_accesskit();
    run(program);
    click(program, choice);
}

#[test]
fn each_export_is_copied_as_the_command_that_makes_it() {
    let mut program = start_with_scene(quick_scene());
    set_slider(&mut program, "sun: Elevation", 7.5);
    click(&mut program, "Export");
    let line = copied(&mut program);
    assert!(line.starts_with("tyndall render ") && line.contains("--set sun.elevation_deg=7.5"), "{line}");

    click(&mut program, "HDRI");
    choose(&mut program, "Sun's disc", "For a lamp");
    choose(&mut program, "Panorama width", "4096 x 2048 px");
    let line = copied(&mut program);
    assert!(line.starts_with("tyndall hdri ") && line.contains("--set sun.elevation_deg=7.5"), "{line}");
    assert!(line.ends_with("-o scene-sky.exr --width 4096 --sun lamp"), "{line}");

    click(&mut program, "Cube map");
    choose(&mut program, "Layout of the faces", "Strip");
    let line = copied(&mut program);
    assert!(line.starts_with("tyndall cubemap ") && line.ends_with("-o scene-cube.exr --layout strip"), "{line}");
}

#[test]
fn an_ending_that_will_be_refused_is_told_at_once() {
    let mut program = start_with_scene(quick_scene());
    click(&mut program, "Export");
    click(&mut program, "HDRI");
    type_into(&mut program, "Picture file", "sky.png");
    assert!(program.query_by_label_contains("must be .exr or .hdr").is_some(), "the reason");
}
