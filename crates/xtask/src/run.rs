//! `cargo xtask run`: the app on a scene, or pictures where no window can be opened.

use std::path::Path;

use anyhow::Result;

use crate::setup::{self, Purpose};
use crate::{gallery, shell};

const FIRST_SCENE: &str = "assets/scenes/noon.toml";

/// Opens the app; without a display renders the gallery and says where it is.
pub(crate) fn run(arguments: &[String], install: bool) -> Result<()> {
    if !setup::has_display() {
        println!("no display (neither DISPLAY nor WAYLAND_DISPLAY is set): rendering the presets to files instead");
        setup::prepare(Purpose::Headless, install)?;
        return gallery::gallery(false);
    }
    setup::prepare(Purpose::Window, install)?;
    let mut command = shell::cargo(["run", "--package", "tyndall-app", "--manifest-path"]);
    command.arg(shell::in_root("Cargo.toml")).arg("--");
    if !arguments.iter().any(|argument| Path::new(argument).extension().is_some_and(|suffix| suffix == "toml")) {
        command.arg(shell::in_root(FIRST_SCENE));
    }
    // Scenes that the user names are relative to the folder the user is in.
    command.current_dir(std::env::current_dir()?).args(arguments);
    shell::run_shown(&mut command)
}
