//! Named arrays: how simulations hand their state to files without knowing any file format.

/// Numbers of one kind.
#[derive(Clone, Debug, PartialEq)]
pub enum ArrayData {
    /// Bytes; also logical values.
    U8(Vec<u8>),
    /// 16-bit whole numbers.
    U16(Vec<u16>),
    /// 32-bit whole numbers.
    U32(Vec<u32>),
    /// 32-bit whole numbers with a sign.
    I32(Vec<i32>),
    /// 64-bit whole numbers.
    U64(Vec<u64>),
    /// 64-bit whole numbers with a sign.
    I64(Vec<i64>),
    /// Single precision.
    F32(Vec<f32>),
    /// Double precision.
    F64(Vec<f64>),
}

impl ArrayData {
    /// How many numbers.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::U8(values) => values.len(),
            Self::U16(values) => values.len(),
            Self::U32(values) => values.len(),
            Self::I32(values) => values.len(),
            Self::U64(values) => values.len(),
            Self::I64(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::F64(values) => values.len(),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// An array of any number of dimensions; the first index runs fastest, as in the grids of [`crate::grid`].
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    shape: Vec<usize>,
    data: ArrayData,
}

impl Array {
    /// From numbers in index order, or `None` when their number is not the product of the shape; no dimension is one number.
    #[must_use]
    pub fn new(shape: Vec<usize>, data: ArrayData) -> Option<Self> {
        (shape.iter().try_fold(1_usize, |product, &side| product.checked_mul(side)) == Some(data.len()))
            .then_some(Self { shape, data })
    }

    /// Length along each index.
    #[must_use]
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// The numbers in index order.
    #[must_use]
    pub fn data(&self) -> &ArrayData {
        &self.data
    }
}

/// Arrays by name, in the order of the file.
pub type NamedArrays = Vec<(String, Array)>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shape_and_numbers_must_agree_and_no_shape_overflows() {
        assert!(Array::new(vec![2, 3], ArrayData::U8(vec![0; 6])).is_some(), "six");
        assert!(Array::new(vec![], ArrayData::U64(vec![7])).is_some(), "one number");
        assert!(Array::new(vec![2, 3], ArrayData::U8(vec![0; 5])).is_none(), "five are not six");
        assert!(Array::new(vec![usize::MAX, 2], ArrayData::U8(Vec::new())).is_none(), "overflow");
    }
}
