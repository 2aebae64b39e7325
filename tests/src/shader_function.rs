//! WGSL functions, run on many inputs and compared with their Rust twins.

use std::fmt::Write as _;
use std::ops::RangeInclusive;

use tyndall_gpu::{ComputePipeline, Gpu, GpuError, Shader, wgpu};

use crate::{Tolerance, gpu};

/// Steps of the additive recurrence: powers of 1/g, where g^5 = g + 1 (the golden ratio's relative in four dimensions).
const STEP: [f64; 4] = [0.856_674_883_854_502_9, 0.733_891_856_627_126, 0.628_706_721_037_808_6, 0.538_597_257_223_61];

/// Fewer inputs than this say little about a function.
const MIN_INPUTS: usize = 1000;

/// Compares the value of a WGSL expression in `x: vec4<f32>` with a reference in f64, on each of the inputs. `imports`
/// are shader files as an `@import` line names them.
///
/// # Panics
/// When a value is outside the tolerance, the expression is not valid, or there are fewer than 1000 inputs.
pub fn assert_matches_cpu(
    expression: &str,
    imports: &[&str],
    inputs: &[[f32; 4]],
    reference: impl Fn([f64; 4]) -> f64,
    tolerance: Tolerance,
) {
    assert!(inputs.len() >= MIN_INPUTS, "`{expression}` is tried on {} inputs, fewer than {MIN_INPUTS}", inputs.len());
    let values = evaluate(expression, imports, inputs);
    if let Some(report) = mismatch(expression, inputs, &values, reference, tolerance) {
        panic!("{report}");
    }
}

/// The value of a WGSL expression in `x: vec4<f32>` for each of the inputs.
///
/// # Panics
/// When the expression is not valid.
pub fn evaluate(expression: &str, imports: &[&str], inputs: &[[f32; 4]]) -> Vec<f32> {
    let lines = imports.iter().fold(String::new(), |mut lines, import| {
        let _infallible = writeln!(lines, "// @import {import}");
        lines
    });
    evaluate_text(&lines, expression, inputs).unwrap_or_else(|error| panic!("`{expression}`: {error}"))
}

/// As [`evaluate`], with WGSL text in front of the expression in place of imports.
///
/// # Errors
/// When the text or the expression is not valid.
pub fn evaluate_text(text: &str, expression: &str, inputs: &[[f32; 4]]) -> Result<Vec<f32>, GpuError> {
    let gpu = gpu();
    let shader = Shader::from_source(gpu, "test.wgsl", &wrap(text, expression))?;
    let pipeline = ComputePipeline::new(gpu, &shader, "harness_main", &[])?;
    run(gpu, &pipeline, inputs)
}

fn wrap(text: &str, expression: &str) -> String {
    format!(
        "{text}
@group(0) @binding(0) var<storage, read> harness_inputs: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> harness_outputs: array<f32>;
@compute @workgroup_size(64)
fn harness_main(@builtin(global_invocation_id) harness_id: vec3<u32>) {{
    if (harness_id.x >= arrayLength(&harness_inputs)) {{ return; }}
    let x = harness_inputs[harness_id.x];
    harness_outputs[harness_id.x] = {expression};
}}
"
    )
}

fn run(gpu: &Gpu, pipeline: &ComputePipeline, inputs: &[[f32; 4]]) -> Result<Vec<f32>, GpuError> {
    let count = inputs.len();
    let storage = wgpu::BufferUsages::STORAGE;
    let xs = gpu.buffer("inputs", 16 * count as u64, storage | wgpu::BufferUsages::COPY_DST)?;
    let ys = gpu.buffer("outputs", 4 * count as u64, storage | wgpu::BufferUsages::COPY_SRC)?;
    gpu.queue.write_buffer(&xs, 0, bytemuck::cast_slice(inputs));
    let resources = [("harness_inputs", xs.as_entire_binding()), ("harness_outputs", ys.as_entire_binding())];
    let bindings = pipeline.bind(gpu, 0, &resources)?;
    let invocations = u32::try_from(count).unwrap_or(u32::MAX);
    gpu.validated("evaluating a WGSL expression", |device| {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_bind_group(0, &bindings, &[]);
        pipeline.dispatch(&mut pass, [invocations, 1, 1]);
        drop(pass);
        gpu.queue.submit([encoder.finish()])
    })?;
    Ok(bytemuck::pod_collect_to_vec(&gpu.read_buffer(&ys)?))
}

/// What is wrong with the values, if anything: how many are outside the tolerance, and the worst of them.
pub fn mismatch(
    expression: &str,
    inputs: &[[f32; 4]],
    values: &[f32],
    reference: impl Fn([f64; 4]) -> f64,
    tolerance: Tolerance,
) -> Option<String> {
    let mut failures = 0;
    let mut worst = (1.0, String::new());
    for (input, value) in inputs.iter().zip(values) {
        let want = reference(input.map(f64::from));
        let excess = tolerance.excess(f64::from(*value), want);
        failures += usize::from(excess > 1.0);
        if excess > worst.0 {
            worst = (excess, format!("for x = {input:?} the shader gives {value}, the reference {want}"));
        }
    }
    let all = inputs.len();
    (failures > 0).then(|| {
        format!(
            "`{expression}`: {failures} of {all} values outside {tolerance:?}; the worst by a factor {:.3}: {}",
            worst.0, worst.1
        )
    })
}

/// `count` points of a box: its 16 corners, then points that fill it evenly (an additive recurrence in four dimensions).
/// Functions of fewer arguments give the unused axes the range `0.0..=0.0`.
///
/// # Panics
/// When `count` is below 16.
#[must_use]
pub fn sample_box(ranges: &[RangeInclusive<f32>; 4], count: usize) -> Vec<[f32; 4]> {
    assert!(count >= 16, "the corners alone are 16 points, {count} were asked for");
    let place = |axis: usize, share: f64| {
        let (low, high) = (f64::from(*ranges[axis].start()), f64::from(*ranges[axis].end()));
        #[expect(clippy::cast_possible_truncation, reason = "an input of the shader is an f32")]
        let value = (low + (high - low) * share) as f32;
        value.clamp(*ranges[axis].start(), *ranges[axis].end())
    };
    let corners = (0..16_u32).map(|bits| std::array::from_fn(|axis| place(axis, f64::from(bits >> axis & 1))));
    let inner = (1..=count - 16).map(|i| std::array::from_fn(|axis| place(axis, (i as f64 * STEP[axis]).fract())));
    corners.chain(inner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sampled_boxes_contain_corners_and_stay_inside() {
        let points = sample_box(&[-1.0..=1.0, 2.0..=2.0, 0.0..=10.0, -5.0..=-4.0], 1000);
        assert_eq!(points.len(), 1000, "as many as asked for");
        assert!(points.contains(&[1.0, 2.0, 0.0, -4.0]), "a corner");
        let inside = |p: &[f32; 4]| {
            p[0].abs() <= 1.0 && (p[1] - 2.0).abs() < 1e-6 && (0.0..=10.0).contains(&p[2]) && p[3] <= -4.0
        };
        assert!(points.iter().all(inside), "no point leaves the box");
        let mean: f64 = points.iter().map(|p| f64::from(p[2])).sum::<f64>() / 1000.0;
        assert!((mean - 5.0).abs() < 0.1, "evenly spread, but the mean of 0..10 is {mean}");
    }
}
