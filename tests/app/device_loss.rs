//! A lost graphics device takes the picture along, not the scene.

use egui_kittest::kittest::Queryable as _;
use tyndall_app::AppOptions;

use crate::harness::{click, rest, set_slider, start_with};

#[test]
fn a_lost_device_is_announced_and_the_scene_is_kept() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut device = None;
    let options = AppOptions { data_dir: Some(folder.path().to_owned()), ..AppOptions::default() };
    let mut program = start_with(options, |context| {
        device = context.wgpu_render_state.as_ref().map(|state| state.device.clone());
    });
    device.expect("the window's device").destroy();

    set_slider(&mut program, "sun: Elevation", 13.5);
    rest(&mut program);
    assert!(program.query_by_label_contains("lost").is_some(), "the loss is announced");
    assert!((program.state().scene().sun.elevation_deg - 13.5).abs() < 1e-9, "the scene can still be changed");

    click(&mut program, "Rebuild");
    assert!(program.query_by_label_contains("Restart Tyndall").is_some(), "the window's own device is gone");
    let kept: Vec<_> = std::fs::read_dir(folder.path())
        .expect("the program's folder")
        .filter_map(|entry| std::fs::read_to_string(entry.ok()?.path()).ok())
        .collect();
    assert!(kept.iter().any(|text| text.contains("elevation_deg = 13.5")), "kept for recovery: {kept:?}");
}
