// Eight wavelengths as two vectors: 395, 442, 477, 524 and 571, 618, 654, 701 nm.

struct Spectrum {
    lo: vec4<f32>, // 395, 442, 477, 524 nm
    hi: vec4<f32>, // 571, 618, 654, 701 nm
}

/// Sum of two spectra.
fn spectrum_add(a: Spectrum, b: Spectrum) -> Spectrum {
    return Spectrum(a.lo + b.lo, a.hi + b.hi);
}

/// Product of two spectra, wavelength by wavelength.
fn spectrum_mul(a: Spectrum, b: Spectrum) -> Spectrum {
    return Spectrum(a.lo * b.lo, a.hi * b.hi);
}

/// A spectrum times a number.
fn spectrum_scale(a: Spectrum, factor: f32) -> Spectrum {
    return Spectrum(a.lo * factor, a.hi * factor);
}

/// exp(-optical depth) for each wavelength.
fn spectrum_transmittance(optical_depth: Spectrum) -> Spectrum {
    return Spectrum(exp(-optical_depth.lo), exp(-optical_depth.hi));
}

/// Weighted sum over the wavelengths, one row of the map to a colour channel.
fn spectrum_dot(a: Spectrum, weights: Spectrum) -> f32 {
    return dot(a.lo, weights.lo) + dot(a.hi, weights.hi);
}
