//! Structs that the host fills: same members at the same bytes in WGSL and in Rust.

use std::collections::BTreeSet;

use naga::{AddressSpace, Handle, Type, TypeInner};
use tyndall_gpu::layout::StructLayout;
use tyndall_gpu::rust_layout;
use tyndall_gpu_sim::gpu_data::{Dunes, Ripples, Sand, SandPass};
use tyndall_render::aerial::gpu_data::Aerial;
use tyndall_render::clouds::gpu_data::{CloudShadow, Clouds};
use tyndall_render::desert::gpu_data::{Blowing, Desert};
use tyndall_render::frame::gpu_data::Frame;
use tyndall_render::landscape::gpu_data::Landscape;
use tyndall_render::sky::gpu_data::{Atmosphere, Orders, SkyLight, SkyView};
use tyndall_render::sky::night::gpu_data::{Airglow, Moon, Refraction, Stars};
use tyndall_render::splats::gpu_data::{SplatBall, SplatCamera};

use crate::modules::{Module, assert_no_faults, faults_in, valid};

/// Every struct in a uniform or storage buffer, by its WGSL name, and its twin in Rust.
fn twins() -> Vec<(&'static str, StructLayout)> {
    vec![
        (
            "Atmosphere",
            rust_layout!(Atmosphere {
                planet_radius_m,
                top_altitude_m,
                air_scale_height_m,
                aerosol_scale_height_m,
                ozone_altitude_m,
                ozone_half_width_m,
                aerosol_g,
                aerosol_phase,
                haze_top_m,
                haze_scale_height_m,
                haze_g,
                haze_forward_weight,
                haze_strongest,
                haze_zone_m,
                padding,
                air_extinction,
                aerosol_extinction,
                ozone_extinction,
                air_source,
                aerosol_source,
                haze_extinction,
                haze_source,
                solar_irradiance,
                ground_albedo,
                red,
                green,
                blue,
            }),
        ),
        frame(),
        ("Aerial", rust_layout!(Aerial { columns, rows, far_m, unit })),
        clouds(),
        cloud_shadow(),
        blowing(),
        desert(),
        dunes(),
        landscape(),
        orders(),
        ("SkyLight", rust_layout!(SkyLight { lowest_mu_sun, highest_mu_sun, top_altitude_m, lux })),
        ("Airglow", rust_layout!(Airglow { zenith, bottom_m, top_m, padding0, padding1 })),
        moon(),
        stars(),
        ("Sand", rust_layout!(Sand { size, wind, keys, fall, open, stamp, padding })),
        ("SandPass", rust_layout!(SandPass { axis, first, last, stride, number, padding0, padding1 })),
        ripples(),
        ("Refraction", rust_layout!(Refraction { lift, horizon_elevation, padding0, padding1, padding2 })),
        sky_view(),
        (
            "SplatBall",
            rust_layout!(SplatBall {
                centre_m,
                radius_m,
                extent,
                peak,
                distance_m,
                sun_depth,
                forward,
                diffuse,
                sky,
                slope,
            }),
        ),
        ("SplatCamera", rust_layout!(SplatCamera { half, perspective, transport, near_m, padding })),
    ]
}

/// Twin of `Frame`.
fn frame() -> (&'static str, StructLayout) {
    (
        "Frame",
        rust_layout!(Frame {
            right,
            tan_half_width,
            up,
            tan_half_height,
            forward,
            near_m,
            position_m,
            pre_exposure,
            size_px,
            tone_map,
            dither,
            auto_exposure,
            manual_gain,
            compensation,
            levels,
            contrast,
            saturation,
            projection,
            largest,
        }),
    )
}

/// Twin of `SkyView`.
fn sky_view() -> (&'static str, StructLayout) {
    (
        "SkyView",
        rust_layout!(SkyView {
            sun_direction,
            observer_altitude_m,
            limb_exponents,
            horizon_elevation,
            sun_angular_radius,
            sun_visible,
            panels,
            table_size,
            rows_below,
            dome_rings,
            dome_segments,
            ground_pattern,
            ground_tile_m,
            padding,
        }),
    )
}

