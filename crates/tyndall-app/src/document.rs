//! The scene being edited: its file, what of it is saved, and the way back.

use std::path::{Path, PathBuf};

use egui::util::undoer::{Settings, Undoer};
use tyndall_core::ParamSet;
use tyndall_scene::{Preset, Scene, SceneError, SceneFile};

/// Seconds without a change after which an undo point is set.
const UNDO_REST_S: f32 = 0.5;

/// Name of a scene that has neither a file nor a title.
const UNTITLED: &str = "Untitled";

/// A scene file with undo history. Every document has a history of its own.
#[derive(Debug)]
pub(crate) struct Document {
    file: SceneFile,
    path: Option<PathBuf>,
    /// The scene as the file on disk has it.
    saved: Scene,
    undo: Undoer<Scene>,
}

impl Document {
    /// A new scene with all defaults.
    pub(crate) fn new() -> Self {
        Self::with(SceneFile::new(Scene::default()), None)
    }

    /// Reads a scene file.
    pub(crate) fn open(path: &Path) -> Result<Self, SceneError> {
        Ok(Self::with(SceneFile::load(path)?, Some(path.to_owned())))
    }

    /// A copy of a preset, to be saved under a name of its own.
    pub(crate) fn from_preset(preset: &Preset) -> Result<Self, SceneError> {
        Ok(Self::with(preset.load()?, None))
    }

    /// What an earlier session left unsaved; `path` is the file that it was editing.
    pub(crate) fn recovered(text: &str, path: Option<PathBuf>) -> Result<Self, SceneError> {
        let file = SceneFile::parse("recovered scene", text)?;
        let saved = path.as_ref().and_then(|path| SceneFile::load(path).ok()).map_or_else(Scene::default, |f| f.scene);
        Ok(Self { saved, ..Self::with(file, path) })
    }

    fn with(file: SceneFile, path: Option<PathBuf>) -> Self {
        // What plays for long is undone in one step.
        let settings = Settings { stable_time: UNDO_REST_S, auto_save_interval: f32::INFINITY, ..Settings::default() };
        let mut undo = Undoer::with_settings(settings);
        undo.add_undo(&file.scene);
        Self { saved: file.scene.clone(), file, path, undo }
    }

    /// The scene.
    pub(crate) fn scene(&self) -> &Scene {
        &self.file.scene
    }

    /// The scene, to change it.
    pub(crate) fn scene_mut(&mut self) -> &mut Scene {
        &mut self.file.scene
    }

    /// The scene as the file has it: what a command line starts from.
    pub(crate) fn saved_scene(&self) -> &Scene {
        &self.saved
    }

    /// The file, when there is one.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Text of the file as saving would write it.
    pub(crate) fn to_text(&self) -> String {
        self.file.to_text()
    }

    /// Whether closing would lose something.
    pub(crate) fn is_dirty(&self) -> bool {
        self.file.scene != self.saved
    }

    /// Name for people: that of the file, or else the title.
    pub(crate) fn name(&self) -> String {
        let of_file =
            self.path.as_ref().and_then(|path| path.file_name()).map(|name| name.to_string_lossy().into_owned());
        let title = Some(self.scene().title.clone()).filter(|title| !title.is_empty());
        of_file.or(title).unwrap_or_else(|| UNTITLED.to_owned())
    }

    /// Name for a new file beside nothing: letters of the title that every file system takes.
    pub(crate) fn file_stem(&self) -> String {
        if let Some(stem) = self.path.as_ref().and_then(|path| path.file_stem()) {
            return stem.to_string_lossy().into_owned();
        }
        let stem: String =
            self.name().to_lowercase().chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
        stem.trim_matches('-').to_owned()
    }

    /// Writes the file; the user's comments are kept.
    pub(crate) fn save_as(&mut self, path: &Path) -> Result<(), SceneError> {
        self.file.save(path)?;
        self.path = Some(path.to_owned());
        self.saved = self.file.scene.clone();
        Ok(())
    }

    /// Gives every parameter its default; title and description stay.
    pub(crate) fn reset(&mut self) {
        for (_, set) in self.scene_mut().groups_mut() {
            reset_set(set);
        }
    }

    /// To be called once a frame: sets an undo point when the scene has come to rest. Whether that is still to come.
    pub(crate) fn watch(&mut self, time_s: f64) -> bool {
        self.undo.feed_state(time_s, &self.file.scene);
        self.undo.is_in_flux()
    }

    /// Whether there is something to undo.
    pub(crate) fn has_undo(&self) -> bool {
        self.undo.has_undo(self.scene())
    }

    /// Whether there is something to redo.
    pub(crate) fn has_redo(&self) -> bool {
        self.undo.has_redo(self.scene())
    }

