//! The scenes that come with Tyndall.

use crate::{SceneError, SceneFile};

/// A scene that comes with Tyndall.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Preset {
    /// Name on the command line and of the file in `assets/scenes`.
    pub name: &'static str,
    /// Title for people.
    pub title: String,
    /// Text of the scene file.
    pub text: &'static str,
}

impl Preset {
    /// The scene, with a file that keeps the preset's comments when it is saved.
    ///
    /// # Errors
    /// When the text is no scene; a test loads every preset.
    pub fn load(&self) -> Result<SceneFile, SceneError> {
        SceneFile::parse(&format!("{}.toml", self.name), self.text)
    }
}

/// All presets, in the order in which a gallery shows them.
#[must_use]
pub fn presets() -> Vec<Preset> {
    let presets = tyndall_assets::SCENES.iter().map(|&(name, text)| {
        let mut preset = Preset { name, title: String::new(), text };
        preset.title = preset.load().map_or_else(|_no_scene| name.to_owned(), |file| file.scene.title);
        preset
    });
    presets.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_loads_has_a_title_and_a_description_and_writes_itself_back() {
        for preset in presets() {
            let file = preset.load().unwrap_or_else(|error| panic!("{}", error.report()));
            assert_eq!(file.to_text(), preset.text, "{}", preset.name);
            assert!(!file.scene.description.is_empty(), "{} has no description", preset.name);
            assert_ne!(preset.title, preset.name, "{} has no title", preset.name);
        }
    }

    #[test]
    fn the_presets_sun_stands_where_their_names_say() {
        let expected = [
            ("noon", 60.0),
            ("low-sun", 8.0),
            ("sunset", 1.0),
            ("twilight", -3.0),
            ("high-altitude", 35.0),
            ("red-sunset", -0.25),
            ("civil-twilight", -5.0),
            ("nautical-twilight", -9.5),
        ];
        for (name, elevation_deg) in expected {
            let preset = presets().into_iter().find(|preset| preset.name == name).expect("a preset of that name");
            let found = preset.load().unwrap().scene.sun.elevation_deg;
            assert!((found - elevation_deg).abs() < 1e-9, "{name}: {found} deg");
        }
    }

    #[test]
    fn no_two_presets_are_the_same_picture() {
        let hashes: std::collections::HashSet<_> =
            presets().iter().map(|preset| preset.load().unwrap().scene.hash()).collect();
        assert_eq!(hashes.len(), presets().len(), "{hashes:?}");
    }
}
