//! Relief of ripples near the camera: what a ray sees is what it meets first.

use half::f16;
use tyndall_gpu::{GpuError, wgpu};
use tyndall_render::desert::gpu_data::Desert;
use tyndall_tests::gpu;

use crate::rays::{answers, texture};

/// Texels of the tile, waves on it, its side (m); the height of crests as a share of it (1 / 32 of a wave).
const TEXELS: u32 = 128;
const WAVES: f64 = 8.0;
const TILE_M: f64 = 1.12;
const CREST: f64 = 1.0 / 32.0 / WAVES;

/// Waves across the wind that are no sines, with a second one that travels aside.
fn share(x: f64, y: f64) -> f64 {
    let turn = std::f64::consts::TAU * WAVES * x;
    0.7 * turn.sin() + 0.15 * (2.0 * turn).sin() + 0.15 * (std::f64::consts::TAU * (2.0 * y + x)).cos()
}

/// Heights of the tile, as the shader gets them.
#[expect(clippy::cast_possible_truncation, reason = "textures hold halves")]
fn texels() -> Vec<u16> {
    let at = |index: u32| (f64::from(index) + 0.5) / f64::from(TEXELS);
    (0..TEXELS * TEXELS).map(|k| f16::from_f32(share(at(k % TEXELS), at(k / TEXELS)) as f32).to_bits()).collect()
}

/// One patch alone: that of the origin, whose wind blows to the east.
const TEXT: &str = "
// @import desert/relief.wgsl
@group(0) @binding(0) var<storage, read> inputs: array<vec4<f32>>; // place (m), rise of the view, and its azimuth
@group(0) @binding(1) var<storage, read_write> outputs: array<vec4<f32>>; // place (m), height (m), share of the sun's light
@compute @workgroup_size(64)
fn relief_main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= arrayLength(&inputs)) { return; }
    let x = inputs[id.x];
    let part = RipplePatch(vec2<f32>(0.0), vec2<f32>(1.0, 0.0), vec2<f32>(0.0), desert.tile_m, 1.0);
    let none = RipplePatch(vec2<f32>(0.0), vec2<f32>(1.0, 0.0), vec2<f32>(0.0), desert.tile_m, 0.0);
    let parts = array<RipplePatch, 3>(part, none, none);
    let top_m = desert.relief * desert.tile_m;
    let around = relief_around(x.xy, 1.0, 0.0001, 1.0);
    let relief = Relief(parts, 1.0, desert.relief, top_m, 0.0, around.ripple_m);
    let ray = vec3<f32>(cos(x.w) * sqrt(1.0 - x.z * x.z), sin(x.w) * sqrt(1.0 - x.z * x.z), x.z);
    let hit = relief_hit(relief, x.xy, vec2<f32>(0.0), ray, 10.0);
    outputs[id.x] = vec4<f32>(hit, relief_shade(relief, hit.xy, hit.z, vec2<f32>(0.0), ray));
}
";

/// Places and heights (m) that rays see, and how much of a sun in their direction shines there.
fn seen(inputs: &[[f32; 4]], relief: f64) -> Result<Vec<[f32; 4]>, GpuError> {
    let gpu = gpu();
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
    let desert = gpu.buffer("desert", size_of::<Desert>() as u64, usage)?;
    gpu.queue.write_buffer(&desert, 0, bytemuck::bytes_of(&uniform(relief)));
    let one = f16::ONE.to_bits();
    let heights = texture(gpu, wgpu::TextureFormat::R16Float, TEXELS, &texels());
    let winds = texture(gpu, wgpu::TextureFormat::Rgba16Float, 1, &[one, 0, one, one]);
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        address_mode_u: wgpu::AddressMode::Repeat,
        address_mode_v: wgpu::AddressMode::Repeat,
        mag_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    });
    let own = [
        ("desert", desert.as_entire_binding()),
        ("ripple_winds", wgpu::BindingResource::TextureView(&winds)),
        ("desert_sampler", wgpu::BindingResource::Sampler(&sampler)),
        ("ripple_sampler", wgpu::BindingResource::Sampler(&sampler)),
        ("ripple_heights", wgpu::BindingResource::TextureView(&heights)),
    ];
    answers(gpu, (TEXT, "relief_main"), inputs, &own)
}

