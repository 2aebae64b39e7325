// Fills the volume, in four steps: the columns of the media up to each slice, a thread per ray; the light of all orders
// around the middle of each slice, and the light that the slice adds, a thread per slice; and the sums up to its end, a
// thread per ray again.
//
// A slice has four pieces. The column of each medium over a piece is exact for an altitude that changes linearly, however
// thin a layer is; light is taken where the piece's extinction has its centre, and dimmed within the piece.
// Exact integral and slices in f64: tyndall_scattering::aerial.
// @import aerial/aerial.wgsl
// @import clouds/shadow.wgsl
// @import frame/frame.wgsl
// @import sky/column_lookup.wgsl
// @import sky/ground_light.wgsl
// @import sky/orders_gather.wgsl

@group(0) @binding(25) var aerial_light_texels: texture_storage_3d<rgba16float, write>;
@group(0) @binding(26) var aerial_aerosol_texels: texture_storage_3d<rgba16float, write>;
@group(0) @binding(27) var aerial_haze_texels: texture_storage_3d<rgba16float, write>;
@group(0) @binding(28) var aerial_depth_texels: texture_storage_3d<rgba16float, write>;

const AERIAL_PIECES: u32 = 4u;
const AERIAL_VECTORS: u32 = 10u; // of a slice

/// Ten vectors a slice, slices of a ray after one another: columns before it (m); the ray, its way over the ground, and
/// in their place the three parts of the light that the slice adds; from the fifth on spectra of the light of all orders
/// that one metre of air, aerosol and haze at density 1 scatters into the ray (W/m^3/sr/nm).
@group(0) @binding(19) var<storage, read_write> aerial_scratch: array<vec4<f32>>;

/// A piece of a ray.
struct AerialPiece {
    columns: vec4<f32>, // m, of air, aerosol, ozone and haze
    centre: f32,        // m along the ray, of its extinction
}

/// Mean density of an exponential between two altitudes (m).
fn aerial_exponential(a: f32, b: f32, scale_height: f32) -> f32 {
    let rise = b - a;
    if (abs(rise) < 0.02 * scale_height) {
        return exp(-0.5 * (a + b) / scale_height);
    }
    return scale_height * (exp(-a / scale_height) - exp(-b / scale_height)) / rise;
}

/// Mean density of the haze between two altitudes (m).
fn aerial_layer(a: f32, b: f32) -> f32 {
    let top = atmosphere.haze_top_m;
    let low = min(a, b);
    let high = max(a, b);
    if (high <= top) {
        return 1.0;
    }
    if (low >= top) {
        return aerial_exponential(low - top, high - top, atmosphere.haze_scale_height_m);
    }
    let above = aerial_exponential(0.0, high - top, atmosphere.haze_scale_height_m);
    return ((top - low) + above * (high - top)) / (high - low);
}

/// A piece from distance t0 to t1 (m).
fn aerial_piece(ray: Ray, t0: f32, t1: f32) -> AerialPiece {
    let radius = atmosphere.planet_radius_m;
    let a = altitude_along(radius, ray.h, ray.mu, t0);
    let b = altitude_along(radius, ray.h, ray.mu, t1);
    let middle = atmosphere_density(0.5 * (a + b));
    let air = aerial_exponential(a, b, atmosphere.air_scale_height_m);
    let aerosol = aerial_exponential(a, b, atmosphere.aerosol_scale_height_m);
    var haze = 0.0;
    if (atmosphere_hazy()) {
        haze = aerial_layer(a, b);
    }
    let weights = vec4<f32>(atmosphere.air_extinction.hi.x, atmosphere.aerosol_extinction.hi.x, 0.0, atmosphere.haze_extinction.hi.x);
    let ends = vec2<f32>(dot(atmosphere_density(a), weights), dot(atmosphere_density(b), weights));
    let share = (ends.x + 2.0 * ends.y) / max(3.0 * (ends.x + ends.y), 1e-30);
    return AerialPiece(vec4<f32>(air, aerosol, middle.z, haze) * (t1 - t0), mix(t0, t1, select(0.5, share, ends.x + ends.y > 1e-29)));
}

/// (1 - e^-depth) / depth.
fn aerial_dimmed(depth: vec4<f32>) -> vec4<f32> {
    let exact = (1.0 - exp(-depth)) / max(depth, vec4<f32>(1e-6));
    return select(exact, 1.0 - 0.5 * depth + depth * depth / 6.0, depth < vec4<f32>(0.02));
}

/// Optical depth of columns.
fn aerial_optical_depth(columns: vec4<f32>) -> Spectrum {
    let air = spectrum_scale(atmosphere.air_extinction, columns.x);
    let aerosol = spectrum_scale(atmosphere.aerosol_extinction, columns.y);
    let ozone = spectrum_scale(atmosphere.ozone_extinction, columns.z);
    return spectrum_add(spectrum_add(air, aerosol), spectrum_add(ozone, spectrum_scale(atmosphere.haze_extinction, columns.w)));
}

