//! A silhouette from an SVG file: the union of all that is painted.
//!
//! `usvg` resolves styles, units, shapes, transforms and references to plain paths in px (96 to the inch) with y down.
//! Fills count under their own fill rule, strokes as the area they cover (dashes too), clips cut. Colour does not
//! matter, so white counts as painted; what is fully transparent or hidden does not. Filters (shadows, blurs) and
//! embedded pictures are left out.

use super::clean::{self, Shapes, Size};
use super::{Outline, OutlineError, Point};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use usvg::tiny_skia_path::{Path, PathSegment, PathStroker};
use usvg::{Group, Node, Transform, Tree};

/// Millimetres in a CSS px.
const MM_PER_PX: f64 = 25.4 / 96.0;
/// Farthest that a flattened curve may lie from the true one, as a fraction of the drawing's longer side: 6 um on
/// 300 mm, below the simplification that follows.
const FLATTEN_FRACTION: f64 = 2e-5;
/// Most pieces a single curve is cut into: stops absurd input, not reached at the above tolerance in sane drawings.
const MAX_PIECES: f64 = 2000.0;

/// Reads the silhouette of an SVG, scaled so that it is `height_mm` high, or in its physical size.
///
/// In physical size, mm, cm, in, pt count as such and px or plain numbers as 1/96 inch. The result is in mm, y up,
/// its origin at the lower left corner of the silhouette's box.
///
/// # Errors
/// Not an SVG, nothing painted, more than one piece, degenerate; see [`OutlineError`].
pub fn read(svg: &[u8], height_mm: Option<f64>) -> Result<Outline, OutlineError> {
    if let Some(height) = height_mm.filter(|h| !(h.is_finite() && *h > 0.0)) {
        return Err(OutlineError::Height(height));
    }
    let tree = Tree::from_data(svg, &options()).map_err(|error| OutlineError::NotSvg(error.to_string()))?;
    let bounds = tree.root().abs_stroke_bounding_box();
    let tolerance = FLATTEN_FRACTION * f64::from(bounds.width().max(bounds.height()));
    let shapes = painted(tree.root(), Transform::identity(), tolerance)?;
    if shapes.is_empty() {
        return Err(OutlineError::NothingPainted);
    }
    clean::outline(shapes, height_mm.map_or(Size::UnitMm(MM_PER_PX), Size::HeightMm))
}

/// The default options, with references to files outside the SVG cut off: a silhouette needs none.
fn options() -> usvg::Options<'static> {
    let mut options = usvg::Options::default();
    options.image_href_resolver.resolve_string = Box::new(|_, _| None);
    options
}

/// The regions painted by a group, in px with y up. `place` comes after the group's own absolute transform (it is the
/// identity but inside clips, whose content has a coordinate system of its own).
fn painted(group: &Group, place: Transform, tolerance: f64) -> Result<Shapes, OutlineError> {
    if group.opacity().get() == 0.0 {
        return Ok(Shapes::new());
    }
    if group.mask().is_some() {
        return Err(OutlineError::Unsupported("a mask"));
    }
    let mut shapes = Shapes::new();
    for node in group.children() {
        match node {
            Node::Group(child) => shapes.extend(painted(child, place, tolerance)?),
            Node::Path(path) if path.is_visible() => shapes.extend(painted_path(path, place, tolerance)),
            _ => {}
        }
    }
    let mut clip = group.clip_path();
    while let Some(path) = clip.filter(|_| !shapes.is_empty()) {
        let to_page = place.pre_concat(group.abs_transform()).pre_concat(path.transform());
        let window = union(painted(path.root(), to_page, tolerance)?);
        shapes = union(shapes).overlay_as::<i64>(&window, OverlayRule::Intersect, FillRule::NonZero);
        clip = path.clip_path();
    }
    Ok(shapes)
}

fn union(shapes: Shapes) -> Shapes {
    clean::resolve(&shapes.into_iter().flatten().collect(), FillRule::NonZero)
}

