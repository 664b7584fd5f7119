//! From what a reader found to one clean outline.

use super::reader::Painting;
use crate::outline::clean;
use crate::outline::options::SIZES_MM;
use crate::outline::{Import, Imported, Note, OutlineError};

/// Without an asked size, a silhouette lower than this is small for a plushie, mm.
const SMALL_MM: f64 = 60.0;

/// Cleans what a reader found.
pub(super) fn finish(painting: Painting, import: &Import) -> Result<Imported, OutlineError> {
    import.check()?;
    let imported = clean::clean(painting, import)?;
    let (_, high) = imported.outline.bounding_box();
    if let Some(side) = high.into_iter().find(|side| !SIZES_MM.contains(side)) {
        return Err(OutlineError::Size(side));
    }
    Ok(warned(imported, import))
}

/// With a warning where the file's own size makes a small plushie.
pub(super) fn warned(mut imported: Imported, import: &Import) -> Imported {
    let (_, high) = imported.outline.bounding_box();
    if !import.asks_size() && high[1] < SMALL_MM {
        imported.changes.notes.push(Note::Small(high[1]));
    }
    imported
}

impl Import {
    /// Refuses lengths that are none, and sizes that no plushie has.
    pub(in crate::outline) fn check(&self) -> Result<(), OutlineError> {
        if self.height_mm.is_some() && self.width_mm.is_some() {
            return Err(OutlineError::TwoSizes);
        }
        for (what, size) in [("height", self.height_mm), ("width", self.width_mm)] {
            if let Some(value) = size.filter(|size| !SIZES_MM.contains(size)) {
                return Err(OutlineError::Asked { what, value });
            }
        }
        let lengths = [
            ("the smoothing tolerance", self.smooth_mm),
            ("the gap", self.gap_mm),
            ("the join", self.join_mm),
            ("the least width", self.min_width_mm),
            ("the unit", self.unit_mm),
        ];
        for (what, value) in lengths {
            if let Some(value) = value.filter(|v| !(v.is_finite() && *v >= 0.0)) {
                return Err(OutlineError::Length { what, value });
            }
        }
        Ok(())
    }
}
