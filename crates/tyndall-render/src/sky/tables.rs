//! The sky's tables on the GPU.

use std::sync::Arc;

use tyndall_core::table_store::TableStore;
use tyndall_gpu::wgpu::{self, BufferUsages, TextureFormat, TextureUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, PassTimer, Shader, Texture, TextureDesc};
use tyndall_scattering::Atmosphere as Model;
use tyndall_scattering::column_table::COLUMN_TABLE_SIZE;
use tyndall_scattering::irradiance_table::IRRADIANCE_TABLE_SIZE;
use tyndall_scattering::orders::OrdersQuality;
use tyndall_scene::Scene;

use super::building::TableBuilding;
use super::gpu_data::{Atmosphere, SkyView};
use super::night::Night;
use super::orders::{OrdersRequest, OrdersTable};
use crate::RenderError;
use crate::frame::gpu_data::Frame;

/// What the column and irradiance tables follow from.
type Inputs = (Atmosphere, Option<OrdersQuality>);

/// Column, irradiance and sky-view tables, their uniforms and the pipelines that fill them.
#[derive(Debug)]
pub struct SkyTables {
    fill_columns: ComputePipeline,
    fill_irradiance: ComputePipeline,
    fill_sky_view: ComputePipeline,
    fill_sky_view_diffuse: ComputePipeline,
    fill_irradiance_diffuse: ComputePipeline,
    orders: OrdersTable,
    pub(crate) atmosphere: Buffer,
    pub(crate) view: Buffer,
    pub(crate) columns: Texture,
    pub(crate) irradiance: Texture,
    pub(super) sky_view_air: Texture,
    pub(super) sky_view_aerosol: Texture,
    /// Small and unused without haze.
    pub(super) sky_view_haze: Texture,
    pub(super) sky_view_diffuse: Texture,
    pub(super) night: Night,
    filled_for: Option<(Inputs, [u32; 8])>,
    /// The orders table that the others were filled from.
    filled_from: u64,
    /// Counts the fillings of any table.
    revision: u64,
}

