//! The program under test: a small window on the software adapter.

use std::{path::PathBuf, time::Duration};

use egui::{Modifiers, accesskit::Role};
use egui_kittest::{Harness, kittest::Queryable as _};
use tempfile::TempDir;
use tyndall_app::{App, AppOptions, wgpu_configuration};
use tyndall_gpu::AdapterChoice;
use tyndall_scene::{Orders, Scene, SceneFile};

/// The program with its state.
pub(crate) type Program = Harness<'static, App>;

/// A picture: width, height, bytes.
pub(crate) type Picture = ([u32; 2], Vec<[u8; 4]>);

/// Small on purpose: the software adapter's time goes with the pixels.
const WINDOW_PT: egui::Vec2 = egui::vec2(640.0, 420.0);

/// Frames that a change may take: the change, the picture, and thumbnails at the start.
const MAX_STEPS: u64 = 24;

/// How often and how long the program is given time for work beside the frames; a busy computer needs it.
const WAIT: Duration = Duration::from_millis(20);
const MAX_WAITS: u32 = 3000;

/// Frames of a quarter of a second until an undo point is set.
const STEPS_TO_REST: usize = 5;

/// The program as it starts.
pub(crate) fn start(options: AppOptions) -> Program {
    start_with(options, |_context| {})
}

/// The program as it starts, with a scene that is drawn quickly unless another is named; `look` sees what it is made from.
pub(crate) fn start_with(mut options: AppOptions, look: impl FnOnce(&eframe::CreationContext<'_>)) -> Program {
    let (_folder, path) = scene_file(quick_scene());
    options.scene.get_or_insert(path);
    let mut program = Harness::builder()
        .with_size(WINDOW_PT)
        .with_max_steps(MAX_STEPS)
        .wgpu_setup(wgpu_configuration(&AdapterChoice::Software).wgpu_setup)
        .build_eframe(|context| {
            look(context);
            App::new(context, options)
        });
    // In place of the gallery, whose thumbnails take longer than most tests.
    click(&mut program, "Log");
    program
}

/// The program with a scene in it, opened from a file.
pub(crate) fn start_with_scene(scene: Scene) -> Program {
    let (_folder, path) = scene_file(scene);
    start(AppOptions { scene: Some(path), ..AppOptions::default() })
}

/// A scene in a folder that is removed with the first value.
fn scene_file(scene: Scene) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.toml");
    SceneFile::new(scene).save(&path).expect("a scene that can be saved");
    (folder, path)
}

/// A scene that is drawn quickly: light counts that was scattered once.
pub(crate) fn quick_scene() -> Scene {
    let mut scene = Scene::default();
    scene.sky.orders = Orders::Single;
    scene
}

/// Runs until nothing moves any more, tables and plots that are made beside the frames included.
pub(crate) fn run(program: &mut Program) {
    program.run();
    for _try in 0..MAX_WAITS {
        if !program.state().is_busy() {
            return;
        }
        std::thread::sleep(WAIT);
        program.run();
    }
    panic!("something is still being computed after {:?}", WAIT * MAX_WAITS);
}

/// Lets a change come to rest, so that it can be undone by itself.
pub(crate) fn rest(program: &mut Program) {
    run(program);
    program.run_steps(STEPS_TO_REST);
    run(program);
}

/// The picture in the viewport.
pub(crate) fn picture(program: &Program) -> Picture {
    program.state().picture().unwrap_or_else(|reason| panic!("no picture: {reason}"))
}

/// Presses a key together with Ctrl or Cmd, and what else is held.
pub(crate) fn press(program: &mut Program, modifiers: Modifiers, key: egui::Key) {
    program.key_press_modifiers(Modifiers::COMMAND | modifiers, key);
    run(program);
}

/// Clicks a button.
pub(crate) fn click(program: &mut Program, name: &str) {
    program.get_by_role_and_label(Role::Button, name).click_accesskit();
    run(program);
}

/// Moves a slider.
pub(crate) fn set_slider(program: &mut Program, name: &str, value: f64) {
    program.get_by_role_and_label(Role::Slider, name).set_value_accesskit(value);
    run(program);
}

/// Types into a field.
pub(crate) fn type_into(program: &mut Program, name: &str, text: &str) {
    program.get_by_label(name).focus();
    run(program);
    program.get_by_label(name).type_text(text);
    run(program);
}
