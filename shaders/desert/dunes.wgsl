// Draws the desert: a mesh of rings with smooth slopes at each pixel, ripples, and sand lit by sun, sky and sand.
// @import aerial/lookup.wgsl
// @import clouds/shadow.wgsl
// @import common/sand.wgsl
// @import desert/bed.wgsl
// @import desert/glints.wgsl
// @import desert/moonlight.wgsl
// @import desert/relief.wgsl
// @import landscape/place.wgsl
// @import sky/light_lookup.wgsl

@group(2) @binding(3) var<storage, read> dune_vertices: array<vec4<f32>>;
@group(2) @binding(4) var dune_light: texture_2d<f32>; // tangent of the horizon under the sun, openness, sunlit share around

struct DuneVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) from_camera: vec2<f32>, // m along the ground
    @location(1) position: vec3<f32>,    // m relative to the camera
    @location(2) altitude: f32,          // m
    @location(3) @interpolate(flat) spacing: f32, // m, of the quadrilateral
}

/// A place (m) on the smooth sand, and height and slopes near it.
struct DunePlace {
    place: vec2<f32>,
    bed: vec3<f32>,
}

/// A pixel's sand: where it lies and how it is seen.
struct DunePixel {
    place: vec2<f32>,
    altitude: f32,
    normal: vec3<f32>,
    slope: vec2<f32>,
    covariance: vec3<f32>, // of slopes within the pixel
    view: vec3<f32>,       // towards the camera
    sun: vec3<f32>,
    footprint_m: f32,
    wide_m: f32,
    facing: f32,           // cosine of the view to the dune's slope
    ripple_shade: f32,     // share of the lamp's light between ripples
}

@vertex
fn dunes_vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) ring: u32) -> DuneVertex {
    let vertex = dune_vertices[(ring + (index & 1u)) * desert.columns + index / 2u];
    let position = place_position(vertex.xy, vertex.z);
    // Bare ground lies on the planet's own, which must not show through.
    let clip = place_clip(position) * vec4<f32>(1.0, 1.0, 1.001, 1.0);
    return DuneVertex(clip, vertex.xy, position, vertex.z, vertex.w);
}

/// Share of the sun's disc over the horizon of a place.
fn dune_sun(horizon: f32, sun: vec3<f32>) -> f32 {
    let over = atan2(sun.z, max(length(sun.xy), 1e-5)) - atan(horizon);
    return smoothstep(-1.0, 1.0, over / desert.sun_half_width);
}

/// Direction to what casts the shadows.
fn dune_lamp(sun: vec3<f32>) -> vec3<f32> {
    return select(sun, moon.direction, desert.moonlit == 1u);
}

/// What sand sends to the camera of a lamp's light, relative to a white even surface that faces the lamp.
fn dune_facing(pixel: DunePixel, lamp: vec3<f32>) -> f32 {
    let n = pixel.normal;
    let up = pixel.covariance;
    let nu = dot(n, lamp);
    let between = dot(lamp, pixel.view);
    let variance = (lamp.x * lamp.x * up.x + 2.0 * lamp.x * lamp.y * up.y + lamp.y * lamp.y * up.z) * n.z * n.z;
    let view = max(dot(n, pixel.view), 0.02);
    let facets = sand_facets(max(nu, 0.0), view, between, desert.facets + 0.5 * (up.x + up.z));
    return sand_mean_cosine(nu, max(variance, 0.0)) * facets * sand_backscatter(between);
}

