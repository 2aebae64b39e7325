// One node of the table: the directions in which its radiance is computed, and the projection onto the harmonics. A
// workgroup of 64 threads per node, up to two directions a thread; sums run in a fixed order.
// Twins: tyndall_scattering::orders::{directions, build}.
// @import sky/march_path.wgsl
// @import sky/orders_altitudes.wgsl
// @import sky/orders_basis.wgsl

@group(0) @binding(12) var<storage, read_write> orders_target: array<vec4<f32>>;
@group(0) @binding(13) var<uniform> orders_first_sun: vec4<u32>; // x: the sun of the first row of workgroups

const ORDERS_THREADS: u32 = 64u;
const ORDERS_DIRECTIONS_MAX: u32 = 128u;
const ORDERS_DIRECTIONS_PER_THREAD: u32 = 2u;
const ORDERS_PI: f32 = 3.1415926535;

var<workgroup> orders_lo: array<vec4<f32>, 128>;
var<workgroup> orders_hi: array<vec4<f32>, 128>;

/// A direction of the quadrature.
struct OrdersDirection {
    mu: f32,          // zenith cosine
    cos_phi: f32,     // of the azimuth from the sun
    solid_angle: f32, // sr, with its mirror image
    above: bool,      // the local horizon
}

fn orders_directions() -> u32 {
    return 2u * orders.zenith_count * orders.azimuths;
}

/// Direction of an index: zenith angles below the horizon first, azimuths fastest.
fn orders_direction(h: f32, index: u32) -> OrdersDirection {
    let zenith = index / orders.azimuths;
    let above = zenith >= orders.zenith_count;
    let node = orders.zeniths[select(zenith, zenith - orders.zenith_count, above)];
    let horizon = horizon_mu(atmosphere.planet_radius_m, h);
    let span = select(-1.0, 1.0, above) - horizon;
    let cos_phi = cos(ORDERS_PI * (f32(index % orders.azimuths) + 0.5) / f32(orders.azimuths));
    let solid_angle = abs(span) * 4.0 * ORDERS_PI * node.x * node.y / f32(orders.azimuths);
    return OrdersDirection(horizon + span * node.x * node.x, cos_phi, solid_angle, above);
}

/// The ray of a direction for a sun.
fn orders_ray(h: f32, mu_sun: f32, direction: OrdersDirection) -> Ray {
    let sines = sqrt((1.0 - direction.mu * direction.mu) * max((1.0 - mu_sun) * (1.0 + mu_sun), 0.0));
    let nu = clamp(direction.mu * mu_sun + sines * direction.cos_phi, -1.0, 1.0);
    return Ray(h, direction.mu, mu_sun, nu);
}

/// Length of a ray (m); the direction decides on which side of the horizon it ends, rounding must not.
fn orders_length(ray: Ray, above: bool) -> f32 {
    let radius = atmosphere.planet_radius_m;
    let to_ground = distance_to_ground(radius, ray.h, ray.mu);
    let to_top = distance_to_top(radius, atmosphere.top_altitude_m, ray.h, ray.mu);
    return select(max(to_ground, 0.0), to_top, above);
}

/// Radiance of the ground behind air of these columns (m), for an irradiance (W/m^2/nm).
fn orders_reflected(irradiance: Spectrum, columns: vec4<f32>) -> Spectrum {
    let seen = spectrum_mul(atmosphere_transmittance(columns), spectrum_mul(atmosphere.ground_albedo, irradiance));
    return spectrum_scale(seen, 1.0 / ORDERS_PI);
}

/// Sum over all directions of the stored radiance times harmonic (l, m), or times mu above the horizon where `on_ground`.
fn orders_sum_directions(h: f32, l: u32, m: u32, on_ground: bool) -> Spectrum {
    var sum = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    for (var i = 0u; i < orders_directions(); i++) { // loops: ORDERS_DIRECTIONS_MAX
        let direction = orders_direction(h, i);
        let harmonic = orders_harmonic(l, m, direction.mu, direction.cos_phi);
        let weight = direction.solid_angle * select(harmonic, max(direction.mu, 0.0), on_ground);
        sum = spectrum_add(sum, spectrum_scale(Spectrum(orders_lo[i], orders_hi[i]), weight));
    }
    return sum;
}

/// Projects the stored radiance of a node and writes it: a thread per harmonic, one more for the irradiance at the ground.
fn orders_project(thread: u32, altitude: u32, sun: u32) {
    let count = orders_harmonics();
    let h = orders_altitude(altitude);
    if (thread > count || (thread == count && altitude > 0u)) {
        return;
    }
    var l = 0u;
    while ((l + 1u) * (l + 2u) / 2u <= thread && l < 4u) { // loops: ORDERS_DEGREES
        l++;
    }
    let on_ground = thread == count;
    let m = select(thread - l * (l + 1u) / 2u, 0u, on_ground);
    let sum = orders_sum_directions(h, l, m, on_ground);
    let index = select(2u * ((sun * orders.altitudes + altitude) * count + thread), orders_irradiance_start() + 2u * sun, on_ground);
    orders_target[index] = sum.lo;
    orders_target[index + 1u] = sum.hi;
}
