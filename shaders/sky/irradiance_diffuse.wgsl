// Fills the lower two rows of the irradiance table: skylight that was scattered or reflected at least twice
// (W/m^2/nm). One sun per invocation. Twin: tyndall_scattering::orders::SourceTable::irradiance_beyond_first.
// @import sky/irradiance_map.wgsl
// @import sky/orders_source.wgsl

@group(0) @binding(4) var irradiance_texels: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(64, 1, 1)
fn irradiance_diffuse(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= IRRADIANCE_TABLE_SIZE) { return; }
    var light = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    if (orders.brightness > 0.0) {
        let mu_sun = irradiance_map_inverse(f32(id.x) / f32(IRRADIANCE_TABLE_SIZE - 1u));
        light = spectrum_scale(orders_irradiance(mu_sun), orders.brightness);
    }
    textureStore(irradiance_texels, vec2<u32>(id.x, 2u), light.lo);
    textureStore(irradiance_texels, vec2<u32>(id.x, 3u), light.hi);
}
