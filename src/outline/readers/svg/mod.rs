//! A silhouette from an SVG file: the union of all that is painted.
//!
//! `usvg` resolves styles, units, shapes, transforms, text and references to plain paths in px with y down; what it does not follow of
//! style sheets is written into the elements before (`style/`). Fills count under their own fill rule, strokes as the area they cover
//! (dashes too), clips and masks cut. Colour does not matter, so white counts as painted; what is hardly opaque or hidden does not, unless
//! there is nothing else. What lies below everything else is judged by `super::ground`. Filters (shadows, blurs) and embedded pictures
//! are left out; a drawing of pictures alone, as scanners and phones make them, is read as a picture (`pictured`). What was left out or read in a special way is noted.

mod expansion;
mod fade;
mod flatten;
mod layers;
mod mask;
mod pictured;
mod render;
mod size;
mod style;
mod tree;
mod walk;

use super::finish::finish;
use super::ground::{self, Mark};
use super::{OutlineReader, Painting, ReadingOption};
use crate::outline::regions::{self, Shapes};
use crate::outline::{Aside, Import, Imported, Note, Outline, OutlineError, Point, Why};
use image::RgbaImage;
use size::Size;
use tree::Parsed;
pub(crate) use tree::fonts;
use usvg::{Transform, Tree};
use walk::{FAINT, Walk};

/// Parts of the drawing beyond the page that are worth a note, as a part of the drawing's box.
const OFF_PAGE_FRACTION: f64 = 0.01;
/// Part of the page that paper covers at least.
const PAPER: f64 = 0.97;
/// Faint paint that changes the silhouette by less than this part of it is not worth a note.
const FAINT_FRACTION: f64 = 1e-3;

pub(super) struct Svg;

impl OutlineReader for Svg {
    fn names(&self) -> [&'static str; 2] {
        ["an SVG drawing", "SVG drawings"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["svg", "svgz"]
    }

    /// An angle bracket, and before it at most a byte order mark and blanks.
    fn can_read(&self, head: &[u8]) -> bool {
        let head = head.trim_ascii_start();
        let utf16 = head.starts_with(b"\xff\xfe<\0") || head.starts_with(b"\xfe\xff\0<");
        utf16 || head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start().starts_with(b"<")
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Layers, ReadingOption::Background, ReadingOption::Unit, ReadingOption::Threshold]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        self::import(bytes, import)
    }

    fn texture(&self, bytes: &[u8], import: &Import, drawn_box: [Point; 2]) -> Result<RgbaImage, OutlineError> {
        texture(bytes, import, drawn_box)
    }
}

/// The clean outline of a drawing.
pub(super) fn import(svg: &[u8], import: &Import) -> Result<Imported, OutlineError> {
    finish(painting(svg, import)?, import)
}

pub(super) use render::texture;

/// Reads the silhouette of an SVG, scaled so that it is `height_mm` high, or in its physical size, with the default
/// clean-up.
///
/// In physical size, mm, cm, in, pt count as such and px or plain numbers as 1/96 inch. The result is in mm, y up,
/// its origin at the lower left corner of the silhouette's box.
///
/// # Errors
/// Not an SVG, nothing painted, more than one piece, degenerate; see [`OutlineError`].
pub fn read(svg: &[u8], height_mm: Option<f64>) -> Result<Outline, OutlineError> {
    let import = Import { height_mm, ..Import::default() };
    Ok(finish(painting(svg, &import)?, &import)?.outline)
}

/// All that is painted, in px with y up.
fn painting(svg: &[u8], import: &Import) -> Result<Painting, OutlineError> {
    let Parsed { tree, size, notes } = tree::parsed(svg, import)?;
    match shapes(&tree, size, notes.clone(), import) {
        Err(OutlineError::NothingPainted(_)) if pictured::has_pictures(&tree) => {
            pictured::painting(&tree, size, notes, import)
        }
        other => other,
    }
}

/// What is painted but pictures.
fn shapes(tree: &Tree, size: Size, mut notes: Vec<Note>, import: &Import) -> Result<Painting, OutlineError> {
    let bounds = tree.root().abs_stroke_bounding_box();
    let longer = f64::from(bounds.width().max(bounds.height()));
    if !(longer.is_finite() && longer > 0.0) {
        return Err(NOTHING);
    }
    let page = [f64::from(tree.size().width()), f64::from(tree.size().height())];
    let least = import.threshold.map_or(FAINT, |level| f32::from(level) / 255.0);
    let mut walk = Walk::new(tree.root(), longer, import.smooth_mm != Some(0.0), least);
    let marks = walk.painted(tree.root(), Transform::identity(), 1.0)?;
    let (faint, marks): (Vec<Mark>, Vec<Mark>) = marks.into_iter().partition(|mark| mark.opacity < least);
    // Where all is faint, all counts.
    let (faint, marks) = if marks.is_empty() { (marks, faint) } else { (faint, marks) };
    let (figure, below, more) = ground::part(marks, Some([[0.0, -page[1]], [page[0], 0.0]]), import.background)?;
    let shapes: Vec<_> = figure.into_iter().flat_map(|mark| mark.area).collect();
    // A page below pictures is no more than their paper.
    let is_paper = |shapes: &Shapes| regions::area(shapes) >= PAPER * page[0] * page[1] && pictured::has_pictures(tree);
    if shapes.is_empty() || is_paper(&shapes) {
        return Err(NOTHING);
    }
    let mut painting = Painting { shapes, unit_mm: size.mm_per_px, evened: walk.evened, ..Painting::default() };
    painting.notes = more;
    if !below.is_empty() {
        painting.asides.push(Aside { why: Why::Background, areas: below });
    }
    put_aside(faint, least, &mut painting)?;
    walk.describe(&mut painting.notes);
    painting.notes.append(&mut notes);
    let (low, high) = regions::bounding_box(&painting.shapes);
    let off = (-low[0]).max(high[0] - page[0]).max(high[1]).max(-low[1] - page[1]);
    if off > OFF_PAGE_FRACTION * longer {
        painting.notes.push(Note::OffPage);
    }
    if let Some(sizing) = size.sizing.filter(|_| !import.asks_size()) {
        painting.notes.push(Note::Size(sizing));
    }
    Ok(painting)
}

/// Tells of paint that is hardly seen, where it would have made a difference.
fn put_aside(faint: Vec<Mark>, least: f32, painting: &mut Painting) -> Result<(), OutlineError> {
    let count = faint.len();
    if count == 0 {
        return Ok(());
    }
    let faint = regions::union(faint.into_iter().flat_map(|mark| mark.area).collect())?;
    let shapes = regions::union(std::mem::take(&mut painting.shapes))?;
    let more = regions::difference(&faint, &shapes);
    if regions::area(&more) > FAINT_FRACTION * regions::area(&shapes) {
        painting.notes.push(Note::Faint { count, opacity: f64::from(least) });
        painting.asides.push(Aside { why: Why::Faint, areas: more });
    }
    painting.shapes = shapes;
    Ok(())
}

const NOTHING: OutlineError = OutlineError::NothingPainted("the drawing has no fill or stroke with an area");

#[cfg(test)]
mod tests;
