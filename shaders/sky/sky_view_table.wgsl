// Fills the sky-view table: light scattered once, by air, aerosol and haze, before their phase functions, as linear Rec.709
// [cd/m^2 sr]. One direction per invocation, about 32 nodes of the march each. Twin: tyndall_scattering::sky_view_table.
// @import sky/march.wgsl
// @import sky/sky_view_ray.wgsl

@group(0) @binding(4) var sky_view_air_texels: texture_storage_2d<rgba32float, write>;
@group(0) @binding(5) var sky_view_aerosol_texels: texture_storage_2d<rgba32float, write>;
@group(0) @binding(14) var sky_view_haze_texels: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8, 1)
fn sky_view_table(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= sky_view.table_size)) { return; }
    let ray = sky_view_ray(sky_view_grid_angles(sky_view_grid(), id.xy));
    var air = vec3<f32>(0.0);
    var aerosol = vec3<f32>(0.0);
    var haze = vec3<f32>(0.0);
    if (ray.mu <= 1.0) {
        let length = sky_view_length(ray, id.y >= sky_view.rows_below);
        let light = march_scattered(ray, length, sky_view.panels);
        air = atmosphere_rec709(light.air);
        aerosol = atmosphere_rec709(light.aerosol);
        haze = atmosphere_rec709(light.haze);
    }
    textureStore(sky_view_air_texels, id.xy, vec4<f32>(air, 0.0));
    textureStore(sky_view_aerosol_texels, id.xy, vec4<f32>(aerosol, 0.0));
    if (all(id.xy < textureDimensions(sky_view_haze_texels))) {
        textureStore(sky_view_haze_texels, id.xy, vec4<f32>(haze, 0.0));
    }
}
