//! What is written comes back: pixels, depth, header.

use std::fs;
use std::io::BufReader;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use tyndall_core::primaries::RgbPrimaries;
use tyndall_io::{
    Channels, Compression, Destination, ExrOptions, IoError, MAX_SIDE_PX, Picture, PictureFormat, PictureMetadata,
    Precision, Projection, SKY_DEPTH_M, is_finished, read_exr, read_picture_header, write_exr, write_png8, write_png16,
};

const FLOAT_ZIPS: ExrOptions =
    ExrOptions { precision: Precision::Float, compression: Compression::Zips, channels: Channels::Rgba };
const HALF_ZIPS: ExrOptions = ExrOptions { precision: Precision::Half, ..FLOAT_ZIPS };

/// Values over eight decades, no two pixels alike.
fn picture() -> Picture {
    let size_px = [37, 11];
    let value = |index: u32, channel: u32| ((index * 4 + channel) as f32 * 0.012).exp2() * 6.2e-5;
    let rgba = (0..37 * 11).map(|index| [value(index, 0), value(index, 1), value(index, 2), 1.0]).collect();
    let depth_m = (0..37 * 11).map(|index| if index < 100 { SKY_DEPTH_M } else { 1.0 + index as f32 / 3.0 }).collect();
    Picture { size_px, rgba, depth_m: Some(depth_m) }
}

fn metadata() -> PictureMetadata {
    let mut world_to_camera = PictureMetadata::default().world_to_camera;
    world_to_camera[14] = -5.5;
    PictureMetadata {
        scene_hash: "0123456789abcdef".to_owned(),
        title: "Abendd\u{e4}mmerung \u{5915}\u{66ae}".to_owned(),
        world_to_camera,
        near_m: 0.25,
        field_of_view_rad: 1.0,
        latitude_deg: Some(35.5),
        longitude_deg: Some(-139.75),
        exposure_ev100: 14.625,
        comments: "for the tests".to_owned(),
        extra: vec![("tyndall/adapter".to_owned(), "llvmpipe".to_owned())],
        ..PictureMetadata::default()
    }
}

#[test]
fn float_pixels_and_depth_come_back_exactly_with_every_compression() {
    let folder = tempfile::tempdir().unwrap();
    for compression in [Compression::None, Compression::Rle, Compression::Zips, Compression::Zip, Compression::Piz] {
        let path = folder.path().join(format!("{compression:?}.exr"));
        let options = ExrOptions { compression, ..FLOAT_ZIPS };
        let report = write_exr(&path, &picture(), &metadata(), &options).unwrap();
        assert_eq!(report.bytes, fs::metadata(&path).unwrap().len(), "{compression:?}: size of the file");
        assert_eq!(report.clamped_pixels, 0, "{compression:?}: floats are never clamped");
        assert_eq!(read_exr(&path).unwrap().0, picture(), "{compression:?}: pixels");
    }
}

#[test]
fn a_panorama_keeps_its_unit_and_primaries_and_has_no_camera() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.exr");
    let written = PictureMetadata {
        primaries: RgbPrimaries::AcesCg,
        white_luminance_cd_m2: 683.0,
        projection: Projection::LatLong,
        ..PictureMetadata::default()
    };
    let options = ExrOptions { channels: Channels::Rgb, ..FLOAT_ZIPS };
    let picture = Picture { depth_m: None, ..picture() };
    write_exr(&path, &picture, &written, &options).unwrap();
    let (pixels, back) = read_exr(&path).unwrap();
    assert_eq!(back, written, "unit, primaries and projection");
    assert_eq!(pixels, picture, "alpha is 1 where the file has none");
    let file = BufReader::new(fs::File::open(&path).unwrap());
    let header = exr::meta::MetaData::read_from_buffered(file, false).unwrap().headers.remove(0);
    assert_eq!(header.own_attributes.world_to_camera, None, "no camera sees everything");
    assert_eq!(header.channels.list.len(), 3, "R, G and B alone");
}

#[test]
fn half_pixels_come_back_within_half_a_unit_of_the_last_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("half.exr");
    write_exr(&path, &picture(), &metadata(), &HALF_ZIPS).unwrap();
    let (back, _) = read_exr(&path).unwrap();
    assert_eq!(back.depth_m, picture().depth_m, "depth stays 32-bit float");
    for (written, read) in picture().rgba.as_flattened().iter().zip(back.rgba.as_flattened()) {
        // Half has ten stored bits: rounding is within 2^-11 of the value from 2^-14 on.
        assert!((read / written - 1.0).abs() <= 1.0 / 2048.0, "{written} came back as {read}");
    }
}

