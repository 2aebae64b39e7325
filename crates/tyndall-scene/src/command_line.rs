//! A scene as arguments of the command line.

use std::path::Path;

use crate::Scene;

impl Scene {
    /// The parameters that differ from `base`, each as `group.key=value`, which `--set` and [`Scene::set_text`] take.
    #[must_use]
    pub fn differences(&self, base: &Self) -> Vec<String> {
        let groups = self.groups().into_iter().zip(base.groups());
        let pairs = groups.flat_map(|((group, mine), (_, theirs))| {
            let infos = mine.info().iter().enumerate();
            let changed = infos.filter(move |(index, _)| mine.get(*index).total_cmp(&theirs.get(*index)).is_ne());
            let numbers =
                changed.map(move |(index, info)| format!("{group}.{}={}", info.name, info.format(mine.get(index))));
            let texts = mine.text_info().iter().enumerate();
            let changed = texts.filter(move |(index, _)| mine.text(*index) != theirs.text(*index));
            numbers.chain(changed.map(move |(index, info)| format!("{group}.{}={}", info.name, mine.text(index))))
        });
        pairs.collect()
    }

    /// Program and arguments that render this scene from the file at `path`, which holds `base`: the differences as
    /// `--set` options. The caller adds the output and quotes for its shell.
    #[must_use]
    pub fn to_command_line(&self, base: &Self, path: &Path) -> Vec<String> {
        let start = ["tyndall".to_owned(), "render".to_owned(), path.display().to_string()];
        let options = self.differences(base).into_iter().flat_map(|pair| ["--set".to_owned(), pair]);
        start.into_iter().chain(options).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ToneMap;

    #[test]
    fn the_command_line_names_what_changed_and_nothing_else() {
        let base = Scene::default();
        let mut scene = Scene { title: "Not a parameter".to_owned(), ..base.clone() };
        scene.sun.elevation_deg = -4.25;
        scene.sun.disc = false;
        scene.film.tone_map = ToneMap::Aces;
        scene.image.width_px = 640;
        let line = scene.to_command_line(&base, Path::new("a b.toml")).join("|");
        let sets =
            "|--set|sun.elevation_deg=-4.25|--set|sun.disc=false|--set|film.tone_map=aces|--set|image.width_px=640";
        assert_eq!(line, format!("tyndall|render|a b.toml{sets}"), "{line}");
    }

    #[test]
    fn setting_the_differences_makes_the_scenes_equal() {
        let presets: Vec<_> = crate::presets().iter().map(|preset| preset.load().unwrap().scene).collect();
        for (from, to) in presets.iter().zip(presets.iter().skip(1)) {
            let mut scene = Scene { title: to.title.clone(), description: to.description.clone(), ..from.clone() };
            for pair in to.differences(from) {
                let (path, value) = pair.split_once('=').unwrap();
                scene.set_text(path, value).unwrap();
            }
            assert_eq!(&scene, to, "from {} to {}", from.title, to.title);
        }
    }
}
