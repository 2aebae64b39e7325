//! How finely the orders of scattering are computed.

use super::basis::MAX_DEGREE;
use crate::Atmosphere;

/// Orders that haze adds for each unit of its vertical optical depth, and at most.
const ORDERS_PER_DEPTH: f64 = 1.0;
const MOST_ORDERS_OF_HAZE: f64 = 24.0;

/// What the source table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrdersMethod {
    /// All orders, by spherical harmonics of the light in all directions.
    Harmonics,
    /// The first order in eight directions, for a second one in pictures: Nishita et al. 1996.
    Nishita1996,
}

/// Sizes of the source table and of the quadratures that fill it. Time grows with the product of altitudes, suns,
/// directions, steps and orders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OrdersQuality {
    /// What the table holds.
    pub method: OrdersMethod,
    /// Altitudes of the table, from the ground to the top, quadratically dense at the ground; at least 3.
    pub altitudes: usize,
    /// How many of these altitudes lie in haze; 0 without haze.
    pub haze_altitudes: usize,
    /// Suns above the horizon, the horizon itself and the zenith among them, dense at the horizon; at least 3.
    pub suns_above: usize,
    /// Suns below the horizon, evenly spaced in the cosine; at least 2.
    pub suns_below: usize,
    /// Zenith angles of the quadrature above the local horizon, and as many below; at least 2.
    pub zeniths: usize,
    /// Azimuths from the sun in half a turn; the other half is its mirror image. At least 2.
    pub azimuths: usize,
    /// Panels of four nodes along each ray; at least 2.
    pub panels: usize,
    /// Orders that are computed one by one; all higher ones follow as a geometric series. At least 3.
    pub orders: usize,
    /// Degree of the spherical harmonics, 0 to 4.
    pub degree: usize,
}

impl OrdersQuality {
    /// For pictures: a fraction of a per cent by day, a second on two cores.
    #[must_use]
    pub const fn best() -> Self {
        Self {
            method: OrdersMethod::Harmonics,
            altitudes: 24,
            haze_altitudes: 0,
            suns_above: 24,
            suns_below: 28,
            zeniths: 8,
            azimuths: 8,
            panels: 5,
            orders: 5,
            degree: MAX_DEGREE,
        }
    }

    /// For a slider that is being dragged: one per cent by day, an eighth of the time.
    #[must_use]
    pub const fn preview() -> Self {
        Self {
            method: OrdersMethod::Harmonics,
            altitudes: 16,
            haze_altitudes: 0,
            suns_above: 14,
            suns_below: 20,
            zeniths: 6,
            azimuths: 5,
            panels: 4,
            orders: 4,
            degree: MAX_DEGREE,
        }
    }

    /// The second order by eight directions, on as many altitudes as in Nishita et al. 1996; zenith angles, azimuths and
    /// orders do not count.
    #[must_use]
    pub const fn nishita1996() -> Self {
        Self { method: OrdersMethod::Nishita1996, altitudes: 33, ..Self::best() }
    }

    /// The same for an atmosphere that may be hazy: with altitudes in the haze, and more orders the thicker it is, for there
    /// light is scattered many times before it finds its way out.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a few dozen")]
    pub fn for_haze_of(self, atmosphere: &Atmosphere) -> Self {
        let Some(layer) = atmosphere.haze_layer().filter(|_| self.haze_altitudes == 0) else { return self };
        let haze_altitudes = self.altitudes * 2 / 3;
        let depth = layer.strongest_per_m * (layer.top_m + layer.scale_height_m);
        let more = (ORDERS_PER_DEPTH * depth).ceil().min(MOST_ORDERS_OF_HAZE) as usize;
        Self { altitudes: self.altitudes + haze_altitudes, haze_altitudes, orders: self.orders + more, ..self }
    }

    /// Suns of the table.
    #[must_use]
    pub const fn suns(&self) -> usize {
        self.suns_above + self.suns_below
    }
}

impl Default for OrdersQuality {
    fn default() -> Self {
        Self::best()
    }
}
