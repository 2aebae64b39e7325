//! What this machine has.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// Operating systems with the same package names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Family {
    /// Debian, Ubuntu and what derives from them.
    Debian,
    /// Fedora and what derives from it.
    Fedora,
    /// Arch and what derives from it.
    Arch,
    /// Any other Linux.
    OtherLinux,
    /// macOS and Windows, which bring Metal, Direct3D and their windows with them.
    NotLinux,
}

/// Window systems of Linux.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Display {
    X11,
    Wayland,
}

/// Facts about the machine that decide what is missing.
#[derive(Debug)]
pub(crate) struct Machine {
    pub(crate) family: Family,
    /// Manifests of Vulkan drivers.
    pub(crate) vulkan_drivers: Vec<PathBuf>,
    /// The dynamic loader's list of libraries; none where it keeps no such list.
    pub(crate) library_cache: Option<Vec<u8>>,
    /// Where windows can be opened now.
    pub(crate) displays: Vec<Display>,
}

impl Machine {
    /// Looks at the machine that this program runs on; a few small files are read.
    pub(crate) fn this() -> Self {
        let os_release = fs::read_to_string("/etc/os-release").unwrap_or_default();
        let family = if cfg!(target_os = "linux") { Family::from_os_release(&os_release) } else { Family::NotLinux };
        let variables = [("DISPLAY", Display::X11), ("WAYLAND_DISPLAY", Display::Wayland)];
        Self {
            family,
            vulkan_drivers: vulkan_drivers(),
            library_cache: fs::read("/etc/ld.so.cache").ok(),
            displays: variables.into_iter().filter(|(name, _)| is_set(name)).map(|(_, display)| display).collect(),
        }
    }

    /// Whether a window can be opened.
    pub(crate) fn has_display(&self) -> bool {
        self.family == Family::NotLinux || !self.displays.is_empty()
    }

    /// Whether the dynamic loader knows the library; true where it keeps no list to look it up in.
    pub(crate) fn has_library(&self, name: &str) -> bool {
        let entry = format!("{name}\0");
        self.library_cache
            .as_ref()
            .is_none_or(|cache| cache.windows(entry.len()).any(|window| window == entry.as_bytes()))
    }

    /// The manifest of lavapipe, Mesa's Vulkan on the CPU.
    pub(crate) fn software_driver(&self) -> Option<String> {
        let is_lavapipe =
            |path: &&PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("lvp_icd"));
        self.vulkan_drivers.iter().find(is_lavapipe).map(|path| path.display().to_string())
    }
}

impl Family {
    /// From the text of /etc/os-release: its own name first, then the names of its parents.
    pub(crate) fn from_os_release(text: &str) -> Self {
        let value = |key: &str| {
            let line = text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
            line.unwrap_or_default().trim_matches(['"', '\'']).to_owned()
        };
        let names = format!("{} {}", value("ID"), value("ID_LIKE"));
        let known = names.split_whitespace().find_map(|name| match name {
            "debian" | "ubuntu" => Some(Self::Debian),
            "fedora" | "rhel" => Some(Self::Fedora),
            "arch" => Some(Self::Arch),
            _ => None,
        });
        known.unwrap_or(Self::OtherLinux)
    }
}

/// Whether the user has chosen a Vulkan driver by an environment variable.
pub(crate) fn driver_chosen() -> bool {
    is_set("VK_DRIVER_FILES") || is_set("VK_ICD_FILENAMES")
}

/// Whether Linux has a GPU that programs may use.
pub(crate) fn has_gpu() -> bool {
    let is_render_node = |entry: fs::DirEntry| entry.file_name().to_string_lossy().starts_with("renderD");
    Path::new("/dev/nvidiactl").exists()
        || fs::read_dir("/dev/dri").is_ok_and(|entries| entries.flatten().any(is_render_node))
}

fn is_set(variable: &str) -> bool {
    env::var_os(variable).is_some_and(|value| !value.is_empty())
}

/// Manifests in the folders that the Vulkan loader searches, or those that its variables name.
fn vulkan_drivers() -> Vec<PathBuf> {
    for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        if let Some(paths) = env::var_os(variable).filter(|paths| !paths.is_empty()) {
            return env::split_paths(&paths).filter(|path| path.exists()).collect();
        }
    }
    let home = env::var_os("HOME").map(|home| Path::new(&home).join(".local/share"));
    let shared = env::var_os("XDG_DATA_DIRS").unwrap_or_default();
    let standard = ["/etc", "/usr/local/etc", "/usr/local/share", "/usr/share"].map(PathBuf::from);
    let mut drivers: Vec<_> = env::split_paths(&shared)
        .chain(home)
        .chain(standard)
        .filter_map(|folder| fs::read_dir(folder.join("vulkan/icd.d")).ok())
        .flat_map(|entries| entries.flatten().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "json"))
        .collect();
    drivers.sort();
    drivers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distributions_are_known_by_their_own_name_or_their_parents() {
        for (text, family) in [
            ("PRETTY_NAME=\"Debian GNU/Linux 12\"\nVERSION_ID=\"12\"\nID=debian\n", Family::Debian),
            ("NAME=\"Ubuntu\"\nID=ubuntu\nID_LIKE=debian\n", Family::Debian),
            ("ID=linuxmint\nID_LIKE=\"ubuntu debian\"\n", Family::Debian),
            ("ID=fedora\n", Family::Fedora),
            ("ID=\"rocky\"\nID_LIKE=\"rhel centos fedora\"\n", Family::Fedora),
            ("ID=arch\n", Family::Arch),
            ("ID=endeavouros\nID_LIKE='arch'\n", Family::Arch),
            ("ID=nixos\n", Family::OtherLinux),
            ("", Family::OtherLinux),
        ] {
            assert_eq!(Family::from_os_release(text), family, "{text}");
        }
    }
}
