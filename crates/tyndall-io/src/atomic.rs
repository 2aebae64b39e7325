//! A file appears under its name complete or not at all.
//!
//! The bytes go to `.NAME.PID.part` in the same folder, are flushed to the disk, and are then renamed; the rename is
//! flushed too. Two processes that write the same file are harmless: the last one wins. The temporary file is locked
//! while its writer lives, so that the next writer of the same name can tell the leftover of a killed process (removed)
//! from a file in the making (kept), also on another machine that shares the folder and when process numbers are
//! reused.
//!
//! Not done: keeping the permissions of a replaced file.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use crate::{Destination, IoError};

/// Names that are tried for a temporary file; machines that share a folder may have processes of the same number.
const MAX_ATTEMPTS: u32 = 100;

/// Number of the next temporary file of this process. No name is used twice: between finding that the writer of a name
/// is gone and removing the file, another thread could have taken the name again.
static NEXT_SERIAL: AtomicU32 = AtomicU32::new(0);

/// The temporary file: readable, writable, seekable, buffered. Fails every write once the destination is cancelled.
#[derive(Debug)]
pub struct PartFile<'a> {
    file: BufWriter<File>,
    cancel: Option<&'a AtomicBool>,
}

/// Writes a file by `write`, which fills the temporary file; gives back what `write` gave back.
///
/// # Errors
/// [`IoError`] when the folder or the disk refuses, when `write` fails, or when cancelled. Nothing is left then, and a
/// file that stood there before is untouched.
pub fn write_atomically<'a, T>(
    destination: impl Into<Destination<'a>>,
    write: impl FnOnce(&mut PartFile<'a>) -> io::Result<T>,
) -> Result<T, IoError> {
    let destination = destination.into();
    let path = destination.path;
    let target = resolve(path)?;
    remove_leftovers(&target);
    let (file, part) = create_part(&target).map_err(|source| IoError::from_write(path, source))?;
    let mut part_file = PartFile { file: BufWriter::new(file), cancel: destination.cancel };
    let written = write(&mut part_file).and_then(|value| part_file.finish().map(|()| value));
    if destination.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
        return Err(IoError::Cancelled { path: path.to_path_buf() });
    }
    let value = written.map_err(|source| IoError::from_write(path, source))?;
    part.rename_to(&target).map_err(|source| IoError::from_write(path, source))?;
    Ok(value)
}

/// Whether a file could be written at `path`, tried out with an empty temporary file; asked before a long render.
///
/// # Errors
/// The [`IoError`] that [`write_atomically`] would give for the path and its folder.
pub fn check_writable(path: impl AsRef<Path>) -> Result<(), IoError> {
    let path = path.as_ref();
    let target = resolve(path)?;
    create_part(&target).map(|_| ()).map_err(|source| IoError::from_write(path, source))
}

/// The folder that holds `path`.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The file that is really written: symbolic links are followed, so that the rename does not replace the link.
fn resolve(path: &Path) -> Result<PathBuf, IoError> {
    let owned = path.to_path_buf();
    if path.file_name().is_none() {
        return Err(IoError::IsFolder { path: owned });
    }
    let folder = folder_of(path);
    if folder.is_file() {
        return Err(IoError::NotAFolder { folder: folder.to_path_buf(), path: owned });
    }
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(IoError::IsFolder { path: owned }),
        // As root, a rename onto /dev/null would replace the device for the whole machine.
        Ok(found) if !found.is_file() => Err(IoError::NotAFile { path: owned }),
        Ok(_) => path.canonicalize().map_err(|source| IoError::from_write(path, source)),
        Err(_) => Ok(owned),
    }
}

/// A temporary file that removes itself unless it was renamed.
#[derive(Debug)]
struct Part {
    path: PathBuf,
    renamed: bool,
}

impl Part {
    fn rename_to(mut self, target: &Path) -> io::Result<()> {
        fs::rename(&self.path, target)?;
        self.renamed = true;
        sync_folder(folder_of(target));
        Ok(())
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if !self.renamed {
            // Nothing better can be done here; the next writer of this name tries again.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Flushes the rename. A failure is not reported: the file is complete and in place, and several file systems refuse to
/// flush a folder.
fn sync_folder(folder: &Path) {
    if cfg!(unix) {
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
}

/// Creates and locks the temporary file of `target`.
fn create_part(target: &Path) -> io::Result<(File, Part)> {
    let name = target.file_name().unwrap_or_default();
    for _ in 0..MAX_ATTEMPTS {
        let serial = NEXT_SERIAL.fetch_add(1, Ordering::Relaxed);
        let path = folder_of(target).join(part_name(name, serial));
        let file = match OpenOptions::new().read(true).write(true).create_new(true).open(&path) {
            Ok(file) => file,
            Err(error) if error.kind() == ErrorKind::AlreadyExists => continue,
            Err(error) => return Err(error),
        };
        let part = Part { path, renamed: false };
        // Between creation and lock another process may have taken the file for a leftover: it holds the lock, or has
        // removed the file already. Where locks are not supported, leftovers stay.
        let taken = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
        if !taken && part.path.exists() {
            return Ok((file, part));
        }
    }
    Err(io::Error::other(format!("{MAX_ATTEMPTS} temporary files of this name exist already")))
}

/// `.NAME.PID.part`, from the second file of a process on `.NAME.PID-SERIAL.part`.
fn part_name(name: &OsStr, serial: u32) -> OsString {
    let mut part = OsString::from(".");
    part.push(name);
    part.push(format!(".{}", process::id()));
    if serial > 0 {
        part.push(format!("-{serial}"));
    }
    part.push(".part");
    part
}

/// Removes temporary files of `target` whose writer is dead. Failures do not matter: they concern litter only.
fn remove_leftovers(target: &Path) {
    let Some(name) = target.file_name().and_then(OsStr::to_str) else { return };
    let Ok(entries) = fs::read_dir(folder_of(target)) else { return };
    for entry in entries.flatten() {
        if !entry.file_name().to_str().is_some_and(|found| is_part_of(found, name)) {
            continue;
        }
        let Ok(file) = OpenOptions::new().write(true).open(entry.path()) else { continue };
        if file.try_lock().is_ok() {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether `found` is a name that [`part_name`] makes for `name`, in any process.
fn is_part_of(found: &str, name: &str) -> bool {
    let number = found
        .strip_prefix('.')
        .and_then(|rest| rest.strip_prefix(name))
        .and_then(|rest| rest.strip_prefix('.'))
        .and_then(|rest| rest.strip_suffix(".part"));
    number.is_some_and(|number| {
        let (pid, serial) = number.split_once('-').unwrap_or((number, "0"));
        [pid, serial].iter().all(|digits| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()))
    })
}

impl PartFile<'_> {
    fn finish(&mut self) -> io::Result<()> {
        self.file.flush()?;
        self.file.get_ref().sync_all()
    }

    fn check_cancel(&self) -> io::Result<()> {
        if self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            // Not `Interrupted`: `write_all` would try again for ever.
            return Err(io::Error::other("cancelled"));
        }
        Ok(())
    }
}

impl Write for PartFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.check_cancel()?;
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Read for PartFile<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.file.flush()?;
        self.file.get_mut().read(bytes)
    }
}

impl Seek for PartFile<'_> {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.file.seek(position)
    }
}

#[cfg(test)]
mod tests;
