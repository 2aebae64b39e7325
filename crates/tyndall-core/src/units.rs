//! Conversions at the edges of the program. Inside it everything is metres, seconds, radians and kelvin.

/// Metres in a kilometre.
pub const M_PER_KM: f64 = 1000.0;

/// Metres in a nanometre.
pub const M_PER_NM: f64 = 1e-9;

/// Molecules in a vertical column of one square metre per Dobson unit (1/m^2).
pub const MOLECULES_PER_M2_PER_DOBSON_UNIT: f64 = 2.686_78e20;
