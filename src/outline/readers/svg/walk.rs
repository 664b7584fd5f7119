//! What is painted, element by element.

use super::fade;
use super::flatten::flatten;
use crate::outline::even::{self, EVEN_FRACTION, Evened};
use crate::outline::readers::ground::{Mark, holds_box};
use crate::outline::regions::{self, Shapes};
use crate::outline::{Note, OutlineError, Point};
use i_overlay::core::fill_rule::FillRule;
use usvg::tiny_skia_path::PathStroker;
use usvg::{Group, ImageKind, Node, Paint, Transform};

/// Farthest that a flattened curve may lie from the true one, as a fraction of the drawing's longer side: 6 um on
/// 300 mm, below the simplification that follows.
const FLATTEN_FRACTION: f64 = 2e-5;
/// The same in a drawing of more paths than `MANY`, as fur drawn hair by hair: a fifth of what scissors can follow. Points and the crossings
/// of what lies over each other become a fraction.
const COARSE_FRACTION: f64 = 2e-4;
const MANY: usize = 5000;
/// Paint whose most opaque place is below this is a shadow or a tint, and no body.
pub(super) const FAINT: f32 = 0.4;
/// Groups and paths that are visited at most: clips and masks may refer to each other, which multiplies them.
const MAX_VISITS: usize = 400_000;
/// Clips and masks that are cut with at most, and how deep they may be clipped and masked themselves.
const MAX_CUTS: usize = 10_000;
const MAX_CUT_DEPTH: usize = 6;
/// Points of all flattened curves together.
const MAX_POINTS: usize = 3_000_000;
/// Marks that are clipped one by one, so that each can be judged; of more, the later ones are clipped together.
const SEPARATE: usize = 24;
/// Colours all of whose channels are at least this are those of paper.
const WHITE: u8 = 235;

/// What is gathered while the tree is walked.
pub(super) struct Walk {
    /// Farthest that a polygon may lie from its curve, px.
    tolerance: f64,
    /// The drawing's longer side, px.
    size: f64,
    /// Whether contours finer than scissors can follow are evened, and what was.
    evens: bool,
    /// Opacity from which paint counts.
    least: f32,
    pub evened: Evened,
    visits: usize,
    cuts: usize,
    cut_depth: usize,
    points: usize,
    pictures: usize,
    filters: usize,
    texts: Vec<String>,
}

impl Walk {
    /// For a drawing that `size` is the longer side of.
    pub fn new(drawing: &Group, size: f64, evens: bool, least: f32) -> Self {
        // What is asked for as it is, however fine, is not made coarser.
        let fraction = if evens && paths(drawing) > MANY { COARSE_FRACTION } else { FLATTEN_FRACTION };
        let (tolerance, evened) = (fraction * size, Evened::default());
        let (visits, cuts, cut_depth, points, pictures, filters) = (0, 0, 0, 0, 0, 0);
        Self {
            tolerance,
            size,
            evens,
            least,
            evened,
            visits,
            cuts,
            cut_depth,
            points,
            pictures,
            filters,
            texts: Vec::new(),
        }
    }

    /// What a group paints, in px with y up, in painting order. `place` is that of the group around it, whose opacity is `opacity`. (The
    /// absolute transforms of `usvg` would do, but are wrong below a `use` of a symbol whose overflow is visible.)
    pub fn painted(&mut self, group: &Group, place: Transform, opacity: f32) -> Result<Vec<Mark>, OutlineError> {
        let opacity = opacity * group.opacity().get();
        if opacity == 0.0 {
            return Ok(Vec::new());
        }
        self.visit()?;
        let place = place.pre_concat(group.transform());
        self.filters += group.filters().len();
        let mut marks = Vec::new();
        for node in group.children() {
            match node {
                Node::Group(child) => marks.extend(self.painted(child, place, opacity)?),
                Node::Path(path) if path.is_visible() => marks.extend(self.painted_path(path, place, opacity)?),
                Node::Path(_) => {}
                Node::Text(text) => {
                    self.text(text)?;
                    marks.extend(self.painted(text.flattened(), place, opacity)?);
                }
                Node::Image(image) => match image.kind() {
                    // A nested drawing; its own page is the picture's box.
                    ImageKind::SVG(tree) if image.is_visible() => {
                        marks.extend(self.painted(tree.root(), place, opacity)?);
                    }
                    _ => self.pictures += 1,
                },
            }
        }
        self.cut(marks, group, place)
    }

