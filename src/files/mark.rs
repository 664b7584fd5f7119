//! A mark in the pictures that we write, by which they are told from those of others.

/// The chunk of a PNG file that says who made it: length, kind, keyword and text, CRC-32.
const PNG_MARK: &[u8] = b"\0\0\0\x14tEXtSoftware\0plushwright\x0f\x01\x4b\xb4";
/// Where it stands: after the signature (8 bytes) and the header (25).
const PNG_MARK_AT: usize = 33;
/// The comment of a JPEG file that says it: marker, length, text.
const JPEG_MARK: &[u8] = b"\xff\xfe\x00\x0dplushwright";
/// Where it stands: after the marker of the start (2 bytes) and the header (18).
const JPEG_MARK_AT: usize = 20;

/// The comment of a GIF file that says it: introducer, label, length, text, end.
const GIF_MARK: &[u8] = b"\x21\xfe\x0bplushwright\0";
/// Length of a GIF's header.
const GIF_HEADER: usize = 13;

/// The bytes of a PNG file with the mark.
pub fn marked_png(png: &[u8]) -> Vec<u8> {
    with(png, PNG_MARK, PNG_MARK_AT)
}

/// The bytes of a JPEG file with the mark.
pub fn marked_jpeg(jpeg: &[u8]) -> Vec<u8> {
    with(jpeg, JPEG_MARK, JPEG_MARK_AT)
}

/// The bytes of a GIF file with the mark.
pub fn marked_gif(gif: &[u8]) -> Vec<u8> {
    with(gif, GIF_MARK, gif_mark_at(gif))
}

/// Where the mark of a GIF stands: after the header, and the table of colours of all pictures where there is one.
fn gif_mark_at(head: &[u8]) -> usize {
    let flags = head.get(10).copied().unwrap_or(0);
    GIF_HEADER + if flags & 0x80 == 0 { 0 } else { 6 << (flags & 7) }
}

/// Whether a file that begins like this is a GIF of ours.
pub fn is_marked_gif(head: &[u8]) -> bool {
    head.starts_with(b"GIF8") && head.get(gif_mark_at(head)..).is_some_and(|rest| rest.starts_with(GIF_MARK))
}

/// Whether a file that begins like this is a PNG of ours.
pub fn is_marked_png(head: &[u8]) -> bool {
    head.starts_with(b"\x89PNG") && head.get(PNG_MARK_AT..).is_some_and(|rest| rest.starts_with(PNG_MARK))
}

/// Whether a file that begins like this is a JPEG of ours.
pub fn is_marked_jpeg(head: &[u8]) -> bool {
    head.starts_with(b"\xff\xd8") && head.get(JPEG_MARK_AT..).is_some_and(|rest| rest.starts_with(JPEG_MARK))
}

fn with(bytes: &[u8], mark: &[u8], at: usize) -> Vec<u8> {
    let (start, rest) = bytes.split_at(at.min(bytes.len()));
    [start, mark, rest].concat()
}