#[test]
fn pixels_beyond_half_are_clamped_and_their_share_of_the_light_is_reported() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sun.exr");
    let mut rgba = vec![[1000.0, 1000.0, 1000.0, 1.0]; 99];
    rgba.push([1.6e9, 1.6e9, 1.6e9, 1.0]);
    let picture = Picture { size_px: [10, 10], rgba, depth_m: None };
    let report = write_exr(&path, &picture, &metadata(), &HALF_ZIPS).unwrap();
    let expected = (1.6e9 - 65_504.0) / (1.6e9 + 99_000.0);
    assert_eq!(report.clamped_pixels, 1, "the sun");
    assert!((report.clamped_luminance_share - expected).abs() < 1e-12, "{}", report.clamped_luminance_share);
    let (back, _) = read_exr(&path).unwrap();
    let sun = Picture { size_px: [1, 1], rgba: vec![[65_504.0, 65_504.0, 65_504.0, 1.0]], depth_m: None };
    assert_eq!(&back.rgba[99..], sun.rgba, "the largest half, not infinity");
}

#[test]
fn metadata_of_an_exr_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write_exr(&path, &picture(), &metadata(), &HALF_ZIPS).unwrap();
    let (_, back) = read_exr(&path).unwrap();
    assert!((back.field_of_view_rad - 1.0).abs() < 1e-6, "{} rad went through degrees", back.field_of_view_rad);
    assert_eq!(PictureMetadata { field_of_view_rad: 1.0, ..back }, metadata(), "everything else exactly");
}

#[test]
fn the_header_names_primaries_white_and_units() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write_exr(&path, &picture(), &metadata(), &HALF_ZIPS).unwrap();
    let headers = exr::meta::MetaData::read_from_file(&path, true).unwrap().headers;
    assert_eq!(headers.len(), 1, "one part");
    let (shared, own) = (&headers[0].shared_attributes, &headers[0].own_attributes);
    let primaries = shared.chromaticities.unwrap();
    assert_eq!(
        [primaries.red, primaries.white].map(|xy| [xy.0, xy.1]),
        [[0.64, 0.33], [0.3127, 0.3290]],
        "Rec.709, D65"
    );
    assert_eq!(own.white_luminance, Some(1.0), "one unit is one cd/m^2");
    let tan_half = own.screen_window_width / 2.0 * 11.0 / 37.0;
    assert!((tan_half - 0.5_f32.tan()).abs() < 1e-6, "screen window {}", own.screen_window_width);
    let names: Vec<_> = headers[0].channels.list.iter().map(|channel| channel.name.to_string()).collect();
    assert_eq!(names, ["A", "B", "G", "R", "Z"], "channels in the order of the format");
}

#[test]
fn equal_pictures_are_equal_files() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = |name: &str| {
        let path = folder.path().join(name);
        write_exr(&path, &picture(), &metadata(), &HALF_ZIPS).unwrap();
        fs::read(path).unwrap()
    };
    let first = bytes("first.exr");
    for attempt in 0..10 {
        assert!(bytes("again.exr") == first, "attempt {attempt} differs");
    }
}

#[test]
fn values_that_are_not_finite_are_refused_with_the_place_of_the_first() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.exr");
    let mut colour = picture();
    colour.rgba[2 * 37 + 5][1] = f32::NAN;
    colour.rgba[4 * 37][2] = f32::INFINITY;
    let message = write_exr(&path, &colour, &metadata(), &FLOAT_ZIPS).unwrap_err().to_string();
    assert!(message.contains("channel G of pixel (5, 2) is NaN; the first of 2"), "{message}");
    let mut depth = picture();
    depth.depth_m.as_mut().unwrap()[38] = f32::INFINITY;
    let message = write_exr(&path, &depth, &metadata(), &FLOAT_ZIPS).unwrap_err().to_string();
    assert!(message.contains("channel Z of pixel (1, 1) is inf"), "{message}");
    assert!(!path.exists(), "nothing was written");
}

#[test]
fn pictures_of_impossible_size_are_refused() {
    let huge = Picture { size_px: [60_000, 60_000], ..Picture::default() };
    let error = write_exr("never.exr", &huge, &metadata(), &HALF_ZIPS).unwrap_err();
    assert!(matches!(error, IoError::Size { .. }), "{error}");
    let error = write_png8("never.png", [0, 5], &[], &metadata()).unwrap_err();
    assert!(matches!(error, IoError::Size { .. }), "{error}");
    let short = Picture { depth_m: Some(vec![0.0; 3]), ..picture() };
    let error = write_exr("never.exr", &short, &metadata(), &HALF_ZIPS).unwrap_err();
    assert!(error.to_string().contains("depth_m has 3 entries"), "{error}");
}

#[test]
fn a_header_of_impossible_size_is_refused_before_its_pixels_are_allocated() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write_exr(&path, &picture(), &metadata(), &HALF_ZIPS).unwrap();
    let mut bytes = fs::read(&path).unwrap();
    for window in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
        let start = bytes.windows(window.len()).position(|found| found == window).unwrap() + window.len() + 4;
        bytes[start + 8..start + 16].copy_from_slice(&[59_999_u32.to_le_bytes(); 2].concat());
    }
    fs::write(&path, bytes).unwrap();
    let error = read_exr(&path).unwrap_err();
    assert!(error.to_string().contains(&format!("60000 x 60000 pixels is outside 1 x 1 to {MAX_SIDE_PX}")), "{error}");
}

