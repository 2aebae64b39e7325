//! The window: which device it asks for, and what to say when there is none.

use std::{process::ExitCode, sync::Arc};

use eframe::{NativeOptions, Renderer};
use egui::{ViewportBuilder, vec2};
use egui_wgpu::{NativeAdapterSelectorMethod, WgpuConfiguration, WgpuError, WgpuSetup, WgpuSetupCreateNew, wgpu};
use tyndall_gpu::{AdapterChoice, Gpu, GpuOptions};

use crate::{App, AppOptions};

/// Identifies the program to the desktop and names the folder of what it stores.
const APP_ID: &str = "tyndall";

/// No graphics adapter; the command line program has the same code.
const EXIT_NO_ADAPTER: u8 = 3;

const WINDOW_PT: egui::Vec2 = vec2(1440.0, 900.0);
const MIN_WINDOW_PT: egui::Vec2 = vec2(800.0, 520.0);

/// Opens the window and returns when it is closed.
#[must_use]
pub fn run(mut options: AppOptions) -> ExitCode {
    options.data_dir = options.data_dir.or_else(|| Some(eframe::storage_dir(APP_ID)?.join("recovery")));
    let native = NativeOptions {
        viewport: ViewportBuilder::default()
            .with_app_id(APP_ID)
            .with_title("Tyndall")
            .with_inner_size(WINDOW_PT)
            .with_min_inner_size(MIN_WINDOW_PT),
        renderer: Renderer::Wgpu,
        wgpu_options: wgpu_configuration(&options.adapter),
        ..NativeOptions::default()
    };
    let result = eframe::run_native(APP_ID, native, Box::new(move |context| Ok(Box::new(App::new(context, options)))));
    result.map_or_else(|error| explain(&error), |()| ExitCode::SUCCESS)
}

/// A device with the limits and the timestamps that the renderer wants, on the adapter chosen.
#[must_use]
pub fn wgpu_configuration(choice: &AdapterChoice) -> WgpuConfiguration {
    let base = WgpuSetupCreateNew::without_display_handle();
    let setup = WgpuSetupCreateNew {
        // OpenGL is compiled in by egui, but the renderer is not made for it.
        instance_descriptor: wgpu::InstanceDescriptor {
            backends: base.instance_descriptor.backends & wgpu::Backends::PRIMARY,
            ..base.instance_descriptor
        },
        native_adapter_selector: selector(choice.clone()),
        device_descriptor: Arc::new(|adapter| wgpu::DeviceDescriptor {
            label: Some("tyndall"),
            required_features: wgpu::Features::TIMESTAMP_QUERY & adapter.features(),
            required_limits: Gpu::wanted_limits(adapter),
            ..Default::default()
        }),
        display_handle: base.display_handle,
        power_preference: base.power_preference,
    };
    WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..WgpuConfiguration::default() }
}

/// Picks among the adapters that can show the window; `None` leaves the choice to the system.
fn selector(choice: AdapterChoice) -> Option<NativeAdapterSelectorMethod> {
    if choice == AdapterChoice::Auto {
        return None;
    }
    Some(Arc::new(move |adapters, surface| {
        let usable = |adapter: &&wgpu::Adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface));
        let usable: Vec<_> = adapters.iter().filter(usable).collect();
        let found = match &choice {
            AdapterChoice::Auto => usable.first(),
            AdapterChoice::Software => usable.iter().find(|a| a.get_info().device_type == wgpu::DeviceType::Cpu),
            AdapterChoice::Index(index) => usable.get(*index),
            AdapterChoice::Name(part) => {
                usable.iter().find(|a| a.get_info().name.to_lowercase().contains(&part.to_lowercase()))
            }
        };
        if usable.is_empty() {
            return Err(no_adapter());
        }
        let names: Vec<_> = usable.iter().map(|adapter| adapter.get_info().name).collect();
        let missing = || format!("no adapter fits `{choice}`; there are: {}", names.join(", "));
        found.map(|adapter| (*adapter).clone()).ok_or_else(missing)
    }))
}

/// What to install, or that what there is shows no window.
fn no_adapter() -> String {
    match Gpu::open(&GpuOptions::default()) {
        Err(reason) => reason.to_string(),
        Ok(_) => "no graphics adapter can show a window".to_owned(),
    }
}

/// One sentence on stderr, and the exit code.
#[expect(clippy::print_stderr, reason = "there is no window to say it in")]
fn explain(error: &eframe::Error) -> ExitCode {
    let (sentence, code) = match error {
        eframe::Error::Wgpu(WgpuError::CustomNativeAdapterSelectionError(reason)) => {
            (reason.clone(), ExitCode::from(EXIT_NO_ADAPTER))
        }
        eframe::Error::Wgpu(reason) => {
            tracing::debug!(%reason, "no window");
            (no_adapter(), ExitCode::from(EXIT_NO_ADAPTER))
        }
        eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => {
            (format!("no window can be opened: {error}; `tyndall render` needs none"), ExitCode::FAILURE)
        }
        eframe::Error::AppCreation(reason) => (reason.to_string(), ExitCode::FAILURE),
    };
    eprintln!("tyndall-app: {sentence}");
    code
}
