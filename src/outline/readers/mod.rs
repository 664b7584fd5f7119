//! Readers of outlines, one kind of file each, and the table of them.

mod drawing;
mod dxf;
mod encoding;
mod finish;
mod flat;
mod foreign;
mod ground;
mod layers;
mod packed;
mod pdf;
mod picture;
mod reader;
pub mod svg;

pub(super) use foreign::unknown;
pub(super) use packed::unpacked;
pub(super) use picture::decoded;
pub(super) use reader::Painting;
pub use reader::{OutlineReader, ReadingOption};

/// All readers; the first that can read a file does. A new one is a file and its two lines here.
const READERS: [&dyn OutlineReader; 8] =
    [&picture::Picture, &pdf::Pdf, &dxf::Dxf, &svg::Svg, &drawing::OfParts, &flat::Obj, &flat::Stl, &flat::Threemf];

/// The reader of a file, whatever it is called; `None` where it is no outline.
pub fn reader_of(bytes: &[u8]) -> Option<&'static dyn OutlineReader> {
    READERS.into_iter().find(|reader| reader.can_read(bytes))
}

/// How files with outlines are called.
pub fn extensions() -> Vec<&'static str> {
    READERS.iter().flat_map(|reader| reader.extensions()).copied().collect()
}
