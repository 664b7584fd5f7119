//! A silhouette from the first page of a PDF; files of Illustrator (AI) are PDF too.
//!
//! The page becomes an SVG drawing, its points plain numbers, and is read as that.

use super::{OutlineReader, ReadingOption, svg};
use crate::outline::{Import, Imported, MAX_FILE_BYTES, Note, OutlineError, Point};
use hayro_svg::hayro_interpret::InterpreterSettings;
use hayro_svg::hayro_syntax::Pdf as Document;
use hayro_svg::{RenderCache, SvgRenderSettings, convert};
use image::RgbaImage;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Millimetres in a point, the unit of pages.
const MM_PER_POINT: f64 = 25.4 / 72.0;
/// How such a file begins, and within how many bytes.
const MAGIC: &[u8] = b"%PDF-";
const HEAD: usize = 1024;

pub(super) struct Pdf;

impl OutlineReader for Pdf {
    fn names(&self) -> [&'static str; 2] {
        ["a PDF or AI drawing", "PDF drawings"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["pdf", "ai"]
    }

    fn can_read(&self, bytes: &[u8]) -> bool {
        bytes[..bytes.len().min(HEAD)].windows(MAGIC.len()).any(|window| window == MAGIC)
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Background, ReadingOption::Unit, ReadingOption::Threshold]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        let (drawing, pages) = first_page(bytes)?;
        let unit_mm = import.unit_mm.or(Some(MM_PER_POINT));
        let mut imported = svg::import(drawing.as_bytes(), &Import { unit_mm, ..import.clone() })?;
        if pages > 1 {
            imported.changes.notes.push(Note::Pages(pages));
        }
        Ok(imported)
    }

    fn texture(&self, bytes: &[u8], import: &Import, drawn_box: [Point; 2]) -> Result<RgbaImage, OutlineError> {
        svg::texture(first_page(bytes)?.0.as_bytes(), import, drawn_box)
    }
}

/// The first page as SVG, and the number of pages.
fn first_page(bytes: &[u8]) -> Result<(String, usize), OutlineError> {
    let unreadable = |reason: &str| OutlineError::Unreadable { format: "PDF", reason: reason.to_owned() };
    // The library promises no panic for no file; one is a file that cannot be read.
    let converted = catch_unwind(AssertUnwindSafe(|| {
        let document = Document::new(bytes.to_vec()).map_err(|error| format!("{error:?}"))?;
        let pages = document.pages();
        let page = pages.first().ok_or("it has no pages")?;
        let svg = convert(page, &RenderCache::new(), &InterpreterSettings::default(), &SvgRenderSettings::default());
        Ok::<_, String>((svg, pages.len()))
    }));
    let (svg, pages) = converted.map_err(|_| unreadable("its page cannot be drawn"))?.map_err(|e| unreadable(&e))?;
    if svg.len() > MAX_FILE_BYTES { Err(OutlineError::TooLarge) } else { Ok((svg, pages)) }
}
