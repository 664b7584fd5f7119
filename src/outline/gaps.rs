//! Parts that all but touch become one piece.
//!
//! With `r` half the gap, growing by `r` and shrinking again fills what no disc of radius `r` can enter from outside. Two parts that are grown
//! each on its own overlap in the gap. That is grown again, to reach into both parts; what of it lies in the filled shape joins
//! them.

use super::regions::{self, Shapes};
use super::simplify::simplify;
use super::{OutlineError, Point, polygon};

/// Gaps narrower than this part of the drawing's size are none: 0.25 mm on 250 mm, which scissors cannot part.
pub(super) const GAP_FRACTION: f64 = 1e-3;
/// How far an outline may be simplified before it is grown, in `r`: offsets of points much finer than that take quadratic time.
const SIMPLIFY: f64 = 0.05;
/// How much farther than the gap parts are grown, in `r`, so that one of just that width is closed.
const OVERLAP: f64 = 0.2;
/// Additions smaller than this, in `r^2`, are rounded corners.
const SPECK: f64 = 1e-3;
/// Parts lie along each other for at least so long, in `r`.
const LONG: f64 = 8.0;
/// Slits narrower than this part of the drawing's size are none: 0.05 mm on 250 mm, where parts share a boundary that each has drawn for itself.
pub(super) const SLIT_FRACTION: f64 = 2e-4;
/// Silhouettes of more points are not looked at for slits: what is drawn of thousands of strokes is shaved.
const MAX_SLIT_POINTS: usize = 40_000;
/// Most bridges.
const MAX_BRIDGES: usize = 4000;

/// What closing gaps did.
pub(super) struct Closed {
    pub shapes: Shapes,
    /// What lies in the gaps now.
    pub bridges: Shapes,
}

/// Closes gaps narrower than `gap` between separate parts; also those within a part where `all`.
pub(super) fn closed(shapes: Shapes, gap: f64, all: bool) -> Result<Closed, OutlineError> {
    let untouched = |shapes| Ok(Closed { shapes, bridges: Shapes::new() });
    if gap <= 0.0 || (shapes.len() < 2 && !all) {
        return untouched(shapes);
    }
    let r = 0.5 * gap;
    let plain = |ring: &Vec<Point>| simplify(ring, SIMPLIFY * r);
    let rough: Shapes =
        shapes.iter().map(|rings| rings.iter().map(plain).filter(|ring| ring.len() >= 3).collect()).collect();
    let filled = regions::grown(&regions::grown(&regions::union(rough)?, (1.0 + OVERLAP) * r), -(1.0 + OVERLAP) * r);
    if filled.len() >= shapes.len() && !all {
        return untouched(shapes);
    }
    let mut bridges = Shapes::new();
    if all {
        let mut more = regions::difference(&filled, &shapes);
        more.retain(|piece| regions::piece_area(piece) > SPECK * r * r);
        bridges.extend(regions::grown(&more, OVERLAP * r));
    }
    bridges.extend(between(&shapes, &filled, r));
    let joined = regions::union([shapes.clone(), bridges.clone()].concat())?;
    Ok(Closed { bridges: regions::difference(&bridges, &shapes), shapes: joined })
}

/// Without slits narrower than `width`, and how many there were: what is left of a boundary that two parts share, as far as their points do not agree.
pub(super) fn without_slits(shapes: Shapes, width: f64) -> Result<(Shapes, usize), OutlineError> {
    if shapes.iter().flatten().map(Vec::len).sum::<usize>() > MAX_SLIT_POINTS {
        return Ok((shapes, 0));
    }
    let r = 0.5 * width;
    let filled = regions::grown(&regions::grown(&shapes, r), -(1.0 + OVERLAP) * r);
    let mut slits = regions::difference(&filled, &shapes);
    // The rest are inner corners, rounded.
    slits.retain(|piece| 0.5 * polygon::perimeter(&piece[0]) > LONG * r);
    if slits.is_empty() {
        return Ok((shapes, 0));
    }
    let whole = regions::union([shapes, regions::grown(&slits, OVERLAP * r)].concat())?;
    Ok((whole, slits.len()))
}

