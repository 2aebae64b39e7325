//! What can be exported and how, as arguments of the command line program.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::document::Document;

/// What is made of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum ExportKind {
    #[default]
    Picture,
    Hdri,
    Cubemap,
}

impl ExportKind {
    /// All, in the order of the panel.
    pub(crate) const ALL: [Self; 3] = [Self::Picture, Self::Hdri, Self::Cubemap];

    /// Name of the choice, and what it is for.
    pub(crate) fn label(self) -> (&'static str, &'static str) {
        match self {
            Self::Picture => ("Picture", "What the camera sees, as PNG, JPEG or EXR."),
            Self::Hdri => ("HDRI", "The light from all around, for Blender and other renderers."),
            Self::Cubemap => ("Cube map", "What is all around as the six faces of a cube, for games."),
        }
    }

    /// Subcommand of the program.
    pub(crate) fn verb(self) -> &'static str {
        match self {
            Self::Picture => "render",
            Self::Hdri => "hdri",
            Self::Cubemap => "cubemap",
        }
    }
}

/// What the user has chosen for exports besides the picture's size.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct ExportOptions {
    /// What is made.
    pub(crate) kind: ExportKind,
    /// Where the picture goes; the ending decides about the format.
    pub(crate) path: String,
    /// Precision of EXR files: 32 bits in place of 16.
    pub(crate) float: bool,
    /// Precision of PNG files: 16 bits in place of 8.
    pub(crate) deep: bool,
    /// The panorama.
    pub(crate) hdri: HdriOptions,
    /// The cube.
    pub(crate) cubemap: CubemapOptions,
}

/// Choices of `tyndall hdri`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct HdriOptions {
    pub(crate) path: String,
    pub(crate) width_px: u32,
    /// Positions in [`UNITS`], [`SUNS`] and [`PRIMARIES`].
    pub(crate) unit: usize,
    pub(crate) sun: usize,
    pub(crate) primaries: usize,
    pub(crate) black_ground: bool,
    pub(crate) half: bool,
}

impl Default for HdriOptions {
    fn default() -> Self {
        let (path, black_ground, half) = (String::new(), false, false);
        Self { path, width_px: 2048, unit: 0, sun: 0, primaries: 0, black_ground, half }
    }
}

/// Choices of `tyndall cubemap`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct CubemapOptions {
    pub(crate) path: String,
    pub(crate) size_px: u32,
    /// Positions in [`LAYOUTS`] and [`SUNS`].
    pub(crate) layout: usize,
    pub(crate) sun: usize,
    pub(crate) black_ground: bool,
}

impl Default for CubemapOptions {
    fn default() -> Self {
        Self { path: String::new(), size_px: 512, layout: 0, sun: 0, black_ground: false }
    }
}

