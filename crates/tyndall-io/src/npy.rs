//! Arrays in `NumPy`'s NPY form, versions 1 to 3: a line that describes the array, and its numbers in little-endian bytes.
//!
//! Arrays are written with `fortran_order`: index [x, y, z] in Python is cell (x, y, z). Either order is read. Not done:
//! big-endian numbers, complex numbers, text, records.

use std::io::{self, Read, Write};

use tyndall_core::array::{Array, ArrayData};

const MAGIC: &[u8; 6] = b"\x93NUMPY";
/// The description ends where this divides the number of bytes.
const ALIGNMENT: usize = 64;
/// Longest description that is read.
const MAX_HEADER_BYTES: usize = 1 << 16;
/// Most bytes of one array.
const MAX_ARRAY_BYTES: usize = 1 << 34;

/// What the description says.
struct Header {
    kind: String,
    fortran_order: bool,
    shape: Vec<usize>,
}

/// Writes one array.
pub(crate) fn write_array(target: &mut impl Write, array: &Array) -> io::Result<()> {
    let sides: Vec<_> = array.shape().iter().map(usize::to_string).collect();
    let shape = if sides.len() == 1 { format!("({},)", sides[0]) } else { format!("({})", sides.join(", ")) };
    let kind = kind_of(array.data());
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': True, 'shape': {shape}, }}");
    let length = (MAGIC.len() + 4 + text.len() + 1).next_multiple_of(ALIGNMENT) - MAGIC.len() - 4;
    text = format!("{text:<width$}\n", width = length - 1);
    target.write_all(MAGIC)?;
    target.write_all(&[1, 0])?;
    let length = u16::try_from(length).map_err(|_too_long| io::Error::other("too many dimensions"))?;
    target.write_all(&length.to_le_bytes())?;
    target.write_all(text.as_bytes())?;
    write_numbers(target, array.data())
}

fn kind_of(data: &ArrayData) -> &'static str {
    match data {
        ArrayData::U8(_) => "|u1",
        ArrayData::U16(_) => "<u2",
        ArrayData::U32(_) => "<u4",
        ArrayData::I32(_) => "<i4",
        ArrayData::U64(_) => "<u8",
        ArrayData::I64(_) => "<i8",
        ArrayData::F32(_) => "<f4",
        ArrayData::F64(_) => "<f8",
    }
}

fn write_numbers(target: &mut impl Write, data: &ArrayData) -> io::Result<()> {
    macro_rules! write_each {
        ($values:expr) => {
            // Blocks, because a write per number goes through the compressor each time.
            $values.chunks(8192).try_for_each(|block| {
                target.write_all(&block.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>())
            })
        };
    }
    match data {
        ArrayData::U8(values) => target.write_all(values),
        ArrayData::U16(values) => write_each!(values),
        ArrayData::U32(values) => write_each!(values),
        ArrayData::I32(values) => write_each!(values),
        ArrayData::U64(values) => write_each!(values),
        ArrayData::I64(values) => write_each!(values),
        ArrayData::F32(values) => write_each!(values),
        ArrayData::F64(values) => write_each!(values),
    }
}

/// Reads one array.
///
/// # Errors
/// A sentence that says what is wrong.
pub(crate) fn read_array(source: &mut impl Read) -> Result<Array, String> {
    let header = read_header(source)?;
    let count = header.shape.iter().try_fold(1_usize, |product, &side| product.checked_mul(side));
    let size = item_bytes(&header.kind)?;
    let bytes = count.and_then(|count| count.checked_mul(size)).filter(|&bytes| bytes <= MAX_ARRAY_BYTES);
    let bytes = bytes.ok_or_else(|| format!("an array of shape {:?} is too large", header.shape))?;
    // `take`, so that memory grows with what is there and not with what the description claims.
    let mut numbers = Vec::new();
    let read = source.take(bytes as u64).read_to_end(&mut numbers).map_err(|error| error.to_string())?;
    if read != bytes {
        return Err(format!("the array ends after {read} of {bytes} bytes"));
    }
    let data = numbers_from(&header, &numbers)?;
    Array::new(header.shape, data).ok_or_else(|| "shape and numbers do not agree".to_owned())
}