/// Radiance (cd/m^2) that sand sends to the camera.
fn dune_radiance(pixel: DunePixel, albedo: vec3<f32>) -> vec3<f32> {
    let n = pixel.normal;
    let sun = pixel.sun;
    let nu = dot(n, sun);
    let up = pixel.covariance;
    let view = max(dot(n, pixel.view), 0.02);
    let between = dot(sun, pixel.view);
    let texels_a_cell = f32(textureDimensions(dune_light).x) / desert.size.x;
    let level = log2(max(pixel.wide_m * texels_a_cell / desert.cell_m, 1.0));
    let light = textureSampleLevel(dune_light, desert_sampler, desert_map_place(pixel.place), level);
    let shade = cloud_shade_at(pixel.place, pixel.altitude);
    let sunlight = sky_light_sun(pixel.altitude, sun.z);
    let lamp = dune_lamp(sun);
    let seen = dune_sun(light.x, lamp) * pixel.ripple_shade * shade.direct;
    let direct = sunlight * seen;
    let from_sun = direct * dune_facing(pixel, sun);
    let sines = sqrt(max((1.0 - n.z * n.z) * (1.0 - sun.z * sun.z), 1e-12));
    let cos_phi = clamp((nu - n.z * sun.z) / sines, -1.0, 1.0);
    let scattered = sunlight * max(sun.z, 0.0) * (0.5 + 0.5 * n.z) * shade.diffuse;
    let sky = sky_light_irradiance(pixel.altitude, sun.z, n.z, cos_phi, nu) * shade.sky + scattered;
    // What sand hides of the sky it replaces by its own light.
    let level_sky = sky_light_irradiance(pixel.altitude, sun.z, 1.0, 1.0, sun.z) * shade.sky + scattered;
    let thrown = desert.bounce * albedo * (sunlight * shade.direct * light.z + level_sky);
    let open = clamp(light.y, 0.0, 1.0);
    let from_around = mix(thrown, sky, open);
    var from_moon = vec3<f32>(0.0);
    // A loop, as lavapipe 22.3 fails in shaders that branch on several uniform buffers.
    for (var nights = moon.skylight; nights > 0u; nights--) { // loops: 1
        from_moon += moonlight_on_sand(seen * dune_facing(pixel, moon.direction), open * (0.5 + 0.5 * n.z));
    }
    let halfway = normalize(sun + pixel.view);
    let rough = up + vec3<f32>(desert.facets, 0.0, desert.facets) * 0.6;
    let mirror = sand_mirror(halfway, pixel.slope, rough, view, dot(halfway, pixel.view));
    let glint = mix(1.0, glints_at(pixel.place, pixel.footprint_m, pixel.view.xy / max(length(pixel.view.xy), 1e-4), pixel.facing, halfway), desert.glints);
    let lit_side = smoothstep(0.0, 0.1, nu);
    return albedo * (from_sun + from_around + from_moon) / SKY_PI + desert.shine * direct * lit_side * mirror * glint;
}

/// Place (m) on the smooth sand that a pixel `width_m` wide sees, from where its line of sight meets the mesh: Newton's steps
/// along the line, `view` towards the camera, `distance` away. Loops skip work where software adapters run both sides of a branch.
fn dune_place(on_mesh: vec2<f32>, altitude: f32, view: vec3<f32>, distance: f32, width_m: f32) -> DunePlace {
    let longest = 0.05 * distance;
    var way = 0.0;
    var bed = bed_at(on_mesh, width_m);
    for (var step = 0; step < 3 && abs(bed.x - altitude - way * view.z) > 0.3 * width_m; step++) { // loops: 3
        way = clamp(way + dune_step(bed, altitude + way * view.z, view), -longest, longest);
        bed = bed_at(on_mesh + way * view.xy, width_m);
    }
    way = clamp(way + dune_step(bed, altitude + way * view.z, view), -longest, longest);
    return DunePlace(on_mesh + way * view.xy, bed);
}

/// Way (m) towards the camera from a point at an altitude to the plane that touches the sand under it.
fn dune_step(bed: vec3<f32>, altitude: f32, view: vec3<f32>) -> f32 {
    return (bed.x - altitude) / max(view.z - dot(bed.yz, view.xy), 0.04);
}

@fragment
fn dunes_fragment(vertex: DuneVertex) -> @location(0) vec4<f32> {
    let plane = frame_plane(vertex.clip);
    let distance = length(vertex.position);
    let view = -vertex.position / distance;
    let pixel_m = 0.7 * distance * frame_pixel_angle(plane);
    let found = dune_place(frame.position_m.xy + vertex.from_camera, vertex.altitude, view, distance, pixel_m);
    let smooth_place = found.place;
    let coarse = found.bed;
    let facing = max(dot(normalize(vec3<f32>(-coarse.yz, 1.0)), view), 0.04);
    let wide_m = min(pixel_m * inverseSqrt(facing), 4.0 * pixel_m);
    let bed = bed_at(smooth_place, wide_m);
    let wind = ripple_wind(smooth_place, wide_m);
    let sun = place_sun(vertex.from_camera);
    let relief = relief_around(smooth_place, length(wind.xy), pixel_m, facing);
    let hit = relief_hit(relief, smooth_place, bed.yz, view, distance);
    let ripple_shade = relief_shade(relief, hit.xy, hit.z, bed.yz, dune_lamp(sun));
    let place = hit.xy;
    let long = view.xy / max(length(view.xy), 1e-4) * pixel_m / facing;
    let quad_m = 0.13 * vertex.spacing;
    let ripples = ripples_at(place, long, select(pixel_m, quad_m, desert.ripples == 1u), length(wind.xy));
    let slope = bed.yz + ripples.slope;
    let normal = normalize(vec3<f32>(-slope, 1.0));
    let pixel = DunePixel(place, max(bed.x, 0.0), normal, slope, ripples.covariance, view, sun, pixel_m, wide_m, facing, ripple_shade);
    let cover = wind.w * desert_inside(place);
    let radiance = dune_radiance(pixel, mix(desert.ground, desert.albedo, cover));
    let air = aerial_seen(plane, distance, sky_sun_cosine(-view));
    return vec4<f32>((radiance * air.transmittance + air.light) * frame.pre_exposure, 1.0);
}
