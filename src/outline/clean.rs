//! Painted areas to one clean outline: union, slivers out, simplification, placement.

use super::{Outline, OutlineError, Point, polygon};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;

/// Farthest that simplification may move the boundary, as a fraction of the longer side of the box: 0.03 mm on a
/// 300 mm plushie, a tenth of what scissors can follow. Larger values drop detail, smaller ones keep needless points.
const SIMPLIFY_FRACTION: f64 = 1e-4;
/// Pieces and holes smaller than this fraction of the silhouette are leftovers of rounding: 0.02 mm^2 in 20 000 mm^2.
const SLIVER_FRACTION: f64 = 1e-6;
/// Silhouettes that fill less than this fraction of the square of their longer side are taken for lines.
const DEGENERATE_FRACTION: f64 = 1e-5;

/// Regions with holes, as the overlay library gives them: outer polygon counter-clockwise, then its holes.
pub(super) type Shapes = Vec<Vec<Vec<Point>>>;

/// The regions covered by `contours` under a fill rule, holes and self-crossings resolved.
pub(super) fn resolve(contours: &Vec<Vec<Point>>, rule: FillRule) -> Shapes {
    contours.simplify_shape_as::<i64>(rule)
}

/// One outline from areas in any consistent unit (y up) that may overlap; `size` says how many mm a unit measures, or
/// the height in mm.
pub(super) fn outline(shapes: Shapes, size: Size) -> Result<Outline, OutlineError> {
    let contours: Vec<Vec<Point>> = shapes.into_iter().flatten().collect();
    let shapes = without_slivers(resolve(&contours, FillRule::NonZero));
    let rings = match shapes.len() {
        0 => return Err(OutlineError::Degenerate),
        1 => shapes.into_iter().next().unwrap_or_default(),
        pieces => return Err(OutlineError::Pieces { pieces }),
    };
    let Some(outer) = rings.first() else { return Err(OutlineError::Degenerate) };
    let (low, high) = polygon::bounding_box(outer);
    let longer = (high[0] - low[0]).max(high[1] - low[1]);
    let area: f64 = rings.iter().map(|ring| polygon::signed_area(ring)).sum();
    if area.is_nan() || area <= DEGENERATE_FRACTION * longer * longer {
        return Err(OutlineError::Degenerate);
    }
    let rings = simplified(rings, SIMPLIFY_FRACTION * longer);
    // The height is that of what is left: simplification may have shaved a rounded top.
    let (low, high) = polygon::bounding_box(rings.first().map_or(&[], Vec::as_slice));
    let scale = match size {
        Size::UnitMm(mm) => mm,
        Size::HeightMm(mm) => mm / (high[1] - low[1]),
    };
    place(rings, scale)
}

/// What the unit of the input measures.
#[derive(Clone, Copy)]
pub(super) enum Size {
    UnitMm(f64),
    HeightMm(f64),
}

fn without_slivers(shapes: Shapes) -> Shapes {
    let total: f64 = shapes.iter().flatten().map(|ring| polygon::signed_area(ring)).sum();
    let big = |ring: &Vec<Point>| polygon::signed_area(ring).abs() > SLIVER_FRACTION * total;
    shapes
        .into_iter()
        .filter(|rings| rings.first().is_some_and(big))
        .map(|rings| rings.into_iter().filter(big).collect())
        .collect()
}

/// Simplified to `tolerance`; as it was where that would make the boundary touch itself.
fn simplified(rings: Vec<Vec<Point>>, tolerance: f64) -> Vec<Vec<Point>> {
    let thin: Vec<Vec<Point>> = rings.iter().map(|ring| simplify(ring, tolerance)).collect();
    if thin.iter().any(|ring| ring.len() < 3) {
        return rings;
    }
    let mut shapes = without_slivers(resolve(&thin, FillRule::NonZero));
    match shapes.pop() {
        Some(clean) if shapes.is_empty() && clean.len() == rings.len() => clean,
        _ => rings,
    }
}