/// Light of the sun at a distance t (m), 0 in the planet's shadow.
fn aerial_sunlight(ray: Ray, t: f32) -> Spectrum {
    let radius = atmosphere.planet_radius_m;
    let h = min(altitude_along(radius, ray.h, ray.mu, t), atmosphere.top_altitude_m);
    let mu_sun = mu_along(radius, ray.h, ray.mu_sun, ray.nu, t, h);
    let horizon = horizon_mu(radius, h);
    let lit = select(0.0, 1.0, mu_sun >= horizon);
    return spectrum_scale(atmosphere_transmittance(columns_to_top(h, max(mu_sun, horizon))), lit);
}

/// The light that one slice adds, before the phase functions of aerosol and haze (W/m^2/nm).
struct AerialSlice {
    light: Spectrum, // of the air with its phase function, and of all orders beyond the first
    aerosol: Spectrum,
    haze: Spectrum,
}

/// What a slice adds behind columns of `before` (m); the way's first half is the horizontal direction, then the origin (m).
fn aerial_slice(ray: Ray, way: vec4<f32>, slice: u32, before: vec4<f32>, around: Scattered) -> AerialSlice {
    let zero = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    var out = AerialSlice(zero, zero, zero);
    var columns = before;
    let phase = atmosphere_phases(ray.nu).x;
    for (var i = 0u; i < AERIAL_PIECES; i++) { // loops: AERIAL_PIECES
        let ends = aerial_ends(slice, i);
        let piece = aerial_piece(ray, ends.x, ends.y);
        let depth = aerial_optical_depth(piece.columns);
        let view = atmosphere_transmittance(columns);
        let seen = Spectrum(view.lo * aerial_dimmed(depth.lo), view.hi * aerial_dimmed(depth.hi));
        let h = altitude_along(atmosphere.planet_radius_m, ray.h, ray.mu, piece.centre);
        let shadow = cloud_shadow(way.zw + piece.centre * way.xy, h);
        let lit = spectrum_scale(spectrum_mul(seen, aerial_sunlight(ray, piece.centre)), shadow);
        let air = spectrum_scale(around.air, piece.columns.x);
        let aerosol = spectrum_scale(around.aerosol, piece.columns.y);
        let haze = spectrum_scale(around.haze, piece.columns.w);
        let diffuse = spectrum_scale(spectrum_add(spectrum_add(air, aerosol), haze), cloud_shade_mean(h));
        out.light = spectrum_add(out.light, spectrum_mul(seen, diffuse));
        out.light = spectrum_add(out.light, spectrum_scale(spectrum_mul(lit, atmosphere.air_source), phase * piece.columns.x));
        out.aerosol = spectrum_add(out.aerosol, spectrum_scale(spectrum_mul(lit, atmosphere.aerosol_source), piece.columns.y));
        out.haze = spectrum_add(out.haze, spectrum_scale(spectrum_mul(lit, atmosphere.haze_source), piece.columns.w));
        columns += piece.columns;
    }
    return out;
}

/// Optical depth in the three colours of what dims the light that the ground reflects.
fn aerial_colour_depth(columns: vec4<f32>) -> vec3<f32> {
    let mu_sun = sky_view.sun_direction.z;
    let on_ground = spectrum_add(ground_sun_irradiance(mu_sun), ground_sky_irradiance(mu_sun));
    // By night any light will do.
    let light = spectrum_add(on_ground, spectrum_scale(atmosphere.solar_irradiance, 1e-9));
    let dimmed = atmosphere_rec709(spectrum_mul(light, atmosphere_transmittance(columns)));
    return -log(max(dimmed, vec3<f32>(1e-30)) / max(atmosphere_rec709(light), vec3<f32>(1e-30)));
}

/// First vector of a slice of a ray of the volume.
fn aerial_scratch_index(place: vec2<u32>, slice: u32) -> u32 {
    return AERIAL_VECTORS * ((place.y * aerial.columns + place.x) * AERIAL_SLICES + slice);
}

/// Direction of a column and a row.
fn aerial_direction(place: vec2<u32>) -> vec3<f32> {
    return frame_direction(2.0 * vec2<f32>(place) / vec2<f32>(f32(aerial.columns - 1u), f32(aerial.rows - 1u)) - 1.0);
}

/// The ray in a direction.
fn aerial_ray(direction: vec3<f32>) -> Ray {
    return Ray(sky_view.observer_altitude_m, direction.z, sky_view.sun_direction.z, sky_sun_cosine(direction));
}

/// Ends of a piece of a slice (m).
fn aerial_ends(slice: u32, piece: u32) -> vec2<f32> {
    let t0 = aerial_distance(f32(slice));
    let t1 = aerial_distance(f32(slice + 1u));
    return mix(vec2<f32>(t0), vec2<f32>(t1), vec2<f32>(f32(piece), f32(piece + 1u)) / f32(AERIAL_PIECES));
}

