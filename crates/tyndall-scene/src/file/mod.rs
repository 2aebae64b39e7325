//! Scene files: TOML in, TOML out, with the user's comments, order and formatting kept.

mod read;
mod syntax;
mod write;

use std::{
    fs::{self, File},
    io::{self, Read as _, Write as _},
    path::{Path, PathBuf},
};

use atomic_write_file::AtomicWriteFile;
use toml_edit::{Document, DocumentMut};

use crate::{Place, Scene, SceneError};

/// Format of the scene files that this version writes, and the only one there has been.
pub const FORMAT: i64 = 1;

/// Size above which a file is refused unread. Scenes have a few kilobytes; the worst file of this size takes 0.2 s to refuse.
pub const MAX_BYTES: usize = 1 << 20;

/// A scene with the file it came from. Change [`SceneFile::scene`] at will; saving writes what differs.
///
/// ```
/// use tyndall_scene::SceneFile;
///
/// let mut file = SceneFile::parse("evening.toml", "format = 1\n[sun]\nelevation_deg = 4 # soon gone\n")?;
/// file.scene.set("sun.elevation_deg", 3.5)?;
/// assert_eq!(file.to_text(), "format = 1\n[sun]\nelevation_deg = 3.5 # soon gone\n");
///
/// let error = SceneFile::parse("evening.toml", "format = 1\n[sun]\nelevation = 4\n").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "evening.toml:3:1: unknown parameter `sun.elevation`; did you mean `sun.elevation_deg`?"
/// );
/// # Ok::<(), tyndall_scene::SceneError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// The file as it was read.
    document: DocumentMut,
    /// Windows line ends throughout, and the byte order mark: what the document forgets.
    crlf: bool,
    byte_order_mark: bool,
}

impl SceneFile {
    /// A file that does not exist yet.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        let mut document = DocumentMut::new();
        document.insert(read::FORMAT_KEY, toml_edit::value(FORMAT));
        Self { scene, document, crlf: false, byte_order_mark: false }
    }

    /// Reads and checks a scene file.
    ///
    /// # Errors
    /// When the file cannot be read, or for the first thing that is wrong in it, with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        let path = path.as_ref();
        let bytes = read_bytes(path)?;
        let name = path.display().to_string();
        match String::from_utf8(bytes) {
            Ok(text) => {
                let mut file = Self::parse(&name, &text)?;
                file.scene.folder = folder_of(path).into();
                Ok(file)
            }
            Err(error) => {
                let start = error.utf8_error().valid_up_to();
                let text = String::from_utf8_lossy(error.as_bytes());
                Err(SceneError::NotText.at(Place::new(&name, &text, start..start)))
            }
        }
    }

    /// Reads and checks the text of a scene file; `name` stands for the file in messages.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place.
    pub fn parse(name: &str, text: &str) -> Result<Self, SceneError> {
        if text.len() > MAX_BYTES {
            return Err(SceneError::TooLarge { path: name.into() });
        }
        let (byte_order_mark, text) = text.strip_prefix('\u{feff}').map_or((false, text), |rest| (true, rest));
        let document = Document::parse(text).map_err(|error| syntax::error(name, text, &error))?;
        let scene = read::scene(&document).map_err(|(problem, span)| problem.at(Place::new(name, text, span)))?;
        Ok(Self { scene, document: document.into_mut(), crlf: has_only_crlf(text), byte_order_mark })
    }

    /// The text of the file with the scene as it is now. Parameters that the file does not mention and that have their
    /// default stay unmentioned; everything unchanged stays as the user wrote it.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut document = self.document.clone();
        write::update(&mut document, &self.scene);
        let mut text = document.to_string();
        if self.crlf {
            text = text.replace("\r\n", "\n").replace('\n', "\r\n");
        }
        if self.byte_order_mark { format!("\u{feff}{text}") } else { text }
    }

    /// Writes the file: all of it or, when anything fails, nothing. A link is followed to the file that it names. In another
    /// folder than the scene's, relative paths in the scene are written such that they still name the same files.
    ///
    /// # Errors
    /// When a value of the scene is not allowed, as the file could not be read again, or the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), SceneError> {
        self.scene.check()?;
        let path = path.as_ref();
        let mut moved = self.clone();
        moved.scene.move_to(&folder_of(path));
        write_bytes(path, moved.to_text().as_bytes())
            .map_err(|source| SceneError::Write { path: path.to_owned(), source })
    }
}

/// Folder of a file; empty for one where the program runs.
fn folder_of(path: &Path) -> PathBuf {
    path.parent().map(Path::to_owned).unwrap_or_default()
}

fn has_only_crlf(text: &str) -> bool {
    text.contains('\n') && text.matches('\n').count() == text.matches("\r\n").count()
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, SceneError> {
    let failed = |source| SceneError::Read { path: path.to_owned(), source };
    if path.is_dir() {
        return Err(SceneError::Folder { path: path.to_owned() });
    }
    let mut bytes = Vec::new();
    let one_too_many = MAX_BYTES as u64 + 1;
    File::open(path).map_err(failed)?.take(one_too_many).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() > MAX_BYTES {
        return Err(SceneError::TooLarge { path: path.to_owned() });
    }
    Ok(bytes)
}

fn write_bytes(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = fs::canonicalize(path).unwrap_or_else(|_new_file| path.to_owned());
    let mut file = AtomicWriteFile::open(target)?;
    file.write_all(bytes)?;
    file.commit()
}
