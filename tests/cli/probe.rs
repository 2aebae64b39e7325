//! `probe sky` and `validate sky`: numbers for people who check.

use crate::program::Place;

const ATMOSPHERE: &str = include_str!("../data/atmosphere_csm8.txt");
const LIST: &str = "# three directions and an irradiance\n60 0 0\n60 80 90\n60 120 0\n60 -1 0\n";

fn place() -> Place {
    let place = Place::new();
    place.write("atm.txt", ATMOSPHERE);
    place.write("dirs.txt", LIST);
    place
}

/// The rows of a table by the names of its columns.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let index = header.iter().position(|column| *column == name).unwrap_or_else(|| panic!("{name} in {header:?}"));
    lines.map(|line| line.split(',').nth(index).and_then(|word| word.parse().ok()).expect("a number")).collect()
}

const BASE: [&str; 6] = ["probe", "sky", "--atmosphere", "atm.txt", "--directions", "dirs.txt"];

#[test]
fn tables_and_monte_carlo_print_the_same_columns_and_nearly_the_same_light() {
    let place = place();
    let tables = place.run(&[&BASE[..], &["-o", "-", "--detail", "preview"]].concat()).succeeded().stdout;
    let walks = place.run(&[&BASE[..], &["-o", "walks.csv", "--reference", "--paths", "2048"]].concat()).succeeded();
    assert!(walks.stdout.is_empty(), "{}", walks.stdout);
    let walks = std::fs::read_to_string(place.path("walks.csv")).expect("the table is there");
    assert!(walks.starts_with("# tyndall ") && walks.contains("2048 paths a direction, seed 1"), "{walks}");
    let noise = column(&walks, "median_stderr_pct");
    assert!(noise.iter().all(|percent| *percent < 3.0), "{noise:?}");
    for name in ["L430.5", "cd_m2", "x"] {
        for (row, (a, b)) in column(&tables, name).into_iter().zip(column(&walks, name)).enumerate() {
            // Preview detail is a per cent, 2048 walks another.
            assert!((a / b - 1.0).abs() < 0.05, "{name}, row {row}: {a} {b}");
        }
    }
}

#[test]
fn one_seed_gives_the_same_bits_and_single_scattering_is_a_part_of_the_whole() {
    let place = place();
    place.write("dirs.txt", "60 80 90\n");
    let walk =
        |seed: &str| place.run(&[&BASE[..], &["-o", "-", "--reference", "--seed", seed]].concat()).succeeded().stdout;
    assert_eq!(walk("5"), walk("5"), "the same seed");
    assert_ne!(walk("5"), walk("6"), "another seed");
    let single = place.run(&[&BASE[..], &["-o", "-", "--single"]].concat()).succeeded().stdout;
    let (part, whole) = (column(&single, "cd_m2")[0], column(&walk("5"), "cd_m2")[0]);
    let fraction = column(&walk("5"), "single_fraction")[0];
    assert!((part / whole - fraction).abs() < 0.01, "{part} of {whole} is not {fraction}");
}

#[test]
fn wrong_files_and_options_are_refused_with_file_and_line() {
    let place = place();
    place.write("bad.txt", "60 0 0\n60 200 0\n");
    place.write("bad_atm.txt", &ATMOSPHERE.replace("mie_g", "mie_g x"));
    let run = |words: &[&str]| place.run(words);
    let list = |file: &'static str| ["probe", "sky", "--atmosphere", "atm.txt", "-o", "-", "--directions", file];
    run(&list("bad.txt")).refused(2, "bad.txt:2: view_zenith = \"200\" must be a number from 0 to 180 deg");
    run(&list("none.txt")).refused(2, "none.txt: cannot be read");
    run(&[&BASE[..], &["-o", "nowhere/a.csv"]].concat()).refused(2, "the folder nowhere does not exist");
    run(&[&BASE[..], &["-o", "-", "--single"]].concat()).refused(2, "dirs.txt:5: irradiance");
    run(&[&BASE[..], &["-o", "-", "--altitude", "-1"]].concat()).refused(2, "kilometres from 0");
    run(&[&BASE[..], &["-o", "-", "--reference", "--paths", "3"]].concat()).refused(2, "32..=1000000000");
    run(&["probe", "sky", "--directions", "dirs.txt", "-o", "-"]).refused(2, "--atmosphere");
    let bad = ["probe", "sky", "--atmosphere", "bad_atm.txt", "--directions", "dirs.txt", "-o", "-"];
    run(&bad).refused(2, "bad_atm.txt:");
}

#[test]
fn the_error_meter_prints_bands_and_fails_above_its_limit() {
    let place = Place::new();
    let base = ["validate", "sky", "preset:noon", "--directions", "20", "--paths", "256", "--detail", "preview"];
    let text = place.run(&base).succeeded().stdout;
    for word in ["median", "noise", "zenith", "horizon", "aureole", "worst: "] {
        assert!(text.contains(word), "{word} in {text}");
    }
    let json = place.run(&[&base[..], &["--json"]].concat()).succeeded().stdout;
    let value: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(value["bands"][0]["band"], "all", "{json}");
    let refused = place.run(&[&base[..], &["--limit-median", "0.001"]].concat());
    assert_eq!(refused.code, Some(5), "{}", refused.stderr);
    assert!(refused.stderr.contains("0.001 % are allowed"), "{}", refused.stderr);
    place.run(&[&base[..], &["--limit-p95", "-3"]].concat()).refused(2, "per cent");
}
