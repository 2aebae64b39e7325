// Lookup in the column table. Twin: tyndall_scattering::column_table::ColumnTable::lookup.
// @import sky/column_map.wgsl
// @import sky/layer_column.wgsl

@group(0) @binding(2) var column_table: texture_2d<f32>;

/// Columns [m] of air, aerosol, ozone and haze from altitude h (0 to the top) in a direction above the horizon to the top.
fn columns_to_top(h: f32, mu: f32) -> vec4<f32> {
    let position = column_map(h, mu) * vec2<f32>(COLUMN_TABLE_SIZE - 1u);
    let first = min(vec2<u32>(position), COLUMN_TABLE_SIZE - 2u);
    let fraction = position - vec2<f32>(first);
    let a = textureLoad(column_table, first, 0).xyz;
    let b = textureLoad(column_table, first + vec2<u32>(1u, 0u), 0).xyz;
    let c = textureLoad(column_table, first + vec2<u32>(0u, 1u), 0).xyz;
    let d = textureLoad(column_table, first + vec2<u32>(1u, 1u), 0).xyz;
    let texel = mix(mix(a, b, fraction.x), mix(c, d, fraction.x), fraction.y);
    let heights = vec2<f32>(atmosphere.air_scale_height_m, atmosphere.aerosol_scale_height_m);
    return vec4<f32>(exp(texel.xy - h / heights), texel.z, layer_column(h, mu));
}
