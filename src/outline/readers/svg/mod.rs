//! A silhouette from an SVG file: the union of all that is painted.
//!
//! `usvg` resolves styles, units, shapes, transforms, text and references to plain paths in px (96 to the inch) with y
//! down. Fills count under their own fill rule, strokes as the area they cover (dashes too), clips and masks cut. Colour
//! does not matter, so white counts as painted; what is fully transparent or hidden does not. A rectangle below
//! everything else that fills the page is paper, not plushie. Filters (shadows, blurs) and embedded pictures are left
//! out. What was left out or read in a special way is noted.

mod expansion;
mod flatten;
mod layers;
mod mask;
mod render;
mod tree;

use super::finish::finish;
use super::{OutlineReader, Painting, ReadingOption};
use crate::outline::regions::{self, Shapes};
use crate::outline::{Background, Import, Imported, Note, Outline, OutlineError, Point, polygon};
use flatten::flatten;
use i_overlay::core::fill_rule::FillRule;
use image::RgbaImage;
use tree::tree;
use usvg::tiny_skia_path::PathStroker;
use usvg::{Group, ImageKind, Node, Paint, Transform, Tree};

/// Millimetres in a CSS px.
const MM_PER_PX: f64 = 25.4 / 96.0;
/// Farthest that a flattened curve may lie from the true one, as a fraction of the drawing's longer side: 6 um on
/// 300 mm, below the simplification that follows.
const FLATTEN_FRACTION: f64 = 2e-5;
/// A rectangle is page-sized if it reaches every edge of the page within this part of the page's side.
const PAGE_FRACTION: f64 = 0.01;
/// Groups and paths that are visited at most: clips and masks may refer to each other, which multiplies them.
const MAX_VISITS: usize = 400_000;
/// Clips and masks that are cut with at most, and how deep they may be clipped and masked themselves.
const MAX_CUTS: usize = 10_000;
const MAX_CUT_DEPTH: usize = 6;
/// Points of all flattened curves together.
const MAX_POINTS: usize = 3_000_000;
/// Parts of the drawing beyond the page that are worth a note, as a part of the drawing's box.
const OFF_PAGE_FRACTION: f64 = 0.01;

pub(super) struct Svg;

impl OutlineReader for Svg {
    fn names(&self) -> [&'static str; 2] {
        ["an SVG drawing", "SVG drawings"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["svg"]
    }

    /// An angle bracket, and before it at most a byte order mark and blanks.
    fn can_read(&self, head: &[u8]) -> bool {
        let head = head.trim_ascii_start();
        head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start().starts_with(b"<")
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Layers, ReadingOption::Background]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        finish(painting(bytes, import)?, import)
    }

    fn texture(&self, bytes: &[u8], import: &Import, drawn_box: [Point; 2]) -> Result<RgbaImage, OutlineError> {
        render::texture(bytes, import, drawn_box)
    }
}

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
    let tree = tree(svg, &import.layers)?;
    let bounds = tree.root().abs_stroke_bounding_box();
    let longer = f64::from(bounds.width().max(bounds.height()));
    let page = [f64::from(tree.size().width()), f64::from(tree.size().height())];
    if !(longer.is_finite() && longer > 0.0) {
        return Err(nothing(&tree));
    }
    let mut walk = Walk {
        tolerance: FLATTEN_FRACTION * longer,
        page,
        keep_background: import.background == Background::Keep,
        visits: 0,
        cuts: 0,
        cut_depth: 0,
        points: 0,
        background: Shapes::new(),
        begun: false,
        pictures: 0,
        filters: 0,
        texts: Vec::new(),
    };
    let mut shapes = walk.painted(tree.root(), Transform::identity())?;
    let mut notes = Vec::new();
    if shapes.is_empty() {
        // Nothing lies on the rectangle: it is the silhouette.
        shapes = std::mem::take(&mut walk.background);
    } else if !walk.background.is_empty() {
        notes.push(Note::Background);
    }
    if shapes.is_empty() {
        return Err(nothing(&tree));
    }
    walk.describe(&mut notes, longer, &shapes)?;
    Ok(Painting { shapes, unit_mm: MM_PER_PX, notes })
}

/// Nothing is painted: says so, and whether there is something that cannot count.
fn nothing(tree: &Tree) -> OutlineError {
    fn any(group: &Group, test: &dyn Fn(&Node) -> bool) -> bool {
        group.children().iter().any(|node| match node {
            Node::Group(child) => any(child, test),
            other => test(other),
        })
    }
    if any(tree.root(), &|node| matches!(node, Node::Image(_))) {
        return OutlineError::NothingPainted("the SVG has embedded pictures alone; save the picture as PNG or JPEG");
    }
    OutlineError::NothingPainted("the SVG has no fill or stroke with an area")
}

