//! Files that are compressed as a whole.

use crate::outline::{MAX_FILE_BYTES, OutlineError};
use flate2::read::MultiGzDecoder;
use std::borrow::Cow;
use std::io::Read;

/// The first bytes of what `gzip` writes: an SVGZ is that.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// The bytes of a file, unpacked where it is compressed.
///
/// # Errors
/// It is broken, or larger than any that is read.
pub(in crate::outline) fn unpacked(bytes: &[u8]) -> Result<Cow<'_, [u8]>, OutlineError> {
    if !bytes.starts_with(&GZIP) {
        return Ok(bytes.into());
    }
    let mut plain = Vec::new();
    let unreadable =
        |error: std::io::Error| OutlineError::Unreadable { format: "compressed file", reason: error.to_string() };
    MultiGzDecoder::new(bytes).take(MAX_FILE_BYTES as u64 + 1).read_to_end(&mut plain).map_err(unreadable)?;
    if plain.len() > MAX_FILE_BYTES { Err(OutlineError::TooLarge) } else { Ok(plain.into()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::GzEncoder;
    use std::io::Write;

    fn packed(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn what_is_packed_is_unpacked_within_bounds() {
        assert_eq!(unpacked(b"<svg/>").unwrap().as_ref(), b"<svg/>");
        assert_eq!(unpacked(&packed(b"<svg/>")).unwrap().as_ref(), b"<svg/>");
        assert!(matches!(unpacked(&GZIP), Err(OutlineError::Unreadable { .. })));
        assert_eq!(unpacked(&packed(&vec![b' '; MAX_FILE_BYTES + 1])).err(), Some(OutlineError::TooLarge));
    }
}
