//! What Tyndall needs from the operating system, and how it gets there.
//!
//! - [`machine`]: what is there.
//! - [`requirements`]: what is needed, and the package that has it on each family of systems.
//! - [`install`]: on Debian and Ubuntu, the commands that install it.

mod install;
mod machine;
mod requirements;

use anyhow::{Result, ensure};

use machine::{Family, Machine};

/// What the machine is prepared for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Rendering and testing without a window.
    Headless,
    /// The app.
    Window,
}

/// Makes sure that the machine has what `purpose` needs, or says how to get it; gives back whether it has now. Prints
/// nothing when nothing is missing.
pub(crate) fn prepare(purpose: Purpose, install: bool) -> Result<bool> {
    let machine = Machine::this();
    let packages = requirements::missing(&machine, purpose);
    if packages.is_empty() {
        return Ok(true);
    }
    let list = packages.join(" ");
    println!("set-up: system packages are missing: {list}");
    match machine.family {
        Family::Debian if install => {
            install::with_apt(&packages)?;
            let remaining = requirements::missing(&Machine::this(), purpose);
            ensure!(remaining.is_empty(), "{} still cannot be found after its installation", remaining.join(" "));
            return Ok(true);
        }
        Family::Debian => {
            println!("set-up: install them with `apt-get install --no-install-recommends {list}` as root");
        }
        Family::Fedora => println!("set-up: install them with `sudo dnf install {list}`"),
        Family::Arch => println!("set-up: install them with `sudo pacman -S --needed {list}`"),
        Family::OtherLinux | Family::NotLinux => {
            println!("set-up: these are Debian's names; install what your system calls them");
        }
    }
    Ok(false)
}

/// Whether a window can be opened on this machine.
pub(crate) fn has_display() -> bool {
    Machine::this().has_display()
}

/// Variables that let the Vulkan loader find the software adapter at once where there is no GPU. Without them it loads
/// the driver of every GPU it has heard of, some of which complain at length.
pub(crate) fn software_adapter_variables() -> Vec<(&'static str, String)> {
    if machine::has_gpu() || machine::driver_chosen() {
        return Vec::new();
    }
    let Some(driver) = Machine::this().software_driver() else { return Vec::new() };
    // The second name is that of loaders before 1.3.207.
    vec![("VK_DRIVER_FILES", driver.clone()), ("VK_ICD_FILENAMES", driver)]
}
