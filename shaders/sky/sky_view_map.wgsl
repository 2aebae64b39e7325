// Place of a direction in the sky-view table: azimuth from the sun, and elevation from the horizon, quadratically dense
// there. Twins: tyndall_scattering::sky_view_table.
// @import sky/view.wgsl

/// Texels of a part of the sky-view table: azimuths and rows, and how many rows lie below the horizon.
struct SkyViewGrid {
    size: vec2<u32>,
    rows_below: u32,
}

/// Column and row in a grid of a direction: elevation and azimuth from the sun, 0..pi (rad).
fn sky_view_grid_place(grid: SkyViewGrid, elevation: f32, azimuth: f32) -> vec2<f32> {
    let from_horizon = elevation - sky_view.horizon_elevation;
    let above = from_horizon >= 0.0;
    let pole = select(-0.5 * SKY_PI, 0.5 * SKY_PI, above) - sky_view.horizon_elevation;
    let share = sqrt(clamp(from_horizon / pole, 0.0, 1.0));
    let rows_above = f32(grid.size.y - grid.rows_below) - 1.0;
    let rows_below = f32(grid.rows_below);
    let row = select(rows_below - 1.0 - share * (rows_below - 1.0), rows_below + share * rows_above, above);
    return vec2<f32>(azimuth / SKY_PI * f32(grid.size.x - 1u), row);
}

/// Elevation and azimuth (rad) of a texel of a grid.
fn sky_view_grid_angles(grid: SkyViewGrid, texel: vec2<u32>) -> vec2<f32> {
    let above = texel.y >= grid.rows_below;
    let rows_above = f32(grid.size.y - grid.rows_below) - 1.0;
    let share = select(
        f32(grid.rows_below - 1u - min(texel.y, grid.rows_below - 1u)) / f32(grid.rows_below - 1u),
        f32(texel.y - min(grid.rows_below, texel.y)) / rows_above,
        above,
    );
    let pole = select(-0.5 * SKY_PI, 0.5 * SKY_PI, above) - sky_view.horizon_elevation;
    let azimuth = SKY_PI * f32(texel.x) / f32(grid.size.x - 1u);
    return vec2<f32>(sky_view.horizon_elevation + pole * share * share, azimuth);
}

/// The grid of the light scattered once.
fn sky_view_grid() -> SkyViewGrid {
    return SkyViewGrid(sky_view.table_size, sky_view.rows_below);
}

/// The grid of the diffuse light, a texture of this size: one row in four lies below the horizon.
fn sky_view_diffuse_grid(size: vec2<u32>) -> SkyViewGrid {
    return SkyViewGrid(size, size.y / 4u);
}
