//! What the commands that draw a scene have in common: the scene, and what draws it.

use std::path::PathBuf;

use tyndall_gpu::{AdapterChoice, GpuOptions};
use tyndall_scene::Scene;

use crate::Failure;
use crate::cache::CacheArguments;
use crate::render::source;
use crate::values::{parse_bytes, parse_setting};

/// A scene, with what the command line changes in it.
#[derive(Clone, Debug, clap::Args)]
pub struct SceneArguments {
    /// Scene file, or `preset:NAME` for a scene that comes with Tyndall
    #[arg(value_name = "SCENE")]
    pub source: PathBuf,
    /// Change a parameter of the scene; may be repeated
    #[arg(long, value_name = "GROUP.KEY=VALUE", value_parser = parse_setting)]
    pub set: Vec<(String, String)>,
}

impl SceneArguments {
    /// Loads and checks the scene.
    ///
    /// # Errors
    /// When there is no such scene, or a value is not allowed.
    pub fn load(&self) -> Result<Scene, Failure> {
        source::load_with(&self.source, &self.set)
    }
}

/// What draws, and with how much memory.
#[derive(Clone, Debug, clap::Args)]
pub struct DeviceArguments {
    /// Graphics adapter: auto, software, an index or a part of its name (see `tyndall doctor`)
    #[arg(long, value_name = "ADAPTER", default_value_t)]
    pub adapter: AdapterChoice,
    /// Most memory for pictures, such as 8G; by default what the system has to spare
    #[arg(long, value_name = "BYTES", value_parser = parse_bytes)]
    pub max_memory: Option<u64>,
    /// Whether tables are kept between runs.
    #[command(flatten)]
    pub cache: CacheArguments,
}

impl DeviceArguments {
    /// The device to open.
    #[must_use]
    pub fn options(&self) -> GpuOptions {
        GpuOptions { adapter: self.adapter.clone(), max_memory_bytes: self.max_memory }
    }
}
