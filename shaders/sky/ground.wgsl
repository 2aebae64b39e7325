// The ground: a Lambertian sphere lit by the sun and the sky, seen through the air in front of it. Writes depth.
// @import clouds/shadow.wgsl
// @import frame/frame.wgsl
// @import sky/ground_light.wgsl
// @import sky/ground_night.wgsl
// @import sky/sky_view_lookup.wgsl
// @import sky/view.wgsl

struct GroundFragment {
    @location(0) radiance: vec4<f32>, // cd/m^2 times pre-exposure
    @builtin(frag_depth) depth: f32,  // reversed
}

/// Mean over boxes of `width`, along each axis, of waves that are 1 from 0 to 1, -1 from 1 to 2, and so on.
fn ground_waves(at: vec2<f32>, width: vec2<f32>) -> vec2<f32> {
    // Narrow boxes meet one edge at most, whose distance is exact however far the origin is.
    let edge = round(at);
    let rises = 1.0 - 2.0 * abs(edge - 2.0 * floor(0.5 * edge));
    let narrow = rises * clamp((at - edge) / (0.5 * width), vec2<f32>(-1.0), vec2<f32>(1.0));
    // Of wide ones the integral's difference, a wave of triangles.
    let ends = vec4<f32>(at + 0.5 * width, at - 0.5 * width);
    let sums = 1.0 - abs(1.0 - (ends - 2.0 * floor(0.5 * ends)));
    return select((sums.xy - sums.zw) / width, narrow, width < vec2<f32>(0.5));
}

/// Reflection relative to the mean at a point [m] under a pixel as wide as `footprint_m` east and north: the mean of the squares under it.
fn ground_pattern(point: vec2<f32>, footprint_m: vec2<f32>) -> f32 {
    if (sky_view.ground_pattern == 0u) {
        return 1.0;
    }
    // Half a pixel more: edges on pixels' borders and within them look alike, and no beats arise.
    let width = max(1.5 * footprint_m / sky_view.ground_tile_m, vec2<f32>(1e-3));
    let waves = ground_waves(point / sky_view.ground_tile_m, width) * (1.0 - smoothstep(vec2<f32>(1.0), vec2<f32>(2.0), width));
    return 1.0 + 0.35 * waves.x * waves.y;
}

/// Columns [m] between the observer and the ground in a direction.
fn ground_view_columns(mu: f32, t: f32) -> vec4<f32> {
    let radius = atmosphere.planet_radius_m;
    let h = sky_view.observer_altitude_m;
    let mu_ground = mu_along(radius, h, mu, 1.0, t, 0.0);
    // Upwards from the ground, less what lies behind the observer.
    let whole = columns_to_top(0.0, max(-mu_ground, 0.0));
    if (h >= atmosphere.top_altitude_m) {
        return whole;
    }
    return max(whole - columns_to_top(h, -mu), vec4<f32>(0.0));
}

/// Share of the ground in the last pixel before the edge of the planet, which would be stairs otherwise: the edge fades
/// over one pixel below the horizon, to the sky just above it.
fn ground_coverage(plane: vec2<f32>, elevation: f32) -> f32 {
    let pixel = frame_pixel_extent(plane);
    return clamp((sky_view.horizon_elevation - elevation) / max(pixel.x, pixel.y), 0.0, 1.0);
}

/// Light of a sun and its sky (W/m^2/nm) on ground below clouds.
fn ground_shaded(sun: Spectrum, sky: Spectrum, shade: CloudShade) -> Spectrum {
    let light = spectrum_add(spectrum_scale(sun, shade.direct + shade.diffuse), spectrum_scale(sky, shade.sky));
    return Spectrum(light.lo * cloud_shade_between(shade, atmosphere.ground_albedo.lo), light.hi * cloud_shade_between(shade, atmosphere.ground_albedo.hi));
}

@vertex
fn ground_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return frame_triangle(index);
}

@fragment
fn ground_fragment(@builtin(position) position: vec4<f32>) -> GroundFragment {
    let plane = frame_plane(position);
    let direction = frame_direction(plane);
    let radius = atmosphere.planet_radius_m;
    let eye = frame_eye(plane);
    let h = max(sky_view.observer_altitude_m + eye.z, 0.0);
    let t = distance_to_ground(radius, h, direction.z);
    if (t < 0.0) {
        discard;
    }
    let nu = sky_sun_cosine(direction);
    let mu_sun = mu_along(radius, h, sky_view.sun_direction.z, nu, t, 0.0);
    let across_m = frame_pixel_angle(plane) * t;
    let along = abs(direction.xy) / max(length(direction.xy), 1e-6);
    let footprint_m = across_m * (along / max(-direction.z, 1e-4) + along.yx);
    let place = frame.position_m.xy + eye.xy + t * direction.xy;
    let shade = cloud_shade_at(place, 0.0);
    var light = ground_shaded(ground_sun_irradiance(mu_sun), ground_sky_irradiance(mu_sun), shade);
    if (NIGHT && moon.skylight == 1u) {
        let mu_moon = mu_along(radius, h, moon.direction.z, dot(direction, moon.direction), t, 0.0);
        light = spectrum_add(light, spectrum_mul(moon.light, ground_shaded(ground_sun_irradiance(mu_moon), ground_sky_irradiance(mu_moon), shade)));
    }
    light = spectrum_add(light, spectrum_scale(ground_airglow_irradiance(), shade.sky));
    let reflected = spectrum_scale(spectrum_mul(atmosphere.ground_albedo, light), ground_pattern(place, footprint_m) / SKY_PI);
    let transmittance = atmosphere_transmittance(ground_view_columns(direction.z, t));
    let angles = sky_view_angles(direction);
    let air_share = cloud_shade_of_air(h, atmosphere.air_scale_height_m);
    let veil = air_share * (sky_view_radiance(angles, nu) + ground_night_veil(direction, transmittance));
    var radiance = atmosphere_rec709(spectrum_mul(reflected, transmittance)) + veil;
    let coverage = ground_coverage(plane, angles.x);
    if (coverage < 1.0) {
        // A hair above the horizon, so that rounding does not take the rows below it.
        let edge = sky_view.horizon_elevation + 1e-5;
        let raised = vec3<f32>(direction.xy * (cos(edge) / max(length(direction.xy), 1e-6)), sin(edge));
        let above = air_share * (sky_view_radiance(vec2<f32>(edge, angles.y), nu) + ground_night_veil(raised, transmittance));
        radiance = mix(above, radiance, coverage);
    }
    return GroundFragment(vec4<f32>(radiance * frame.pre_exposure, 1.0), frame.near_m / frame_depth_m(direction, t));
}
