//! The table of all WGSL files: one line a file, sorted by name.

/// A row of the table: the name below `shaders/` and the text.
macro_rules! wgsl {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../", $name)))),*]
    };
}

/// All WGSL files, sorted: name relative to the folder `shaders/`, with `/` on every system, and text.
pub const FILES: &[(&str, &str)] = wgsl![
    // One line a file, sorted; the tests of this crate name the line to add when one is forgotten.
    "aerial/aerial.wgsl",
    "aerial/lookup.wgsl",
    "aerial/volume.wgsl",
    "clouds/air.wgsl",
    "clouds/clouds.wgsl",
    "clouds/detail.wgsl",
    "clouds/forward.wgsl",
    "clouds/march.wgsl",
    "clouds/shade.wgsl",
    "clouds/shadow.wgsl",
    "clouds/upsample.wgsl",
    "clouds/view.wgsl",
    "common/erosion.wgsl",
    "common/grain.wgsl",
    "common/lattice.wgsl",
    "common/noise.wgsl",
    "common/phase.wgsl",
    "common/sand.wgsl",
    "common/spectrum.wgsl",
    "common/sphere.wgsl",
    "common/tone.wgsl",
    "desert/bed.wgsl",
    "desert/blowing.wgsl",
    "desert/blowing_view.wgsl",
    "desert/desert.wgsl",
    "desert/dunes.wgsl",
    "desert/glints.wgsl",
    "desert/mesh.wgsl",
    "desert/moonlight.wgsl",
    "desert/relief.wgsl",
    "desert/ripple_patches.wgsl",
    "desert/ripples.wgsl",
    "dunes/cells.wgsl",
    "dunes/dunes.wgsl",
    "dunes/grow.wgsl",
    "dunes/hop.wgsl",
    "dunes/means.wgsl",
    "dunes/near.wgsl",
    "dunes/ripples.wgsl",
    "dunes/sand.wgsl",
    "dunes/shadow.wgsl",
    "dunes/sites.wgsl",
    "dunes/slide.wgsl",
    "dunes/slide_apply.wgsl",
    "dunes/slide_decide.wgsl",
    "dunes/wear.wgsl",
    "frame/develop.wgsl",
    "frame/frame.wgsl",
    "frame/meter.wgsl",
    "landscape/heights.wgsl",
    "landscape/landscape.wgsl",
    "landscape/mesh.wgsl",
    "landscape/place.wgsl",
    "landscape/relief.wgsl",
    "landscape/shadow.wgsl",
    "landscape/shadow_lookup.wgsl",
    "landscape/surface.wgsl",
    "landscape/terrain.wgsl",
    "sky/airglow.wgsl",
    "sky/atmosphere.wgsl",
    "sky/column_lookup.wgsl",
    "sky/column_map.wgsl",
    "sky/column_table.wgsl",
    "sky/dome.wgsl",
    "sky/ground.wgsl",
    "sky/ground_light.wgsl",
    "sky/ground_night.wgsl",
    "sky/haze_breaks.wgsl",
    "sky/irradiance_diffuse.wgsl",
    "sky/irradiance_map.wgsl",
    "sky/irradiance_table.wgsl",
    "sky/layer_column.wgsl",
    "sky/light.wgsl",
    "sky/light_lookup.wgsl",
    "sky/light_table.wgsl",
    "sky/march.wgsl",
    "sky/march_path.wgsl",
    "sky/milky_way.wgsl",
    "sky/moon.wgsl",
    "sky/moon_disc.wgsl",
    "sky/moon_sky.wgsl",
    "sky/moon_table.wgsl",
    "sky/night.wgsl",
    "sky/orders.wgsl",
    "sky/orders_altitudes.wgsl",
    "sky/orders_basis.wgsl",
    "sky/orders_first.wgsl",
    "sky/orders_gather.wgsl",
    "sky/orders_next.wgsl",
    "sky/orders_project.wgsl",
    "sky/orders_source.wgsl",
    "sky/orders_sum.wgsl",
    "sky/orders_suns.wgsl",
    "sky/quadrature.wgsl",
    "sky/refraction.wgsl",
    "sky/sky.wgsl",
    "sky/sky_view_diffuse.wgsl",
    "sky/sky_view_lookup.wgsl",
    "sky/sky_view_map.wgsl",
    "sky/sky_view_ray.wgsl",
    "sky/sky_view_table.wgsl",
    "sky/stars.wgsl",
    "sky/sun_columns.wgsl",
    "sky/sun_disc.wgsl",
    "sky/view.wgsl",
    "splats/billboard.wgsl",
    "splats/column.wgsl",
    "splats/splats.wgsl",
    "splats/view.wgsl",
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use crate::{FILES, compose, entries};

    /// All WGSL files below the folder, by their path with `/` on every system.
    fn files_below(root: &Path, folder: &Path, out: &mut BTreeSet<String>) {
        for entry in std::fs::read_dir(folder).expect("the folder of this crate can be read") {
            let path = entry.expect("the folder of this crate can be read").path();
            if path.is_dir() {
                files_below(root, &path, out);
            } else if path.extension().is_some_and(|extension| extension == "wgsl") {
                let name = path.strip_prefix(root).expect("it lies below the root");
                out.insert(name.to_string_lossy().replace('\\', "/"));
            }
        }
    }

    /// For each file that the table lacks, the line to add and where.
    fn forgotten(found: &BTreeSet<String>, listed: &BTreeSet<String>) -> Vec<String> {
        let line = |name: &String| {
            let before = listed.range(..name.clone()).next_back();
            let place = before.map_or("as the first line".to_owned(), |before| format!("after the line \"{before}\","));
            format!("add to FILES in shaders/src/files.rs, {place}:\n    \"{name}\",")
        };
        found.difference(listed).map(line).collect()
    }

    #[test]
    fn every_wgsl_file_of_the_folder_has_a_line_in_the_table() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut found = BTreeSet::new();
        files_below(root, root, &mut found);
        let forgotten = forgotten(&found, &FILES.iter().map(|(name, _)| (*name).to_owned()).collect());
        assert!(forgotten.is_empty(), "{}", forgotten.join("\n"));
    }

    #[test]
    fn a_forgotten_file_is_reported_with_the_line_to_add_and_its_place() {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        let found = names(&["a.wgsl", "sky/b.wgsl", "sky/c.wgsl"]);
        assert_eq!(
            forgotten(&found, &names(&["a.wgsl", "sky/c.wgsl"])),
            ["add to FILES in shaders/src/files.rs, after the line \"a.wgsl\",:\n    \"sky/b.wgsl\","],
            "between its neighbours"
        );
        assert_eq!(forgotten(&found, &found), Vec::<String>::new(), "nothing is forgotten");
    }

    #[test]
    fn the_table_is_sorted_and_names_nothing_twice() {
        for pair in FILES.windows(2) {
            assert!(
                pair[0].0 < pair[1].0,
                "in shaders/src/files.rs the line {:?} belongs before {:?}",
                pair[1].0,
                pair[0].0
            );
        }
    }

    #[test]
    fn every_entry_file_composes() {
        for name in entries() {
            let composed = compose(name).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(composed.files.last().map(AsRef::as_ref), Some(name), "the entry file stands last");
        }
    }
}
