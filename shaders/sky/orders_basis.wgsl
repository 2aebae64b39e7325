// Real spherical harmonics that are symmetric about the sun's meridian, orthonormal over the sphere:
// Y_lm = N_lm P_lm(mu) cos(m phi), 0 <= m <= l <= 4. Twin: tyndall_scattering::orders::basis.

const ORDERS_DEGREES: u32 = 5u;    // l = 0..4
const ORDERS_HARMONICS: u32 = 15u; // of l <= 4

/// N_lm at l (l + 1) / 2 + m.
const ORDERS_NORMS = array<f32, 15>(
    0.282094791774, 0.488602511903, 0.488602511903, 0.630783130505, 0.364182810197,
    0.182091405099, 0.74635266518, 0.304697199643, 0.0963537147547, 0.0393362393284,
    0.846284375322, 0.267618617423, 0.0630783130505, 0.0168583882836, 0.00596034033761,
);

/// P_lm for the next l: the recurrence from P_l-1,m and P_lm.
fn orders_legendre_next(l: u32, m: u32, mu: f32, before: f32, here: f32) -> f32 {
    return (f32(2u * l + 1u) * mu * here - f32(l + m) * before) / f32(l + 1u - m);
}

/// Y_lm for a zenith cosine and the cosine of the azimuth from the sun.
fn orders_harmonic(l: u32, m: u32, mu: f32, cos_phi: f32) -> f32 {
    let sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0));
    var legendre = vec2<f32>(0.0, 1.0); // P_l-1,m and P_lm, from P_mm = (2m - 1)!! sin^m
    var azimuth = vec2<f32>(cos_phi, 1.0); // cos((m - 1) phi) and cos(m phi), by Chebyshev's recurrence
    for (var i = 0u; i < m; i++) { // loops: ORDERS_DEGREES
        legendre.y *= f32(2u * i + 1u) * sine;
        azimuth = vec2<f32>(azimuth.y, 2.0 * cos_phi * azimuth.y - azimuth.x);
    }
    for (var i = m; i < l; i++) { // loops: ORDERS_DEGREES
        legendre = vec2<f32>(legendre.y, orders_legendre_next(i, m, mu, legendre.x, legendre.y));
    }
    return ORDERS_NORMS[l * (l + 1u) / 2u + m] * legendre.y * azimuth.y;
}
