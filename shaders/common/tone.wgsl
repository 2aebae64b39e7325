// Tone mapping of exposed linear Rec.709 (1 = white) to display values 0..1, sRGB-encoded. Twins: tyndall_render::tone.

/// sRGB encoding of a linear channel, IEC 61966-2-1.
fn tone_srgb_encode(linear: f32) -> f32 {
    let x = clamp(linear, 0.0, 1.0);
    return select(1.055 * pow(x, 1.0 / 2.4) - 0.055, 12.92 * x, x <= 0.0031308);
}

// Scales of the hyperbola v / (1 + v^p)^(1/p) with which the curve reaches 0 and 1 exactly:
// ((s r)^-p ((s r / y)^p - 1))^(-1/p) for slope s = 2, run r to the end of the range, rise y = 0.5, powers 3 and 3.25.
const TONE_AGX_TOE_SCALE: f32 = 0.512277383;
const TONE_AGX_SHOULDER_SCALE: f32 = 0.541464154;

/// The AgX curve on log-encoded x in 0..1: a slope of 2 through the pivot, bent to 0 and 1 with powers 3 and 3.25.
/// Sobotka's AgX: pivot 10/16.5 to 0.5.
fn tone_agx_curve(x: f32) -> f32 {
    let pivot_x = 0.6060606;
    let shoulder = x >= pivot_x;
    let power = select(3.0, 3.25, shoulder);
    let scale = select(TONE_AGX_TOE_SCALE, TONE_AGX_SHOULDER_SCALE, shoulder);
    let v = 2.0 * abs(x - pivot_x) / scale;
    let bent = scale * v / pow(1.0 + pow(v, power), 1.0 / power);
    return 0.5 + select(-bent, bent, shoulder);
}

/// AgX: desaturating matrix, logarithm over 16.5 stops, curve, and the display power of 2.2 already in the curve.
fn tone_agx(colour: vec3<f32>) -> vec3<f32> {
    let inset = mat3x3<f32>(
        vec3<f32>(0.842479062253094, 0.0423282422610123, 0.0423756549057051),
        vec3<f32>(0.0784335999999992, 0.878468636469772, 0.0784336),
        vec3<f32>(0.0792237451477643, 0.0791661274605434, 0.879142973793104),
    );
    // 0.18 lies 10 stops above the foot and 6.5 below the top.
    let low = -12.473931188;
    let log_colour = clamp((log2(max(inset * max(colour, vec3<f32>(0.0)), vec3<f32>(1e-10))) - low) / 16.5, vec3<f32>(0.0), vec3<f32>(1.0));
    let curved = vec3<f32>(tone_agx_curve(log_colour.x), tone_agx_curve(log_colour.y), tone_agx_curve(log_colour.z));
    let outset = mat3x3<f32>(
        vec3<f32>(1.19687900512017, -0.0528968517574562, -0.0529716355144438),
        vec3<f32>(-0.0980208811401368, 1.15190312990417, -0.0980434501171241),
        vec3<f32>(-0.0990297440797205, -0.0989611768448433, 1.15107367264116),
    );
    return clamp(outset * curved, vec3<f32>(0.0), vec3<f32>(1.0));
}

/// A look on display values, as the ASC colour decision list has it: power, then saturation about Rec.709 luma.
fn tone_look(shown: vec3<f32>, contrast: f32, saturation: f32) -> vec3<f32> {
    let bent = pow(max(shown, vec3<f32>(0.0)), vec3<f32>(contrast));
    let luma = dot(bent, vec3<f32>(0.2126, 0.7152, 0.0722));
    return clamp(luma + (bent - luma) * saturation, vec3<f32>(0.0), vec3<f32>(1.0));
}

/// ACES: the reference rendering and sRGB output transforms as a rational curve between two matrices, fitted by S. Hill;
/// linear output.
fn tone_aces(colour: vec3<f32>) -> vec3<f32> {
    let to_rrt = mat3x3<f32>(
        vec3<f32>(0.59719, 0.07600, 0.02840),
        vec3<f32>(0.35458, 0.90834, 0.13383),
        vec3<f32>(0.04823, 0.01566, 0.83777),
    );
    let v = to_rrt * max(colour, vec3<f32>(0.0));
    let curved = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    let from_odt = mat3x3<f32>(
        vec3<f32>(1.60475, -0.10208, -0.00327),
        vec3<f32>(-0.53108, 1.10813, -0.07276),
        vec3<f32>(-0.07367, -0.00605, 1.07602),
    );
    return clamp(from_odt * curved, vec3<f32>(0.0), vec3<f32>(1.0));
}