fn read_header(source: &mut impl Read) -> Result<Header, String> {
    let mut start = [0; 8];
    source.read_exact(&mut start).map_err(|_too_short| "this is no NPY array: it is too short".to_owned())?;
    if &start[..6] != MAGIC {
        return Err("this is no NPY array: it does not begin with \\x93NUMPY".to_owned());
    }
    let ended = |_too_short| "the description of the array is cut off".to_owned();
    let length = if start[6] == 1 {
        let mut bytes = [0; 2];
        source.read_exact(&mut bytes).map_err(ended)?;
        usize::from(u16::from_le_bytes(bytes))
    } else if matches!(start[6], 2 | 3) {
        let mut bytes = [0; 4];
        source.read_exact(&mut bytes).map_err(ended)?;
        u32::from_le_bytes(bytes) as usize
    } else {
        return Err(format!("NPY version {}.{} is none of 1 to 3", start[6], start[7]));
    };
    if length > MAX_HEADER_BYTES {
        return Err(format!("a description of {length} bytes is longer than {MAX_HEADER_BYTES}"));
    }
    let mut text = vec![0; length];
    source.read_exact(&mut text).map_err(ended)?;
    parse_header(&String::from_utf8_lossy(&text))
}

/// Reads the three entries of the description, in any order.
fn parse_header(text: &str) -> Result<Header, String> {
    let value = |key: &str| {
        let found = [format!("'{key}':"), format!("\"{key}\":")];
        let rest = found.iter().find_map(|key| text.split_once(key.as_str())).map(|(_, rest)| rest.trim_start());
        rest.ok_or_else(|| format!("the description has no {key}: {}", text.trim()))
    };
    let kind = value("descr")?;
    let quote = kind.chars().next().filter(|quote| matches!(quote, '\'' | '"'));
    let kind = quote.and_then(|quote| kind[1..].split_once(quote)).map(|(kind, _)| kind.to_owned());
    let order = value("fortran_order")?;
    let shape = value("shape")?.strip_prefix('(').and_then(|rest| rest.split_once(')')).map(|(shape, _)| shape);
    let sides = shape.ok_or_else(|| format!("the shape cannot be read: {}", text.trim()))?.split(',');
    let sides: Result<Vec<usize>, _> =
        sides.map(str::trim).filter(|side| !side.is_empty()).map(str::parse::<usize>).collect();
    Ok(Header {
        kind: kind.ok_or_else(|| "records are not read; save each column as an array of its own".to_owned())?,
        fortran_order: order.starts_with("True"),
        shape: sides.map_err(|_no_number| format!("the shape cannot be read: {}", text.trim()))?,
    })
}

fn item_bytes(kind: &str) -> Result<usize, String> {
    match kind {
        "|u1" | "|b1" | "<u1" => Ok(1),
        "<u2" => Ok(2),
        "<u4" | "<i4" | "<f4" => Ok(4),
        "<u8" | "<i8" | "<f8" => Ok(8),
        _ => Err(format!(
            "numbers of kind {kind:?} are not read; allowed are |u1, |b1, <u2, <u4, <i4, <u8, <i8, <f4, <f8"
        )),
    }
}

fn numbers_from(header: &Header, bytes: &[u8]) -> Result<ArrayData, String> {
    macro_rules! read_each {
        ($variant:ident, $kind:ty) => {{
            let (items, _) = bytes.as_chunks::<{ size_of::<$kind>() }>();
            let numbers = items.iter().map(|item| <$kind>::from_le_bytes(*item)).collect();
            ArrayData::$variant(first_index_fastest(header, numbers))
        }};
    }
    Ok(match header.kind.as_str() {
        "<u2" => read_each!(U16, u16),
        "<u4" => read_each!(U32, u32),
        "<i4" => read_each!(I32, i32),
        "<u8" => read_each!(U64, u64),
        "<i8" => read_each!(I64, i64),
        "<f4" => read_each!(F32, f32),
        "<f8" => read_each!(F64, f64),
        "|u1" | "|b1" | "<u1" => read_each!(U8, u8),
        other => return Err(format!("numbers of kind {other:?} are not read")),
    })
}

