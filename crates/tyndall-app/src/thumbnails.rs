//! Small pictures of scenes, drawn by a thread with a renderer of its own, so that the window never waits for one.

use std::{
    io,
    sync::{
        Arc,
        mpsc::{Receiver, Sender, channel},
    },
    thread,
};

use tyndall_gpu::Gpu;
use tyndall_render::{FrameTarget, RenderError, Renderer, RendererConfig};
use tyndall_scene::Scene;

use crate::detail::coarse;

/// Size of the pictures.
pub(crate) const SIZE_PX: [u32; 2] = [192, 108];

/// Which picture, and the target with it; none when the scene or the GPU refused.
type Drawn = (usize, Option<FrameTarget>);

/// The thread and what it has been asked for.
#[derive(Debug)]
pub(crate) struct Thumbnails {
    orders: Sender<(usize, Scene)>,
    drawn: Receiver<Drawn>,
    /// Whether a picture is on its way.
    is_busy: bool,
}

impl Thumbnails {
    /// Starts the thread; it ends with this value. `wake` is called whenever a picture has come.
    pub(crate) fn start(gpu: Arc<Gpu>, wake: impl Fn() + Send + 'static) -> io::Result<Self> {
        let (orders, received) = channel();
        let (sender, drawn) = channel();
        let work = move || {
            let mut renderer = Renderer::new(&gpu, RendererConfig::default());
            for (index, scene) in received {
                let target = renderer.as_mut().ok().and_then(|renderer| draw(&gpu, renderer, &scene));
                if sender.send((index, target)).is_err() {
                    return;
                }
                wake();
            }
        };
        thread::Builder::new().name("thumbnails".to_owned()).spawn(work)?;
        Ok(Self { orders, drawn, is_busy: false })
    }

    /// Asks for a picture, unless one is on its way.
    pub(crate) fn order(&mut self, index: usize, scene: &Scene) {
        if !self.is_busy {
            self.is_busy = self.orders.send((index, scene.clone())).is_ok();
        }
    }

    /// The picture that was asked for, once it has come.
    pub(crate) fn take(&mut self) -> Option<Drawn> {
        let drawn = self.drawn.try_recv().ok()?;
        self.is_busy = false;
        Some(drawn)
    }
}

fn draw(gpu: &Gpu, renderer: &mut Renderer, scene: &Scene) -> Option<FrameTarget> {
    try_draw(gpu, renderer, scene)
        .inspect_err(|error| tracing::warn!(%error, title = scene.title, "a small picture cannot be drawn"))
        .ok()
}

fn try_draw(gpu: &Gpu, renderer: &mut Renderer, scene: &Scene) -> Result<FrameTarget, RenderError> {
    let mut target = FrameTarget::new(gpu, SIZE_PX, RendererConfig::default())?;
    let submission = renderer.render(gpu, &coarse(scene), &mut target)?;
    gpu.wait(submission)?;
    Ok(target)
}
