//! What is needed, how it is recognised, and the package that has it.

use super::Purpose;
use super::machine::{Display, Family, Machine};

/// One thing that has to be there.
#[derive(Debug)]
struct Requirement {
    evidence: Evidence,
    debian: &'static str,
    fedora: &'static str,
    arch: &'static str,
}

/// How one sees that a requirement is met.
#[derive(Debug)]
enum Evidence {
    /// Any Vulkan driver is registered.
    VulkanDriver,
    /// The dynamic loader knows this library.
    Library(&'static str),
}

const fn library(name: &'static str, debian: &'static str, fedora: &'static str, arch: &'static str) -> Requirement {
    Requirement { evidence: Evidence::Library(name), debian, fedora, arch }
}

/// Mesa's packages bring lavapipe, so that they serve machines with and without a GPU.
const VULKAN: &[Requirement] = &[
    Requirement {
        evidence: Evidence::VulkanDriver,
        debian: "mesa-vulkan-drivers",
        fedora: "mesa-vulkan-drivers",
        arch: "vulkan-swrast",
    },
    library("libvulkan.so.1", "libvulkan1", "vulkan-loader", "vulkan-icd-loader"),
];

/// Loaded by the window library at run time on X11.
const X11: &[Requirement] = &[
    library("libX11.so.6", "libx11-6", "libX11", "libx11"),
    library("libX11-xcb.so.1", "libx11-xcb1", "libX11-xcb", "libx11"),
    library("libXcursor.so.1", "libxcursor1", "libXcursor", "libxcursor"),
    library("libXi.so.6", "libxi6", "libXi", "libxi"),
    library("libxkbcommon-x11.so.0", "libxkbcommon-x11-0", "libxkbcommon-x11", "libxkbcommon-x11"),
];

/// The same on Wayland.
const WAYLAND: &[Requirement] = &[
    library("libwayland-client.so.0", "libwayland-client0", "libwayland-client", "wayland"),
    library("libxkbcommon.so.0", "libxkbcommon0", "libxkbcommon", "libxkbcommon"),
];

/// The packages that `purpose` needs and `machine` lacks, each once.
pub(crate) fn missing(machine: &Machine, purpose: Purpose) -> Vec<&'static str> {
    if machine.family == Family::NotLinux {
        return Vec::new();
    }
    let window = purpose == Purpose::Window;
    let on = |display| window && machine.displays.contains(&display);
    let groups = [(true, VULKAN), (on(Display::X11), X11), (on(Display::Wayland), WAYLAND)];
    let wanted = groups.into_iter().filter(|(applies, _)| *applies).flat_map(|(_, group)| group);
    let mut packages: Vec<_> = wanted
        .filter(|requirement| !requirement.is_met(machine))
        .map(|requirement| requirement.package(machine.family))
        .collect();
    packages.dedup();
    packages
}

impl Requirement {
    fn is_met(&self, machine: &Machine) -> bool {
        match self.evidence {
            Evidence::VulkanDriver => !machine.vulkan_drivers.is_empty(),
            Evidence::Library(name) => machine.has_library(name),
        }
    }

    fn package(&self, family: Family) -> &'static str {
        match family {
            Family::Debian | Family::OtherLinux | Family::NotLinux => self.debian,
            Family::Fedora => self.fedora,
            Family::Arch => self.arch,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A freshly installed machine with X11 that has these libraries.
    fn machine(family: Family, libraries: &str) -> Machine {
        Machine {
            family,
            vulkan_drivers: Vec::new(),
            library_cache: Some(libraries.replace(' ', "\0").into_bytes()),
            displays: vec![Display::X11],
        }
    }

    #[test]
    fn a_bare_debian_needs_the_software_adapter_and_the_window_libraries() {
        let bare = machine(Family::Debian, "libc.so.6 ");
        assert_eq!(missing(&bare, Purpose::Headless), ["mesa-vulkan-drivers", "libvulkan1"], "without a window");
        let with_window = missing(&bare, Purpose::Window);
        assert_eq!(with_window[2..], ["libx11-6", "libx11-xcb1", "libxcursor1", "libxi6", "libxkbcommon-x11-0"], "X11");
    }

    #[test]
    fn a_complete_machine_needs_nothing() {
        let libraries = "libvulkan.so.1 libX11.so.6 libX11-xcb.so.1 libXcursor.so.1 libXi.so.6 libxkbcommon-x11.so.0 ";
        let mut complete = machine(Family::Debian, libraries);
        complete.vulkan_drivers.push("lvp_icd.x86_64.json".into());
        assert!(missing(&complete, Purpose::Window).is_empty(), "{:?}", missing(&complete, Purpose::Window));
        let mut without_list = machine(Family::OtherLinux, "");
        without_list.library_cache = None;
        without_list.vulkan_drivers = complete.vulkan_drivers;
        assert!(missing(&without_list, Purpose::Window).is_empty(), "nothing can be said without the loader's list");
    }

    #[test]
    fn a_library_whose_name_only_begins_alike_does_not_count() {
        let other = machine(Family::Debian, "libvulkan.so.1.3 libvulkan.so ");
        assert!(missing(&other, Purpose::Headless).contains(&"libvulkan1"), "libvulkan.so.1 itself is wanted");
    }

    #[test]
    fn other_families_get_their_own_names_and_each_once() {
        let arch = missing(&machine(Family::Arch, ""), Purpose::Window);
        let expected = ["vulkan-swrast", "vulkan-icd-loader", "libx11", "libxcursor", "libxi", "libxkbcommon-x11"];
        assert_eq!(arch, expected, "Arch");
        assert_eq!(missing(&machine(Family::Fedora, ""), Purpose::Headless)[1], "vulkan-loader", "Fedora");
        let mac = machine(Family::NotLinux, "");
        assert!(missing(&mac, Purpose::Window).is_empty(), "macOS and Windows bring everything");
    }
}
