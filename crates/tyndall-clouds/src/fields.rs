//! The three logical variables of every cell.

use crate::CloudError;
use crate::bit_field::BitField;
use crate::fnv::fnv1a;
use crate::grid_size::check_size;

/// hum, act and cld of the paper's section 3.2.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CloudFields {
    /// There is vapour enough to form cloud.
    pub hum: BitField,
    /// Vapour is about to become water.
    pub act: BitField,
    /// There is cloud.
    pub cld: BitField,
}

impl CloudFields {
    /// Dry, clear air.
    ///
    /// # Errors
    /// [`CloudError::GridSize`] for a size that the automaton does not take.
    pub fn new(size: [usize; 3]) -> Result<Self, CloudError> {
        let empty = BitField::new(check_size(size)?);
        Ok(Self { hum: empty.clone(), act: empty.clone(), cld: empty })
    }

    /// From one byte per cell, hum + 2 act + 4 cld, x fastest, then y, then z.
    ///
    /// # Errors
    /// When the size is refused, or there is not one byte for each cell.
    pub fn from_bytes(size: [usize; 3], bytes: &[u8]) -> Result<Self, CloudError> {
        let mut fields = Self::new(size)?;
        let expected = size.iter().product();
        if bytes.len() != expected {
            let what = "the list of cells".to_owned();
            return Err(CloudError::WrongLength { what, found: bytes.len(), expected });
        }
        let byte = |[x, y, z]: [usize; 3]| bytes[(z * size[1] + y) * size[0] + x];
        for (bit, field) in [&mut fields.hum, &mut fields.act, &mut fields.cld].into_iter().enumerate() {
            field.fill_with(|cell| (byte(cell) >> bit) & 1 == 1);
        }
        Ok(fields)
    }

    /// [nx, ny, nz].
    #[must_use]
    pub fn size(&self) -> [usize; 3] {
        self.cld.size()
    }

    /// One byte per cell, hum + 2 act + 4 cld, x fastest, then y, then z.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let [nx, ny, nz] = self.size();
        let mut bytes = Vec::with_capacity(nx * ny * nz);
        for z in 0..nz {
            let (layer, height) = (z / crate::bit_field::HEIGHTS_PER_LAYER, z % crate::bit_field::HEIGHTS_PER_LAYER);
            for y in 0..ny {
                let rows = [&self.hum, &self.act, &self.cld].map(|field| field.row(layer, y));
                let bit = |row: usize, x: usize| u8::from((rows[row][x] >> height) & 1 == 1);
                bytes.extend((0..nx).map(|x| bit(0, x) | bit(1, x) << 1 | bit(2, x) << 2));
            }
        }
        bytes
    }

    /// 64-bit FNV-1a hash of [`CloudFields::to_bytes`]: equal states have equal hashes on every system.
    #[must_use]
    pub fn hash(&self) -> u64 {
        fnv1a(&self.to_bytes())
    }

    /// Number of cells with hum, act and cld set.
    #[must_use]
    pub fn counts(&self) -> [u64; 3] {
        [&self.hum, &self.act, &self.cld].map(BitField::count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_survive_the_way_through_bits() {
        let size = [19, 5, 37];
        let bytes: Vec<u8> = (0..19 * 5 * 37_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 29) as u8).collect();
        let fields = CloudFields::from_bytes(size, &bytes).unwrap();
        assert_eq!(fields.to_bytes(), bytes, "all eight states of a cell");
        let ones = bytes.iter().filter(|byte| *byte & 4 != 0).count();
        assert_eq!(fields.counts()[2], ones as u64, "cloud cells");
    }

    #[test]
    fn a_wrong_number_of_bytes_is_refused() {
        let text = CloudFields::from_bytes([4, 4, 4], &[0; 63]).unwrap_err().to_string();
        assert_eq!(text, "the list of cells has 63 entries; 64 are needed");
    }
}
