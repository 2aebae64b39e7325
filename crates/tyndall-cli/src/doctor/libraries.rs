//! Packages of Linux that this computer lacks: a graphics driver, and libraries that the desktop program loads at run time.

use std::fs;

/// The package with Mesa's drivers, the software adapter among them, on Debian, Fedora and Arch.
const DRIVER: [&str; 3] = ["mesa-vulkan-drivers", "mesa-vulkan-drivers", "vulkan-swrast"];

/// Library, and its package on Debian, Fedora and Arch. On the other systems windows need nothing.
const LIBRARIES: [(&str, [&str; 3]); 4] = [
    ("libvulkan.so.1", ["libvulkan1", "vulkan-loader", "vulkan-icd-loader"]),
    ("libxkbcommon-x11.so.0", ["libxkbcommon-x11-0", "libxkbcommon-x11", "libxkbcommon-x11"]),
    ("libXcursor.so.1", ["libxcursor1", "libXcursor", "libxcursor"]),
    ("libXi.so.6", ["libxi6", "libXi", "libxi"]),
];

/// Systems whose package names are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Family {
    Debian,
    Fedora,
    Arch,
}

impl Family {
    /// From the text of `/etc/os-release`; Debian where it names none, as most others derive from it.
    fn of(os_release: &str) -> Self {
        let names = os_release.lines().filter_map(|line| line.strip_prefix("ID=").or(line.strip_prefix("ID_LIKE=")));
        let mut words = names.flat_map(|names| names.trim_matches('"').split_whitespace());
        let known = |word| match word {
            "debian" | "ubuntu" => Some(Self::Debian),
            "fedora" | "rhel" => Some(Self::Fedora),
            "arch" => Some(Self::Arch),
            _ => None,
        };
        words.find_map(known).unwrap_or(Self::Debian)
    }

    fn this() -> Self {
        Self::of(&fs::read_to_string("/etc/os-release").unwrap_or_default())
    }

    fn installer(self) -> &'static str {
        match self {
            Self::Debian => "sudo apt-get install -y",
            Self::Fedora => "sudo dnf install -y",
            Self::Arch => "sudo pacman -S --needed",
        }
    }
}

/// The packages that are missing; where the dynamic loader keeps no list of libraries, nothing is said about those.
pub(super) fn missing_packages(has_adapter: bool) -> Vec<&'static str> {
    if !cfg!(target_os = "linux") {
        return Vec::new();
    }
    let family = Family::this();
    let driver = (!has_adapter).then_some(DRIVER[family as usize]);
    let libraries = fs::read("/etc/ld.so.cache").map(|cache| missing_in(&cache, family)).unwrap_or_default();
    driver.into_iter().chain(libraries).collect()
}

fn missing_in(cache: &[u8], family: Family) -> Vec<&'static str> {
    let has = |name: &str| {
        let entry = format!("{name}\0");
        cache.windows(entry.len()).any(|window| window == entry.as_bytes())
    };
    LIBRARIES.iter().filter(|(name, _)| !has(name)).map(|(_, packages)| packages[family as usize]).collect()
}

/// The command that installs the packages; `None` when there is nothing to install.
pub(super) fn install_command(packages: &[&str]) -> Option<String> {
    (!packages.is_empty()).then(|| format!("{} {}", Family::this().installer(), packages.join(" ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn libraries_that_the_loader_does_not_know_are_named_by_their_package() {
        let cache = b"libvulkan.so.1\0libXcursor.so.1.0\0libXi.so.6\0";
        assert_eq!(missing_in(cache, Family::Debian), ["libxkbcommon-x11-0", "libxcursor1"], "only whole names count");
        assert_eq!(missing_in(cache, Family::Arch), ["libxkbcommon-x11", "libxcursor"], "Arch's own names");
    }

    #[test]
    fn derived_systems_are_known_by_their_parents() {
        let mint = "NAME=\"Linux Mint\"\nID=linuxmint\nID_LIKE=\"ubuntu debian\"\n";
        let rocky = "ID=\"rocky\"\nID_LIKE=\"rhel centos fedora\"\n";
        for (text, family) in [(mint, Family::Debian), (rocky, Family::Fedora), ("ID=arch\n", Family::Arch)] {
            assert_eq!(Family::of(text), family, "{text}");
        }
    }

    #[test]
    fn a_computer_without_an_adapter_lacks_a_driver() {
        let drivers = |has_adapter| missing_packages(has_adapter).iter().filter(|name| DRIVER.contains(name)).count();
        assert_eq!(drivers(false), usize::from(cfg!(target_os = "linux")), "the driver's package");
        assert_eq!(drivers(true), 0, "an adapter is there, and with it a driver");
    }

    #[test]
    fn nothing_missing_needs_no_command() {
        assert_eq!(install_command(&[]), None, "nothing to install");
    }
}
