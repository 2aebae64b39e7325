//! Choice of the adapter.

use tyndall_gpu::{AdapterChoice, Gpu, GpuError, GpuOptions};
use tyndall_tests::{gpu, own_gpu};

fn open(adapter: AdapterChoice) -> Result<Gpu, GpuError> {
    Gpu::open(&GpuOptions { adapter, max_memory_bytes: None })
}

#[test]
fn every_adapter_of_the_system_opens_by_its_index_and_says_who_it_is() {
    let reports = Gpu::adapters();
    assert!(!reports.is_empty(), "the shared device came from one");
    for (index, report) in reports.iter().enumerate() {
        let opened = open(AdapterChoice::Index(index)).unwrap_or_else(|error| panic!("{report}: {error}"));
        assert_eq!(opened.adapter(), report, "index {index}");
    }
}

#[test]
fn an_adapter_opens_by_a_part_of_its_name_in_any_case() {
    let name = gpu().adapter().name.to_uppercase();
    let part: String = name.chars().skip(1).take(5).collect();
    let opened = open(AdapterChoice::Name(part.clone())).unwrap_or_else(|error| panic!("{part:?}: {error}"));
    assert!(opened.adapter().name.to_uppercase().contains(&part), "{part:?} gave {}", opened.adapter());
}

#[test]
fn a_name_that_fits_nothing_lists_the_adapters_there_are() {
    let error = open(AdapterChoice::Name("no such card".to_owned())).expect_err("no such card").to_string();
    assert!(error.contains("`no such card`") && error.contains(&gpu().adapter().name), "{error}");
}

#[test]
fn the_limits_are_those_every_adapter_has_but_for_textures_and_buffers() {
    let limits = own_gpu().limits().clone();
    let default = wgpu::Limits::default();
    assert_eq!(limits.max_storage_buffers_per_shader_stage, default.max_storage_buffers_per_shader_stage, "no more");
    assert_eq!(limits.max_compute_workgroup_storage_size, default.max_compute_workgroup_storage_size, "no more");
    assert_eq!(limits.max_bind_groups, default.max_bind_groups, "no more");
    let side = limits.max_texture_dimension_2d;
    assert!((default.max_texture_dimension_2d..=16384).contains(&side), "{side} px");
}

#[test]
fn the_device_without_a_driver_opens_everywhere() {
    let noop = Gpu::noop().expect("it needs no driver");
    assert_eq!(noop.adapter().backend, wgpu::Backend::Noop, "{}", noop.adapter());
}
