//! What survives a crash: each running program keeps its unsaved scene in a file of its own and locks another one while
//! it lives. A recovery file whose lock nobody holds was left by a crash.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, Read as _, Seek as _, Write as _},
    path::{Path, PathBuf},
};

use crate::document::Document;

/// Extension of the locked file; its text is the path of the scene being edited, or nothing.
const LOCK: &str = "lock";
/// Extension of the unsaved scene.
const SCENE: &str = "toml";
/// Numbers tried for the files of this program.
const MAX_SESSIONS: u32 = 1000;

/// The recovery files of this program while it runs.
#[derive(Debug)]
pub(crate) struct Session {
    lock: File,
    lock_path: PathBuf,
    /// Text in the recovery file; empty when there is no such file.
    written: String,
    /// Whether the files outlive the program.
    stays: bool,
}

/// An unsaved scene that a crashed program left.
#[derive(Debug)]
pub(crate) struct Leftover {
    /// The scene as a file's text.
    pub(crate) text: String,
    /// The file that it came from.
    pub(crate) path: Option<PathBuf>,
    scene_path: PathBuf,
    /// Held so that no second program offers the same scene.
    _lock: File,
}

impl Session {
    /// Starts in a folder, which is made when it does not exist, and returns what crashed programs have left there.
    pub(crate) fn start(folder: &Path) -> io::Result<(Self, Vec<Leftover>)> {
        fs::create_dir_all(folder)?;
        let leftovers = leftovers(folder)?;
        for number in 0..MAX_SESSIONS {
            let lock_path = folder.join(format!("session-{number}.{LOCK}"));
            let lock = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&lock_path)?;
            if lock.try_lock().is_ok() && !lock_path.with_extension(SCENE).exists() {
                return Ok((Self { lock, lock_path, written: String::new(), stays: false }, leftovers));
            }
        }
        Err(io::Error::new(io::ErrorKind::AlreadyExists, "too many programs are running"))
    }

    /// The recovery file.
    pub(crate) fn scene_path(&self) -> PathBuf {
        self.lock_path.with_extension(SCENE)
    }

    /// Lets the files stay when the program ends.
    pub(crate) fn leave(&mut self) {
        self.stays = true;
    }

    /// Keeps what is unsaved, or removes the recovery file when nothing is.
    pub(crate) fn keep(&mut self, document: &Document) -> io::Result<()> {
        let text = if document.is_dirty() { document.to_text() } else { String::new() };
        if text == self.written {
            return Ok(());
        }
        if text.is_empty() {
            fs::remove_file(self.scene_path())?;
        } else {
            self.lock.set_len(0)?;
            self.lock.rewind()?;
            let path = document.path().map(|path| std::path::absolute(path).unwrap_or_else(|_gone| path.to_owned()));
            self.lock.write_all(path.unwrap_or_default().to_string_lossy().as_bytes())?;
            let scene_path = self.scene_path();
            tyndall_io::atomic::write_atomically(&scene_path, |file| file.write_all(text.as_bytes()))
                .map_err(io::Error::other)?;
        }
        self.written = text;
        Ok(())
    }
}

impl Drop for Session {
    /// A regular end leaves nothing behind; a user who wanted the changes has saved them.
    fn drop(&mut self) {
        if self.stays || std::thread::panicking() {
            return;
        }
        for path in [self.scene_path(), self.lock_path.clone()] {
            // Nobody is left to be told.
            let _removed = fs::remove_file(path);
        }
    }
}

impl Leftover {
    /// Removes it: the user has it in a window now, or does not want it.
    pub(crate) fn remove(self) {
        for path in [self.scene_path.with_extension(LOCK), self.scene_path] {
            if let Err(error) = fs::remove_file(&path) {
                tracing::warn!(path = %path.display(), %error, "a recovery file cannot be removed");
            }
        }
    }
}

fn leftovers(folder: &Path) -> io::Result<Vec<Leftover>> {
    let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    paths.retain(|path| path.extension().is_some_and(|extension| extension == SCENE));
    paths.sort();
    Ok(paths.into_iter().filter_map(leftover).collect())
}

/// The scene at a path, unless a running program owns it or it cannot be read.
fn leftover(scene_path: PathBuf) -> Option<Leftover> {
    let mut lock = OpenOptions::new().read(true).write(true).open(scene_path.with_extension(LOCK)).ok()?;
    lock.try_lock().ok()?;
    let mut path = String::new();
    lock.read_to_string(&mut path).ok()?;
    let text = fs::read_to_string(&scene_path).ok()?;
    let path = Some(PathBuf::from(path)).filter(|path| !path.as_os_str().is_empty());
    Some(Leftover { text, path, scene_path, _lock: lock })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed() -> Document {
        let mut document = Document::new();
        document.scene_mut().sun.elevation_deg = 3.25;
        document
    }

    /// Ends a session as a crash does: the lock is released and the files stay.
    fn crash(session: Session) {
        let files = [session.scene_path(), session.lock_path.clone()].map(|path| (fs::read(&path).unwrap(), path));
        drop(session);
        for (bytes, path) in files {
            fs::write(path, bytes).unwrap();
        }
    }

    #[test]
    fn a_crash_leaves_the_scene_and_where_it_came_from() {
        let folder = tempfile::tempdir().unwrap();
        let scene_file = folder.path().join("mine.toml");
        let (mut session, leftovers) = Session::start(&folder.path().join("data")).unwrap();
        assert!(leftovers.is_empty(), "{leftovers:?}");
        let mut document = changed();
        document.save_as(&scene_file).unwrap();
        document.scene_mut().sun.elevation_deg = 4.5;
        session.keep(&document).unwrap();
        crash(session);

        let (_session, mut leftovers) = Session::start(&folder.path().join("data")).unwrap();
        let leftover = leftovers.pop().unwrap();
        assert_eq!(leftover.path.as_deref(), Some(scene_file.as_path()), "the scene's file");
        assert!(leftover.text.contains("elevation_deg = 4.5"), "{}", leftover.text);
        leftover.remove();
        let (_third, leftovers) = Session::start(&folder.path().join("data")).unwrap();
        assert!(leftovers.is_empty(), "removed: {leftovers:?}");
    }

    #[test]
    fn a_running_program_keeps_its_scene_to_itself() {
        let folder = tempfile::tempdir().unwrap();
        let (mut first, _) = Session::start(folder.path()).unwrap();
        first.keep(&changed()).unwrap();
        let (mut second, leftovers) = Session::start(folder.path()).unwrap();
        assert!(leftovers.is_empty(), "not a leftover: {leftovers:?}");
        second.keep(&changed()).unwrap();
        assert_ne!(first.scene_path(), second.scene_path(), "each has its own file");
    }

    #[test]
    fn a_regular_end_and_a_saved_scene_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let (mut session, _) = Session::start(folder.path()).unwrap();
        session.keep(&changed()).unwrap();
        assert!(session.scene_path().exists(), "kept while unsaved");
        session.keep(&Document::new()).unwrap();
        assert!(!session.scene_path().exists(), "nothing unsaved");
        session.keep(&changed()).unwrap();
        drop(session);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "files after a regular end");
    }
}
