//! Faces into files.

use std::f32::consts::FRAC_PI_2;
use std::path::Path;

use tyndall_io::{Picture, PictureMetadata, Projection, SKY_DEPTH_M};
use tyndall_render::CubeFace;
use tyndall_scene::Scene;
use tyndall_scene::camera::CameraFrame;

use super::{Cube, CubemapArguments, Layout, Plan};
use crate::Failure;
use crate::interrupt::Interrupt;
use crate::light::UnitName;
use crate::progress::Progress;
use crate::render::frame::{Frame, Pixels};
use crate::render::{header, write};

/// Writes one file or six, each complete or not at all; gives back their size in bytes.
pub(super) fn write(
    arguments: &CubemapArguments,
    scene: &Scene,
    cube: Cube,
    plan: &Plan,
    (progress, interrupt): (&Progress, &Interrupt),
) -> Result<u64, Failure> {
    let Cube { faces, adapter, ev100 } = cube;
    let frame = |pixels: Pixels, size_px: [u32; 2]| Frame {
        size_px,
        pixels,
        adapter: adapter.clone(),
        ev100,
        passes: Vec::new(),
    };
    let side_px = arguments.size;
    let mut bytes = 0;
    let mut file = |path: &Path, frame: &Frame, metadata: &PictureMetadata| -> Result<(), Failure> {
        interrupt.check()?;
        let written = write::write(path, frame, plan.format, metadata, interrupt)?;
        bytes += written.bytes;
        if written.clamped_pixels > 0 {
            let (path, percent) = (path.display(), 100.0 * written.clamped_luminance_share);
            progress.warn(&format!(
                "{path}: {} pixels are brighter than half floats can say and were clamped, {percent:.2} % of the \
                 light; --float keeps it",
                written.clamped_pixels
            ));
        }
        Ok(())
    };
    if arguments.layout == Layout::Faces {
        for ((face, pixels), path) in CubeFace::ALL.into_iter().zip(faces).zip(&plan.paths) {
            let frame = frame(pixels, [side_px; 2]);
            file(path, &frame, &face_metadata(arguments, scene, &frame, face))?;
        }
    } else if let Some(path) = plan.paths.first() {
        let size_px = arguments.layout.grid().map(|faces| faces * side_px);
        let frame = frame(assembled(arguments.layout, faces, side_px), size_px);
        let metadata = PictureMetadata { projection: Projection::Assembled, ..metadata(arguments, scene, &frame) };
        file(path, &frame, &metadata)?;
    }
    Ok(bytes)
}

fn metadata(arguments: &CubemapArguments, scene: &Scene, frame: &Frame) -> PictureMetadata {
    let unit = arguments.units.unwrap_or(UnitName::CandelaPerSquareMetre).at(frame.ev100);
    #[expect(clippy::cast_possible_truncation, reason = "EXR stores it as f32")]
    let white_luminance_cd_m2 = unit.white_luminance_cd_m2() as f32;
    PictureMetadata { white_luminance_cd_m2, ..header::metadata(scene, None, frame) }
}

fn face_metadata(arguments: &CubemapArguments, scene: &Scene, frame: &Frame, face: CubeFace) -> PictureMetadata {
    let camera = face.frame(CameraFrame::new(&scene.grounded().camera).position);
    PictureMetadata {
        world_to_camera: header::world_to_camera(&camera),
        field_of_view_rad: FRAC_PI_2,
        ..metadata(arguments, scene, frame)
    }
}

/// One picture of all faces; transparent where none is.
fn assembled(layout: Layout, faces: Vec<Pixels>, side_px: u32) -> Pixels {
    let (mut eight, mut sixteen, mut light, mut depth_m) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for face in faces {
        match face {
            Pixels::Eight(rgba) => eight.push(rgba),
            Pixels::Sixteen(rgba) => sixteen.push(rgba),
            Pixels::Light(picture) => {
                light.push(picture.rgba);
                depth_m.extend(picture.depth_m);
            }
        }
    }
    if !eight.is_empty() {
        return Pixels::Eight(layout.assemble(&eight, side_px, [0; 4]));
    }
    if !sixteen.is_empty() {
        return Pixels::Sixteen(layout.assemble(&sixteen, side_px, [0; 4]));
    }
    Pixels::Light(Picture {
        size_px: layout.grid().map(|faces| faces * side_px),
        rgba: layout.assemble(&light, side_px, [0.0; 4]),
        depth_m: Some(layout.assemble(&depth_m, side_px, SKY_DEPTH_M)),
    })
}
