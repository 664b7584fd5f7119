//! A file becomes a picture of what would be read of it.

use super::{Cancelled, Context};
use crate::outline::{self, Changes, Import, OutlineError, Pieces};
use crate::picture::preview::{self, Preview};
use crate::picture::raster::RasterError;

/// Width and height of a preview, pixels.
pub const SIZE: (u32, u32) = (900, 900);

/// What would be read of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Previewed {
    pub picture: Preview,
    /// What each colour of the picture stands for.
    pub legend: Vec<String>,
    pub changes: Changes,
    /// Width and height of the outline, mm.
    pub size_mm: [f64; 2],
    /// Why it would be refused all the same: it is in several pieces, which the picture shows.
    pub refused: Option<OutlineError>,
}

/// Why there is no preview.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Outline(#[from] OutlineError),
    #[error(transparent)]
    Picture(#[from] RasterError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Reads an outline and draws it, with what was left out and what was filled.
///
/// # Errors
/// The bytes show no outline; [`Error::Cancelled`].
pub fn run(bytes: &[u8], import: &Import, size: (u32, u32), context: &Context) -> Result<Previewed, Error> {
    context.check()?;
    let (imported, refused) = match outline::import(bytes, import) {
        Err(refused @ OutlineError::Pieces { .. }) => {
            let largest = Import { pieces: Pieces::Largest, ..import.clone() };
            (outline::import(bytes, &largest)?, Some(refused))
        }
        read => (read?, None),
    };
    context.check()?;
    let picture = preview::paint(&imported, size)?;
    let (_, size_mm) = imported.outline.bounding_box();
    Ok(Previewed { picture, legend: preview::legend(&imported), changes: imported.changes, size_mm, refused })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn pieces_are_shown_though_they_are_refused() {
        let svg = b"<svg xmlns='http://www.w3.org/2000/svg' width='90mm' height='90mm' viewBox='0 0 90 90'>\
                    <rect width='30' height='60'/><rect x='40' width='20' height='60'/></svg>";
        let cancel = AtomicBool::new(false);
        let shown = run(svg, &Import::default(), (64, 64), &Context::new(&cancel)).unwrap();
        assert!(matches!(shown.refused, Some(OutlineError::Pieces { pieces: 2, .. })));
        assert_eq!(shown.legend, ["red: other pieces, left out"]);
        assert_eq!(shown.picture.pixels.len(), 64 * 64 * 4);
        assert!(run(b"none", &Import::default(), (64, 64), &Context::new(&cancel)).is_err());
    }
}
