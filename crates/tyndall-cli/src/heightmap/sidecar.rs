//! What lies beside the maps: everything that their numbers do not say.

use serde_json::{Value, json};
use tyndall_scene::Scene;

use super::Form;
use super::layers::{Layer, Samples};
use super::write::{Writer, Written, range};

/// Version of the sidecar's form; raised when an entry changes its meaning.
const FORMAT: u32 = 1;

/// A layer and its files.
pub(super) fn entry(layer: &Layer, files: &[Written]) -> Value {
    let (kind, range) = match &layer.samples {
        Samples::Amounts(amounts) => ("amount", Some(range(amounts))),
        Samples::Vectors(_) => ("vector", None),
        Samples::Shares(_) => ("share", None),
    };
    let files: Vec<Value> = files
        .iter()
        .map(|written| {
            let name = written.path.file_name().map(|name| name.to_string_lossy());
            json!({ "file": name, "tile": written.tile })
        })
        .collect();
    let name = if layer.suffix.is_empty() { "height" } else { layer.suffix };
    json!({ "name": name, "holds": layer.doc, "kind": kind, "unit": layer.unit, "range": range, "files": files })
}

/// The whole sidecar.
pub(super) fn whole(writer: &Writer<'_>, scene: &Scene, layers: &[Value]) -> Value {
    let desert = writer.desert;
    let [lowest_m, highest_m] = desert.height_range_m();
    let [width_px, height_px] = writer.file_size();
    json!({
        "format": FORMAT,
        "software": format!("tyndall {}", env!("CARGO_PKG_VERSION")),
        "title": scene.title,
        "scene_hash": scene.hash().to_string(),
        "step": desert.step_count(),
        "hash": format!("{:#018x}", desert.hash()),
        "width": width_px,
        "height": height_px,
        "cells": desert.size(),
        "metres_per_pixel": desert.cell_m(),
        "lowest_m": lowest_m,
        "highest_m": highest_m,
        "first_row": "north",
        "edges": desert.field().edges().name(),
        "tiles": writer.arguments.tiles,
        "borders": if writer.arguments.tiles.is_some() || writer.arguments.shared_edge { "shared" } else { "none" },
        "mesh_axes": (writer.form == Form::Mesh).then_some("x east, y up, z south, metres, centred"),
        "wind_toward_deg": desert.wind_toward_deg(),
        "layers": layers,
    })
}
