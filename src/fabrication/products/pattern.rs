//! The pattern: front and back of the skin on sheets to be cut by a machine.
//!
//! Both faces carry the same holes, because both are rigged alike; the back is the mirror image of the front, so that
//! the pieces meet with their outer sides together.

use super::skin::{self, FACES};
use crate::fabrication::error::ExportError;
use crate::fabrication::piece::{Bed, Laid, Piece, nest};
use crate::fabrication::preset::Preset;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::remark::Remark;
use crate::fabrication::sheet::{REFERENCE_MM, Sheet, reference};
use crate::outline::{Point, polygon::bounding_box};

/// Space around and between the pieces, mm.
const MARGIN_MM: f64 = 10.0;
const BETWEEN_MM: f64 = 4.0;
/// Height of the lower left corner that holds the reference line and its words, mm.
const REFERENCE_ROW_MM: f64 = 10.0;

/// The sheets `pattern`, or `pattern-1` and so on.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let (design, options) = (source.design, source.options);
    let piece = source.piece();
    let (sheets, mut remarks) = sheets(source, &piece.for_cutter(options.cutting.kerf_mm));
    remarks.extend(skin::remarks(design, piece, &options.cutting));
    let [width, height] = options.sheet.size_mm;
    let guide = format!(
        "  One unit is one millimetre. Measure the 100 mm line before you cut. Red hairlines are cut (holes first), blue lines
  are sewn, green marks are for you. The seam allowance is {allowance} mm. The sheets are {width} x {height} mm. DXF files have a block a piece and
  the layers of pattern files: 1 rim, 4 notches, 8 snips, 11 cut-outs, 13 holes, 14 stitches, 15 words.
  Put front and back together with their outer sides facing, so that the marks on their rims meet, sew along the blue line, leave the marked
  gap open. Snip the allowance along the dotted lines, to 2 mm before the stitches. Turn, put the winches in, stuff, close the gap by hand.
  A hole that is marked but not cut lies on the seam or next to it: lead the cable through the seam after sewing.
",
        allowance = design.fabrication.seam_allowance_mm
    );
    let single = sheets.len() == 1;
    let named = |(i, sheet)| {
        let name = if single { "pattern".to_owned() } else { format!("pattern-{}", i + 1) };
        Product::new(name, Content::Cut(sheet))
    };
    Ok(Part { products: sheets.into_iter().enumerate().map(named).collect(), guide, remarks })
}

/// Front and back on as few sheets as they fit on, and a remark where a piece fits on none.
fn sheets(source: &Source<'_>, piece: &Piece) -> (Vec<Sheet>, Vec<Remark>) {
    let (design, options) = (source.design, source.options);
    let size = options.sheet.size_mm;
    let reserved = [REFERENCE_MM + 2.0 * MARGIN_MM, MARGIN_MM + REFERENCE_ROW_MM];
    let bed = Bed { size, margin_mm: MARGIN_MM, between_mm: BETWEEN_MM, reserved };
    let rims: Vec<(&[Point], bool)> = FACES.iter().map(|face| (piece.rim.as_slice(), face.mirrored)).collect();
    let laid = nest(&rims, &bed);
    let (low, high) = bounding_box(&piece.rim);
    let own = [high[0] - low[0], high[1] - low[1]];
    let mut count = laid.iter().flatten().map(|l| l.sheet + 1).max().unwrap_or(0);
    // A piece that is too large gets a sheet of its own size.
    let alone = |mirrored: bool, sheet: usize| Laid {
        sheet,
        mirrored,
        turns: 0,
        shift: [MARGIN_MM + if mirrored { high[0] } else { -low[0] }, reserved[1] - low[1]],
    };
    let large = [(own[0] + 2.0 * MARGIN_MM).max(reserved[0]), own[1] + reserved[1] + MARGIN_MM];
    let mut remarks = Vec::new();
    if laid.iter().any(Option::is_none) {
        let words = format!(
            "Each piece is {:.0} x {:.0} mm and does not fit on a sheet of {} x {} mm: it has a larger sheet of its own. Choose larger sheets, \
             or make the design smaller.",
            own[0], own[1], size[0], size[1]
        );
        remarks.push(words.into());
    }
    let places: Vec<(Laid, bool)> = laid
        .into_iter()
        .zip(FACES)
        .map(|(laid, face)| match laid {
            Some(laid) => (laid, false),
            None => {
                count += 1;
                (alone(face.mirrored, count - 1), true)
            }
        })
        .collect();
    let preset = Preset::of(options.cutter);
    let sheets = (0..count)
        .map(|sheet| {
            let mut groups = Vec::new();
            let mut size = size;
            for (face, (laid, is_large)) in FACES.iter().zip(&places).filter(|(_, (laid, _))| laid.sheet == sheet) {
                groups.extend(skin::drawn(source.skin, piece, face, &preset, |p| laid.point(p)));
                if *is_large {
                    size = large;
                }
            }
            groups.push(reference([MARGIN_MM, MARGIN_MM]));
            let part = if count == 1 { String::new() } else { format!(", sheet {} of {count}", sheet + 1) };
            Sheet { title: format!("{}: pattern{part}", design.name), width_mm: size[0], height_mm: size[1], groups }
        })
        .collect();
    (sheets, remarks)
}
