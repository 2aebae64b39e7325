//! Marching through sand in the air: optical depth, energy, light and shade.

use half::f16;
use tyndall_gpu::{GpuError, wgpu};
use tyndall_render::desert::gpu_data::{Blowing, Desert, grain_albedo};
use tyndall_tests::gpu;

use crate::rays::{answers, texture};

/// A flat layer: its optical depth straight down, mean height and scale (m), and the height over which the lamp shines.
#[derive(Clone, Copy)]
struct Layer {
    depth: f32,
    height_m: f32,
    scale_m: f32,
    light_m: f32,
}

const LAYER: Layer = Layer { depth: 0.5, height_m: 2.0, scale_m: 0.75, light_m: -100.0 };

const TEXT: &str = "
// @import desert/blowing.wgsl
@group(0) @binding(0) var<storage, read> inputs: array<vec4<f32>>; // height of the eye (m), rise, azimuth (rad), limit (m)
@group(0) @binding(1) var<storage, read_write> outputs: array<vec4<f32>>; // transmittance, direct, distance (m), phase
@compute @workgroup_size(64)
fn blowing_main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= arrayLength(&inputs)) { return; }
    let x = inputs[id.x];
    let flat = sqrt(max(1.0 - x.y * x.y, 0.0));
    let direction = vec3<f32>(flat * cos(x.z), flat * sin(x.z), x.y);
    let light = blowing_march(vec3<f32>(3.0, -7.0, x.x), direction, x.w);
    outputs[id.x] = vec4<f32>(light.transmittance, light.direct, light.distance_m, blowing_phase(x.y));
}
";

/// What rays through a layer find.
fn seen(layer: Layer, inputs: &[[f32; 4]]) -> Result<Vec<[f32; 4]>, GpuError> {
    let gpu = gpu();
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
    let desert = gpu.buffer("desert", size_of::<Desert>() as u64, usage)?;
    let blowing = gpu.buffer("blowing", size_of::<Blowing>() as u64, usage)?;
    let field = Desert { cell_m: 1.0, size: [1.0, 1.0], wraps: 1, ..bytemuck::Zeroable::zeroed() };
    gpu.queue.write_buffer(&desert, 0, bytemuck::bytes_of(&field));
    let sand = Blowing {
        albedo: [1.0; 3],
        along: [1.0, 0.0],
        top_m: layer.height_m + 12.0 * layer.scale_m,
        floor_m: layer.height_m - 12.0 * layer.scale_m,
        streaks_a_metre: 0.1,
        ..bytemuck::Zeroable::zeroed()
    };
    gpu.queue.write_buffer(&blowing, 0, bytemuck::bytes_of(&sand));
    let half = |value: f32| f16::from_f32(value).to_bits();
    let column = [layer.depth, layer.height_m, layer.scale_m, layer.light_m].map(half);
    let columns = texture(gpu, wgpu::TextureFormat::Rgba16Float, 1, &column);
    let streaks = texture(gpu, wgpu::TextureFormat::R16Float, 1, &[half(1.0)]);
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor::default());
    let own = [
        ("desert", desert.as_entire_binding()),
        ("blowing", blowing.as_entire_binding()),
        ("blowing_repeated", wgpu::BindingResource::Sampler(&sampler)),
        ("blowing_sampler", wgpu::BindingResource::Sampler(&sampler)),
        ("blowing_columns", wgpu::BindingResource::TextureView(&columns)),
        ("blowing_streaks", wgpu::BindingResource::TextureView(&streaks)),
    ];
    answers(gpu, (TEXT, "blowing_main"), inputs, &own)
}

/// Rays from a height (m) with a rise, from many sides.
fn rays(height_m: f32, rise: f32) -> Vec<[f32; 4]> {
    (0..64_u16).map(|index| [height_m, rise, 0.1 * f32::from(index), 1e6]).collect()
}

/// Share of a layer's depth below a height (m).
fn below(layer: Layer, height_m: f32) -> f32 {
    1.0 / (1.0 + ((layer.height_m - height_m) / layer.scale_m).exp())
}

