//! Paths of files that a scene names.

use std::ops::Deref;
use std::path::{Path, PathBuf};

use crate::Scene;

/// The folder that relative paths of a scene start from. Where a scene lies is no part of what it is: all folders are equal.
#[derive(Clone, Debug, Default)]
pub struct SceneFolder(PathBuf);

impl PartialEq for SceneFolder {
    fn eq(&self, _other: &Self) -> bool {
        true
    }
}

impl Deref for SceneFolder {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.0
    }
}

impl From<PathBuf> for SceneFolder {
    fn from(folder: PathBuf) -> Self {
        Self(folder)
    }
}

impl Scene {
    /// Where the file of the clouds is; relative paths start from [`Scene::folder`].
    #[must_use]
    pub fn cloud_file(&self) -> PathBuf {
        self.folder.join(&self.clouds.file)
    }

    /// Where the height map under the desert's sand is; `None` without one.
    #[must_use]
    pub fn terrain_file(&self) -> Option<PathBuf> {
        (!self.desert.terrain.is_empty()).then(|| self.folder.join(&self.desert.terrain))
    }

    /// Where the table of the desert's winds is; `None` without one.
    #[must_use]
    pub fn wind_table_file(&self) -> Option<PathBuf> {
        (!self.desert.wind_table.is_empty()).then(|| self.folder.join(&self.desert.wind_table))
    }

    /// Makes another folder the one that relative paths start from: they become relative to it where the files lie within,
    /// and absolute where not.
    pub fn move_to(&mut self, folder: &Path) {
        if is_same(&self.folder, folder) {
            return;
        }
        for name in [&mut self.clouds.file, &mut self.desert.terrain, &mut self.desert.wind_table] {
            if !name.is_empty() && Path::new(name).is_relative() {
                let whole = absolute(&self.folder.join(&*name));
                let within = whole.strip_prefix(absolute(folder)).map(Path::to_owned);
                *name = within.unwrap_or(whole).display().to_string();
            }
        }
        self.folder = folder.to_owned().into();
    }
}

fn is_same(a: &Path, b: &Path) -> bool {
    absolute(a) == absolute(b)
}

/// The path from the root; as it is where the program's own folder is unknown. The empty path is that folder.
fn absolute(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    std::path::absolute(path).unwrap_or_else(|_unknown| path.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SceneFile;

    #[test]
    fn a_scene_saved_elsewhere_names_the_same_files() {
        let folder = tempfile::tempdir().unwrap();
        let [here, inside] = ["here", "here/inside"].map(|name| folder.path().join(name));
        std::fs::create_dir_all(&inside).unwrap();
        let path = here.join("scene.toml");
        std::fs::write(
            &path,
            "format = 1\n[clouds]\nfile = \"inside/cloud.npz\" # mine\n[desert]\nterrain = \"rock.r16\"\n",
        )
        .unwrap();
        let file = SceneFile::load(&path).unwrap();
        assert_eq!(file.scene.cloud_file(), inside.join("cloud.npz"), "relative to the scene's file");
        file.save(&path).unwrap();
        assert!(std::fs::read_to_string(&path).unwrap().contains("\"inside/cloud.npz\" # mine"), "as it was");
        for other in [inside.join("b.toml"), folder.path().join("c.toml")] {
            file.save(&other).unwrap();
            let moved = SceneFile::load(&other).unwrap().scene;
            assert_eq!(moved.cloud_file(), inside.join("cloud.npz"), "{}", other.display());
            assert_eq!(moved.terrain_file(), Some(here.join("rock.r16")), "{}", other.display());
        }
        let text = std::fs::read_to_string(inside.join("b.toml")).unwrap();
        assert!(text.contains("file = \"cloud.npz\" # mine"), "within the new folder a path is short: {text}");
    }

    #[test]
    fn texts_are_read_written_set_and_hashed() {
        let mut file = SceneFile::parse("a.toml", "format = 1\n[clouds]\narray = \"q\"\n").unwrap();
        assert_eq!(file.scene.clouds.array, "q", "read");
        let before = file.scene.hash();
        file.scene.set_text("clouds.array", "density").unwrap();
        assert_ne!(file.scene.hash(), before, "another array, another picture");
        assert_eq!(file.to_text(), "format = 1\n[clouds]\narray = \"density\"\n");
        assert_eq!(file.scene.differences(&Scene::default()), ["clouds.array=density"], "for the command line");
        let refused = |result: Result<(), crate::SceneError>| result.unwrap_err().to_string();
        assert_eq!(refused(file.scene.set("clouds.array", 1.0)), "`clouds.array` is a text, not a number");
        assert!(refused(file.scene.set_text("clouds.arrays", "x")).contains("did you mean `clouds.array`"), "nearest");
        let wrong = SceneFile::parse("a.toml", "format = 1\n[clouds]\nfile = 3\n").unwrap_err().to_string();
        assert!(wrong.starts_with("a.toml:3:8: ") && wrong.contains("a line of text"), "{wrong}");
    }
}