/// Twin of `Clouds`.
fn clouds() -> (&'static str, StructLayout) {
    (
        "Clouds",
        rust_layout!(Clouds {
            size,
            cell_m,
            asymmetry,
            forward_weight,
            transport,
            floor_m,
            ceiling_m,
            reach_m,
            full_per_m,
            wraps,
            all_orders,
            detail,
            block_cells,
            low_corner_m,
            drift_cells,
        }),
    )
}

/// Twin of `CloudShadow`.
fn cloud_shadow() -> (&'static str, StructLayout) {
    (
        "CloudShadow",
        rust_layout!(CloudShadow {
            map_corner_m,
            map_size_m,
            cells_corner_m,
            cells_size_m,
            slope,
            floor_m,
            ceiling_m,
            texel_m,
            spread,
            layers,
            wraps,
            mean,
            moonlit,
            lamp,
            padding,
        }),
    )
}

/// Twin of `Blowing`.
fn blowing() -> (&'static str, StructLayout) {
    ("Blowing", rust_layout!(Blowing { albedo, base_m, along, travelled_m, top_m, floor_m, streaks_a_metre, padding }))
}

/// Twin of `Desert`.
fn desert() -> (&'static str, StructLayout) {
    (
        "Desert",
        rust_layout!(Desert {
            albedo,
            facets,
            ground,
            cell_m,
            size,
            tile_m,
            ripple_gain,
            columns,
            rings,
            wraps,
            ripples,
            centre_radius_m,
            far_radius_m,
            first_azimuth,
            azimuth_step,
            sun_half_width,
            shine,
            glints,
            bounce,
            tile_texels,
            hexagon_m,
            moonlit,
            relief,
        }),
    )
}

/// Twin of `Dunes`.
fn dunes() -> (&'static str, StructLayout) {
    (
        "Dunes",
        rust_layout!(Dunes {
            repose,
            rest,
            plant_repose,
            slab,
            lift_256,
            hop_256,
            speed_up_256,
            drop_on_sand_4096,
            drop_on_bare_4096,
            inflow_65536,
            wear_65536,
            growth,
            best_burial,
            tolerance,
            padding,
        }),
    )
}

/// Twin of `Ripples`.
fn ripples() -> (&'static str, StructLayout) {
    (
        "Ripples",
        rust_layout!(Ripples {
            hop_256,
            hop_per_height_256,
            layer,
            creep_side,
            creep_corner,
            creep_limit,
            dither,
            bedrock,
        }),
    )
}

/// Twin of `Landscape`.
fn landscape() -> (&'static str, StructLayout) {
    (
        "Landscape",
        rust_layout!(Landscape {
            base,
            amplitude,
            half_size_m,
            height_m,
            wavelength_m,
            gain,
            damping,
            ridge,
            valley_m,
            snow_line_m,
            ground_albedo,
            key,
            columns,
            rings,
            far_rings,
            centre_radius_m,
            split_radius_m,
            far_radius_m,
            first_azimuth,
            azimuth_step,
            sun_tan_low,
            sun_tan_high,
            valley_phase,
            padding0,
            sun_heading,
            padding1,
            padding2,
        }),
    )
}

/// Twin of `Moon`.
fn moon() -> (&'static str, StructLayout) {
    (
        "Moon",
        rust_layout!(Moon {
            direction,
            angular_radius,
            sunlight,
            disc_per_sr,
            north,
            earthshine_per_sr,
            light,
            disc,
            maria,
            skylight,
            padding,
        }),
    )
}

/// Twin of `Stars`.
fn stars() -> (&'static str, StructLayout) {
    (
        "Stars",
        rust_layout!(Stars { from_world_x, from_world_y, from_world_z, white, grid, factor, milky_way_cd_m2, padding }),
    )
}

