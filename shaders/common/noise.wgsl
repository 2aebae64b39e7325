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
