//! Signals and faults from outside: nothing half-written, and the same bytes in the end.

use crate::program::Place;

#[test]
fn a_lost_device_is_replaced_and_the_bytes_are_those_of_an_undisturbed_run() {
    let words = ["render", "preset:low-sun", "-o", "a.exr", "--size", "96x64"];
    let (calm, disturbed) = (Place::new(), Place::new());
    calm.run(&words).succeeded();
    let run = disturbed.run_with(&[("TYNDALL_FAULT", "device-lost@1")], &words).succeeded();
    assert!(run.stderr.contains("warning: the graphics device was lost"), "{}", run.stderr);
    assert!(calm.read("a.exr") == disturbed.read("a.exr"), "the second device draws the same picture");
    assert_eq!(disturbed.files(), ["a.exr"], "no litter of the first try");
}

#[cfg(unix)]
mod signals {
    use std::io::{BufRead as _, BufReader};
    use std::process::{Child, Command, Stdio};

    use crate::program::Place;

    /// Two moments: the GPU at work, and a part of the file written.
    const STAGES: [&str; 2] = ["rendering", "writing the file"];

    /// A render that takes long enough on any machine, seen to have reached the stage.
    fn start(place: &Place, stage: &str) -> Child {
        let words = ["render", "preset:noon", "-o", "a.exr", "--size", "2048x2048", "--compression", "piz", "--float"];
        start_with(place, &words, stage)
    }

    /// The program with these words, seen to have told something.
    fn start_with(place: &Place, words: &[&str], stage: &str) -> Child {
        let mut command = place.command(&[words, &["--progress", "json"]].concat());
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("it starts");
        let stdout = child.stdout.take().expect("piped");
        let mut lines = BufReader::new(stdout).lines().map_while(Result::ok);
        assert!(lines.any(|line| line.contains(&format!("\"{stage}\""))), "{stage} is never reached");
        child
    }

    /// Sends a signal; the exit code.
    fn end(child: &mut Child, signal: &str) -> Option<i32> {
        let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().expect("kill runs");
        assert!(sent.success(), "{signal} was not sent");
        child.wait().expect("it ends").code()
    }

    /// Exit codes of renders that get the signal at each of the stages.
    fn ended_by(signal: &str) -> [Option<i32>; 2] {
        STAGES.map(|stage| {
            let place = Place::new();
            place.write("a.exr", "an older picture");
            let mut child = start(&place, stage);
            let code = end(&mut child, signal);
            assert_eq!(place.read("a.exr"), b"an older picture", "{signal} while {stage}: the older file is untouched");
            assert_eq!(place.files(), ["a.exr"], "{signal} while {stage}: no temporary file");
            code
        })
    }

    #[test]
    fn ctrl_c_leaves_no_partial_file() {
        assert_eq!(ended_by("-INT"), [Some(130); 2], "exit codes while {STAGES:?}");
    }

    #[test]
    fn termination_leaves_no_partial_file_and_says_that_the_work_can_be_repeated() {
        assert_eq!(ended_by("-TERM"), [Some(75); 2], "exit codes while {STAGES:?}");
    }

    #[test]
    fn ctrl_c_ends_a_simulation_and_leaves_the_older_state() {
        let place = Place::new();
        place.write("a.npz", "an older state");
        let words = ["simulate", "preset:cumulus", "--steps", "10000000", "-o", "a.npz"];
        let mut child = start_with(&place, &words, "simulating");
        assert_eq!(end(&mut child, "-INT"), Some(130), "the code of Ctrl-C");
        assert_eq!(
            (place.read("a.npz"), place.files()),
            (b"an older state".to_vec(), vec!["a.npz".to_owned()]),
            "untouched"
        );
    }

    #[test]
    fn ctrl_c_ends_an_animation_and_leaves_whole_frames() {
        let place = Place::new();
        let size = ["--size", "16x16", "--set", "sky.orders=single"];
        let words = ["render", "preset:noon", "-o", "f-#.png", "--frames", "0-9999"];
        let mut child = start_with(&place, &[&words[..], &size].concat(), "frame");
        assert_eq!(end(&mut child, "-INT"), Some(130), "the code of Ctrl-C");
        let files = place.files();
        assert!(!files.is_empty() && files.iter().all(|file| image::open(place.path(file)).is_ok()), "{files:?}");
    }
}