    /// Back to the scene before the last change.
    pub(crate) fn undo(&mut self) {
        if let Some(scene) = self.undo.undo(&self.file.scene).cloned() {
            self.file.scene = scene;
        }
    }

    /// Takes the last undo back.
    pub(crate) fn redo(&mut self) {
        if let Some(scene) = self.undo.redo(&self.file.scene).cloned() {
            self.file.scene = scene;
        }
    }
}

/// Gives all parameters of a group their defaults.
pub(crate) fn reset_group(scene: &mut Scene, group: &str) {
    for (name, set) in scene.groups_mut() {
        if name == group {
            reset_set(set);
        }
    }
}

fn reset_set(set: &mut dyn ParamSet) {
    set.info().iter().enumerate().for_each(|(index, info)| set.set_unchecked(index, info.default));
    set.text_info().iter().enumerate().for_each(|(index, info)| set.put_text_unchecked(index, info.default));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Changes the scene and lets it come to rest.
    fn change(document: &mut Document, time_s: &mut f64, elevation_deg: f64) {
        document.scene_mut().sun.elevation_deg = elevation_deg;
        for _frame in 0..2 {
            document.watch(*time_s);
            *time_s += 1.0;
        }
    }

    #[test]
    fn undo_and_redo_walk_along_the_same_scenes() {
        let (mut document, mut time_s) = (Document::new(), 0.0);
        let start = document.scene().clone();
        change(&mut document, &mut time_s, 10.0);
        change(&mut document, &mut time_s, 20.0);
        document.undo();
        assert!((document.scene().sun.elevation_deg - 10.0).abs() < 1e-12, "{:?}", document.scene().sun);
        document.undo();
        assert_eq!(document.scene(), &start, "the first scene again");
        assert!(!document.has_undo() && document.has_redo(), "at the beginning of the history");
        document.redo();
        document.redo();
        assert!((document.scene().sun.elevation_deg - 20.0).abs() < 1e-12, "{:?}", document.scene().sun);
    }

    #[test]
    fn a_change_that_has_not_come_to_rest_is_undone_too() {
        let mut document = Document::new();
        document.scene_mut().sun.elevation_deg = 10.0;
        assert!(document.watch(0.0), "an undo point is to come");
        document.undo();
        assert_eq!(document.scene(), &Scene::default(), "as before the change");
    }

    #[test]
    fn a_document_is_dirty_until_it_is_saved_or_changed_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("evening.toml");
        let mut document = Document::new();
        assert!(!document.is_dirty(), "nothing to lose yet");
        document.scene_mut().sun.elevation_deg = 2.0;
        assert!(document.is_dirty(), "a change");
        document.save_as(&path).unwrap();
        assert!(!document.is_dirty(), "saved");
        assert_eq!((document.name(), document.file_stem()), ("evening.toml".to_owned(), "evening".to_owned()), "names");
        document.scene_mut().sun.elevation_deg = 3.0;
        assert!(document.is_dirty(), "changed after saving");
        document.scene_mut().sun.elevation_deg = 2.0;
        assert!(!document.is_dirty(), "changed back");
    }

    #[test]
    fn saving_keeps_the_comments_of_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "format = 1\n# mine\n[sun]\nelevation_deg = 4 # low\n").unwrap();
        let mut document = Document::open(&path).unwrap();
        document.scene_mut().sun.elevation_deg = 5.5;
        document.save_as(&path).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text, "format = 1\n# mine\n[sun]\nelevation_deg = 5.5 # low\n", "{text}");
    }

    #[test]
    fn resetting_leaves_title_and_description() {
        let mut document = Document::from_preset(&tyndall_scene::presets()[2]).unwrap();
        let title = document.scene().title.clone();
        document.reset();
        let expected = Scene { title, description: document.scene().description.clone(), ..Scene::default() };
        assert_eq!(document.scene(), &expected, "all parameters at their defaults");
        assert!(document.is_dirty(), "differs from the preset");
    }

    #[test]
    fn a_group_is_reset_without_the_others() {
        let mut scene = Scene::default();
        scene.sun.elevation_deg = 1.0;
        scene.ground.red = 1.0;
        reset_group(&mut scene, "sun");
        assert_eq!(scene.sun, Scene::default().sun, "reset");
        assert!((scene.ground.red - 1.0).abs() < 1e-12, "left alone");
    }

    #[test]
    fn a_recovered_document_is_dirty_against_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        let mut document = Document::new();
        document.save_as(&path).unwrap();
        document.scene_mut().sun.elevation_deg = 7.0;
        let recovered = Document::recovered(&document.to_text(), Some(path.clone())).unwrap();
        assert_eq!(recovered.scene(), document.scene(), "the unsaved scene");
        assert!(recovered.is_dirty(), "not yet in the file");
        assert_eq!(recovered.path(), Some(path.as_path()), "to be saved where it came from");
    }
}
