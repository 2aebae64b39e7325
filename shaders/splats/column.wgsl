// Columns of a metaball over its radius; u is 1 less the square of a line's distance in radii. Twins: tyndall_clouds::splats.

/// Integral of the field from the point nearest to the centre to s radii past it, which is odd in s.
fn splat_half_column(u: f32, s: f32) -> f32 {
    let s2 = s * s;
    let square = s * (u * u - s2 * (2.0 / 3.0 * u - s2 / 5.0));
    let cube = s * (u * u * u - s2 * (u * u - s2 * (3.0 / 5.0 * u - s2 / 7.0)));
    return (5.0 * square + 4.0 * cube) / 9.0;
}

/// Integral of the field along a line between two places on it, in radii past the point nearest to the centre.
fn splat_column(u: f32, start: f32, end: f32) -> f32 {
    let inside = max(u, 0.0);
    let rim = sqrt(inside);
    return max(splat_half_column(inside, clamp(end, -rim, rim)) - splat_half_column(inside, clamp(start, -rim, rim)), 0.0);
}
