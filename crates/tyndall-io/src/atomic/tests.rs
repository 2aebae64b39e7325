//! What stands in the folder after success, failure, cancelling and death.

use std::fs;
use std::io::{self, BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::{check_writable, is_part_of, write_atomically};
use crate::{Destination, IoError};

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_written_file_is_complete_and_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let count = write_atomically(&path, |file| file.write_all(b"new").map(|()| 3)).unwrap();
    assert_eq!((count, fs::read_to_string(&path).unwrap().as_str()), (3, "new"), "content");
    assert_eq!(names_in(folder.path()), ["a.txt"], "nothing else in the folder");
}

#[test]
fn a_failed_write_keeps_the_old_file_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let result = write_atomically(&path, |file| {
        file.write_all(b"half of it")?;
        Err::<(), _>(io::Error::from(io::ErrorKind::StorageFull))
    });
    assert!(matches!(result, Err(IoError::DiskFull { .. })), "{result:?}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "old", "old content");
    assert_eq!(names_in(folder.path()), ["a.txt"], "no temporary file");
}

#[test]
fn cancelling_stops_the_write_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let cancel = AtomicBool::new(false);
    let mut blocks = 0;
    let result = write_atomically(Destination::new(&path).cancelled_by(&cancel), |file| {
        loop {
            file.write_all(&[7; 1000])?;
            blocks += 1;
            if blocks == 5 {
                cancel.store(true, Ordering::Relaxed);
            }
        }
        #[expect(unreachable_code, reason = "gives the closure its type")]
        Ok(())
    });
    assert!(matches!(result, Err(IoError::Cancelled { .. })), "{result:?}");
    assert_eq!((blocks, names_in(folder.path()).len()), (5, 0), "stopped at once, empty folder");
}

#[test]
fn a_panicking_writer_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let panicked = std::panic::catch_unwind(|| {
        write_atomically::<()>(&path, |_| std::panic::resume_unwind(Box::new("on purpose")))
    });
    assert!(panicked.is_err() && names_in(folder.path()).is_empty(), "{:?}", names_in(folder.path()));
}

/// The test starts itself again as the process that is killed.
#[test]
fn a_killed_writer_leaves_no_file_and_the_next_writer_clears_its_leftover() {
    const CHILD: &str = "TYNDALL_IO_KILLED_WRITER";
    if let Some(path) = std::env::var_os(CHILD) {
        write_atomically::<()>(&PathBuf::from(path), |file| {
            file.write_all(b"half of it")?;
            file.flush()?;
            println!("\nhalf written");
            std::thread::sleep(Duration::from_mins(10));
            Ok(())
        })
        .unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let name = "atomic::tests::a_killed_writer_leaves_no_file_and_the_next_writer_clears_its_leftover";
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--nocapture"])
        .env(CHILD, &path)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(lines.map_while(Result::ok).any(|line| line == "half written"), "the child reached its middle");

    let part = format!(".a.txt.{}.part", child.id());
    write_atomically(&path, |file| file.write_all(b"by the parent")).unwrap();
    assert_eq!(names_in(folder.path()), [part.as_str(), "a.txt"], "a live writer's file stays");
    fs::remove_file(&path).unwrap();

    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(names_in(folder.path()), [part.as_str()], "killed: only the leftover");
    write_atomically(&path, |file| file.write_all(b"complete")).unwrap();
    assert_eq!(names_in(folder.path()), ["a.txt"], "the leftover went with the next write");
}

#[test]
fn impossible_places_are_named_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let check = |path: &Path| check_writable(path).unwrap_err();
    let below_a_file = check(&file.join("a.exr"));
    assert!(matches!(below_a_file, IoError::NotAFolder { .. }), "{below_a_file}");
    let deep_below_a_file = check(&file.join("b/a.exr"));
    assert!(matches!(deep_below_a_file, IoError::NotAFolder { .. }), "{deep_below_a_file}");
    let missing = check(&folder.path().join("none/a.exr"));
    assert!(matches!(missing, IoError::MissingFolder { .. }), "{missing}");
    for path in [folder.path(), Path::new("/"), Path::new("")] {
        let error = check(path);
        assert!(matches!(error, IoError::IsFolder { .. }), "{}: {error}", path.display());
    }
    assert_eq!(names_in(folder.path()), ["file"], "nothing was left");
}

#[cfg(target_os = "linux")]
#[test]
fn devices_and_read_only_file_systems_are_refused() {
    // Both refuse root too, as the rights of a folder would not.
    let device = write_atomically(Path::new("/dev/null"), |file| file.write_all(b"x")).unwrap_err();
    assert!(matches!(device, IoError::NotAFile { .. }), "{device}");
    let kernel = check_writable("/proc/a.exr").unwrap_err();
    assert!(kernel.to_string().contains("/proc"), "{kernel}");
}

#[cfg(unix)]
#[test]
fn a_symbolic_link_stays_and_its_target_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (target, link) = (folder.path().join("target"), folder.path().join("link"));
    fs::write(&target, "old").unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    write_atomically(&link, |file| file.write_all(b"new")).unwrap();
    assert!(link.is_symlink(), "the link is still one");
    assert_eq!(fs::read_to_string(&target).unwrap(), "new", "its target has the content");
}

#[test]
fn threads_that_write_the_same_file_do_not_meet() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    std::thread::scope(|scope| {
        for text in ["one", "two", "six", "ten"] {
            let path = &path;
            scope.spawn(move || {
                for _ in 0..50 {
                    write_atomically(path, |file| file.write_all(text.as_bytes())).unwrap();
                }
            });
        }
    });
    assert_eq!(fs::read_to_string(&path).unwrap().len(), 3, "one whole text");
    assert_eq!(names_in(folder.path()), ["a.txt"], "nothing else in the folder");
}

#[test]
fn only_temporary_names_of_the_same_file_count_as_leftovers() {
    for (found, expected) in [
        (".a.exr.17.part", true),
        (".a.exr.17-3.part", true),
        (".a.exr.part", false),
        (".a.exr.old.part", false),
        (".b.exr.17.part", false),
        ("a.exr.17.part", false),
        (".a.exr.17-.part", false),
    ] {
        assert_eq!(is_part_of(found, "a.exr"), expected, "{found}");
    }
}