@compute @workgroup_size(8, 8, 1)
fn aerial_columns(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= vec2<u32>(aerial.columns, aerial.rows))) { return; }
    let direction = aerial_direction(id.xy);
    let ray = aerial_ray(direction);
    var columns = vec4<f32>(0.0);
    for (var slice = 0u; slice < AERIAL_SLICES; slice++) { // loops: AERIAL_SLICES
        let index = aerial_scratch_index(id.xy, slice);
        aerial_scratch[index] = columns;
        aerial_scratch[index + 1u] = vec4<f32>(ray.h, ray.mu, ray.mu_sun, ray.nu);
        aerial_scratch[index + 2u] = vec4<f32>(direction.xy, frame.position_m.xy);
        for (var i = 0u; i < AERIAL_PIECES; i++) { // loops: AERIAL_PIECES
            let ends = aerial_ends(slice, i);
            columns += aerial_piece(ray, ends.x, ends.y).columns;
        }
    }
    textureStore(aerial_depth_texels, vec3<u32>(id.xy, AERIAL_SLICES - 1u), vec4<f32>(min(aerial_colour_depth(columns), vec3<f32>(60.0)), 0.0));
}

/// The ray of a slice's scratch.
fn aerial_stored_ray(index: u32) -> Ray {
    let ray = aerial_scratch[index + 1u];
    return Ray(ray.x, ray.y, ray.z, ray.w);
}

@compute @workgroup_size(4, 4, 4)
fn aerial_diffuse(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id >= vec3<u32>(aerial.columns, aerial.rows, AERIAL_SLICES))) { return; }
    let index = aerial_scratch_index(id.xy, id.z);
    let ray = aerial_stored_ray(index);
    let radius = atmosphere.planet_radius_m;
    let t = 0.5 * (aerial_distance(f32(id.z)) + aerial_distance(f32(id.z + 1u)));
    let h = min(altitude_along(radius, ray.h, ray.mu, t), atmosphere.top_altitude_m);
    let mu = mu_along(radius, ray.h, ray.mu, 1.0, t, h);
    let around = orders_scattered(h, mu, mu_along(radius, ray.h, ray.mu_sun, ray.nu, t, h), ray.nu);
    aerial_scratch[index + 4u] = orders.brightness * around.air.lo * orders.air_scattering.lo;
    aerial_scratch[index + 5u] = orders.brightness * around.air.hi * orders.air_scattering.hi;
    aerial_scratch[index + 6u] = orders.brightness * around.aerosol.lo * orders.aerosol_scattering.lo;
    aerial_scratch[index + 7u] = orders.brightness * around.aerosol.hi * orders.aerosol_scattering.hi;
    aerial_scratch[index + 8u] = orders.brightness * around.haze.lo * orders.haze_scattering.lo;
    aerial_scratch[index + 9u] = orders.brightness * around.haze.hi * orders.haze_scattering.hi;
}

@compute @workgroup_size(4, 4, 4)
fn aerial_slices(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id >= vec3<u32>(aerial.columns, aerial.rows, AERIAL_SLICES))) { return; }
    let index = aerial_scratch_index(id.xy, id.z);
    let around = Scattered(
        Spectrum(aerial_scratch[index + 4u], aerial_scratch[index + 5u]),
        Spectrum(aerial_scratch[index + 6u], aerial_scratch[index + 7u]),
        Spectrum(aerial_scratch[index + 8u], aerial_scratch[index + 9u]),
    );
    let added = aerial_slice(aerial_stored_ray(index), aerial_scratch[index + 2u], id.z, aerial_scratch[index], around);
    aerial_scratch[index + 1u] = vec4<f32>(atmosphere_rec709(added.light), 0.0);
    aerial_scratch[index + 2u] = vec4<f32>(atmosphere_rec709(added.aerosol), 0.0);
    aerial_scratch[index + 3u] = vec4<f32>(atmosphere_rec709(added.haze), 0.0);
}

@compute @workgroup_size(8, 8, 1)
fn aerial_sums(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= vec2<u32>(aerial.columns, aerial.rows))) { return; }
    var light = vec4<f32>(0.0);
    var aerosol = vec4<f32>(0.0);
    var haze = vec4<f32>(0.0);
    for (var slice = 0u; slice < AERIAL_SLICES; slice++) { // loops: AERIAL_SLICES
        let index = aerial_scratch_index(id.xy, slice);
        light += aerial_scratch[index + 1u] / aerial.unit;
        aerosol += aerial_scratch[index + 2u] / aerial.unit;
        haze += aerial_scratch[index + 3u] / aerial.unit;
        let texel = vec3<u32>(id.xy, slice);
        textureStore(aerial_light_texels, texel, light);
        textureStore(aerial_aerosol_texels, texel, aerosol);
        textureStore(aerial_haze_texels, texel, haze);
        if (slice > 0u) {
            let depth = min(aerial_colour_depth(aerial_scratch[index]), vec3<f32>(60.0));
            textureStore(aerial_depth_texels, texel - vec3<u32>(0u, 0u, 1u), vec4<f32>(depth, 0.0));
        }
    }
}