#[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
fn uniform(relief: f64) -> Desert {
    Desert {
        cell_m: 1.0,
        size: [1.0, 1.0],
        wraps: 1,
        ripples: 2,
        tile_m: TILE_M as f32,
        tile_texels: TEXELS as f32,
        hexagon_m: (14.0 * TILE_M / WAVES) as f32,
        sun_half_width: 0.006,
        relief: relief as f32,
        ..bytemuck::Zeroable::zeroed()
    }
}

/// Rays that reach many places of the tile, risen by an angle, from many sides.
fn rays(rise_deg: f32) -> Vec<[f32; 4]> {
    let ray = |index: u16| {
        let turns = [0.754_877_67, 0.569_840_3, 0.618_034].map(|step: f32| (f32::from(index) * step).fract());
        [turns[0], turns[1], rise_deg.to_radians().sin(), std::f32::consts::TAU * turns[2]]
    };
    (0..2000).map(ray).collect()
}

/// Height (m) of the ripples.
fn height_m(x_m: f64, y_m: f64) -> f64 {
    CREST * TILE_M * share(x_m / TILE_M, y_m / TILE_M)
}

/// What a ray meets first, by many small steps; metres along it from the smooth sand, and along the ground.
fn first_met([x, y, rise, azimuth]: [f32; 4]) -> [f64; 2] {
    let [x, y, rise, azimuth] = [x, y, rise, azimuth].map(f64::from);
    let flat = (1.0 - rise * rise).sqrt();
    let (start, step) = (CREST * TILE_M / rise, 1e-5);
    let over = |along: f64| along * rise - height_m(x + along * flat * azimuth.cos(), y + along * flat * azimuth.sin());
    let mut along = start;
    while over(along) > 0.0 && along > -start {
        along -= step;
    }
    [along * flat * azimuth.cos(), along * flat * azimuth.sin()]
}

#[test]
fn a_ray_meets_the_ripple_that_a_march_by_tiny_steps_meets() {
    let ripple_m = TILE_M / WAVES;
    for (rise_deg, allowed) in [(30.0, 0.02), (60.0, 0.02), (15.0, 0.02)] {
        let inputs = rays(rise_deg);
        let found = seen(&inputs, CREST).expect("the shader runs");
        let mut worst = 0.0_f64;
        for (input, hit) in inputs.iter().zip(&found) {
            let wanted = first_met(*input);
            let off = [0, 1].map(|axis| f64::from(hit[axis]) - f64::from(input[axis]) - wanted[axis]);
            worst = worst.max(off[0].hypot(off[1]) / ripple_m);
            let height = height_m(f64::from(hit[0]), f64::from(hit[1]));
            assert!((f64::from(hit[2]) - height).abs() < 0.01 * ripple_m, "the hit lies on a ripple: {hit:?}");
        }
        assert!(worst < allowed, "at {rise_deg} degrees: off by {worst} of a ripple's length");
    }
}

#[test]
fn from_straight_above_or_without_height_nothing_shifts() {
    for (rise_deg, relief) in [(90.0, CREST), (30.0, 0.0), (5.0, 0.0)] {
        let inputs = rays(rise_deg);
        for (input, hit) in inputs.iter().zip(seen(&inputs, relief).expect("the shader runs")) {
            let off = (hit[0] - input[0]).hypot(hit[1] - input[1]);
            assert!(off < 1e-6 || (relief > 0.0 && off < 1e-4), "{rise_deg} degrees, height {relief}: {off} m");
            if relief == 0.0 {
                assert_eq!(
                    [hit[0], hit[1], hit[3]].map(f32::to_bits),
                    [input[0], input[1], 1.0].map(f32::to_bits),
                    "flat"
                );
            }
        }
    }
}

#[test]
fn a_place_that_a_ray_sees_is_lit_from_where_the_ray_comes_and_high_suns_shade_nothing() {
    // A sun at the eye shines on all that the eye sees, but for the soft edges of shadows.
    let found = seen(&rays(20.0), CREST).expect("the shader runs");
    let mean = found.iter().map(|hit| f64::from(hit[3])).sum::<f64>() / found.len() as f64;
    assert!(mean > 0.98, "a sun at the eye lights {mean} of what is seen");
    for hit in seen(&rays(50.0), CREST).expect("the shader runs") {
        assert!(hit[3] > 0.999, "ripples are less than 20 degrees steep: {hit:?}");
    }
}
