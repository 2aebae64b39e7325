//! Small pictures of scenes, drawn by a thread with a device and a renderer of its own, so that the window never waits for one.

use std::{
    io,
    sync::mpsc::{Receiver, Sender, channel},
    thread,
};

use egui::ColorImage;
use tyndall_gpu::{Gpu, GpuOptions};
use tyndall_render::{FrameTarget, RenderError, Renderer, RendererConfig};
use tyndall_scene::Scene;

use crate::detail::coarse;

/// Size of the pictures.
pub(crate) const SIZE_PX: [u32; 2] = [192, 108];

/// Which picture, and what it shows; nothing when the scene or the GPU refused.
type Drawn = (usize, Option<ColorImage>);

/// The thread and what it has been asked for.
#[derive(Debug)]
pub(crate) struct Thumbnails {
    orders: Sender<(usize, Scene)>,
    drawn: Receiver<Drawn>,
    /// Whether a picture is on its way.
    is_busy: bool,
}

impl Thumbnails {
    /// Starts the thread on an adapter; it ends with this value. `wake` is called whenever a picture has come.
    pub(crate) fn start(options: GpuOptions, wake: impl Fn() + Send + 'static) -> io::Result<Self> {
        let (orders, received) = channel();
        let (sender, drawn) = channel();
        let work = move || {
            let mut easel = Easel::new(&options).inspect_err(|error| tracing::warn!(%error, "no small pictures"));
            for (index, scene) in received {
                let picture = easel.as_mut().ok().and_then(|easel| easel.draw(&scene));
                if sender.send((index, picture)).is_err() {
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

/// What draws them.
struct Easel {
    gpu: Gpu,
    renderer: Renderer,
}

impl Easel {
    fn new(options: &GpuOptions) -> Result<Self, RenderError> {
        let gpu = Gpu::open(options)?;
        let renderer = Renderer::new(&gpu, RendererConfig::default())?;
        Ok(Self { gpu, renderer })
    }

    fn draw(&mut self, scene: &Scene) -> Option<ColorImage> {
        self.try_draw(scene)
            .inspect_err(|error| tracing::warn!(%error, title = scene.title, "a small picture cannot be drawn"))
            .ok()
    }

    fn try_draw(&mut self, scene: &Scene) -> Result<ColorImage, RenderError> {
        let mut target = FrameTarget::new(&self.gpu, SIZE_PX, RendererConfig::default())?;
        let submission = self.renderer.render(&self.gpu, &coarse(scene), &mut target)?;
        self.gpu.wait(submission)?;
        let pixels = target.read_picture8(&self.gpu)?;
        Ok(ColorImage::from_rgba_unmultiplied(SIZE_PX.map(|side| side as usize), pixels.as_flattened()))
    }
}
