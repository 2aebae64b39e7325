//! `cargo xtask gallery`: every preset as a picture, by the command line program that users have.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use crate::{setup, shell};

const SCENES: &str = "assets/scenes";
const GALLERY: &str = "target/gallery";
const GALLERY_SIZE_PX: &str = "960x540";
const README_GALLERY: &str = "docs/gallery";
const README_SIZE_PX: &str = "480x270";

/// Largest picture of the README; they are downloaded with every look at it.
const README_MAX_BYTES: u64 = 200_000;

/// Renders every preset; with `readme` also the small pictures of the README.
pub(crate) fn gallery(readme: bool) -> Result<()> {
    shell::run_shown(&mut shell::cargo(["build", "--package", "tyndall-cli", "--bin", "tyndall"]))?;
    let scenes = scenes()?;
    for scene in &scenes {
        render(scene, GALLERY, GALLERY_SIZE_PX)?;
    }
    if readme {
        for scene in &scenes {
            let picture = render(scene, README_GALLERY, README_SIZE_PX)?;
            let bytes = fs::metadata(shell::in_root(&picture))?.len();
            ensure!(bytes <= README_MAX_BYTES, "{} has {bytes} bytes, {README_MAX_BYTES} at most", picture.display());
        }
    }
    println!("{} pictures in {GALLERY}", scenes.len());
    Ok(())
}

/// The presets in alphabetical order, relative to the root.
fn scenes() -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(shell::in_root(SCENES)).with_context(|| format!("cannot list {SCENES}"))?;
    let names = entries.map(|entry| entry.map(|entry| Path::new(SCENES).join(entry.file_name())));
    let mut scenes = names.collect::<Result<Vec<_>, _>>()?;
    scenes.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    scenes.sort();
    ensure!(!scenes.is_empty(), "no scene files in {SCENES}");
    Ok(scenes)
}

/// Renders one scene into `folder` and gives back the picture's path, relative to the root.
fn render(scene: &Path, folder: &str, size_px: &str) -> Result<PathBuf> {
    fs::create_dir_all(shell::in_root(folder)).with_context(|| format!("cannot create {folder}"))?;
    let name = scene.file_stem().context("a scene file has a name")?;
    let picture = Path::new(folder).join(name).with_extension("png");
    let mut command = Command::new(program()?);
    command.arg("render").arg(scene).arg("-o").arg(&picture).args(["--size", size_px]);
    command.envs(setup::software_adapter_variables()).current_dir(shell::root());
    shell::run_shown(&mut command)?;
    Ok(picture)
}

/// The command line program, which cargo has built beside this one.
fn program() -> Result<PathBuf> {
    let this = std::env::current_exe().context("cannot find this program's own folder")?;
    Ok(this.with_file_name(format!("tyndall{}", std::env::consts::EXE_SUFFIX)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_noon_preset_is_among_the_scenes() {
        let scenes = scenes().unwrap();
        assert!(scenes.contains(&Path::new(SCENES).join("noon.toml")), "{scenes:?}");
        assert!(scenes.is_sorted(), "{scenes:?}");
    }
}
