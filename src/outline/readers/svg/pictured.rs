//! A drawing that has pictures alone: a scan in a PDF, a photo placed on a page.

use super::render::drawn;
use super::size::Size;
use crate::outline::readers::{Painting, picture};
use crate::outline::{Import, Note, OutlineError};
use image::DynamicImage;
use usvg::{Group, Node, Rect, Tree};

/// Longer side of the picture that is made of the pictures, in pixels: 0.2 mm on 300 mm.
const DRAWN_PX: f64 = 1600.0;
/// It is blurred once: what is embedded may be a JPEG, and enlarged.
const PASSES: usize = 1;

/// Whether a drawing has pictures.
pub(super) fn has_pictures(tree: &Tree) -> bool {
    let mut count = 0;
    in_pictures(tree.root(), &mut |_| count += 1);
    count > 0
}

/// What counts in the pictures of a drawing, in px with y up.
pub(super) fn painting(tree: &Tree, size: Size, notes: Vec<Note>, import: &Import) -> Result<Painting, OutlineError> {
    let mut whole: Option<Rect> = None;
    in_pictures(tree.root(), &mut |place| {
        whole = Some(match whole {
            None => place,
            Some(known) => joined(known, place),
        });
    });
    let page = Rect::from_xywh(0.0, 0.0, tree.size().width(), tree.size().height());
    // What lies off the page is not seen.
    let seen =
        whole.zip(page).and_then(|(whole, page)| common(whole, page)).or(whole).ok_or(OutlineError::Degenerate)?;
    let [left, top, right, bottom] = [seen.left(), seen.top(), seen.right(), seen.bottom()].map(f64::from);
    let pixels = drawn(tree, [[left, -bottom], [right, -top]], DRAWN_PX)?;
    let scale = (right - left) / f64::from(pixels.width());
    let mut painting = picture::painted(DynamicImage::ImageRgba8(pixels), PASSES, import)?;
    // From working pixels of the picture to px of the drawing.
    let scale = scale * painting.unit_mm;
    let place = |[x, y]: [f64; 2]| [left + scale * x, -top + scale * y];
    let rings = painting.shapes.iter_mut().chain(painting.asides.iter_mut().flat_map(|aside| &mut aside.areas));
    rings.flatten().flatten().for_each(|point| *point = place(*point));
    painting.unit_mm = size.mm_per_px;
    painting.notes.insert(0, Note::PicturesAlone);
    painting.notes.extend(notes);
    painting.notes.extend(size.sizing.filter(|_| !import.asks_size()).map(Note::Size));
    Ok(painting)
}

/// The places of all pictures, px with y down.
fn in_pictures(group: &Group, take: &mut dyn FnMut(Rect)) {
    for node in group.children() {
        match node {
            Node::Group(child) => in_pictures(child, take),
            Node::Image(image) if image.is_visible() => take(image.abs_bounding_box()),
            _ => {}
        }
    }
}

fn joined(a: Rect, b: Rect) -> Rect {
    let [left, top] = [a.left().min(b.left()), a.top().min(b.top())];
    Rect::from_ltrb(left, top, a.right().max(b.right()), a.bottom().max(b.bottom())).unwrap_or(a)
}

fn common(a: Rect, b: Rect) -> Option<Rect> {
    let [left, top] = [a.left().max(b.left()), a.top().max(b.top())];
    Rect::from_ltrb(left, top, a.right().min(b.right()), a.bottom().min(b.bottom()))
        .filter(|both| both.width() > 0.0 && both.height() > 0.0)
}
