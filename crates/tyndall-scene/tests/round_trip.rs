//! Saving keeps what the user wrote, and what was saved is what is read.

use proptest::prelude::*;
use tyndall_core::{ParamInfo, ParamKind};
use tyndall_scene::{Scene, SceneError, SceneFile, ToneMap, presets};

fn parse(text: &str) -> SceneFile {
    SceneFile::parse("scene.toml", text).unwrap_or_else(|error| panic!("{}\n{text}", error.report()))
}

/// Allowed value of a parameter at a position from 0 to 1 of its range.
fn value_at(info: &ParamInfo, position: f64) -> f64 {
    let (low, high) = (*info.range.start(), *info.range.end());
    let value = (low + (high - low) * position).clamp(low, high);
    if info.kind == ParamKind::Real { value } else { value.round() }
}

/// The scene with some parameters moved; those that other parameters depend on stay.
fn changed(mut scene: Scene, moves: &[(usize, usize, f64)]) -> Scene {
    for &(group, index, position) in moves {
        let mut groups = scene.groups_mut();
        let count = groups.len();
        let (_, set) = &mut groups[group % count];
        let index = index % set.info().len();
        let info = &set.info()[index];
        if !["day", "top_altitude_km", "ozone_altitude_km"].contains(&info.name) {
            set.set_unchecked(index, value_at(info, position));
        }
    }
    scene
}

const FILES: &[&str] = &[
    "format = 1\n",
    "# head\n\nformat = 1 # f\n\n# about the sun\n[sun] # s\n  elevation_deg = 1_0.0   # e\n\n[camera]\n# nothing\n\n# tail\n",
    "format = 1\nsun = { disc = true }\n# end\n",
    "format = 1\nsun.disc = true # x\nimage.width_px = 0x10\n\n# film\n[film]\n# end\n",
    "format = 1\r\ntitle = '''two\r\nlines'''\r\n# c\r\n[sun]\r\n",
    "\u{feff}format = 1\n[ground]\n",
];

fn moves() -> impl Strategy<Value = Vec<(usize, usize, f64)>> {
    prop::collection::vec((0_usize..7, 0_usize..16, 0.0..=1.0), 0..12)
}

proptest! {
    #[test]
    fn what_was_written_is_what_is_read(file in 0..FILES.len(), moves in moves(), title in "\\PC{0,12}", text in "[ -~\n\"\\\\]{0,40}") {
        let mut file = parse(FILES[file]);
        file.scene = changed(file.scene, &moves);
        file.scene.title = title;
        file.scene.description = text;
        let read = parse(&file.to_text());
        prop_assert_eq!(&read.scene, &file.scene, "{}", file.to_text());
        prop_assert_eq!(read.scene.hash(), file.scene.hash(), "{}", file.to_text());
        prop_assert_eq!(read.to_text(), file.to_text(), "writing twice changes nothing");
    }

    #[test]
    fn undoing_every_change_gives_the_users_bytes_back(file in 0..FILES.len(), moves in moves()) {
        let text = FILES[file];
        let mut file = parse(text);
        let before = std::mem::take(&mut file.scene);
        file.scene = changed(before.clone(), &moves);
        let changes = before.differences(&file.scene).len();
        prop_assert_eq!(file.to_text() == text, changes == 0, "{} changes", changes);
        file.scene = before;
        prop_assert_eq!(file.to_text(), text, "after the changes were taken back");
    }

    #[test]
    fn every_comment_of_the_user_survives(file in 0..FILES.len(), moves in moves()) {
        let mut file = parse(FILES[file]);
        let comments: Vec<_> = file.to_text().lines().filter_map(|line| line.split_once('#')).map(|(_, c)| c.to_owned()).collect();
        file.scene = changed(file.scene, &moves);
        let text = file.to_text();
        for comment in comments {
            prop_assert!(text.contains(&comment), "{comment} is not in\n{text}");
        }
    }

    #[test]
    fn hostile_texts_are_refused_without_a_panic(
        preset in 0_usize..5, edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0_u8..4), 1..20),
    ) {
        let mut bytes = presets()[preset].text.as_bytes().to_vec();
        for (at, byte, kind) in edits {
            let at = at.index(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                2 => drop(bytes.drain(at..(at + usize::from(byte)).min(bytes.len() - 1).max(at))),
                _ => bytes.extend_from_within(at..(at + usize::from(byte)).min(bytes.len())),
            }
        }
        let text = String::from_utf8_lossy(&bytes);
        match SceneFile::parse("scene.toml", &text) {
            Ok(file) => prop_assert!(file.scene.check().is_ok(), "{text}"),
            Err(error) => prop_assert!(error.place().is_some() && !error.report().is_empty(), "{error}"),
        }
    }
}

#[test]
fn files_that_nothing_was_changed_in_are_written_as_they_were() {
    for text in FILES {
        assert_eq!(parse(text).to_text(), *text, "{text:?}");
    }
}

#[test]
fn only_what_changed_is_written_and_below_the_users_last_comment() {
    let mut file = parse(FILES[1]);
    file.scene.title = "Evening".to_owned();
    file.scene.sun.elevation_deg = 12.5;
    file.scene.film.tone_map = ToneMap::Aces;
    let expected = "# head\n\nformat = 1 # f\ntitle = \"Evening\"\n\n# about the sun\n[sun] # s\n  elevation_deg = 12.5   # e\n\n\
                    [camera]\n# nothing\n\n# tail\n\n[film]\ntone_map = \"aces\"\n";
    assert_eq!(file.to_text(), expected, "{}", file.to_text());
}

#[test]
fn values_equal_to_the_default_are_written_only_where_the_user_wrote_them() {
    let mut file = parse("format = 1\n[sun]\nelevation_deg = 5 # low\n");
    file.scene = Scene::default();
    assert_eq!(file.to_text(), "format = 1\n[sun]\nelevation_deg = 35.0 # low\n", "{}", file.to_text());
    assert_eq!(SceneFile::new(Scene::default()).to_text(), "format = 1\n", "a new file");
}

#[test]
fn a_saved_file_is_complete_and_a_refused_one_leaves_the_old() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let mut file = SceneFile::new(Scene::default());
    file.scene.sun.elevation_deg = -3.0;
    file.save(&path).unwrap();
    assert_eq!(SceneFile::load(&path).unwrap().scene, file.scene, "as saved");

    let before = std::fs::read(&path).unwrap();
    file.scene.sun.elevation_deg = f64::NAN;
    let refused = file.save(&path).unwrap_err();
    assert_eq!(refused.field().as_deref(), Some("sun.elevation_deg"), "{refused}");
    assert_eq!(std::fs::read(&path).unwrap(), before, "a scene that cannot be read again is not written");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file is left");

    let nowhere = SceneFile::new(Scene::default()).save(folder.path().join("none/scene.toml")).unwrap_err();
    assert!(matches!(nowhere, SceneError::Write { .. }), "{nowhere}");
}

#[test]
#[cfg(unix)]
fn saving_through_a_link_keeps_the_link() {
    let folder = tempfile::tempdir().unwrap();
    let [target, link] = ["target.toml", "link.toml"].map(|name| folder.path().join(name));
    SceneFile::new(Scene::default()).save(&target).unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    let mut file = SceneFile::load(&link).unwrap();
    file.scene.title = "Through the link".to_owned();
    file.save(&link).unwrap();
    assert!(link.is_symlink(), "the link was replaced by a file");
    assert_eq!(SceneFile::load(&target).unwrap().scene.title, file.scene.title, "the target is the old one");
}