/// What is gathered while the tree is walked.
struct Walk {
    /// Farthest that a polygon may lie from its curve, px.
    tolerance: f64,
    /// Width and height of the page, px.
    page: [f64; 2],
    keep_background: bool,
    visits: usize,
    cuts: usize,
    cut_depth: usize,
    points: usize,
    /// Page-sized rectangles below everything else.
    background: Shapes,
    /// Whether something else was painted.
    begun: bool,
    pictures: usize,
    filters: usize,
    texts: Vec<String>,
}

impl Walk {
    /// The regions painted by a group, in px with y up. `place` comes after the group's own absolute transform (it is
    /// the identity but inside clips and masks, whose content has a coordinate system of its own).
    fn painted(&mut self, group: &Group, place: Transform) -> Result<Shapes, OutlineError> {
        if group.opacity().get() == 0.0 {
            return Ok(Shapes::new());
        }
        self.visit()?;
        self.filters += group.filters().len();
        let mut shapes = Shapes::new();
        for node in group.children() {
            match node {
                Node::Group(child) => shapes.extend(self.painted(child, place)?),
                Node::Path(path) if path.is_visible() => shapes.extend(self.painted_path(path, place)?),
                Node::Path(_) => {}
                Node::Text(text) => {
                    self.text(text)?;
                    shapes.extend(self.painted(text.flattened(), place)?);
                }
                Node::Image(image) => match image.kind() {
                    // A nested drawing; its own page is the picture's box.
                    ImageKind::SVG(tree) if image.is_visible() => {
                        let to_page = place.pre_concat(image.abs_transform());
                        shapes.extend(self.painted(tree.root(), to_page)?);
                    }
                    _ => self.pictures += 1,
                },
            }
        }
        self.cut(shapes, group, place)
    }

    /// What the clips and masks of a group leave of its regions.
    fn cut(&mut self, mut shapes: Shapes, group: &Group, place: Transform) -> Result<Shapes, OutlineError> {
        let mut clip = group.clip_path();
        while let Some(path) = clip.filter(|_| !shapes.is_empty()) {
            let to_page = place.pre_concat(group.abs_transform()).pre_concat(path.transform());
            let window = self.aside(|walk| walk.painted(path.root(), to_page))?;
            shapes = regions::intersection(&regions::union(shapes)?, &regions::union(window)?);
            clip = path.clip_path();
        }
        let mut mask = group.mask();
        while let Some(cover) = mask.filter(|_| !shapes.is_empty()) {
            let to_page = place.pre_concat(group.abs_transform());
            let window = self.aside(|walk| walk.shown(cover, to_page))?;
            shapes = regions::intersection(&regions::union(shapes)?, &window);
            mask = cover.mask();
        }
        Ok(shapes)
    }

    /// Reads something that is not painted itself: it is neither background nor below anything.
    fn aside<T>(&mut self, f: impl FnOnce(&mut Self) -> Result<T, OutlineError>) -> Result<T, OutlineError> {
        self.cuts += 1;
        if self.cuts > MAX_CUTS || self.cut_depth >= MAX_CUT_DEPTH {
            return Err(OutlineError::TooComplex("has too many clips and masks within each other"));
        }
        self.cut_depth += 1;
        let begun = std::mem::replace(&mut self.begun, true);
        let result = f(self);
        self.begun = begun;
        self.cut_depth -= 1;
        result
    }

    fn visit(&mut self) -> Result<(), OutlineError> {
        self.visits += 1;
        if self.visits > MAX_VISITS { Err(OutlineError::TooComplex("has more than 400 000 parts")) } else { Ok(()) }
    }

    /// The regions of a path's fill and stroke.
    fn painted_path(&mut self, path: &usvg::Path, place: Transform) -> Result<Shapes, OutlineError> {
        self.visit()?;
        let mut shapes = Shapes::new();
        if path.fill().is_some_and(|fill| fill.opacity().get() > 0.0 && shows(fill.paint())) {
            let area = self.fill(path, place)?;
            if !self.begun && !self.keep_background && is_page(&area, self.page) {
                self.background.extend(area);
                return Ok(shapes);
            }
            shapes.extend(area);
        }
        if path.stroke().is_some_and(|stroke| stroke.opacity().get() > 0.0 && shows(stroke.paint())) {
            shapes.extend(self.stroke(path, place)?);
        }
        self.begun |= !shapes.is_empty();
        Ok(shapes)
    }