#[test]
fn a_ray_through_a_layer_meets_its_depth_over_the_sine_of_the_ray() {
    for (height_m, rise) in [(40.0, -1.0), (40.0, -0.5), (15.0, -0.1), (-9.0, 0.3), (2.0, 0.2), (2.0, -0.2)] {
        for [transmittance, direct, ..] in seen(LAYER, &rays(height_m, rise)).expect("the shader runs") {
            let above = 1.0 - below(LAYER, height_m);
            let share = if rise > 0.0 { above } else { 1.0 - above };
            let wanted = (-LAYER.depth * share / rise.abs()).exp();
            // Half floats of the layer's numbers are exact; its ends are cut at 12 scales.
            assert!((transmittance - wanted).abs() < 2e-3, "from {height_m} m, rise {rise}: {transmittance}, {wanted}");
            assert!((transmittance + direct - 1.0).abs() < 1e-5, "in full light all that is taken may be scattered");
        }
    }
}

#[test]
fn the_optical_depth_of_a_ray_is_linear_in_that_of_the_air() {
    let depth = |factor: f32| {
        let layer = Layer { depth: 0.02 * factor, ..LAYER };
        let found = seen(layer, &rays(5.0, -0.15)).expect("the shader runs");
        found.into_iter().map(|[transmittance, ..]| -transmittance.ln()).collect::<Vec<_>>()
    };
    for (one, eight) in depth(1.0).into_iter().zip(depth(8.0)) {
        assert!((eight / one - 8.0).abs() < 0.02, "{one} and {eight}");
    }
}

#[test]
fn no_sand_takes_nothing_and_what_is_in_front_of_it_hides_it() {
    for [transmittance, direct, ..] in seen(Layer { depth: 0.0, ..LAYER }, &rays(5.0, -0.2)).expect("the shader runs") {
        assert_eq!([transmittance, direct].map(f32::to_bits), [1.0_f32, 0.0].map(f32::to_bits), "clear air");
    }
    let near: Vec<[f32; 4]> =
        rays(40.0, -0.5).into_iter().map(|[height, rise, azimuth, _]| [height, rise, azimuth, 20.0]).collect();
    for [transmittance, ..] in seen(LAYER, &near).expect("the shader runs") {
        assert!(transmittance > 0.9999, "a rock 20 m away hides a layer at 70 m: {transmittance}");
    }
}

#[test]
fn sand_under_the_height_of_the_light_is_not_lit() {
    // So thin that the lower half gets as much as the upper one.
    let layer = Layer { light_m: LAYER.height_m, depth: 0.01, ..LAYER };
    for [transmittance, direct, distance_m, _] in seen(layer, &rays(40.0, -0.8)).expect("the shader runs") {
        let share = direct / (1.0 - transmittance);
        assert!((share - 0.5).abs() < 0.03, "{share} of what is taken is lit, half of it wanted");
        assert!((distance_m - 38.0 / 0.8).abs() < 0.5, "{distance_m} m away");
    }
}

#[test]
fn grains_scatter_all_light_that_they_do_not_take_and_darker_sand_has_darker_grains() {
    let steps = 4000_u16;
    let cosine = |step: u16| 2.0 * (f32::from(step) + 0.5) / f32::from(steps) - 1.0;
    let inputs: Vec<[f32; 4]> = (0..steps).map(|step| [1e3, cosine(step), 0.0, 1.0]).collect();
    let sum: f64 = seen(LAYER, &inputs).expect("the shader runs").iter().map(|[.., phase]| f64::from(*phase)).sum();
    let over_sphere = sum * 2.0 / f64::from(steps) * std::f64::consts::TAU;
    assert!((over_sphere - 1.0).abs() < 1e-4, "the phase function sums to {over_sphere}");
    assert!((grain_albedo(1.0) - 1.0).abs() < 1e-12 && grain_albedo(0.0).abs() < 1e-12, "white and black");
    assert!(grain_albedo(0.36) > 0.7 && grain_albedo(0.36) < 0.85, "{}", grain_albedo(0.36));
}
