// Draws the terrain: a mesh of rings with the exact slope at each pixel, lit by the sun and by the sky, seen through air.
// @import aerial/lookup.wgsl
// @import clouds/shadow.wgsl
// @import landscape/place.wgsl
// @import landscape/shadow_lookup.wgsl
// @import landscape/surface.wgsl
// @import sky/light_lookup.wgsl

@group(2) @binding(5) var<storage, read> terrain_vertices: array<vec4<f32>>;

struct TerrainVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) from_camera: vec2<f32>, // m along the ground
    @location(1) position: vec3<f32>,    // m relative to the camera
}

@vertex
fn terrain_vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) ring: u32) -> TerrainVertex {
    let vertex = terrain_vertices[(ring + (index & 1u)) * landscape.columns + index / 2u];
    let position = place_position(vertex.xy, vertex.z);
    return TerrainVertex(place_clip(position), vertex.xy, position);
}

@fragment
fn terrain_fragment(vertex: TerrainVertex) -> @location(0) vec4<f32> {
    let distance = length(vertex.position);
    let footprint_m = 0.7 * distance * frame_pixel_angle(frame_plane(vertex.clip));
    let place = frame.position_m.xy + vertex.from_camera;
    let ground = relief_at(place, footprint_m);
    let normal = normalize(vec3<f32>(-ground.yz, 1.0));
    let sun = place_sun(vertex.from_camera);
    let altitude = max(ground.x, 0.0);
    let nu = dot(normal, sun);
    let sines = sqrt(max((1.0 - normal.z * normal.z) * (1.0 - sun.z * sun.z), 1e-12));
    let cos_phi = clamp((nu - normal.z * sun.z) / sines, -1.0, 1.0);
    let shade = cloud_shade_at(place, altitude);
    let sunlight = sky_light_sun(altitude, sun.z);
    // What clouds scatter down comes from all of the sky.
    let scattered = sunlight * max(sun.z, 0.0) * (0.5 + 0.5 * normal.z) * shade.diffuse;
    let lit = sunlight * max(nu, 0.0) * shadow_of_terrain(place, ground.x) * shade.direct + scattered;
    let light = lit + sky_light_irradiance(altitude, sun.z, normal.z, cos_phi, nu) * shade.sky;
    let albedo = surface_albedo(place, ground, footprint_m);
    let radiance = albedo * light * cloud_shade_between(shade, vec4<f32>(albedo, 0.0)).xyz / SKY_PI;
    let air = aerial_seen(frame_plane(vertex.clip), distance, sky_sun_cosine(vertex.position / distance));
    return vec4<f32>((radiance * air.transmittance + air.light) * frame.pre_exposure, 1.0);
}