    /// The area of all that a group paints.
    pub fn area(&mut self, group: &Group, place: Transform) -> Result<Shapes, OutlineError> {
        let marks = self.painted(group, place, 1.0)?;
        regions::union(marks.into_iter().flat_map(|mark| mark.area).collect())
    }

    /// What the clips and masks of a group leave of its marks; `place` is its own.
    fn cut(&mut self, mut marks: Vec<Mark>, group: &Group, place: Transform) -> Result<Vec<Mark>, OutlineError> {
        if group.clip_path().is_none() && group.mask().is_none() {
            return Ok(marks);
        }
        gather(&mut marks);
        let mut clip = group.clip_path();
        while let Some(path) = clip.filter(|_| !marks.is_empty()) {
            let to_page = place.pre_concat(path.transform());
            let window = self.aside(|walk| walk.area(path.root(), to_page))?;
            within(&mut marks, &window)?;
            clip = path.clip_path();
        }
        let mut mask = group.mask();
        while let Some(cover) = mask.filter(|_| !marks.is_empty()) {
            let window = self.aside(|walk| walk.shown(cover, place))?;
            within(&mut marks, &window)?;
            mask = cover.mask();
        }
        Ok(marks)
    }

    /// Reads something that is not painted itself.
    fn aside<T>(&mut self, f: impl FnOnce(&mut Self) -> Result<T, OutlineError>) -> Result<T, OutlineError> {
        self.cuts += 1;
        if self.cuts > MAX_CUTS || self.cut_depth >= MAX_CUT_DEPTH {
            return Err(OutlineError::TooComplex("has too many clips and masks within each other"));
        }
        self.cut_depth += 1;
        let result = f(self);
        self.cut_depth -= 1;
        result
    }

    pub fn visit(&mut self) -> Result<(), OutlineError> {
        self.visits += 1;
        if self.visits > MAX_VISITS { Err(OutlineError::TooComplex("has more than 400 000 parts")) } else { Ok(()) }
    }

    /// A path's fill and stroke; apart from these, where its fill fades to less than counts.
    fn painted_path(&mut self, path: &usvg::Path, place: Transform, opacity: f32) -> Result<Vec<Mark>, OutlineError> {
        self.visit()?;
        let (mut mark, mut faint) = (Mark::default(), Mark::default());
        let fill = path.fill().map(|fill| (fill.paint(), fill.opacity().get()));
        if let Some((paint, own)) = fill.map(|(paint, own)| (paint, own * shows(paint))).filter(|(_, own)| *own > 0.0) {
            let area = self.fill(path, place)?;
            let seen = path.fill().map_or(1.0, |fill| fill.opacity().get()) * opacity;
            let bounds = path.bounding_box();
            let within = [[bounds.left(), bounds.top()], [bounds.right(), bounds.bottom()]];
            match fade::dense(paint, self.least / seen, within, place) {
                Some(dense) => {
                    mark.area.extend(regions::intersection(&area, &dense));
                    faint = Mark { area: regions::difference(&area, &dense), opacity: 0.5 * self.least, white: false };
                }
                None => mark.area.extend(area),
            }
            mark.opacity = own;
            mark.white = matches!(paint, Paint::Color(c) if c.red.min(c.green).min(c.blue) >= WHITE);
        }
        let stroke = path.stroke().map(|stroke| stroke.opacity().get() * shows(stroke.paint()));
        if let Some(own) = stroke.filter(|own| *own > 0.0) {
            mark.area.extend(self.stroke(path, place)?);
            mark.opacity = mark.opacity.max(own);
        }
        mark.opacity *= opacity;
        Ok([faint, mark].into_iter().filter(|mark| !mark.area.is_empty()).collect())
    }