    fn fill(&mut self, path: &usvg::Path, place: Transform) -> Result<Shapes, OutlineError> {
        let rule = match path.fill().map(usvg::Fill::rule) {
            Some(usvg::FillRule::EvenOdd) => FillRule::EvenOdd,
            _ => FillRule::NonZero,
        };
        let contours = self.flat(path.data(), place.pre_concat(path.abs_transform()))?;
        regions::resolve(&contours, rule)
    }

    fn stroke(&mut self, path: &usvg::Path, place: Transform) -> Result<Shapes, OutlineError> {
        let Some(stroke) = path.stroke() else { return Ok(Shapes::new()) };
        let transform = place.pre_concat(path.abs_transform());
        // The stroker is accurate to about a quarter px at a given scale: let it see `tolerance` as that.
        let scale = PathStroker::compute_resolution_scale(&transform) * (0.25 / self.tolerance) as f32;
        let stroke = stroke.to_tiny_skia();
        let dashed = stroke.dash.as_ref().and_then(|dash| path.data().dash(dash, scale));
        match dashed.as_ref().unwrap_or(path.data()).stroke(&stroke, scale) {
            Some(area) => {
                let contours = self.flat(&area, transform)?;
                regions::resolve(&contours, FillRule::NonZero)
            }
            None => Ok(Shapes::new()),
        }
    }

    fn flat(
        &mut self,
        path: &usvg::tiny_skia_path::Path,
        transform: Transform,
    ) -> Result<Vec<Vec<Point>>, OutlineError> {
        let contours = flatten(path, transform, self.tolerance);
        self.points += contours.iter().map(Vec::len).sum::<usize>();
        if self.points > MAX_POINTS {
            return Err(OutlineError::TooComplex("has more than three million points"));
        }
        Ok(contours)
    }

    /// Notes the text, and refuses what the bundled fonts cannot write.
    fn text(&mut self, text: &usvg::Text) -> Result<(), OutlineError> {
        let written: String = text.chunks().iter().map(|chunk| chunk.text()).collect();
        let glyphs = text.layouted().iter().flat_map(|span| &span.positioned_glyphs);
        if glyphs.into_iter().any(|glyph| glyph.id.0 == 0) {
            return Err(OutlineError::NoFont(shortened(&written)));
        }
        if !written.trim().is_empty() {
            self.texts.push(shortened(&written));
        }
        Ok(())
    }

    fn describe(&self, notes: &mut Vec<Note>, longer: f64, shapes: &Shapes) -> Result<(), OutlineError> {
        if !self.texts.is_empty() {
            notes.push(Note::Text(self.texts.iter().take(3).cloned().collect()));
        }
        if self.pictures > 0 {
            notes.push(Note::EmbeddedPictures(self.pictures));
        }
        if self.filters > 0 {
            notes.push(Note::Filters);
        }
        let (low, high) = regions::bounding_box(shapes);
        let off = (-low[0]).max(high[0] - self.page[0]).max(high[1]).max(-low[1] - self.page[1]);
        if off > OFF_PAGE_FRACTION * longer {
            notes.push(Note::OffPage);
        }
        Ok(())
    }
}

fn shortened(text: &str) -> String {
    const SHOWN: usize = 24;
    let plain: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(SHOWN).collect();
    if text.chars().count() > SHOWN { plain + "..." } else { plain }
}

/// Whether a paint has any opaque part.
fn shows(paint: &Paint) -> bool {
    let any = |stops: &[usvg::Stop]| stops.iter().any(|stop| stop.opacity().get() > 0.0);
    match paint {
        Paint::Color(_) | Paint::Pattern(_) => true,
        Paint::LinearGradient(gradient) => any(gradient.stops()),
        Paint::RadialGradient(gradient) => any(gradient.stops()),
    }
}

/// Whether an area is one upright rectangle that covers the page.
fn is_page(area: &Shapes, page: [f64; 2]) -> bool {
    let [rings] = area.as_slice() else { return false };
    let [ring] = rings.as_slice() else { return false };
    let (low, high) = polygon::bounding_box(ring);
    let slack = page.map(|side| PAGE_FRACTION * side);
    // The page has y from -height to 0 here.
    let covers =
        low[0] <= slack[0] && high[0] >= page[0] - slack[0] && low[1] <= slack[1] - page[1] && high[1] >= -slack[1];
    let boxed = (high[0] - low[0]) * (high[1] - low[1]);
    covers && ring.len() == 4 && polygon::signed_area(ring) > (1.0 - 1e-6) * boxed
}

#[cfg(test)]
mod tests;