/// Twin of `Orders`.
fn orders() -> (&'static str, StructLayout) {
    (
        "Orders",
        rust_layout!(Orders {
            air_scattering,
            aerosol_scattering,
            haze_scattering,
            moments,
            zeniths,
            altitudes,
            suns_above,
            suns_below,
            zenith_count,
            azimuths,
            panels,
            degree,
            brightness,
            lowest_mu_sun,
            haze_even,
            haze_thinning,
            lights_surfaces,
        }),
    )
}

/// The structs in uniform and storage buffers of a module, those in arrays included.
fn bound_structs(module: &Module) -> Vec<(String, StructLayout)> {
    let is_buffer = |space: AddressSpace| matches!(space, AddressSpace::Uniform | AddressSpace::Storage { .. });
    let variables = module.ir.global_variables.iter().filter(|(_, variable)| is_buffer(variable.space));
    variables.filter_map(|(_, variable)| struct_of(&module.ir, variable.ty)).collect()
}

fn struct_of(ir: &naga::Module, handle: Handle<Type>) -> Option<(String, StructLayout)> {
    let ty = &ir.types[handle];
    match &ty.inner {
        TypeInner::Array { base, .. } => struct_of(ir, *base),
        TypeInner::Struct { members, span } => {
            let members = members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect();
            Some((ty.name.clone().unwrap_or_default(), StructLayout { members, size: *span }))
        }
        _ => None,
    }
}

/// Bound structs without a twin, or with one of another layout.
fn strangers(module: &Module, twins: &[(&str, StructLayout)]) -> Vec<String> {
    let fault = |(name, wgsl): (String, StructLayout)| match twins.iter().find(|(known, _)| *known == name) {
        None => Some(format!("`{name}` has no twin in tests/shaders/layouts.rs")),
        Some((_, rust)) if *rust != wgsl => Some(format!("`{name}`:\n  WGSL {wgsl:?}\n  Rust {rust:?}")),
        Some(_) => None,
    };
    bound_structs(module).into_iter().filter_map(fault).collect()
}

#[test]
fn every_struct_in_a_buffer_has_the_layout_of_its_rust_twin() {
    let twins = twins();
    assert_no_faults(|module| strangers(module, &twins), "host and shader disagree about these bytes");
}

#[test]
fn every_twin_is_bound_by_some_shader() {
    let bound: BTreeSet<String> = valid().flat_map(bound_structs).map(|(name, _)| name).collect();
    for (name, _) in twins() {
        assert!(bound.contains(name), "no shader binds `{name}`; remove its row");
    }
}

#[test]
fn planted_drift_of_a_struct_is_found() {
    let twins = [("Sun", StructLayout::new(&[("direction", 0), ("cos_radius", 12)], 16))];
    let sun = |members: &str| {
        format!(
            "struct Sun {{ {members} }}\n@group(0) @binding(0) var<storage, read> suns: array<Sun>;
             @fragment fn fs() -> @location(0) vec4<f32> {{ return vec4<f32>(suns[0].direction, 1.0); }}"
        )
    };
    let faults = |members: &str| faults_in(|module| strangers(module, &twins), &sun(members));
    assert_eq!(faults("direction: vec3<f32>, cos_radius: f32"), Vec::<String>::new(), "the twin");
    for drift in [
        "direction: vec3<f32>, cos_angle: f32",
        "cos_radius: f32, direction: vec3<f32>",
        "direction: vec3<f32>, cos_radius: f32, normal_offset: f32",
        "direction: vec3<f32>",
    ] {
        assert_eq!(faults(drift).len(), 1, "{drift}");
    }
    let other = faults_in(|module| strangers(module, &[]), &sun("direction: vec3<f32>"));
    assert_eq!(other, ["`Sun` has no twin in tests/shaders/layouts.rs"], "a new struct");
}
