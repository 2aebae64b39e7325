//! What splats leave in a picture.

/// Planes of a picture: 0 to 2 for light scattered once, 3 to 6 for light scattered often.
pub(super) const ONCE_PLANES: usize = 3;
/// All planes.
pub(super) const ALL_PLANES: usize = 7;
/// Values that are computed at a time.
pub(super) const LANES: usize = 8;

/// Shares of light of every pixel. Sums run over the balls, each times what the cloud before it lets through.
#[derive(Clone, Debug, PartialEq)]
pub struct SplatPlanes {
    size_px: [usize; 2],
    stride: usize,
    planes: usize,
    /// Row by row, in each row plane by plane.
    values: Vec<f32>,
}

/// Values of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplatPixel {
    /// Direct sunlight that reaches the eye by one scattering, over the phase function.
    pub direct: f32,
    /// Distance (m) times the share of what is seen.
    pub distance_m: f32,
    /// What is left of the light from behind.
    pub transmittance: f32,
    /// Sunlight scattered forward alone, over its phase function.
    pub forward: f32,
    /// Sunlight scattered often (1/sr).
    pub diffuse: f32,
    /// Light of the sky.
    pub sky: f32,
    /// What is left of light that may be scattered often on its way.
    pub thin: f32,
}

impl SplatPlanes {
    /// A clear picture.
    pub(super) fn new(size_px: [usize; 2], planes: usize) -> Self {
        let stride = size_px[0].next_multiple_of(LANES) + LANES;
        let mut values = vec![0.0; stride * planes * size_px[1]];
        for row in values.chunks_exact_mut(stride * planes) {
            row[2 * stride..3 * stride].fill(1.0);
            if planes > ONCE_PLANES {
                row[6 * stride..].fill(1.0);
            }
        }
        Self { size_px, stride, planes, values }
    }

    /// Width and height (px).
    #[must_use]
    pub fn size_px(&self) -> [usize; 2] {
        self.size_px
    }

    /// Values in a row of a plane, some beyond the picture.
    pub(super) fn stride(&self) -> usize {
        self.stride
    }

    pub(super) fn values_mut(&mut self) -> &mut [f32] {
        &mut self.values
    }

    /// The pixel in a column of a row, from the upper left corner; light scattered often is nothing where it was not asked for.
    #[must_use]
    pub fn pixel(&self, column: usize, row: usize) -> SplatPixel {
        let value = |plane: usize| self.values[(row * self.planes + plane) * self.stride + column];
        let often = |plane: usize| if self.planes > ONCE_PLANES { value(plane) } else { 0.0 };
        let thin = if self.planes > ONCE_PLANES { value(6) } else { 1.0 };
        SplatPixel {
            direct: value(0),
            distance_m: value(1),
            transmittance: value(2),
            forward: often(3),
            diffuse: often(4),
            sky: often(5),
            thin,
        }
    }
}
