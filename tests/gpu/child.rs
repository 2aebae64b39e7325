//! A test of this program, run once more in a child process with other environment variables.

use std::process::Command;

/// A test that opens the shared device, draws and reads back twice.
const DRAWS_TWICE: &str = "rendering::the_same_draw_twice_gives_the_same_bytes";

/// Whether the test passed in a child process with one more environment variable, and what it wrote.
fn draw_twice_with(variable: &str, value: &str) -> (bool, String) {
    let program = std::env::current_exe().expect("a test is a program");
    let output = Command::new(program)
        .args(["--exact", DRAWS_TWICE, "--nocapture"])
        .env(variable, value)
        .output()
        .expect("it ran before");
    let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert!(text.contains("running 1 test"), "there is a test of that name: {text}");
    (output.status.success(), text)
}

#[test]
fn a_planted_loss_strikes_at_its_read_back() {
    for n in [1, 2] {
        let (passed, text) = draw_twice_with("TYNDALL_FAULT", &format!("device-lost@{n}"));
        assert!(!passed && text.contains("the graphics device was lost"), "device-lost@{n}: {text}");
    }
    let (passed, text) = draw_twice_with("TYNDALL_FAULT", "device-lost@3");
    assert!(passed, "there is no third read-back: {text}");
}

#[test]
fn without_any_adapter_tests_fail_and_say_what_to_install() {
    let (passed, text) = draw_twice_with("WGPU_BACKEND", "noop");
    assert!(!passed, "a skipped test would look like success: {text}");
    assert!(text.contains("needs a graphics adapter: no graphics driver was found"), "{text}");
    assert!(!cfg!(target_os = "linux") || text.contains("mesa-vulkan-drivers"), "{text}");
}

#[test]
fn an_adapter_named_for_the_tests_is_the_one_that_is_used() {
    let (passed, text) = draw_twice_with("TYNDALL_TEST_ADAPTER", "no such card");
    assert!(!passed && text.contains("no adapter fits `no such card`"), "{text}");
}
