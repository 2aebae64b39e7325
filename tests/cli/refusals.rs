//! What cannot work is refused within a second, with a sentence and the designed exit code, and leaves nothing behind.

use crate::program::Place;

/// Runs `render preset:noon` with these words.
fn refused(words: &[&str], code: i32, part: &str) {
    let place = Place::new();
    place.run(&[&["render"], words].concat()).refused(code, part);
    assert!(place.files().is_empty(), "{words:?} left {:?}", place.files());
}

#[test]
fn missing_and_unknown_scenes_are_refused() {
    refused(&["missing.toml", "-o", "a.png"], 2, "missing.toml: cannot be read");
    refused(&[".", "-o", "a.png"], 2, ".: is a folder");
    refused(&["preset:midnight", "-o", "a.png"], 2, "the presets are noon");
    refused(&["", "-o", "a.png"], 2, "<SCENE>");
}

#[test]
fn unknown_formats_and_options_of_other_formats_are_refused() {
    refused(&["preset:noon", "-o", "a.tiff"], 2, ".png, .exr, .npy, .jpg or .jpeg");
    refused(&["preset:noon", "-o", "a.png", "--float"], 2, "--float concerns EXR files only");
    refused(&["preset:noon", "-o", "a.exr", "--bits", "16"], 2, "--bits concerns PNG files only");
    refused(&["preset:noon", "-o", "a.exr", "--half", "--float"], 2, "cannot be used with");
    refused(&["preset:noon"], 2, "--output <FILE>");
}

#[test]
fn unknown_parameters_and_impossible_values_are_refused() {
    let set = |setting: &str, part: &str| refused(&["preset:noon", "-o", "a.png", "--set", setting], 2, part);
    set("sun.elevation=4", "did you mean `sun.elevation_deg`?");
    set("sin.elevation_deg=4", "unknown group `sin`");
    set("sun.elevation_deg=nan", "outside -90 to 90 deg");
    set("sun.elevation_deg=inf", "outside -90 to 90 deg");
    set("sun.elevation_deg=high", "a number from -90 to 90 deg");
    set("film.tone_map=vivid", "one of \"agx\", \"aces\", \"none\"");
    set("image.width_px=10.5", "must be a whole number");
    set("sun.day=32", "outside 1 to 31");
    set("elevation", "group.parameter=value");
}

#[test]
fn impossible_sizes_are_refused_with_the_limits() {
    let size = |size: &str, part: &str| refused(&["preset:noon", "-o", "a.png", "--size", size], 2, part);
    size("60000x60000", "`image.width_px` = 60000 px is outside 1 to 16384 px");
    size("640x0", "`image.height_px` = 0 px is outside 1 to 16384 px");
    size("640", "such as 1920x1080");
    size("nanxnan", "such as 1920x1080");
}

#[test]
fn places_that_take_no_file_are_refused_before_anything_is_drawn() {
    refused(&["preset:noon", "-o", "nowhere/a.png"], 2, "the folder nowhere does not exist");
    let place = Place::new();
    place.write("scene.toml", "format = 1\n");
    std::fs::create_dir(place.path("folder.png")).unwrap();
    place.run(&["render", "scene.toml", "-o", "folder.png"]).refused(2, "it is a folder");
    place.run(&["render", "scene.toml", "-o", "scene.toml/a.png"]).refused(2, "is not a folder");
}

/// The kernel's own folder takes no files from anybody, root included.
#[cfg(target_os = "linux")]
#[test]
fn read_only_folders_are_refused() {
    refused(&["preset:noon", "-o", "/sys/kernel/tyndall.png"], 2, "no permission to write in /sys/kernel");
}

#[test]
fn a_picture_beyond_the_memory_budget_is_refused_with_both_numbers() {
    let words = ["preset:noon", "-o", "a.exr", "--size", "8000x8000", "--max-memory", "100M"];
    refused(&words, 4, "a picture of 8000 x 8000 pixels needs");
    refused(&words, 4, "100.00 MiB (104857600 bytes) are free");
    refused(&["preset:noon", "-o", "a.png", "--max-memory", "lots"], 2, "such as 8G");
}

#[test]
fn a_broken_scene_is_shown_with_its_line_and_a_caret() {
    let place = Place::new();
    for (text, line, part) in [
        ("[sun]\n", " --> a.toml:1:1", "`format` is missing"),
        ("format = 1\n[sun]\nelevation = 4\n", " --> a.toml:3:1", "did you mean `sun.elevation_deg`?"),
        ("format = 1\n[sun]\nelevation_deg = 91\n", " --> a.toml:3:17", "outside -90 to 90 deg"),
        ("format = 1\n[sun]\nelevation_deg = nan\n", " --> a.toml:3:17", "outside -90 to 90 deg"),
        ("format = 1\n[volcano]\n", " --> a.toml:2:2", "unknown group `volcano`"),
        ("format = 1\n[sun\n", " --> a.toml:2:", "error: "),
        ("format = 2\n", " --> a.toml:1:10", "format 1"),
    ] {
        place.write("a.toml", text);
        let run = place.run(&["render", "a.toml", "-o", "a.png"]);
        run.refused(2, part);
        assert!(run.stderr.contains(line) && run.stderr.contains('^'), "{line:?} is not in {}", run.stderr);
        assert_eq!(place.files(), ["a.toml"], "no picture of {text:?}");
    }
}

#[test]
fn adapters_that_are_not_there_are_refused_with_those_that_are() {
    refused(&["preset:noon", "-o", "a.png", "--adapter", "99"], 3, "no adapter fits `99`; there are: 0: ");
    refused(&["preset:noon", "-o", "a.png", "--adapter", "no such card"], 3, "no adapter fits `no such card`");
    refused(&["preset:noon", "-o", "a.png", "--adapter", ""], 2, "the text is empty");
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_driver_the_program_names_the_package_to_install() {
    // Built together with the desktop program, wgpu may find OpenGL drivers besides those of Vulkan.
    let no_driver = [("VK_DRIVER_FILES", "/nonexistent"), ("WGPU_BACKEND", "vulkan")];
    let place = Place::new();
    place.run_with(&no_driver, &["render", "preset:noon", "-o", "a.png"]).refused(3, "mesa-vulkan-drivers");
    assert!(place.files().is_empty(), "left {:?}", place.files());
    let doctor = place.run_with(&no_driver, &["doctor"]);
    doctor.refused(3, "mesa-vulkan-drivers");
    assert!(doctor.stdout.contains("  none\n") && doctor.stdout.contains("install"), "{}", doctor.stdout);
}

#[test]
fn a_wrong_command_line_is_refused_with_a_way_to_the_help() {
    let place = Place::new();
    place.run(&["paint"]).refused(2, "--help");
    place.run(&["render", "preset:noon", "-o", "a.png", "--sizes", "1x1"]).refused(2, "--size");
    assert_eq!(place.run(&[]).code, Some(2), "nothing to do");
}
