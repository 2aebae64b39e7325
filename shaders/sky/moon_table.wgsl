// Fills the table of the sky that the moon lights: radiance by all orders of scattering, phase functions included, as linear
// Rec.709 (cd/m^2), on the grid of the sky-view table with azimuths from the moon. `sky_view` is the moon's: its "sun" is
// the moon, and the rows of `atmosphere` that lead to Rec.709 hold the moon's colour. One direction per invocation.
// @import sky/march.wgsl
// @import sky/orders_gather.wgsl
// @import sky/sky_view_ray.wgsl

@group(0) @binding(4) var moon_sky_texels: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8, 1)
fn moon_table(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= sky_view.table_size)) { return; }
    let ray = sky_view_ray(sky_view_grid_angles(sky_view_grid(), id.xy));
    var light = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    if (ray.mu <= 1.0) {
        let length = sky_view_length(ray, id.y >= sky_view.rows_below);
        light = march_radiance(march_scattered(ray, length, sky_view.panels), atmosphere_phases(ray.nu));
        if (orders.brightness > 0.0) {
            light = spectrum_add(light, spectrum_scale(orders_gather(ray, length, sky_view.panels).light, orders.brightness));
        }
    }
    textureStore(moon_sky_texels, id.xy, vec4<f32>(atmosphere_rec709(light), 0.0));
}
