//! A mark in the PNG files that we write, by which they are told from the pictures of others.

/// The chunk that says who made a picture: length, kind, keyword and text, CRC-32.
const MARK: &[u8] = b"\0\0\0\x14tEXtSoftware\0plushwright\x0f\x01\x4b\xb4";
/// Where it stands: after the signature (8 bytes) and the header (25).
const MARK_AT: usize = 33;

/// The bytes of a PNG file with the mark.
pub fn marked_png(png: &[u8]) -> Vec<u8> {
    let (start, rest) = png.split_at(MARK_AT.min(png.len()));
    [start, MARK, rest].concat()
}

/// Whether a file that begins like this is a PNG of ours.
pub fn is_marked_png(head: &[u8]) -> bool {
    head.starts_with(b"\x89PNG") && head.get(MARK_AT..).is_some_and(|rest| rest.starts_with(MARK))
}
