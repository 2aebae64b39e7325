// Fills the third part of the sky-view table: light scattered or reflected before it was scattered into the ray, as linear
// Rec.709 (cd/m^2). It changes slowly with direction: a third of the other parts' columns and a quarter of their
// rows hold it. Twin: tyndall_scattering::sky_diffuse_table.
// @import sky/orders_gather.wgsl
// @import sky/sky_view_ray.wgsl

@group(0) @binding(4) var sky_view_diffuse_texels: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8, 1)
fn sky_view_diffuse(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= textureDimensions(sky_view_diffuse_texels))) { return; }
    let grid = sky_view_diffuse_grid(textureDimensions(sky_view_diffuse_texels));
    let ray = sky_view_ray(sky_view_grid_angles(grid, id.xy));
    var light = vec3<f32>(0.0);
    if (ray.mu <= 1.0 && orders.brightness > 0.0) {
        let length = sky_view_length(ray, id.y >= grid.rows_below);
        light = orders.brightness * atmosphere_rec709(orders_gather(ray, length, sky_view.panels).light);
    }
    textureStore(sky_view_diffuse_texels, id.xy, vec4<f32>(light, 0.0));
}
