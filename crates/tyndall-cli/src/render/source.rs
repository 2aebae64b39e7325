//! Where a scene comes from: a file, or the program itself; and what the command line changes in it.

use std::path::Path;

use tyndall_scene::{Scene, SceneFile};

use crate::{Failure, presets};

/// Marks the name of a preset.
const PRESET: &str = "preset:";

/// Loads the scene that a user names.
pub(crate) fn load(source: &Path) -> Result<Scene, Failure> {
    let file = match source.to_str().and_then(|text| text.strip_prefix(PRESET)) {
        Some(name) => presets::find(name)?.load()?,
        None => SceneFile::load(source)?,
    };
    Ok(file.scene)
}

/// The scene that a user names, with these parameters changed.
pub(crate) fn load_with(source: &Path, settings: &[(String, String)]) -> Result<Scene, Failure> {
    let mut scene = load(source)?;
    for (path, value) in settings {
        scene.set_text(path, value)?;
    }
    scene.check()?;
    Ok(scene)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_loaded_by_name_and_files_by_path() {
        let preset = load(Path::new("preset:noon")).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("noon.toml");
        std::fs::write(&path, presets::find("noon").unwrap().text).unwrap();
        let loaded = load(&path).unwrap();
        assert_eq!(&*loaded.folder, folder.path(), "what a scene names lies beside it");
        assert_eq!(loaded, preset, "the same scene both ways");
    }

    #[test]
    fn a_missing_scene_is_refused_with_its_name() {
        let failure = load(Path::new("no/such/scene.toml")).expect_err("no such file");
        assert!(failure.to_string().starts_with("no/such/scene.toml: cannot be read: "), "{failure}");
    }
}
