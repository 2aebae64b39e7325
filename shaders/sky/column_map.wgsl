// Place of an altitude and a direction in the column table, Bruneton and Neyret 2008; 0 and 1 are the centres of the
// first and last texel. Twins: tyndall_scattering::column_table.
// @import common/sphere.wgsl
// @import sky/atmosphere.wgsl

const COLUMN_TABLE_SIZE = vec2<u32>(256u, 128u);

/// (distance to the top, distance to the horizon), each over its longest.
fn column_map(h: f32, mu: f32) -> vec2<f32> {
    let radius = atmosphere.planet_radius_m;
    let top = atmosphere.top_altitude_m;
    let rho = sqrt(h * (2.0 * radius + h));
    let rho_top = sqrt(top * (2.0 * radius + top));
    let distance = distance_to_top(radius, top, h, mu);
    let shortest = top - h;
    let longest = rho + rho_top;
    return vec2<f32>(clamp((distance - shortest) / (longest - shortest), 0.0, 1.0), min(rho / rho_top, 1.0));
}

/// Altitude [m] and zenith cosine of a place in the table.
fn column_map_inverse(unit: vec2<f32>) -> vec2<f32> {
    let radius = atmosphere.planet_radius_m;
    let top = atmosphere.top_altitude_m;
    let rho_top = sqrt(top * (2.0 * radius + top));
    let rho = unit.y * rho_top;
    let h = min(rho * rho / (radius + sqrt(radius * radius + rho * rho)), top);
    let shortest = top - h;
    let distance = shortest + unit.x * (rho + rho_top - shortest);
    if (distance <= 0.0) {
        return vec2<f32>(h, 1.0);
    }
    let q = (top - h) * (2.0 * radius + top + h);
    let mu = (q - distance * distance) / (2.0 * (radius + h) * distance);
    return vec2<f32>(h, clamp(mu, horizon_mu(radius, h), 1.0));
}
