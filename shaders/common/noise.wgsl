// Integer hashes. Twins: tyndall_render::dither.

/// The PCG permutation of O'Neill 2014, 32-bit RXS-M-XS, as a hash of one word.
fn noise_pcg(word: u32) -> u32 {
    let state = word * 747796405u + 2891336453u;
    let mixed = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (mixed >> 22u) ^ mixed;
}

/// Noise for dithering with a triangular distribution over -1..1 and mean 0, for a pixel and a channel.
fn noise_triangular(pixel: vec2<u32>, channel: u32) -> f32 {
    let first = noise_pcg(pixel.x + noise_pcg(pixel.y + noise_pcg(channel)));
    let second = noise_pcg(first);
    return (f32(first >> 8u) - f32(second >> 8u)) * (1.0 / 16777216.0);
}

/// Smooth noise of 0..1 in space, a new value about every unit; for coordinates above -512.
fn noise_value(at: vec3<f32>) -> f32 {
    let cell = floor(at);
    let f = at - cell;
    let u = f * f * (3.0 - 2.0 * f);
    var sum = 0.0;
    for (var i = 0u; i < 8u; i++) { // loops: 8
        let corner = vec3<f32>(f32(i & 1u), f32((i >> 1u) & 1u), f32(i >> 2u));
        let c = vec3<u32>(cell + corner + 512.0);
        let weight = mix(1.0 - u, u, corner);
        sum += weight.x * weight.y * weight.z * f32(noise_pcg(c.x + noise_pcg(c.y + noise_pcg(c.z))) >> 8u);
    }
    return sum / 16777216.0;
}