    pub fn fill(&mut self, path: &usvg::Path, place: Transform) -> Result<Shapes, OutlineError> {
        let rule = match path.fill().map(usvg::Fill::rule) {
            Some(usvg::FillRule::EvenOdd) => FillRule::EvenOdd,
            _ => FillRule::NonZero,
        };
        let contours = self.flat(path.data(), place)?;
        regions::resolve(&contours, rule)
    }

    pub fn stroke(&mut self, path: &usvg::Path, place: Transform) -> Result<Shapes, OutlineError> {
        let Some(stroke) = path.stroke() else { return Ok(Shapes::new()) };
        let transform = place;
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
        let mut contours = flatten(path, transform, self.tolerance);
        self.points += contours.iter().map(Vec::len).sum::<usize>();
        if self.points > MAX_POINTS {
            return Err(OutlineError::TooComplex("has more than three million points"));
        }
        if self.evens {
            self.evened.add(even::evened(&mut contours, EVEN_FRACTION * self.size));
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

    /// What was left out or read in a special way.
    pub fn describe(&self, notes: &mut Vec<Note>) {
        if !self.texts.is_empty() {
            notes.push(Note::Text(self.texts.iter().take(3).cloned().collect()));
        }
        if self.pictures > 0 {
            notes.push(Note::EmbeddedPictures(self.pictures));
        }
        if self.filters > 0 {
            notes.push(Note::Filters);
        }
    }
}

/// How many paths a group has; those of clips, masks and patterns do not count.
fn paths(group: &Group) -> usize {
    let of = |node: &Node| match node {
        Node::Group(child) => paths(child),
        Node::Path(_) => 1,
        _ => 0,
    };
    group.children().iter().map(of).sum()
}

/// Makes one mark of those beyond the first ones, one of what is faint and one of the others.
fn gather(marks: &mut Vec<Mark>) {
    if marks.len() <= SEPARATE {
        return;
    }
    let late = marks.split_off(SEPARATE);
    let (faint, others): (Vec<Mark>, Vec<Mark>) = late.into_iter().partition(|mark| mark.opacity < FAINT);
    for of_kind in [faint, others] {
        let opacity = of_kind.iter().map(|mark| mark.opacity).fold(0.0, f32::max);
        let area: Shapes = of_kind.into_iter().flat_map(|mark| mark.area).collect();
        if !area.is_empty() {
            marks.push(Mark { area, opacity, white: false });
        }
    }
}

/// What a window leaves of marks.
fn within(marks: &mut Vec<Mark>, window: &Shapes) -> Result<(), OutlineError> {
    for mark in marks.iter_mut() {
        if !holds_box(window, regions::bounding_box(&mark.area)) {
            mark.area = regions::intersection(&regions::union(std::mem::take(&mut mark.area))?, window);
        }
    }
    marks.retain(|mark| !mark.area.is_empty());
    Ok(())
}

fn shortened(text: &str) -> String {
    const SHOWN: usize = 24;
    let plain: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(SHOWN).collect();
    if text.chars().count() > SHOWN { plain + "..." } else { plain }
}

/// How opaque a paint is at most.
fn shows(paint: &Paint) -> f32 {
    let most = |stops: &[usvg::Stop]| stops.iter().map(|stop| stop.opacity().get()).fold(0.0, f32::max);
    match paint {
        Paint::Color(_) | Paint::Pattern(_) => 1.0,
        Paint::LinearGradient(gradient) => most(gradient.stops()),
        Paint::RadialGradient(gradient) => most(gradient.stops()),
    }
}