/// A choice: its name on the command line, its name for people and what it means.
pub(crate) type Choice = (&'static str, &'static str, &'static str);

/// Units of the numbers in a panorama.
pub(crate) const UNITS: [Choice; 3] = [
    ("blender", "Blender's", "Luminance over 683, as Blender's own sky textures count."),
    ("cd/m2", "cd/m²", "Luminance as it is."),
    ("exposed", "Exposed", "1 is white at the exposure of the scene's picture."),
];

/// What becomes of the sun's disc.
pub(crate) const SUNS: [Choice; 3] = [
    ("disc", "Drawn", "With all of its light."),
    ("none", "Left out", "Only the sky."),
    ("lamp", "For a lamp", "Left out; direction, strength and colour of a lamp in its place stand in the sidecar."),
];

/// Primaries of the colours.
pub(crate) const PRIMARIES: [Choice; 2] =
    [("rec709", "Rec.709", "Blender's default, with white D65."), ("acescg", "ACEScg", "For productions in ACES.")];

/// How the faces of a cube lie.
pub(crate) const LAYOUTS: [Choice; 4] = [
    ("faces", "Six files", "posx, negx, posy, negy, posz, negz."),
    ("strip", "Strip", "One row in the order of a cube texture."),
    ("cross-horizontal", "Cross, lying", "Four columns, three rows."),
    ("cross-vertical", "Cross, standing", "Three columns, four rows."),
];

/// Sides that are offered (px).
pub(crate) const HDRI_WIDTHS_PX: [u32; 5] = [1024, 2048, 4096, 8192, 16_384];
pub(crate) const CUBE_SIZES_PX: [u32; 5] = [256, 512, 1024, 2048, 4096];

impl ExportOptions {
    /// What was typed as the place of the output.
    pub(crate) fn path(&self) -> &str {
        match self.kind {
            ExportKind::Picture => &self.path,
            ExportKind::Hdri => &self.hdri.path,
            ExportKind::Cubemap => &self.cubemap.path,
        }
    }

    /// [`ExportOptions::path`], to change it.
    pub(crate) fn path_mut(&mut self) -> &mut String {
        match self.kind {
            ExportKind::Picture => &mut self.path,
            ExportKind::Hdri => &mut self.hdri.path,
            ExportKind::Cubemap => &mut self.cubemap.path,
        }
    }

    /// The file or folder: as typed, or else named after the scene.
    pub(crate) fn output(&self, document: &Document) -> PathBuf {
        let stem = document.file_stem();
        match (self.path().trim(), self.kind) {
            ("", ExportKind::Picture) => PathBuf::from(format!("{stem}.png")),
            ("", ExportKind::Hdri) => PathBuf::from(format!("{stem}-sky.exr")),
            ("", ExportKind::Cubemap) => PathBuf::from(format!("{stem}-cube.exr")),
            (path, _) => PathBuf::from(path),
        }
    }

    /// Why the output's name will be refused; `None` when it will do.
    pub(crate) fn complaint(&self, output: &Path) -> Option<&'static str> {
        let known: &[&str] = match self.kind {
            ExportKind::Picture => &["png", "exr", "jpg", "jpeg"],
            ExportKind::Hdri => &["exr", "hdr"],
            // Nothing behind the last dot is a folder.
            ExportKind::Cubemap => &["exr", "png", "jpg", "jpeg", ""],
        };
        let complaint = match self.kind {
            ExportKind::Picture => "The ending must be .png, .exr or .jpg.",
            ExportKind::Hdri => "The ending must be .exr or .hdr.",
            ExportKind::Cubemap => "The ending must be .exr, .png or .jpg, or none for a folder.",
        };
        (!known.contains(&extension(output).as_str())).then_some(complaint)
    }

    /// Options of the subcommand that follow from the choices; defaults are left out.
    pub(crate) fn arguments(&self, output: &Path) -> Vec<String> {
        let ending = extension(output);
        match self.kind {
            ExportKind::Picture => match ending.as_str() {
                "exr" if self.float => vec!["--float".to_owned()],
                "png" if self.deep => vec!["--bits".to_owned(), "16".to_owned()],
                _ => vec![],
            },
            ExportKind::Hdri => self.hdri.arguments(&ending),
            ExportKind::Cubemap => self.cubemap.arguments(),
        }
    }
}

impl HdriOptions {
    fn arguments(&self, ending: &str) -> Vec<String> {
        let default = Self::default();
        let mut arguments = Vec::new();
        let mut add = |name: &str, value: &str| arguments.extend([name.to_owned(), value.to_owned()]);
        if self.width_px != default.width_px {
            add("--width", &self.width_px.to_string());
        }
        chosen(&UNITS, self.unit, |value| add("--units", value));
        chosen(&SUNS, self.sun, |value| add("--sun", value));
        chosen(&PRIMARIES, self.primaries, |value| add("--primaries", value));
        if self.black_ground {
            add("--ground", "black");
        }
        if self.half && ending == "exr" {
            arguments.push("--half".to_owned());
        }
        arguments
    }
}

