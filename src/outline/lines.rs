//! A figure drawn as its outline alone becomes the area within it.
//!
//! A drawing is lines if it is thin all over: a strip of width `w` and length `l` has area `A = w l` and perimeter `P = 2 l`, so its mean
//! width is `2 A / P`. Where such lines leave an opening, it is bridged from end to end before the area is filled, the widest opening
//! first.

use super::basins::{Basin, basins};
use super::grid::Grid;
use super::regions::{self, Shapes};
use super::{OutlineError, Point, polygon};

/// Lines are thinner on the mean than this part of the drawing's size: a felt pen on a sheet.
const THIN: f64 = 0.035;
/// What lines enclose is at least this many times as large as they are.
const ENCLOSES: f64 = 2.5;
/// Openings up to this part of the size are slips of the hand.
pub(super) const OPENING_FRACTION: f64 = 0.12;
/// An opening wider than this part of twice the basin's depth is none: the basin is a bay.
const BAY: f64 = 0.7;
/// Basins smaller than this part of the drawing's box are details.
const DETAIL: f64 = 0.05;
/// Openings that are bridged at most.
const MAX_OPENINGS: usize = 12;
/// Directions in which the far side of an opening is looked for lie at least so far from that of the near side, as a cosine.
const OPPOSITE: f64 = -0.3;

/// What became of a drawing.
pub(super) enum Lines {
    /// It is more than lines.
    Body(Shapes),
    /// Filled; where openings were bridged, the widest of them.
    /// Lines beside it enclose nothing.
    Filled { shapes: Shapes, opening: Option<Basin>, beside: Shapes },
    /// Its widest opening is wider than was allowed.
    Open { shapes: Shapes, opening: Basin },
}

impl Lines {
    /// What lines enclose is the figure, and those that enclose nothing, as under a title, are left beside it.
    fn of(body: Shapes, opening: Option<Basin>) -> Self {
        let (beside, shapes): (Shapes, Shapes) = body.into_iter().partition(|piece| are_lines(&vec![piece.clone()]));
        if shapes.is_empty() {
            return Self::Filled { shapes: beside, opening, beside: shapes };
        }
        Self::Filled { shapes, opening, beside }
    }
}

/// Whether the regions are thin lines all over.
pub(super) fn are_lines(shapes: &Shapes) -> bool {
    let (low, high) = regions::bounding_box(shapes);
    let length: f64 = shapes.iter().flatten().map(|ring| polygon::perimeter(ring)).sum();
    2.0 * regions::area(shapes) / length < THIN * (high[0] - low[0]).max(high[1] - low[1])
}

/// Fills what lines enclose, across openings up to `widest`.
pub(super) fn filled(shapes: Shapes, widest: f64) -> Result<Lines, OutlineError> {
    if !are_lines(&shapes) {
        return Ok(Lines::Body(shapes));
    }
    let ink = regions::area(&shapes);
    let (low, high) = regions::bounding_box(&shapes);
    let whole = (high[0] - low[0]) * (high[1] - low[1]);
    let mut lines = shapes.clone();
    let mut bridged: Option<Basin> = None;
    for _ in 0..MAX_OPENINGS {
        let open = basins(&lines)
            .into_iter()
            .find(|basin| basin.area > DETAIL * whole && basin.opening < BAY * 2.0 * basin.depth);
        let Some(basin) = open else { break };
        if basin.opening > widest {
            // What is closed already may be the figure all the same.
            let body = solid(&lines)?;
            let enough = regions::area(&body) > ENCLOSES * ink && regions::area(&body) > basin.area;
            return Ok(if enough { Lines::of(body, bridged) } else { Lines::Open { shapes, opening: basin } });
        }
        let Some(bridge) = bridge(&lines, &basin) else { break };
        lines = regions::union([lines, vec![vec![bridge]]].concat())?;
        bridged = bridged.or(Some(basin));
    }
    let body = solid(&lines)?;
    let enough = regions::area(&body) > ENCLOSES * ink;
    Ok(if enough { Lines::of(body, bridged) } else { Lines::Body(shapes) })
}

fn solid(shapes: &Shapes) -> Result<Shapes, OutlineError> {
    regions::union(shapes.iter().map(|rings| rings.iter().take(1).cloned().collect()).collect())
}

