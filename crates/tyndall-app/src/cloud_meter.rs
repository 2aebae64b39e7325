//! The picture of the scene's clouds against random walks through their cells.

use tyndall_gpu::{Gpu, GpuOptions};
use tyndall_render::clouds::comparison::{CloudComparison, CloudVerdict};
use tyndall_render::{FrameFormat, RenderError, Renderer, RendererConfig};
use tyndall_scene::{CloudKind, Scene};

use crate::{error_meter::Thoroughness, meter::Meter};

/// Comparisons of clouds.
pub(crate) type CloudMeter = Meter<CloudSubject, CloudVerdict>;

/// The clouds that are judged: the scene as the comparison sees it, without what it leaves out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CloudSubject(Scene);

impl CloudSubject {
    /// The clouds of a scene; `None` when it has none.
    pub(crate) fn of(scene: &Scene) -> Option<Self> {
        // What is said of the scene and how its picture is developed change no cloud.
        let mut seen = comparison(Thoroughness::Quick).scene(scene);
        seen.title.clear();
        seen.film = Scene::default().film;
        (scene.clouds.kind != CloudKind::None).then_some(Self(seen))
    }
}

/// Pictures a sixth as wide as a screen, and more walks for those who wait longer.
fn comparison(thoroughness: Thoroughness) -> CloudComparison {
    let (size_px, paths) = match thoroughness {
        Thoroughness::Quick => ([96, 64], 16),
        Thoroughness::Normal => ([144, 96], 64),
        Thoroughness::Thorough => ([192, 128], 512),
    };
    CloudComparison { size_px, paths, seed: 1, bin: 4 }
}

/// Starts a comparison of clouds on another device of an adapter; `wake` is called whenever there is news.
pub(crate) fn start(
    meter: &mut CloudMeter,
    (options, subject): (GpuOptions, CloudSubject),
    thoroughness: Thoroughness,
    wake: impl Fn() + Send + Sync + 'static,
) {
    let compare = move |CloudSubject(scene): &CloudSubject, progress: &(dyn Fn(f64) -> bool + Sync)| {
        let config = RendererConfig { frame: FrameFormat::Float, ..RendererConfig::default() };
        let run = || {
            let gpu = Gpu::open(&options).map_err(RenderError::from)?;
            let mut renderer = Renderer::new(&gpu, config)?;
            comparison(thoroughness).run((&gpu, &mut renderer), scene, &mut |share| progress(share))
        };
        match run() {
            Ok(CloudVerdict::Stopped) => Ok(None),
            Ok(verdict) => Ok(Some(verdict)),
            Err(error) => Err(error.to_string()),
        }
    };
    meter.start(subject, compare, wake);
}
