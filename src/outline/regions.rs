//! Areas of the plane as polygons with holes: union, difference, growing and shrinking.

use super::{OutlineError, Point, polygon};
use crate::threads;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::simplify::SimplifyShape;
use i_overlay::float::single::SingleFloatOverlay;
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};

/// Regions with holes, as the overlay library gives them: outer polygon counter-clockwise, then its holes.
pub(super) type Shapes = Vec<Vec<Vec<Point>>>;

/// Length of a round join's chords over its radius, rad: they stay within 1.1 % of the radius of the arc.
const ROUND_JOIN: f64 = 0.3;
/// Most vertices that are united at once: a second or two and half a gigabyte.
const MAX_POINTS: usize = 3_000_000;
const TOO_MANY: OutlineError = OutlineError::TooComplex("has more than three million points");
/// Areas of more points than this are united so many at a time: of 4, 8, 16 and 48 the quickest for 29 000 hairs, or next to it.
const BATCHED_FROM: usize = 20_000;
const BATCH: usize = 8;
/// Largest coordinate, in any unit: beyond it nothing is a drawing, and differences lose their digits.
const MAX_COORDINATE: f64 = 1e12;
/// Vertices from which crossings are estimated before the areas are resolved; fewer cannot cross too often.
const TANGLE_FROM: usize = 4000;
/// Most crossings that are resolved. A drawing of a million points has some thousands; a scribble of as many, billions.
const MAX_CROSSINGS: f64 = 4e6;
/// Pairs of sides that are tried for the estimate: it finds a few times 1e5 crossings among a million sides.
const TANGLE_SAMPLES: u64 = 400_000;

/// The regions covered by `contours` under a fill rule, holes and self-crossings resolved.
///
/// # Errors
/// [`OutlineError::TooComplex`] where that would take unbounded time.
pub(super) fn resolve(contours: &Vec<Vec<Point>>, rule: FillRule) -> Result<Shapes, OutlineError> {
    checked(contours)?;
    Ok(contours.simplify_shape_as::<i64>(rule))
}

/// Nothing that the overlay library cannot take, or not in bounded time.
fn checked(contours: &[Vec<Point>]) -> Result<(), OutlineError> {
    let points: usize = contours.iter().map(Vec::len).sum();
    // The overlay library asserts finite coordinates of a sane size.
    if !contours.iter().flatten().flatten().all(|v| v.abs() < MAX_COORDINATE) {
        return Err(OutlineError::Degenerate);
    }
    if points > MAX_POINTS {
        return Err(TOO_MANY);
    }
    if points > TANGLE_FROM && crossings(contours, points) > MAX_CROSSINGS {
        return Err(OutlineError::TooComplex("crosses itself millions of times"));
    }
    Ok(())
}

/// One region from areas that may overlap.
///
/// # Errors
/// As [`resolve`].
pub(super) fn union(mut shapes: Shapes) -> Result<Shapes, OutlineError> {
    let points = |shapes: &Shapes| shapes.iter().flatten().map(Vec::len).sum::<usize>();
    if points(&shapes) > MAX_POINTS {
        return Err(TOO_MANY);
    }
    // Neighbours first: strokes that lie over each other by the thousand cross a million times, their unions hardly.
    while shapes.len() > BATCH && points(&shapes) > BATCHED_FROM {
        let before = shapes.len();
        shapes = by_place(shapes);
        let batches: Vec<&[Vec<Vec<Point>>]> = shapes.chunks(BATCH).collect();
        let united = threads::in_order(&batches, |batch| nearby(&batch.concat()));
        shapes = united.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
        if 2 * shapes.len() > before {
            break;
        }
    }
    resolve(&shapes.into_iter().flatten().collect(), FillRule::NonZero)
}

/// [`resolve`] for a few areas that are next to each other, more than twice as fast: corners are taken to a billionth of the box around them.
fn nearby(contours: &Vec<Vec<Point>>) -> Result<Shapes, OutlineError> {
    checked(contours)?;
    Ok(contours.simplify_shape_as::<i32>(FillRule::NonZero))
}

