// Cutting by noise that keeps the mean. Twins: tyndall_clouds::turbulence.

/// Share of cloud (0 to 1) where uniform noise has the value `noise` (0 to 1), of a `share` that is the mean over all
/// values; `softness`, above 0 and up to 1, is the width of an edge in shares.
fn eroded_share(share: f32, noise: f32, softness: f32) -> f32 {
    let reach = 1.0 - softness;
    let wide = max(softness, reach);
    let narrow = min(softness, reach);
    let near = min(share, 1.0 - share);
    // Towards no cloud and full cloud a part of the ramp is cut off, and the mean is a parabola.
    let parabola = sqrt(max(2.0 * softness * reach * near, 0.0));
    let level = select(0.5 + (near - 0.5) * wide, parabola, near * wide < 0.5 * narrow);
    return clamp((select(level, 1.0 - level, share > 0.5) - noise * reach) / softness, 0.0, 1.0);
}
