// Smooth noise on a lattice with its first and second derivatives. Twins: tyndall_scene::landscape::noise.
// @import common/noise.wgsl

struct LatticeNoise {
    value: f32,           // -1..1
    gradient: vec2<f32>,  // by x and y
    hessian: vec3<f32>,   // xx, xy, yy
}

/// Random number of a lattice point, -1 to 1; `row` is the hash of its y and the key.
fn lattice_value(x: i32, row: u32) -> f32 {
    return f32(noise_pcg(bitcast<u32>(x) + row) >> 8u) / 8388608.0 - 1.0;
}

/// The quintic blend of Perlin 2002 and its two derivatives at 0 to 1.
fn lattice_blend(t: f32) -> vec3<f32> {
    return vec3<f32>(t * t * t * (t * (6.0 * t - 15.0) + 10.0), 30.0 * t * t * (t - 1.0) * (t - 1.0), 60.0 * t * (t * (2.0 * t - 3.0) + 1.0));
}

/// Noise between the lattice points.
fn lattice_noise(point: vec2<f32>, key: u32) -> LatticeNoise {
    let cell = floor(point);
    let corner = vec2<i32>(cell);
    let low = noise_pcg(bitcast<u32>(corner.y) + key);
    let high = noise_pcg(bitcast<u32>(corner.y + 1) + key);
    let a = lattice_value(corner.x, low);
    let b = lattice_value(corner.x + 1, low);
    let c = lattice_value(corner.x, high);
    let d = lattice_value(corner.x + 1, high);
    let u = lattice_blend(point.x - cell.x);
    let v = lattice_blend(point.y - cell.y);
    let along = vec2<f32>(b - a, c - a);
    let across = a - b - c + d;
    return LatticeNoise(
        a + along.x * u.x + along.y * v.x + across * u.x * v.x,
        vec2<f32>(u.y * (along.x + across * v.x), v.y * (along.y + across * u.x)),
        vec3<f32>(u.z * (along.x + across * v.x), u.y * v.y * across, v.z * (along.y + across * u.x)),
    );
}