/// The regions of a path's fill and stroke.
fn painted_path(path: &usvg::Path, place: Transform, tolerance: f64) -> Shapes {
    let transform = place.pre_concat(path.abs_transform());
    let mut shapes = Shapes::new();
    if let Some(fill) = path.fill().filter(|fill| fill.opacity().get() > 0.0) {
        let rule = match fill.rule() {
            usvg::FillRule::NonZero => FillRule::NonZero,
            usvg::FillRule::EvenOdd => FillRule::EvenOdd,
        };
        shapes.extend(clean::resolve(&flatten(path.data(), transform, tolerance), rule));
    }
    if let Some(stroke) = path.stroke().filter(|stroke| stroke.opacity().get() > 0.0) {
        // The stroker is accurate to about a quarter px at a given scale: let it see `tolerance` as that.
        let scale = PathStroker::compute_resolution_scale(&transform) * (0.25 / tolerance) as f32;
        let stroke = stroke.to_tiny_skia();
        let dashed = stroke.dash.as_ref().and_then(|dash| path.data().dash(dash, scale));
        if let Some(area) = dashed.as_ref().unwrap_or(path.data()).stroke(&stroke, scale) {
            shapes.extend(clean::resolve(&flatten(&area, transform, tolerance), FillRule::NonZero));
        }
    }
    shapes
}

/// The closed contours of a path as polygons, transformed, y up.
///
/// A curve cut into n equal steps of its parameter lies within `max |B''| / (8 n^2)` of the polygon.
fn flatten(path: &Path, transform: Transform, tolerance: f64) -> Vec<Vec<Point>> {
    let at = |p: usvg::tiny_skia_path::Point| -> Point {
        let [x, y] = [f64::from(p.x), f64::from(p.y)];
        let row = |a: f32, b: f32, c: f32| f64::from(a) * x + f64::from(b) * y + f64::from(c);
        [row(transform.sx, transform.kx, transform.tx), -row(transform.ky, transform.sy, transform.ty)]
    };
    let steps = |second: f64| (second / (8.0 * tolerance)).sqrt().ceil().clamp(1.0, MAX_PIECES) as usize;
    let bend = |a: Point, b: Point, c: Point| (a[0] - 2.0 * b[0] + c[0]).hypot(a[1] - 2.0 * b[1] + c[1]);
    let mut contours: Vec<Vec<Point>> = Vec::new();
    let mut contour: Vec<Point> = Vec::new();
    for segment in path.segments() {
        let from = contour.last().copied().unwrap_or_default();
        match segment {
            PathSegment::MoveTo(p) => {
                contours.push(std::mem::replace(&mut contour, vec![at(p)]));
            }
            PathSegment::LineTo(p) => contour.push(at(p)),
            PathSegment::QuadTo(p1, p2) => {
                let (b, c) = (at(p1), at(p2));
                let n = steps(2.0 * bend(from, b, c));
                contour.extend((1..=n).map(|i| bernstein([from, b, b, c], i as f64 / n as f64, true)));
            }
            PathSegment::CubicTo(p1, p2, p3) => {
                let (b, c, d) = (at(p1), at(p2), at(p3));
                let n = steps(6.0 * bend(from, b, c).max(bend(b, c, d)));
                contour.extend((1..=n).map(|i| bernstein([from, b, c, d], i as f64 / n as f64, false)));
            }
            PathSegment::Close => {
                // What follows without a new start begins where this contour began.
                let start = contour.first().copied().unwrap_or_default();
                contours.push(std::mem::replace(&mut contour, vec![start]));
            }
        }
    }
    contours.push(contour);
    contours.retain(|c| c.len() >= 3);
    contours
}

