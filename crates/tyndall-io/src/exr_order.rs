//! Puts the attributes of an EXR header into alphabetical order.
//!
//! The encoder keeps custom attributes in a hash map with a random seed, so that the same picture gives other bytes
//! each time. Sorted, as the reference library writes them, equal pictures are equal files.

use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};

/// Magic number and version.
const PREAMBLE_BYTES: u64 = 8;

/// No header of ours comes near; keeps the search for the end of a header short if the file is none.
const MAX_HEADER_BYTES: u64 = 1 << 24;

/// Sorts the header of the one-part file that was just written. The size of the header stays, and with it every offset.
pub(crate) fn sort_attributes(file: &mut (impl Read + Write + Seek)) -> io::Result<()> {
    file.seek(SeekFrom::Start(PREAMBLE_BYTES))?;
    let mut attributes = read_attributes(&mut BufReader::new(&mut *file).take(MAX_HEADER_BYTES))?;
    attributes.sort();
    file.seek(SeekFrom::Start(PREAMBLE_BYTES))?;
    file.write_all(&attributes.concat())
}

/// The attributes, each as its bytes: name, zero, type, zero, size as i32, value. An empty name ends the header.
fn read_attributes(header: &mut impl Read) -> io::Result<Vec<Vec<u8>>> {
    let mut attributes = Vec::new();
    loop {
        let mut attribute = Vec::new();
        read_name(header, &mut attribute)?;
        if attribute == [0] {
            return Ok(attributes);
        }
        read_name(header, &mut attribute)?;
        let mut size = [0; 4];
        header.read_exact(&mut size)?;
        attribute.extend(size);
        let value_bytes = u64::from(u32::from_le_bytes(size));
        if header.take(value_bytes).read_to_end(&mut attribute)? as u64 != value_bytes {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        attributes.push(attribute);
    }
}

/// Appends a name and the zero that ends it.
fn read_name(header: &mut impl Read, attribute: &mut Vec<u8>) -> io::Result<()> {
    loop {
        let mut byte = [0];
        header.read_exact(&mut byte)?;
        attribute.push(byte[0]);
        if byte == [0] {
            return Ok(());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn file_of(attributes: &[&[u8]]) -> Vec<u8> {
        [b"\x76\x2f\x31\x01\x02\0\0\0", attributes.concat().as_slice(), b"\0pixels"].concat()
    }

    #[test]
    fn attributes_are_sorted_and_everything_else_stays() {
        let (a, b, c) = (b"a\0int\0\x04\0\0\0\x01\0\x02\0", b"b\0string\0\0\0\0\0", b"c\0string\0\x02\0\0\0hi");
        let mut file = Cursor::new(file_of(&[c, a, b]));
        sort_attributes(&mut file).unwrap();
        assert_eq!(file.into_inner(), file_of(&[a, b, c]), "sorted by name, the pixels behind untouched");
    }

    #[test]
    fn a_header_without_end_is_an_error() {
        let mut file = Cursor::new(b"\x76\x2f\x31\x01\x02\0\0\0a\0int\0\x7f\0\0\0short".to_vec());
        assert!(sort_attributes(&mut file).is_err(), "the value is shorter than its size");
    }
}