/// Numbers in the order of [`Array`].
fn first_index_fastest<T: Copy>(header: &Header, numbers: Vec<T>) -> Vec<T> {
    if header.fortran_order || header.shape.len() < 2 {
        return numbers;
    }
    let mut strides = vec![1; header.shape.len()];
    for axis in (1..header.shape.len()).rev() {
        strides[axis - 1] = strides[axis] * header.shape[axis];
    }
    let mut index = vec![0; header.shape.len()];
    let mut sorted = Vec::with_capacity(numbers.len());
    for _ in 0..numbers.len() {
        sorted.push(numbers[index.iter().zip(&strides).map(|(index, stride)| index * stride).sum::<usize>()]);
        for (index, side) in index.iter_mut().zip(&header.shape) {
            *index += 1;
            if *index < *side {
                break;
            }
            *index = 0;
        }
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trip(array: &Array) -> Array {
        let mut bytes = Vec::new();
        write_array(&mut bytes, array).unwrap();
        assert_eq!(
            bytes.len() % 64,
            (array.data().len() * item_bytes(kind_of(array.data())).unwrap()) % 64,
            "alignment"
        );
        read_array(&mut &bytes[..]).unwrap()
    }

    #[test]
    fn every_kind_and_shape_comes_back() {
        let arrays = [
            Array::new(vec![2, 3], ArrayData::U8(vec![0, 1, 2, 3, 4, 255])),
            Array::new(vec![3], ArrayData::U16(vec![1, 2, 65_535])),
            Array::new(vec![], ArrayData::U64(vec![u64::MAX])),
            Array::new(vec![1, 2, 1, 1], ArrayData::I64(vec![-1, i64::MIN])),
            Array::new(vec![2], ArrayData::F32(vec![0.1, f32::MIN_POSITIVE])),
            Array::new(vec![0, 5], ArrayData::F64(vec![])),
            Array::new(vec![1], ArrayData::U32(vec![7])),
            Array::new(vec![2], ArrayData::I32(vec![-7, i32::MIN])),
        ];
        for array in arrays.into_iter().flatten() {
            assert_eq!(round_trip(&array), array, "{array:?}");
        }
    }

    /// `numpy.save` of `numpy.arange(6, dtype="<u2").reshape(2, 3)`: the last index runs fastest.
    #[test]
    fn an_array_in_the_other_order_is_turned() {
        let mut bytes = b"\x93NUMPY\x01\x00v\x00".to_vec();
        let text = "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), }";
        bytes.extend(format!("{text:<117}\n").bytes());
        bytes.extend((0..6_u16).flat_map(u16::to_le_bytes));
        let array = read_array(&mut &bytes[..]).unwrap();
        assert_eq!(array.shape(), [2, 3], "shape");
        assert_eq!(*array.data(), ArrayData::U16(vec![0, 3, 1, 4, 2, 5]), "first index fastest");
    }

    #[test]
    fn what_is_no_array_is_refused_with_the_reason() {
        let with = |text: &str, numbers: &[u8]| {
            let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
            bytes.extend(u16::try_from(text.len()).unwrap().to_le_bytes());
            bytes.extend(text.bytes());
            bytes.extend(numbers);
            read_array(&mut &bytes[..]).unwrap_err()
        };
        let header =
            |kind: &str, shape: &str| format!("{{'descr': {kind}, 'fortran_order': False, 'shape': {shape}, }}");
        for (error, reason) in [
            (read_array(&mut &b"PNG"[..]).unwrap_err(), "too short"),
            (read_array(&mut &b"\x89PNG\r\n\x1a\n"[..]).unwrap_err(), "does not begin with"),
            (with(&header("'>f4'", "(1,)"), &[0; 4]), "\">f4\" are not read"),
            (with(&header("[('a', '<f4')]", "(1,)"), &[0; 4]), "records are not read"),
            (with(&header("'<f4'", "(2,)"), &[0; 7]), "ends after 7 of 8 bytes"),
            (with(&header("'<f4'", "(99999999999, 9999999999)"), &[]), "too large"),
            (with(&header("'<f4'", "(-1,)"), &[]), "shape cannot be read"),
            (with("{'fortran_order': False}", &[]), "no descr"),
        ] {
            assert!(error.contains(reason), "{error:?} should say {reason:?}");
        }
    }
}