/// Areas in the order of a curve that fills their box (Morton 1966), so that those next to each other are near each other.
fn by_place(mut shapes: Shapes) -> Shapes {
    let (low, high) = bounding_box(&shapes);
    let longer = (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
    let spread = |v: f64, from: f64| {
        let cell = ((v - from) / longer * 65535.0) as u64;
        (0..16).fold(0_u64, |bits, k| bits | (cell >> k & 1) << (2 * k))
    };
    shapes.sort_by_cached_key(|rings| {
        let (low_corner, high_corner) = rings.first().map_or((low, low), |ring| polygon::bounding_box(ring));
        let middle = polygon::lerp(low_corner, high_corner, 0.5);
        spread(middle[0], low[0]) | spread(middle[1], low[1]) << 1
    });
    shapes
}

pub(super) fn intersection(a: &Shapes, b: &Shapes) -> Shapes {
    a.overlay_as::<i64>(b, OverlayRule::Intersect, FillRule::NonZero)
}

pub(super) fn difference(a: &Shapes, b: &Shapes) -> Shapes {
    a.overlay_as::<i64>(b, OverlayRule::Difference, FillRule::NonZero)
}

/// Area that belongs to one of the two alone.
pub(super) fn unlike(a: &Shapes, b: &Shapes) -> f64 {
    area(&a.overlay_as::<i64>(b, OverlayRule::Xor, FillRule::NonZero))
}

/// Grown by a distance with round corners, or shrunk by a negative one.
pub(super) fn grown(shapes: &Shapes, distance: f64) -> Shapes {
    shapes.outline_as::<i64>(&OutlineStyle::new(distance).line_join(LineJoin::Round(ROUND_JOIN)))
}

pub(super) fn area(shapes: &Shapes) -> f64 {
    shapes.iter().flatten().map(|ring| polygon::signed_area(ring)).sum()
}

/// Area of one region without its holes.
pub(super) fn piece_area(rings: &[Vec<Point>]) -> f64 {
    rings.iter().map(|ring| polygon::signed_area(ring)).sum()
}

/// The box around all outer polygons.
pub(super) fn bounding_box(shapes: &Shapes) -> (Point, Point) {
    shapes.iter().filter_map(|rings| rings.first()).fold(
        ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]),
        |(l, h), ring| {
            let (low, high) = polygon::bounding_box(ring);
            ([l[0].min(low[0]), l[1].min(low[1])], [h[0].max(high[0]), h[1].max(high[1])])
        },
    )
}

/// An estimate of how often the sides cross, from random pairs (always the same ones): with `n` sides and a part `f` of
/// the pairs crossing there are `f n^2 / 2` crossings, wherever they crowd.
fn crossings(contours: &[Vec<Point>], points: usize) -> f64 {
    let mut sides: Vec<(Point, Point)> = Vec::with_capacity(points);
    for contour in contours {
        sides.extend(polygon::sides(contour));
    }
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut index = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % sides.len() as u64) as usize
    };
    let hits = (0..TANGLE_SAMPLES).filter(|_| cross(sides[index()], sides[index()])).count();
    hits as f64 / TANGLE_SAMPLES as f64 * 0.5 * (sides.len() as f64).powi(2)
}

fn cross((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let turn = |p: Point, q: Point, r: Point| (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
    turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, s: f64) -> Vec<Point> {
        vec![[x, y], [x + s, y], [x + s, y + s], [x, y + s]]
    }

    #[test]
    fn the_algebra_of_squares() {
        let a = vec![vec![square(0.0, 0.0, 10.0)]];
        let b = vec![vec![square(5.0, 5.0, 10.0)]];
        let both = union(vec![a[0].clone(), b[0].clone()]).unwrap();
        assert!((area(&both) - 175.0).abs() < 1e-6 && both.len() == 1);
        assert!((area(&intersection(&a, &b)) - 25.0).abs() < 1e-6);
        assert!((area(&difference(&a, &b)) - 75.0).abs() < 1e-6);
        assert!((unlike(&a, &b) - 150.0).abs() < 1e-6);
        assert_eq!(bounding_box(&vec![a[0].clone(), b[0].clone()]), ([0.0, 0.0], [15.0, 15.0]));
        assert!((area(&grown(&a, -2.0)) - 36.0).abs() < 1e-6);
        let expected = 100.0 + 4.0 * 10.0 * 2.0 + std::f64::consts::PI * 4.0;
        assert!((area(&grown(&a, 2.0)) / expected - 1.0).abs() < 0.005);
    }

    #[test]
    fn thousands_of_strokes_unite_to_what_they_unite_to_all_at_once() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut shapes = vec![vec![square(20.0, 20.0, 60.0)]];
        shapes.extend((0..6000).map(|_| vec![square(100.0 * random(), 100.0 * random(), 0.5 + random())]));
        // A hole stays one where nothing covers it.
        shapes.push(vec![square(200.0, 0.0, 10.0), square(203.0, 3.0, 4.0).into_iter().rev().collect()]);
        assert!(shapes.iter().flatten().map(Vec::len).sum::<usize>() > BATCHED_FROM);
        let at_once = resolve(&shapes.concat(), FillRule::NonZero).unwrap();
        let batched = union(shapes).unwrap();
        // Corners of batches are right to a billionth of 20, and some 10 000 lengths of boundary depend on them.
        assert!((area(&batched) - area(&at_once)).abs() < 1e-4, "{} {}", area(&batched), area(&at_once));
        assert!(unlike(&batched, &at_once) < 1e-4);
        assert_eq!(batched.len(), at_once.len());
    }

    #[test]
    fn a_scribble_is_refused_and_a_fine_circle_is_not() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let scribble: Vec<Point> = (0..100_000).map(|_| [random(), random()]).collect();
        assert!(matches!(resolve(&vec![scribble], FillRule::NonZero), Err(OutlineError::TooComplex(_))));
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / 100_000.0;
        let circle: Vec<Point> = (0..100_000).map(|i| [angle(i).cos(), angle(i).sin()]).collect();
        let disc = resolve(&vec![circle], FillRule::NonZero).unwrap();
        assert!((area(&disc) - std::f64::consts::PI).abs() < 1e-6);
    }
}
