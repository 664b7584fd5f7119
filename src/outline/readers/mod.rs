//! Readers of outlines, one kind of file each, and the table of them.

mod drawing;
mod dxf;
mod encoding;
mod finish;
mod foreign;
mod ground;
mod layers;
mod obj;
mod packed;
mod picture;
mod reader;
pub mod svg;

pub(super) use foreign::unknown;
pub(super) use packed::unpacked;
pub(super) use picture::decoded;
pub(super) use reader::Painting;
pub use reader::{OutlineReader, ReadingOption};

/// All readers; the first that can read a file does. A new one is a file and its two lines here.
const READERS: [&dyn OutlineReader; 5] = [&picture::Picture, &dxf::Dxf, &svg::Svg, &drawing::OfParts, &obj::Obj];

/// Bytes by which a kind of file is told.
const HEAD: usize = 4000;

/// The reader of a file, whatever it is called; `None` where it is no outline.
pub fn reader_of(bytes: &[u8]) -> Option<&'static dyn OutlineReader> {
    let head = &bytes[..bytes.len().min(HEAD)];
    READERS.into_iter().find(|reader| reader.can_read(head))
}

/// How files with outlines are called.
pub fn extensions() -> Vec<&'static str> {
    READERS.iter().flat_map(|reader| reader.extensions()).copied().collect()
}