impl SkyTables {
    /// Pipelines and empty tables.
    ///
    /// # Errors
    /// When a shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let pipeline = |file: &str, entry: &str| ComputePipeline::new(gpu, &Shader::load(gpu, file)?, entry, &[]);
        let uniform =
            |label, bytes: usize| gpu.buffer(label, bytes as u64, BufferUsages::UNIFORM | BufferUsages::COPY_DST);
        let columns = COLUMN_TABLE_SIZE.map(small);
        Ok(Self {
            fill_columns: pipeline("sky/column_table.wgsl", "column_table")?,
            fill_irradiance: pipeline("sky/irradiance_table.wgsl", "irradiance_table")?,
            fill_sky_view: pipeline("sky/sky_view_table.wgsl", "sky_view_table")?,
            fill_sky_view_diffuse: pipeline("sky/sky_view_diffuse.wgsl", "sky_view_diffuse")?,
            fill_irradiance_diffuse: pipeline("sky/irradiance_diffuse.wgsl", "irradiance_diffuse")?,
            orders: OrdersTable::new(gpu)?,
            atmosphere: uniform("atmosphere", size_of::<Atmosphere>())?,
            view: uniform("sky view", size_of::<SkyView>())?,
            columns: table(gpu, "column table", columns)?,
            irradiance: table(gpu, "irradiance table", [small(IRRADIANCE_TABLE_SIZE), IRRADIANCE_ROWS])?,
            sky_view_air: table(gpu, "sky-view table, air", [8, 8])?,
            sky_view_aerosol: table(gpu, "sky-view table, aerosol", [8, 8])?,
            sky_view_haze: table(gpu, "sky-view table, haze", [8, 8])?,
            sky_view_diffuse: table(gpu, "sky-view table, diffuse", [8, 8])?,
            night: Night::new(gpu)?,
            filled_for: None,
            filled_from: 0,
            revision: 0,
        })
    }

    /// Uploads what the sky of the night follows from, for a frame whose pixels are `pixel_rad` wide.
    ///
    /// # Errors
    /// When the scene's values do not fit together or memory does not suffice.
    pub fn update_night(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        model: &Model,
        frame: (&Frame, f64),
    ) -> Result<(), RenderError> {
        self.night.update(gpu, scene, model, frame)
    }

    /// Whether light of the night shows in the frame of the last [`SkyTables::update_night`].
    pub(crate) fn is_night_drawn(&self) -> bool {
        self.night.is_drawn()
    }

    /// Uploads the uniforms and records the filling of the tables whose inputs changed.
    ///
    /// # Errors
    /// When memory does not suffice for tables of a new size.
    pub fn update(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        (atmosphere, view): (Atmosphere, SkyView),
        orders: &OrdersRequest<'_>,
    ) -> Result<(), RenderError> {
        gpu.queue.write_buffer(&self.atmosphere, 0, bytemuck::bytes_of(&atmosphere));
        gpu.queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&view));
        let key = view.table_key();
        let inputs = (atmosphere, orders.quality);
        let filled = self.filled_for.take();
        let same_inputs = filled.is_some_and(|(filled, _)| filled == inputs);
        if !same_inputs {
            // Submitted apart from the frame: the orders need the columns, in submissions of their own.
            let mut first =
                gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("columns") });
            self.record_columns(gpu, &mut first, timer)?;
            gpu.queue.submit([first.finish()]);
        }
        self.orders.update(gpu, &self.columns, orders)?;
        let same_orders = self.filled_from == self.orders.version();
        if !(same_inputs && same_orders) {
            self.record_irradiance(gpu, encoder, timer)?;
        }
        if !(same_orders && filled == Some((inputs, key))) {
            self.resize(gpu, &view, atmosphere.haze_strongest > 0.0)?;
            self.record_sky_view(gpu, encoder, timer)?;
        }
        let shared = (&self.columns, &self.orders.uniform, &self.orders.table);
        self.night.moon.record(gpu, encoder, timer, shared, self.orders.version())?;
        if !(same_orders && filled == Some((inputs, key))) {
            self.revision += 1;
        }
        self.filled_for = Some((inputs, key));
        self.filled_from = self.orders.version();
        Ok(())
    }

    fn resize(&mut self, gpu: &Gpu, view: &SkyView, hazy: bool) -> Result<(), RenderError> {
        if self.sky_view_air.size_px() != view.table_size {
            self.sky_view_air = table(gpu, "sky-view table, air", view.table_size)?;
            self.sky_view_aerosol = table(gpu, "sky-view table, aerosol", view.table_size)?;
        }
        let haze_size = if hazy { view.table_size } else { [8, 8] };
        if self.sky_view_haze.size_px() != haze_size {
            self.sky_view_haze = table(gpu, "sky-view table, haze", haze_size)?;
        }
        if self.sky_view_diffuse.size_px() != view.diffuse_size() {
            self.sky_view_diffuse = table(gpu, "sky-view table, diffuse", view.diffuse_size())?;
        }
        Ok(())
    }

    /// Counts the fillings of any table: what was made from them is out of date when this number has changed.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// What shaders need that march through the air near the ground, by the names of their variables.
    #[must_use]
    pub fn air_bindings(&self) -> Vec<(&'static str, wgpu::BindingResource<'_>)> {
        vec![
            ("atmosphere", self.atmosphere.as_entire_binding()),
            ("column_table", self.columns.as_binding()),
            ("sky_view", self.view.as_entire_binding()),
            ("irradiance_table", self.irradiance.as_binding()),
            ("orders", self.orders.uniform.as_entire_binding()),
            ("orders_source", self.orders.table.as_entire_binding()),
        ]
    }

    /// What `sky/sky_view_lookup.wgsl` and `sky/column_lookup.wgsl` need, by the names of their variables.
    #[must_use]
    pub(crate) fn view_bindings(&self) -> [(&'static str, wgpu::BindingResource<'_>); 7] {
        [
            ("atmosphere", self.atmosphere.as_entire_binding()),
            ("column_table", self.columns.as_binding()),
            ("sky_view", self.view.as_entire_binding()),
            ("sky_view_air", self.sky_view_air.as_binding()),
            ("sky_view_aerosol", self.sky_view_aerosol.as_binding()),
            ("sky_view_haze", self.sky_view_haze.as_binding()),
            ("sky_view_diffuse", self.sky_view_diffuse.as_binding()),
        ]
    }

    /// What `sky/moon_sky.wgsl` needs, by the names of its variables.
    pub(crate) fn moon_bindings(&self) -> [(&'static str, wgpu::BindingResource<'_>); 2] {
        self.night.moon_bindings()
    }

    /// Forgets what the tables hold, so that the next frame fills them again.
    pub fn invalidate(&mut self) {
        self.filled_for = None;
        self.night.moon.invalidate();
        self.orders.invalidate();
    }

    fn record_columns(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
    ) -> Result<(), RenderError> {
        let bindings = self.fill_columns.bind(
            gpu,
            0,
            &[("atmosphere", self.atmosphere.as_entire_binding()), ("column_texels", self.columns.as_binding())],
        )?;
        let [width, height] = self.columns.size_px();
        dispatch(encoder, timer, "column table", &self.fill_columns, &bindings, [width, height, 1]);
        Ok(())
    }

    fn record_irradiance(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
    ) -> Result<(), RenderError> {
        let bindings = self.fill_irradiance.bind(
            gpu,
            0,
            &[
                ("atmosphere", self.atmosphere.as_entire_binding()),
                ("column_table", self.columns.as_binding()),
                ("irradiance_texels", self.irradiance.as_binding()),
            ],
        )?;
        let suns = small(IRRADIANCE_TABLE_SIZE);
        let threads = self.fill_irradiance.workgroup_size()[0];
        dispatch(encoder, timer, "irradiance table", &self.fill_irradiance, &bindings, [suns * threads, 1, 1]);
        let bindings = self.fill_irradiance_diffuse.bind(
            gpu,
            0,
            &[
                ("orders", self.orders.uniform.as_entire_binding()),
                ("orders_source", self.orders.table.as_entire_binding()),
                ("irradiance_texels", self.irradiance.as_binding()),
            ],
        )?;
        let name = "irradiance table, diffuse";
        dispatch(encoder, timer, name, &self.fill_irradiance_diffuse, &bindings, [suns, 1, 1]);
        Ok(())
    }

    fn record_sky_view(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
    ) -> Result<(), RenderError> {
        let bindings = self.fill_sky_view.bind(
            gpu,
            0,
            &[
                ("atmosphere", self.atmosphere.as_entire_binding()),
                ("column_table", self.columns.as_binding()),
                ("sky_view", self.view.as_entire_binding()),
                ("sky_view_air_texels", self.sky_view_air.as_binding()),
                ("sky_view_aerosol_texels", self.sky_view_aerosol.as_binding()),
                ("sky_view_haze_texels", self.sky_view_haze.as_binding()),
            ],
        )?;
        let [width, height] = self.sky_view_air.size_px();
        dispatch(encoder, timer, "sky-view table", &self.fill_sky_view, &bindings, [width, height, 1]);
        let bindings = self.fill_sky_view_diffuse.bind(
            gpu,
            0,
            &[
                ("atmosphere", self.atmosphere.as_entire_binding()),
                ("sky_view", self.view.as_entire_binding()),
                ("orders", self.orders.uniform.as_entire_binding()),
                ("orders_source", self.orders.table.as_entire_binding()),
                ("sky_view_diffuse_texels", self.sky_view_diffuse.as_binding()),
            ],
        )?;
        let [width, height] = self.sky_view_diffuse.size_px();
        let name = "sky-view table, diffuse";
        dispatch(encoder, timer, name, &self.fill_sky_view_diffuse, &bindings, [width, height, 1]);
        Ok(())
    }

    /// The column table's texture, for tests.
    #[must_use]
    pub fn columns(&self) -> &Texture {
        &self.columns
    }

    /// The irradiance table's texture, for tests.
    #[must_use]
    pub fn irradiance(&self) -> &Texture {
        &self.irradiance
    }

    /// The sky-view table's textures, air, aerosol and haze, for tests. That of the haze is small and unused without.
    #[must_use]
    pub fn sky_view(&self) -> [&Texture; 3] {
        [&self.sky_view_air, &self.sky_view_aerosol, &self.sky_view_haze]
    }

    /// The diffuse part of the sky-view table, for tests.
    #[must_use]
    pub fn sky_view_diffuse(&self) -> &Texture {
        &self.sky_view_diffuse
    }

    /// The table of diffuse light of all orders.
    #[must_use]
    pub fn orders(&self) -> &OrdersTable {
        &self.orders
    }

    /// Chooses where tables of the CPU are kept between runs.
    pub fn set_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        self.orders.set_store(store);
    }

    /// Chooses when the slow table of all orders is made.
    pub fn set_building(&mut self, building: TableBuilding) {
        self.orders.set_building(building);
    }
}

/// Rows of the irradiance table: two of light scattered once, two of light scattered more often.
const IRRADIANCE_ROWS: u32 = 4;

fn table(gpu: &Gpu, label: &str, size_px: [u32; 2]) -> Result<Texture, RenderError> {
    let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
    Ok(gpu.texture(&TextureDesc::new_2d(label, size_px, TextureFormat::Rgba32Float, usage))?)
}

#[expect(clippy::cast_possible_truncation, reason = "sizes of tables")]
fn small(count: usize) -> u32 {
    count as u32
}

fn dispatch(
    encoder: &mut wgpu::CommandEncoder,
    timer: &mut PassTimer,
    name: &'static str,
    pipeline: &ComputePipeline,
    bindings: &wgpu::BindGroup,
    invocations: [u32; 3],
) {
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some(name),
        timestamp_writes: timer.compute_writes(name),
    });
    pass.set_bind_group(0, bindings, &[]);
    pipeline.dispatch(&mut pass, invocations);
}
