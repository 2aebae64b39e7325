//! [`PictureMetadata`] as attributes of an EXR header, and back.
//!
//! The standard attributes are `OpenEXR`'s own; what it has no name for is called `tyndall/...`. Texts are UTF-8.

use exr::meta::attribute::{AttributeValue, Chromaticities, EnvironmentMap, Text};
use exr::meta::header::{ImageAttributes, LayerAttributes};
use exr::prelude::{IntegerBounds, Vec2};

use tyndall_core::primaries::RgbPrimaries;

use crate::{IoError, PictureMetadata, Projection};

/// Header entry that holds the scene's hash, in EXR and in PNG.
pub(crate) const SCENE_HASH: &str = "tyndall/sceneHash";
const TITLE: &str = "tyndall/title";
const VERSION: &str = "tyndall/version";
const EXPOSURE: &str = "tyndall/exposureEv100";
const COLOR_SPACE: &str = "oiio:ColorSpace";

/// Primaries as the format stores them.
#[expect(clippy::cast_possible_truncation, reason = "the format stores these as f32")]
fn chromaticities(primaries: RgbPrimaries) -> Chromaticities {
    let [red, green, blue, white] = primaries.chromaticities().map(|[x, y]| Vec2(x as f32, y as f32));
    Chromaticities { red, green, blue, white }
}

/// The attributes that all parts of a file share.
pub(crate) fn image_attributes(size_px: [u32; 2], primaries: RgbPrimaries) -> ImageAttributes {
    let window = IntegerBounds::from_dimensions((size_px[0] as usize, size_px[1] as usize));
    let mut image = ImageAttributes::new(window);
    image.chromaticities = Some(chromaticities(primaries));
    image
}

/// The attributes of the one part.
#[expect(clippy::cast_possible_truncation, reason = "the format stores these as f32")]
pub(crate) fn layer_attributes(size_px: [u32; 2], metadata: &PictureMetadata) -> Result<LayerAttributes, IoError> {
    let mut layer = LayerAttributes {
        white_luminance: Some(metadata.white_luminance_cd_m2),
        comments: optional_text(&metadata.comments),
        longitude: metadata.longitude_deg.map(|angle_deg| angle_deg as f32),
        latitude: metadata.latitude_deg.map(|angle_deg| angle_deg as f32),
        software_name: optional_text(&metadata.software),
        ..LayerAttributes::default()
    };
    match metadata.projection {
        Projection::Perspective => add_camera(&mut layer, size_px, metadata),
        Projection::LatLong => layer.environment_map = Some(EnvironmentMap::LatitudeLongitude),
        Projection::Assembled => {}
    }
    let own = [
        (COLOR_SPACE, metadata.primaries.color_space()),
        (VERSION, env!("CARGO_PKG_VERSION")),
        (SCENE_HASH, &metadata.scene_hash),
        (TITLE, &metadata.title),
    ];
    for (name, value) in own.into_iter().chain(metadata.extra.iter().map(|(name, value)| (&**name, &**value))) {
        if value.is_empty() {
            continue;
        }
        let standard = exr::meta::header::standard_names::ALL.contains(&name.as_bytes());
        if standard || name == EXPOSURE || layer.other.insert(text(name), AttributeValue::Text(text(value))).is_some() {
            let problem = "the name is that of another header entry".to_owned();
            return Err(IoError::Metadata { name: name.to_owned(), problem });
        }
    }
    layer.other.insert(text(EXPOSURE), AttributeValue::F64(metadata.exposure_ev100));
    Ok(layer)
}

#[expect(clippy::cast_possible_truncation, reason = "the format stores these as f32")]
fn add_camera(layer: &mut LayerAttributes, size_px: [u32; 2], metadata: &PictureMetadata) {
    let half_height = (f64::from(metadata.field_of_view_rad) / 2.0).tan();
    let half_width = half_height * f64::from(size_px[0]) / f64::from(size_px[1]);
    layer.screen_window_width = (2.0 * half_width) as f32;
    layer.world_to_camera = Some(metadata.world_to_camera);
    layer.near_clip_plane = Some(metadata.near_m);
    layer.horizontal_field_of_view = Some((2.0 * half_width.atan()).to_degrees() as f32);
    layer.vertical_field_of_view = Some(metadata.field_of_view_rad.to_degrees());
}

/// What a header says, as far as it says it; the rest stays at its default.
pub(crate) fn metadata(image: &ImageAttributes, layer: &LayerAttributes) -> PictureMetadata {
    let aces_cg = image.chromaticities == Some(chromaticities(RgbPrimaries::AcesCg));
    let mut metadata = PictureMetadata {
        software: layer.software_name.as_ref().map(string).unwrap_or_default(),
        primaries: if aces_cg { RgbPrimaries::AcesCg } else { RgbPrimaries::Rec709 },
        white_luminance_cd_m2: layer.white_luminance.unwrap_or(1.0),
        projection: match layer.environment_map {
            Some(EnvironmentMap::LatitudeLongitude) => Projection::LatLong,
            Some(EnvironmentMap::Cube) => Projection::Assembled,
            None => Projection::Perspective,
        },
        comments: layer.comments.as_ref().map(string).unwrap_or_default(),
        latitude_deg: layer.latitude.map(f64::from),
        longitude_deg: layer.longitude.map(f64::from),
        ..PictureMetadata::default()
    };
    if let Some(world_to_camera) = layer.world_to_camera {
        metadata.world_to_camera = world_to_camera;
    }
    if let Some(near_m) = layer.near_clip_plane {
        metadata.near_m = near_m;
    }
    if let Some(angle_deg) = layer.vertical_field_of_view {
        metadata.field_of_view_rad = angle_deg.to_radians();
    }
    for (name, value) in &layer.other {
        match (string(name), value) {
            (name, AttributeValue::F64(exposure)) if name == EXPOSURE => metadata.exposure_ev100 = *exposure,
            (name, AttributeValue::Text(value)) => match name.as_str() {
                SCENE_HASH => metadata.scene_hash = string(value),
                TITLE => metadata.title = string(value),
                VERSION | COLOR_SPACE => {}
                _ => metadata.extra.push((name, string(value))),
            },
            _ => {}
        }
    }
    metadata.extra.sort();
    metadata
}

fn text(value: &str) -> Text {
    Text::from_slice_unchecked(value.as_bytes())
}

fn optional_text(value: &str) -> Option<Text> {
    (!value.is_empty()).then(|| text(value))
}

fn string(text: &Text) -> String {
    String::from_utf8_lossy(text.as_slice()).into_owned()
}
