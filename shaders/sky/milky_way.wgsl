// The Milky Way: the stars too faint for the catalogue, as a band about the galactic equator, bright towards the centre of the
// galaxy and split by dust. A model, not a map: two bells in galactic latitude and noise in place of the star clouds.
// @import common/noise.wgsl
// @import sky/stars.wgsl

/// Radiance (cd/m^2) above the atmosphere in a direction in the axes of the catalogue.
fn milky_way_radiance(direction: vec3<f32>) -> vec3<f32> {
    // Axes of the galaxy in the equator of J2000: to its centre, along its turn, to its north pole.
    let centre = dot(direction, vec3<f32>(-0.0548756, -0.8734371, -0.4838350));
    let turn = dot(direction, vec3<f32>(0.4941094, -0.4448296, 0.7469823));
    let pole = dot(direction, vec3<f32>(-0.8676661, -0.1980764, 0.4559838));
    let bent = pole + 0.035 * (noise_value(direction * 5.0) - 0.5);
    let towards = 0.5 + 0.5 * centre;
    let width = mix(0.13, 0.2, towards * towards);
    let disc = exp(-0.5 * bent * bent / (width * width)) * mix(0.22, 0.75, towards * towards);
    let bulge = 0.9 * exp(-0.5 * (turn * turn / 0.09 + pole * pole / 0.028)) * step(0.0, centre);
    var clouds = 0.0;
    var scale = 11.0;
    var share = 0.5;
    for (var octave = 0u; octave < 4u; octave++) { // loops: 4
        clouds += share * noise_value(direction * scale);
        scale *= 2.1;
        share *= 0.5;
    }
    // The great rift runs along the equator from the centre half way round.
    let off_rift = (bent - 0.02) / 0.045;
    let rift = exp(-0.5 * off_rift * off_rift) * smoothstep(-0.4, 0.5, centre) * smoothstep(0.3, 0.62, clouds);
    let light = (disc + bulge) * (0.45 + 1.1 * clouds) * (1.0 - 0.75 * rift) + 0.03;
    // Old stars in the middle are warmer than the arms.
    let colour = mix(vec3<f32>(0.93, 1.0, 1.19), vec3<f32>(1.12, 0.98, 0.80), clamp(bulge, 0.0, 1.0));
    return stars.milky_way_cd_m2 * light * colour;
}
