//! The pattern on paper: every piece on a page of its size, and on the pages of an office printer, to be glued together.

use super::skin::{self, FACES, Face};
use super::tiles::{PAPERS, Tiles};
use crate::fabrication::error::ExportError;
use crate::fabrication::piece::Piece;
use crate::fabrication::preset::Preset;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::sheet::{Group, REFERENCE_MM, Sheet, reference_square};
use crate::outline::polygon::bounding_box;

/// Space around a piece on its page, mm.
const MARGIN_MM: f64 = 15.0;
/// The same where it is cut into pages, mm: the width of its line.
const CLOSE_MM: f64 = 1.0;

const GUIDE: &str = "  The pattern on paper. pattern-print has each piece on a page of its own size, for a copy shop. The others are for A4 and for Letter paper:
  print them at 100 %, without scaling to the page, measure the square of 100 mm on the first page, cut along the frame of a page where it
  meets another one, and glue the pages together so that the crosses and the letters meet. The first page shows how they lie.
";

/// The books `pattern-print`, `pattern-a4` and `pattern-letter`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let piece = source.piece();
    let pages: Vec<Sheet> = FACES.iter().map(|face| page(source, piece, face, MARGIN_MM)).collect();
    let with_square = |page: &Sheet| {
        let mut page = page.clone();
        // Below the piece, on a page that is as wide as the square at least.
        let room = REFERENCE_MM + MARGIN_MM;
        for group in &mut page.groups {
            group.entities = group.entities.iter().map(|e| e.placed(|p| [p[0], p[1] + room], 1.0)).collect();
        }
        page.height_mm += room;
        page.width_mm = page.width_mm.max(REFERENCE_MM + 2.0 * MARGIN_MM);
        page.groups.push(reference_square([MARGIN_MM, MARGIN_MM]));
        page
    };
    let mut products = vec![Product::new("pattern-print", Content::Book(pages.iter().map(with_square).collect()))];
    let mut counts = Vec::new();
    let close: Vec<Sheet> = FACES.iter().map(|face| page(source, piece, face, CLOSE_MM)).collect();
    let mut remarks = Vec::new();
    for paper in PAPERS {
        let Some(tiles) = Tiles::new(&source.design.name, &close, &paper) else {
            let words = format!("The pattern would take hundreds of pages of {} paper: there are none.", paper.title);
            remarks.push(words.into());
            continue;
        };
        counts.push(format!("{} of {}", tiles.pages.len(), paper.title));
        products.push(Product::new(format!("pattern-{}", paper.name), Content::Book(tiles.pages)));
    }
    let guide = format!("{GUIDE}  Pages: {}.\n", counts.join(", "));
    Ok(Part { products, guide, remarks })
}

/// A page as large as the piece and a margin.
fn page(source: &Source<'_>, piece: &Piece, face: &Face, margin_mm: f64) -> Sheet {
    let (low, high) = bounding_box(&piece.rim);
    let left = if face.mirrored { high[0] } else { -low[0] };
    let side = if face.mirrored { -1.0 } else { 1.0 };
    let groups: Vec<Group> = skin::drawn(source.skin, piece, face, &Preset::paper(), |p| {
        [side * p[0] + left + margin_mm, p[1] - low[1] + margin_mm]
    });
    Sheet {
        title: format!("{}: {}", source.design.name, face.title),
        width_mm: high[0] - low[0] + 2.0 * margin_mm,
        height_mm: high[1] - low[1] + 2.0 * margin_mm,
        groups,
    }
}
