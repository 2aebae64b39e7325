//! Opening, saving, losing and recovering scenes.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use tyndall_app::AppOptions;
use tyndall_scene::Scene;

use crate::harness::{Program, click, press, quick_scene, rest, set_slider, start, start_with_scene};

const TEXT: &str = "format = 1\ntitle = \"Mine\"\n# the evening\n[sun]\nelevation_deg = 4 # low\n";

/// Opens a file by keyboard alone.
fn open_by_path(program: &mut Program, path: &Path) {
    press(program, Modifiers::NONE, Key::O);
    program.get_by_label("Path of the file").type_text(&path.display().to_string());
    program.run();
    program.key_press(Key::Enter);
    program.run();
}

#[test]
fn opening_changing_and_saving_keeps_the_comments() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("mine.toml");
    fs::write(&path, TEXT).expect("a scene file");
    let mut program = start(AppOptions::default());
    open_by_path(&mut program, &path);
    assert_eq!(program.state().scene().title, "Mine", "opened");
    assert_eq!(program.state().title(), "mine.toml - Tyndall", "nothing to save");
    set_slider(&mut program, "sun: Elevation", 7.25);
    assert_eq!(program.state().title(), "*mine.toml - Tyndall", "changed");
    press(&mut program, Modifiers::NONE, Key::S);
    assert_eq!(program.state().title(), "mine.toml - Tyndall", "saved");
    let saved = fs::read_to_string(&path).expect("the saved file");
    assert_eq!(saved, TEXT.replace("elevation_deg = 4 ", "elevation_deg = 7.25 "), "{saved}");
}

#[test]
fn a_broken_file_is_explained_and_the_scene_stays() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("broken.toml");
    fs::write(&path, "format = 1\n[sun]\nelevatoin_deg = 4\n").expect("a broken scene file");
    let mut program = start_with_scene(quick_scene());
    open_by_path(&mut program, &path);
    let report = program.get_by_label_contains("did you mean");
    let text = format!("{report:?}");
    assert!(text.contains("sun.elevation_deg"), "{text}");
    assert_eq!(program.state().scene(), &quick_scene(), "the scene stays");
    click(&mut program, "Close");
    assert!(program.query_by_label_contains("did you mean").is_none(), "the message is gone");
}

#[test]
fn changes_are_not_lost_without_a_question() {
    let mut program = start_with_scene(quick_scene());
    set_slider(&mut program, "sun: Elevation", 9.0);
    for (answer, elevation_deg) in [("Cancel", 9.0), ("Discard", Scene::default().sun.elevation_deg)] {
        press(&mut program, Modifiers::NONE, Key::N);
        click(&mut program, answer);
        let found = program.state().scene().sun.elevation_deg;
        assert!((found - elevation_deg).abs() < 1e-9, "{answer}: {found}");
    }
    press(&mut program, Modifiers::NONE, Key::N);
    assert!(program.query_by_label("Discard").is_none(), "nothing would be lost");
}

#[test]
fn a_preset_is_opened_from_the_gallery_and_undo_does_not_leave_it() {
    let mut program = start_with_scene(quick_scene());
    click(&mut program, "Gallery");
    click(&mut program, "Preset: Sunset");
    assert_eq!(program.state().scene().title, "Sunset", "opened");
    press(&mut program, Modifiers::NONE, Key::Z);
    assert_eq!(program.state().scene().title, "Sunset", "a document of its own");
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn a_file_dropped_on_the_window_is_opened() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("mine.toml");
    fs::write(&path, TEXT).expect("a scene file");
    let mut program = start_with_scene(quick_scene());
    program.input_mut().dropped_files.push(Arc::new(Dropped(path)));
    program.run();
    assert_eq!(program.state().scene().title, "Mine", "opened");
}

#[test]
fn unsaved_changes_survive_a_crash() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [first, second] = ["first", "second"].map(|name| folder.path().join(name));
    let options = |data_dir: &Path| AppOptions { data_dir: Some(data_dir.to_owned()), ..AppOptions::default() };
    let mut program = start(options(&first));
    set_slider(&mut program, "sun: Elevation", 11.5);
    rest(&mut program);

    // What a crash would leave, taken while the program still runs: its files without their lock.
    fs::create_dir(&second).expect("a folder");
    for entry in fs::read_dir(&first).expect("the program's folder") {
        let path = entry.expect("a file").path();
        fs::copy(&path, second.join(path.file_name().expect("a name"))).expect("a copy");
    }
    let mut next = start(options(&second));
    click(&mut next, "Recover");
    assert!((next.state().scene().sun.elevation_deg - 11.5).abs() < 1e-9, "{:?}", next.state().scene().sun);
    assert!(next.state().title().starts_with('*'), "still unsaved: {}", next.state().title());
}

#[test]
fn redo_takes_an_undo_back() {
    let mut program = start_with_scene(quick_scene());
    set_slider(&mut program, "sun: Elevation", 20.0);
    rest(&mut program);
    press(&mut program, Modifiers::NONE, Key::Z);
    for (modifiers, key) in [(Modifiers::SHIFT, Key::Z), (Modifiers::NONE, Key::Y)] {
        press(&mut program, modifiers, key);
        let found = program.state().scene().sun.elevation_deg;
        assert!((found - 20.0).abs() < 1e-9, "{key:?}: {found}");
        press(&mut program, Modifiers::NONE, Key::Z);
    }
}

#[test]
fn the_help_lists_the_shortcuts() {
    let mut program = start_with_scene(quick_scene());
    program.key_press(Key::F1);
    program.run();
    for text in ["Undo", "Full viewport", "Double click on a name"] {
        assert!(program.query_by_label(text).is_some(), "{text}");
    }
}