#[test]
fn damaged_and_foreign_files_are_errors_that_name_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write_exr(&path, &picture(), &metadata(), &FLOAT_ZIPS).unwrap();
    let bytes = fs::read(&path).unwrap();
    for length in (0..bytes.len()).step_by(97) {
        fs::write(&path, &bytes[..length]).unwrap();
        let message = read_exr(&path).unwrap_err().to_string();
        assert!(message.contains("a.exr"), "cut at {length}: {message}");
    }
    fs::write(&path, "a text").unwrap();
    let message = read_picture_header(&path).unwrap_err().to_string();
    assert!(message.contains("neither an EXR nor a PNG"), "{message}");
    let message = read_picture_header(folder.path().join("none.exr")).unwrap_err().to_string();
    assert!(message.contains("cannot read") && message.contains("none.exr"), "{message}");
}

#[test]
fn png_pixels_and_texts_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let pixels16: Vec<[u16; 4]> = (0..35).map(|index| [index * 1871, 65_535 - index, index, 65_535]).collect();
    write_png16(&path, [7, 5], &pixels16, &metadata()).unwrap();
    let (info, bytes) = decode_png(&path).unwrap();
    let expected: Vec<u8> = pixels16.as_flattened().iter().flat_map(|value| value.to_be_bytes()).collect();
    assert_eq!(bytes, expected, "16-bit pixels");
    assert!(info.srgb.is_some(), "sRGB chunk");

    let pixels8: Vec<[u8; 4]> = (0..35).map(|index| [index, 255 - index, 7 * index, 255]).collect();
    let size_bytes = write_png8(&path, [7, 5], &pixels8, &metadata()).unwrap();
    assert_eq!(size_bytes, fs::metadata(&path).unwrap().len(), "size of the file");
    let (info, bytes) = decode_png(&path).unwrap();
    assert_eq!(bytes, pixels8.as_flattened(), "8-bit pixels");
    let texts: Vec<_> = info.uncompressed_latin1_text.iter().map(|chunk| chunk.keyword.as_str()).collect();
    assert_eq!(texts, ["Software", "Comment", "tyndall/sceneHash", "tyndall/adapter"], "ASCII texts");
    assert_eq!(info.utf8_text[0].get_text().unwrap(), metadata().title, "title in UTF-8");
}

fn decode_png(path: &Path) -> Result<(png::Info<'static>, Vec<u8>), png::DecodingError> {
    let mut reader = png::Decoder::new(BufReader::new(fs::File::open(path)?)).read_info()?;
    let mut bytes = vec![0; reader.output_buffer_size().unwrap_or_default()];
    reader.next_frame(&mut bytes)?;
    Ok((reader.info().clone(), bytes))
}

#[test]
fn a_picture_is_finished_when_hash_program_and_size_agree() {
    let folder = tempfile::tempdir().unwrap();
    let (exr, png) = (folder.path().join("a.exr"), folder.path().join("a.png"));
    assert!(!is_finished(&exr, [37, 11], &metadata()), "no file yet");
    write_exr(&exr, &picture(), &metadata(), &HALF_ZIPS).unwrap();
    write_png8(&png, [37, 11], &[[0; 4]; 37 * 11], &metadata()).unwrap();
    for (path, format) in [(&exr, PictureFormat::Exr), (&png, PictureFormat::Png)] {
        let header = read_picture_header(path).unwrap();
        assert_eq!((header.format, header.title), (format, metadata().title), "{format:?}");
        assert!(is_finished(path, [37, 11], &metadata()), "{format:?}: the same");
        assert!(!is_finished(path, [37, 12], &metadata()), "{format:?}: another size");
        let other_scene = PictureMetadata { scene_hash: "fedcba9876543210".to_owned(), ..metadata() };
        assert!(!is_finished(path, [37, 11], &other_scene), "{format:?}: another scene");
        let other_program = PictureMetadata { software: "tyndall 9.9.9".to_owned(), ..metadata() };
        assert!(!is_finished(path, [37, 11], &other_program), "{format:?}: another version");
    }
}

#[test]
fn a_cancelled_picture_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let cancel = AtomicBool::new(true);
    let path = folder.path().join("a.exr");
    let to = Destination::new(&path).cancelled_by(&cancel);
    let exr = write_exr(to, &picture(), &metadata(), &HALF_ZIPS).unwrap_err();
    let png = write_png8(to, [1, 1], &[[0; 4]], &metadata()).unwrap_err();
    assert!([&exr, &png].iter().all(|error| matches!(error, IoError::Cancelled { .. })), "{exr}; {png}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "empty folder");
}

#[test]
fn extra_entries_with_the_name_of_another_entry_are_refused() {
    for name in ["tyndall/sceneHash", "tyndall/exposureEv100", "comments", "chromaticities"] {
        let metadata = PictureMetadata { extra: vec![(name.to_owned(), "x".to_owned())], ..metadata() };
        let error = write_exr("never.exr", &picture(), &metadata, &HALF_ZIPS).unwrap_err();
        assert!(matches!(error, IoError::Metadata { .. }), "{name}: {error}");
    }
}