/// Scales to mm, moves the lower left corner of the box to the origin, and checks that no point occurs twice.
fn place(mut rings: Vec<Vec<Point>>, scale: f64) -> Result<Outline, OutlineError> {
    let (low, _) = polygon::bounding_box(rings.first().map_or(&[], Vec::as_slice));
    for p in rings.iter_mut().flatten() {
        *p = [(p[0] - low[0]) * scale, (p[1] - low[1]) * scale];
    }
    let mut points: Vec<Point> = rings.iter().flatten().copied().collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    if let Some(twice) = points.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(OutlineError::Pinched { x: twice[0][0], y: twice[0][1] });
    }
    let holes = rings.split_off(1);
    Ok(Outline { outer: rings.pop().unwrap_or_default(), holes })
}

/// Douglas-Peucker on a closed polygon: no dropped point lies farther than `tolerance` from what is left.
///
/// The ring is cut at its lowest leftmost point, which is a corner of the hull, and at the point farthest from it.
fn simplify(ring: &[Point], tolerance: f64) -> Vec<Point> {
    let order = |a: &Point, b: &Point| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
    let Some(first) = (0..ring.len()).min_by(|&a, &b| order(&ring[a], &ring[b])) else { return Vec::new() };
    let mut points: Vec<Point> = ring[first..].iter().chain(&ring[..=first]).copied().collect();
    let far = (0..points.len())
        .max_by(|&a, &b| polygon::length(points[0], points[a]).total_cmp(&polygon::length(points[0], points[b])))
        .unwrap_or(0);
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[far] = true;
    let mut open = vec![(0, far), (far, points.len() - 1)];
    while let Some((from, to)) = open.pop() {
        let away = |i: usize| polygon::distance_to_segment(points[from], points[to], points[i]);
        let Some(worst) = (from + 1..to).max_by(|&a, &b| away(a).total_cmp(&away(b))) else { continue };
        if away(worst) > tolerance {
            keep[worst] = true;
            open.extend([(from, worst), (worst, to)]);
        }
    }
    let mut kept = keep.iter();
    points.retain(|_| kept.next() == Some(&true));
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(n: usize, r: f64) -> Vec<Point> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n).map(|i| [r * angle(i).cos(), r * angle(i).sin()]).collect()
    }

    #[test]
    fn simplification_stays_within_its_tolerance() {
        let ring = circle(5000, 100.0);
        let mut last = usize::MAX;
        for tolerance in [1e-3, 1e-2, 1e-1, 1.0] {
            let thin = simplify(&ring, tolerance);
            assert!(thin.len() < last);
            last = thin.len();
            for &p in &ring {
                assert!(polygon::distance(&thin, p) <= tolerance * (1.0 + 1e-9));
            }
        }
    }

    #[test]
    fn overlapping_areas_become_one_and_slivers_go() {
        let square = |x: f64, y: f64, s: f64| vec![vec![[x, y], [x + s, y], [x + s, y + s], [x, y + s]]];
        let shapes = vec![square(5.0, 5.0, 10.0), square(10.0, 10.0, 10.0), square(40.0, 0.0, 1e-3)];
        let outline = outline(shapes, Size::UnitMm(2.0)).unwrap();
        assert_eq!(outline.outer.len(), 8);
        assert!((outline.area() - 4.0 * 175.0).abs() < 1e-6);
        let (low, high) = outline.bounding_box();
        assert!(low == [0.0, 0.0] && (high[0] - 30.0).abs() < 1e-6 && (high[1] - 30.0).abs() < 1e-6);
    }

    #[test]
    fn a_hole_that_touches_the_rim_in_a_point_is_refused() {
        let outer = vec![[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [4.0, 8.0], [0.0, 8.0]];
        let hole = vec![[4.0, 8.0], [6.0, 4.0], [4.0, 2.0], [2.0, 4.0]];
        let shapes = resolve(&vec![outer, hole], FillRule::EvenOdd);
        assert!(matches!(outline(shapes, Size::UnitMm(1.0)), Err(OutlineError::Pinched { .. })));
    }
}