/// A Bezier curve at `t`: cubic, or quadratic with its middle control point given twice.
fn bernstein(p: [Point; 4], t: f64, quadratic: bool) -> Point {
    let s = 1.0 - t;
    let w = if quadratic {
        [s * s, 2.0 * s * t, 0.0, t * t]
    } else {
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
    };
    [0, 1].map(|axis| (0..4).map(|i| w[i] * p[i][axis]).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn svg(attributes: &str, body: &str) -> Vec<u8> {
        format!("<svg xmlns='http://www.w3.org/2000/svg' {attributes}>{body}</svg>").into_bytes()
    }

    #[test]
    fn a_square_of_100_mm_is_that_in_every_unit() {
        for size in ["100mm", "10cm", "3.937007874in", "283.4645669pt", "377.9527559px", "377.9527559"] {
            for (view, body) in [
                ("viewBox='0 0 50 50'", "<rect width='50' height='50'/>"),
                ("", "<rect width='100%' height='100%' style='fill:red'/>"),
                ("viewBox='-1 -1 2 2'", "<path transform='rotate(90)' d='M-1-1h2v2h-2z'/>"),
            ] {
                let outline = read(&svg(&format!("width='{size}' height='{size}' {view}"), body), None).unwrap();
                let (low, high) = outline.bounding_box();
                assert_eq!((low, outline.outer.len()), ([0.0, 0.0], 4), "{size} {view}");
                assert!((high[0] - 100.0).abs() < 1e-4 && (high[1] - 100.0).abs() < 1e-4, "{size} {view} {high:?}");
                assert!((outline.area() - 1e4).abs() < 0.02);
            }
        }
    }

    #[test]
    fn the_asked_height_wins_and_y_points_up() {
        let wedge = svg("width='10mm' height='20mm' viewBox='0 0 10 20'", "<path d='M2 2h6l-3 12z'/>");
        let outline = read(&wedge, Some(240.0)).unwrap();
        let (_, high) = outline.bounding_box();
        assert!((high[1] - 240.0).abs() < 1e-9 && (high[0] - 120.0).abs() < 1e-3);
        // The tip, at the bottom of the page, is at the bottom here too.
        assert!(outline.contains([60.0, 20.0]) && outline.contains([10.0, 235.0]) && !outline.contains([10.0, 20.0]));
        assert!(crate::outline::polygon::signed_area(&outline.outer) > 0.0);
    }

    #[test]
    fn circles_meet_their_closed_form() {
        let disc =
            read(&svg("width='100mm' height='100mm' viewBox='0 0 100 100'", "<circle cx='50' cy='50' r='40'/>"), None);
        let area = disc.unwrap().area();
        assert!((area / (std::f64::consts::PI * 1600.0) - 1.0).abs() < 1e-3, "{area}");
        let ring = svg(
            "width='100mm' height='100mm' viewBox='0 0 100 100'",
            "<circle cx='50' cy='50' r='40' fill='none' stroke='black' stroke-width='10'/>",
        );
        let ring = read(&ring, None).unwrap();
        assert_eq!(ring.holes.len(), 1);
        let expected = std::f64::consts::PI * (45.0 * 45.0 - 35.0 * 35.0);
        assert!((ring.area() / expected - 1.0).abs() < 1e-3, "{}", ring.area());
        assert!(crate::outline::polygon::signed_area(&ring.holes[0]) < 0.0);
    }

    #[test]
    fn fills_strokes_clips_and_references_are_united() {
        let body = "<defs><clipPath id='c'><rect x='0' y='0' width='50' height='100'/></clipPath>\
                    <rect id='r' width='30' height='20'/></defs>\
                    <g clip-path='url(#c)'><rect x='10' y='10' width='80' height='20'/></g>\
                    <use href='#r' x='40' y='20'/>\
                    <path d='M20 20V80' stroke='blue' stroke-width='10' fill='none'/>\
                    <rect x='0' y='0' width='100' height='100' opacity='0'/>\
                    <rect x='0' y='0' width='100' height='100' visibility='hidden'/>";
        let outline = read(&svg("width='100mm' height='100mm' viewBox='0 0 100 100'", body), None).unwrap();
        let (_, high) = outline.bounding_box();
        assert!((high[0] - 60.0).abs() < 1e-3 && (high[1] - 70.0).abs() < 1e-3, "{high:?}");
        assert!((outline.area() - (40.0 * 20.0 + 30.0 * 20.0 - 100.0 + 50.0 * 10.0)).abs() < 0.1, "{}", outline.area());
    }

    #[test]
    fn faults_are_told_apart() {
        let attributes = "width='100' height='100'";
        assert!(matches!(read(b"\x89PNG", None), Err(OutlineError::NotSvg(_))));
        assert!(matches!(read(b"<html/>", None), Err(OutlineError::NotSvg(_))));
        assert!(matches!(read(b"", None), Err(OutlineError::NotSvg(_))));
        assert_eq!(read(&svg(attributes, ""), None), Err(OutlineError::NothingPainted));
        assert_eq!(read(&svg(attributes, "<text y='20'>pig</text>"), None), Err(OutlineError::NothingPainted));
        assert_eq!(read(&svg(attributes, "<path d='M0 0L50 50'/>"), None), Err(OutlineError::NothingPainted));
        let dots = "<circle cx='10' cy='10' r='5'/><circle cx='30' cy='10' r='5'/><circle cx='50' cy='10' r='5'/>";
        assert_eq!(read(&svg(attributes, dots), None), Err(OutlineError::Pieces { pieces: 3 }));
        let hair = "<rect width='100' height='0.0005'/>";
        assert_eq!(read(&svg(attributes, hair), None), Err(OutlineError::Degenerate));
        let square = svg(attributes, "<rect width='50' height='50'/>");
        assert_eq!(read(&square, Some(-1.0)), Err(OutlineError::Height(-1.0)));
        assert!(matches!(read(&square, Some(f64::NAN)), Err(OutlineError::Height(_))));
    }
}