/// A strip as wide as the lines from one side of an opening to the other.
fn bridge(lines: &Shapes, basin: &Basin) -> Option<Vec<Point>> {
    let sides = || lines.iter().flatten().flat_map(|ring| polygon::sides(ring));
    let nearest = |allowed: &dyn Fn(Point) -> bool| {
        let points = sides().map(|(a, b)| polygon::lerp(a, b, polygon::nearest_parameter(a, b, basin.at)));
        points
            .filter(|p| allowed(*p))
            .min_by(|p, q| polygon::length(basin.at, *p).total_cmp(&polygon::length(basin.at, *q)))
    };
    let towards = |p: Point| {
        let d = polygon::length(basin.at, p);
        [(p[0] - basin.at[0]) / d, (p[1] - basin.at[1]) / d]
    };
    let near = nearest(&|_| true)?;
    let u = towards(near);
    let far = nearest(&|p| {
        let v = towards(p);
        u[0] * v[0] + u[1] * v[1] < OPPOSITE
    })?;
    let length: f64 = lines.iter().flatten().map(|ring| polygon::perimeter(ring)).sum();
    let half = regions::area(lines) / length;
    let gap = polygon::length(near, far);
    let along = [(far[0] - near[0]) / gap, (far[1] - near[1]) / gap];
    // Well into the line at both ends.
    let reach = 2.0 * half;
    let (from, to) = (
        [near[0] - reach * along[0], near[1] - reach * along[1]],
        [far[0] + reach * along[0], far[1] + reach * along[1]],
    );
    let across = [-half * along[1], half * along[0]];
    let corner = |p: Point, s: f64| [p[0] + s * across[0], p[1] + s * across[1]];
    let strip = vec![corner(from, -1.0), corner(to, -1.0), corner(to, 1.0), corner(from, 1.0)];
    // What the strip has to reach is there.
    let grid = Grid::new(lines.iter().flatten().map(Vec::as_slice));
    (gap.is_finite() && grid.is_near(near, half) && grid.is_near(far, half)).then_some(strip)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// A line of width 2 along a circle of radius 100, with openings at angles, each so wide.
    fn ring(openings: &[(f64, f64)]) -> Shapes {
        let at = |r: f64, t: f64| [r * t.cos(), r * t.sin()];
        let circle = |r: f64| (0..360).map(|i| at(r, TAU * f64::from(i) / 360.0)).collect::<Vec<Point>>();
        let mut shapes = vec![vec![circle(101.0), circle(99.0).into_iter().rev().collect()]];
        for &(angle, width) in openings {
            let (u, v) = (at(1.0, angle), at(0.5 * width, angle + 0.25 * TAU));
            let corner = |r: f64, s: f64| [r * u[0] + s * v[0], r * u[1] + s * v[1]];
            let cut = vec![vec![vec![corner(90.0, -1.0), corner(110.0, -1.0), corner(110.0, 1.0), corner(90.0, 1.0)]]];
            shapes = regions::difference(&shapes, &cut);
        }
        shapes
    }

    #[test]
    fn a_ring_is_filled_across_openings_up_to_the_widest_allowed() {
        for openings in [vec![], vec![(1.0, 8.0)], vec![(0.3, 4.0), (2.0, 9.0), (4.0, 6.0)]] {
            let Lines::Filled { shapes, opening, .. } = filled(ring(&openings), 10.0).unwrap() else {
                panic!("{openings:?}")
            };
            assert_eq!((shapes.len(), opening.is_some()), (1, !openings.is_empty()));
            assert!((regions::area(&shapes) / (PI * 101.0 * 101.0) - 1.0).abs() < 0.005, "{openings:?}");
        }
        let Lines::Open { opening, .. } = filled(ring(&[(0.0, 24.0)]), 10.0).unwrap() else { panic!() };
        assert!((opening.opening - 24.0).abs() < 2.0 && (opening.at[0] - 100.0).abs() < 3.0, "{opening:?}");
    }

    #[test]
    fn a_thick_ring_and_a_cross_of_lines_stay() {
        let thick = regions::grown(&ring(&[]), 6.0);
        assert!(matches!(filled(thick, 10.0), Ok(Lines::Body(_))));
        let bar = |w: f64, h: f64| vec![vec![[-w, -h], [w, -h], [w, h], [-w, h]]];
        let cross = regions::union(vec![bar(100.0, 1.0), bar(1.0, 100.0)]).unwrap();
        assert!(matches!(filled(cross, 10.0), Ok(Lines::Body(_))));
    }
}