impl CubemapOptions {
    fn arguments(&self) -> Vec<String> {
        let mut arguments = Vec::new();
        let mut add = |name: &str, value: &str| arguments.extend([name.to_owned(), value.to_owned()]);
        if self.size_px != Self::default().size_px {
            add("--size", &self.size_px.to_string());
        }
        chosen(&LAYOUTS, self.layout, |value| add("--layout", value));
        chosen(&SUNS, self.sun, |value| add("--sun", value));
        if self.black_ground {
            add("--ground", "black");
        }
        arguments
    }
}

/// Calls `add` with the name of a choice, unless it is the first one, which is the default.
fn chosen(choices: &[Choice], index: usize, add: impl FnOnce(&str)) {
    if let Some((name, ..)) = choices.get(index).filter(|_| index > 0) {
        add(name);
    }
}

/// Ending of a file's name in lower case.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(kind: ExportKind) -> ExportOptions {
        ExportOptions { kind, ..ExportOptions::default() }
    }

    #[test]
    fn the_file_is_named_after_the_scene_until_the_user_names_it() {
        let document = Document::from_preset(&tyndall_scene::presets()[1]).unwrap();
        for (kind, name) in [
            (ExportKind::Picture, "low-sun.png"),
            (ExportKind::Hdri, "low-sun-sky.exr"),
            (ExportKind::Cubemap, "low-sun-cube.exr"),
        ] {
            let mut options = of(kind);
            assert_eq!(options.output(&document), PathBuf::from(name), "from the title");
            *options.path_mut() = " elsewhere/a.exr ".to_owned();
            assert_eq!(options.output(&document), PathBuf::from("elsewhere/a.exr"), "as typed");
        }
    }

    #[test]
    fn options_belong_to_the_format_of_the_file() {
        let options = ExportOptions { float: true, deep: true, ..ExportOptions::default() };
        for (file, expected) in [("a.png", "--bits 16"), ("a.EXR", "--float"), ("a.jpg", "")] {
            assert_eq!(options.arguments(Path::new(file)).join(" "), expected, "{file}");
        }
        let mut options = of(ExportKind::Hdri);
        options.hdri.half = true;
        for (file, expected) in [("a.exr", "--half"), ("a.hdr", "")] {
            assert_eq!(options.arguments(Path::new(file)).join(" "), expected, "{file}");
        }
    }

    #[test]
    fn defaults_are_left_out_and_choices_are_named() {
        for kind in ExportKind::ALL {
            assert!(of(kind).arguments(Path::new("a.exr")).is_empty(), "{kind:?}");
        }
        let mut options = of(ExportKind::Hdri);
        options.hdri =
            HdriOptions { width_px: 4096, unit: 1, sun: 2, primaries: 1, black_ground: true, ..options.hdri };
        let line = options.arguments(Path::new("a.exr")).join(" ");
        assert_eq!(line, "--width 4096 --units cd/m2 --sun lamp --primaries acescg --ground black", "{line}");
        let mut options = of(ExportKind::Cubemap);
        options.cubemap = CubemapOptions { size_px: 1024, layout: 2, sun: 1, ..options.cubemap };
        let line = options.arguments(Path::new("a.exr")).join(" ");
        assert_eq!(line, "--size 1024 --layout cross-horizontal --sun none", "{line}");
    }

    #[test]
    fn endings_that_will_be_refused_are_told_beforehand() {
        for (kind, file, fits) in [
            (ExportKind::Picture, "a.png", true),
            (ExportKind::Picture, "a.tif", false),
            (ExportKind::Hdri, "a.hdr", true),
            (ExportKind::Hdri, "a.png", false),
            (ExportKind::Cubemap, "folder", true),
            (ExportKind::Cubemap, "a.bmp", false),
        ] {
            assert_eq!(of(kind).complaint(Path::new(file)).is_none(), fits, "{kind:?} to {file}");
        }
    }
}
