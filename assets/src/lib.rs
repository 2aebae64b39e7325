//! The scenes that come with Tyndall, as files beside this crate and as text in the program. A crate of its own, because a
//! package can include only files of its own folder.

/// Name and text of every scene, in the order in which galleries show them.
pub const SCENES: &[(&str, &str)] = &[
    ("noon", include_str!("../scenes/noon.toml")),
    ("low-sun", include_str!("../scenes/low-sun.toml")),
    ("sunset", include_str!("../scenes/sunset.toml")),
    ("twilight", include_str!("../scenes/twilight.toml")),
    ("high-altitude", include_str!("../scenes/high-altitude.toml")),
    ("cumulus", include_str!("../scenes/cumulus.toml")),
    ("fair-weather", include_str!("../scenes/fair-weather.toml")),
    ("sea-of-clouds", include_str!("../scenes/sea-of-clouds.toml")),
    ("stratocumulus-sunset", include_str!("../scenes/stratocumulus-sunset.toml")),
    ("above-clouds", include_str!("../scenes/above-clouds.toml")),
    ("inside-cloud", include_str!("../scenes/inside-cloud.toml")),
    ("desert", include_str!("../scenes/desert.toml")),
    ("barchans", include_str!("../scenes/barchans.toml")),
    ("star-dunes", include_str!("../scenes/star-dunes.toml")),
    ("ripples", include_str!("../scenes/ripples.toml")),
    ("hazy", include_str!("../scenes/hazy.toml")),
    ("desert-dust", include_str!("../scenes/desert-dust.toml")),
    ("mars", include_str!("../scenes/mars.toml")),
    ("atmosphere-blender", include_str!("../scenes/atmosphere-blender.toml")),
    ("atmosphere-unreal", include_str!("../scenes/atmosphere-unreal.toml")),
    ("atmosphere-bruneton", include_str!("../scenes/atmosphere-bruneton.toml")),
    ("mountains", include_str!("../scenes/mountains.toml")),
    ("fog", include_str!("../scenes/fog.toml")),
    ("valley-fog", include_str!("../scenes/valley-fog.toml")),
    ("red-sunset", include_str!("../scenes/red-sunset.toml")),
    ("civil-twilight", include_str!("../scenes/civil-twilight.toml")),
    ("nautical-twilight", include_str!("../scenes/nautical-twilight.toml")),
    ("moonlight", include_str!("../scenes/moonlight.toml")),
    ("stars", include_str!("../scenes/stars.toml")),
    ("balloon", include_str!("../scenes/balloon.toml")),
    ("orbit-terminator", include_str!("../scenes/orbit-terminator.toml")),
    ("far-planet", include_str!("../scenes/far-planet.toml")),
];

/// The stars of the Bright Star Catalogue as comma-separated values; `assets/stars/README.md` says what and whence.
pub const BRIGHT_STARS: &str = include_str!("../stars/bright_stars.csv");

#[cfg(test)]
mod tests {
    use super::SCENES;

    #[test]
    fn every_scene_of_the_folder_is_in_the_table_and_no_other() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
        let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut found: Vec<_> = files.filter_map(|name| name.strip_suffix(".toml").map(str::to_owned)).collect();
        let mut known: Vec<_> = SCENES.iter().map(|(name, _)| (*name).to_owned()).collect();
        found.sort();
        known.sort();
        assert_eq!(found, known, "files in {folder} against the table");
    }
}
