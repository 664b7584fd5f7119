//! What a reader of outlines is.

use crate::outline::even::Evened;
use crate::outline::regions::Shapes;
use crate::outline::{Aside, Import, Imported, Note, OutlineError, Point};
use image::RgbaImage;

/// Reads one kind of file.
pub trait OutlineReader: Sync {
    /// What one file of this kind is, and several: `an OBJ mesh`, `OBJ meshes`.
    fn names(&self) -> [&'static str; 2];

    /// How they are called; what they are is told by their first bytes.
    fn extensions(&self) -> &'static [&'static str];

    /// Whether a file is of this kind: told by how it begins, or is built.
    fn can_read(&self, bytes: &[u8]) -> bool;

    /// Options of [`Import`] that mean something for this kind, beside those of the clean-up.
    fn options(&self) -> &'static [ReadingOption];

    /// The clean outline of a file, see `super::finish::finish`.
    ///
    /// # Errors
    /// See [`OutlineError`]. Never panics, and ends within some seconds, whatever the bytes are.
    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError>;

    /// What the file shows between the corners of a box, [`Imported::drawn_box`]; its longer side has at most
    /// [`crate::outline::MAX_TEXTURE_PX`].
    ///
    /// # Errors
    /// A kind without colours; a drawing that takes too long to paint.
    fn texture(&self, bytes: &[u8], import: &Import, drawn_box: [Point; 2]) -> Result<RgbaImage, OutlineError> {
        let _ = (bytes, import, drawn_box);
        Err(OutlineError::NoTexture(self.names()[0]))
    }
}

/// An option that not every kind of file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReadingOption {
    /// [`Import::layers`]; refused where there are none.
    Layers,
    /// [`Import::unit_mm`].
    Unit,
    /// [`Import::threshold`].
    Threshold,
    /// [`Import::background`].
    Background,
    /// [`Import::blocks`]; refused where there are none.
    Blocks,
}

/// Painted areas of a file, which may overlap, y up, and what there is to say about them.
#[derive(Default)]
pub(in crate::outline) struct Painting {
    pub shapes: Shapes,
    /// Millimetres in a unit of the shapes.
    pub unit_mm: f64,
    pub notes: Vec<Note>,
    /// What was found besides and does not count.
    pub asides: Vec<Aside>,
    /// What was evened on the way, in the unit of the shapes.
    pub evened: Evened,
}
