// What the terrain is made of: meadows and woods on gentle slopes, rock on steep ones, snow above.
// @import landscape/relief.wgsl

const SURFACE_MEADOW = vec3<f32>(0.105, 0.118, 0.05);
const SURFACE_DRY = vec3<f32>(0.17, 0.145, 0.085);
const SURFACE_WOOD = vec3<f32>(0.030, 0.042, 0.020);
const SURFACE_ROCK = vec3<f32>(0.20, 0.185, 0.168);
const SURFACE_DARK_ROCK = vec3<f32>(0.10, 0.094, 0.088);
const SURFACE_SNOW = vec3<f32>(0.80, 0.83, 0.87);

/// Noise of a wavelength, fading where the footprint hides it.
fn surface_noise(place: vec2<f32>, wavelength_m: f32, footprint_m: f32, key: u32) -> f32 {
    let seen = clamp(0.5 * wavelength_m / max(footprint_m, 1e-3) - 1.0, 0.0, 1.0);
    if (seen <= 0.0) {
        return 0.0;
    }
    return seen * lattice_noise(place / wavelength_m, landscape.key + key).value;
}

/// Share of each colour that the terrain reflects; `ground` = altitude (m) and slopes.
fn surface_albedo(place: vec2<f32>, ground: vec3<f32>, footprint_m: f32) -> vec3<f32> {
    let steepness = length(ground.yz);
    let wide = surface_noise(place, 1700.0, footprint_m, 101u);
    let middle = surface_noise(place, 190.0, footprint_m, 102u);
    let fine = surface_noise(place, 23.0, footprint_m, 103u);
    let grain = surface_noise(place, 2.7, footprint_m, 104u);
    let patches = wide + 0.6 * middle + 0.35 * fine;
    let height = ground.x / max(landscape.snow_line_m, 1.0);
    var albedo = mix(SURFACE_MEADOW, SURFACE_DRY, clamp(0.35 + 0.5 * patches + 0.5 * (height - 0.5), 0.0, 1.0));
    let wooded = smoothstep(-0.25, 0.1, wide + 0.5 * middle + 0.25 * fine + 0.1) * (1.0 - smoothstep(0.5, 0.72, height + 0.12 * middle));
    albedo = mix(albedo, SURFACE_WOOD * (1.0 + 0.35 * fine + 0.3 * grain), wooded * (1.0 - smoothstep(0.9, 1.3, steepness)));
    let stone = mix(SURFACE_ROCK, SURFACE_DARK_ROCK, clamp(0.5 + 0.5 * middle + 0.4 * fine, 0.0, 1.0));
    let bare = smoothstep(0.62, 0.95, steepness + 0.22 * middle + 0.2 * fine + 0.35 * (height - 0.6));
    albedo = mix(albedo, stone, bare);
    let snowy = smoothstep(-0.06, 0.08, height - 1.0 + 0.10 * middle + 0.06 * fine) * (1.0 - smoothstep(0.85, 1.25, steepness + 0.2 * fine));
    albedo = mix(albedo * (1.0 + 0.18 * grain), SURFACE_SNOW, snowy);
    let inside = relief_mask(place).x;
    return mix(landscape.ground_albedo, max(albedo, vec3<f32>(0.01)), smoothstep(0.0, 0.25, inside));
}