/// What lies between parts that are less than `2 r` apart: where they meet when each is grown, as far as that is no bulge on the outside.
fn between(shapes: &Shapes, filled: &Shapes, r: f64) -> Shapes {
    let boxes: Vec<(Point, Point)> = shapes.iter().map(|rings| regions::bounding_box(&vec![rings.clone()])).collect();
    let grown: Vec<Shapes> =
        shapes.iter().map(|rings| regions::grown(&vec![rings.clone()], (1.0 + OVERLAP) * r)).collect();
    let apart = |a: usize, b: usize| {
        let reach = 2.0 * (1.0 + OVERLAP) * r;
        (0..2).any(|i| boxes[a].0[i] > boxes[b].1[i] + reach || boxes[b].0[i] > boxes[a].1[i] + reach)
    };
    let mut bridges = Shapes::new();
    for a in 0..shapes.len() {
        for b in (a + 1..shapes.len()).filter(|&b| !apart(a, b)) {
            if bridges.len() > MAX_BRIDGES {
                return bridges;
            }
            let mut meeting = regions::intersection(&regions::intersection(&grown[a], &grown[b]), filled);
            // Parts that touch in a corner alone are no parts of one.
            meeting.retain(|rings| 0.5 * polygon::perimeter(&rings[0]) > LONG * r);
            // Across a gap nearly as wide as `2 r`, what both reach is a strip in its middle that touches neither.
            let across = regions::grown(&meeting, (1.0 + OVERLAP) * r);
            bridges.extend(regions::intersection(&across, filled));
        }
    }
    bridges
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(low: Point, high: Point) -> Vec<Vec<Point>> {
        vec![vec![low, [high[0], low[1]], high, [low[0], high[1]]]]
    }

    #[test]
    fn a_boundary_that_two_parts_share_leaves_no_slit_behind() {
        // The same wave from below and from above, in other points: they cross, and gape by up to 0.01 between.
        let wave = |count: usize| -> Vec<Point> {
            (0..=count).map(|k| 100.0 * k as f64 / count as f64).map(|x| [x, 50.0 + 8.0 * (x / 16.0).sin()]).collect()
        };
        let below = [wave(180), vec![[100.0, 0.0], [0.0, 0.0]]].concat();
        let above = [wave(97), vec![[100.0, 100.0], [0.0, 100.0]]].concat();
        let parts = regions::union(vec![vec![below.into_iter().rev().collect()], vec![above]]).unwrap();
        let (whole, slits) = without_slits(parts, 0.04).unwrap();
        assert!(whole.len() == 1 && slits > 0);
        // Pinholes at their ends are specks, which go elsewhere.
        assert!(whole[0][1..].iter().all(|hole| polygon::signed_area(hole).abs() < 1e-3));
        assert_eq!(polygon::perimeter(&whole[0][0]).round(), 400.0);
        assert!((regions::area(&whole) - 1e4).abs() < 0.5);
        // One that can be cut stays.
        let cut =
            regions::difference(&vec![rectangle([0.0; 2], [50.0, 40.0])], &vec![rectangle([20.0, 10.0], [20.1, 41.0])]);
        assert_eq!(without_slits(cut.clone(), 0.04).unwrap(), (cut, 0));
    }

    #[test]
    fn a_gap_within_the_width_is_closed_and_a_wider_one_stays() {
        for (gap, pieces) in [(0.0, 1), (1e-6, 1), (0.05, 1), (0.1, 1), (0.2, 2)] {
            let parts = vec![rectangle([0.0; 2], [50.0, 40.0]), rectangle([50.0 + gap, 0.0], [100.0, 40.0])];
            let parts = regions::union(parts).unwrap();
            let Closed { shapes, .. } = closed(parts, 0.1, false).unwrap();
            assert_eq!(shapes.len(), pieces, "{gap}");
            let area: f64 = shapes.iter().flatten().map(|ring| polygon::signed_area(ring)).sum();
            assert!((area - 4000.0).abs() < 8.1, "{gap}: {area}");
        }
        // A slit within one part stays unless it is asked for.
        let slit = regions::difference(
            &vec![rectangle([0.0; 2], [50.0, 40.0])],
            &vec![rectangle([25.0, 10.0], [25.05, 50.0])],
        );
        assert_eq!(closed(slit.clone(), 0.1, false).unwrap().shapes, slit);
        let whole = closed(slit, 0.1, true).unwrap().shapes;
        assert!((regions::area(&whole) - 2000.0).abs() < 0.1);
    }
}
