//! Where a scene comes from: a file, or the program itself.

use tyndall_scene::{Scene, SceneFile};

use crate::{Failure, presets};

/// Marks the name of a preset.
const PRESET: &str = "preset:";

/// Loads the scene that a user names.
pub(super) fn load(name: &str) -> Result<Scene, Failure> {
    let file = match name.strip_prefix(PRESET) {
        Some(preset) => presets::find(preset)?.load()?,
        None => SceneFile::load(name)?,
    };
    Ok(file.scene)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_loaded_by_name_and_files_by_path() {
        let preset = load("preset:noon").unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("noon.toml");
        std::fs::write(&path, presets::find("noon").unwrap().text).unwrap();
        assert_eq!(load(&path.display().to_string()).unwrap(), preset, "the same scene both ways");
    }

    #[test]
    fn a_missing_scene_is_refused_with_its_name() {
        let failure = load("no/such/scene.toml").expect_err("no such file");
        assert!(failure.to_string().starts_with("no/such/scene.toml: cannot be read: "), "{failure}");
    }
}
