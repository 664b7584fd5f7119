//! Pieces of cable that leave the body, at rest or in a pose.

use super::{Breach, Place, Rig};
use crate::outline::{Point, polygon};

/// Length of a piece outside of the body that breaks no rule yet, mm: less than a stitch, and what the corners of a coarse rim cut off.
pub const OUTSIDE_MM: f64 = 1.0;
/// How far beside the rim a cable still counts as inside, mm: the rims of meshes are up to 1.3 mm off their outlines (the bundled designs), and a
/// seam gives as much.
const GRAZING_MM: f64 = 1.5;
/// Rounding by which a cable along the rim may be beside it, mm.
const ON_RIM_MM: f64 = 1e-6;

/// Pieces that lie outside of the body for more than [`OUTSIDE_MM`], cable by cable; what is no more than 1.5 mm beside the rim is inside.
/// `rings` are the body's polygons and `rigs` its cables, both in the same pose. The cost is pieces times sides of the rings.
pub fn judge_pieces<'a>(rings: impl Iterator<Item = &'a [Point]> + Clone, rigs: &[Rig]) -> Vec<Breach> {
    let mut found = Vec::new();
    for (winch, rig) in rigs.iter().enumerate() {
        for (cable, points) in rig.cables.iter().enumerate() {
            for (piece, ends) in points.windows(2).enumerate() {
                let length_mm = beyond(rings.clone(), ends[0], ends[1], GRAZING_MM);
                if length_mm > OUTSIDE_MM {
                    found.push(Breach::Outside { at: Place { winch, cable }, piece, length_mm, most_mm: OUTSIDE_MM });
                }
            }
        }
    }
    found
}

/// Length of the piece from `a` to `b` that lies outside of the body, mm; `rings` are its polygons (outer, and holes the other way around)
/// in the same pose. A body that overlaps itself there is inside where any of it is.
///
/// Exact: the piece is cut where it crosses the rings, and the middle of each part is inside or outside. What runs along a ring is inside.
pub fn outside<'a>(rings: impl Iterator<Item = &'a [Point]> + Clone, a: Point, b: Point) -> f64 {
    beyond(rings, a, b, ON_RIM_MM)
}

/// [`outside`] without the parts that are no more than `grazing` beside the rings in their middle and halfway from there to their ends, mm.
fn beyond<'a>(rings: impl Iterator<Item = &'a [Point]> + Clone, a: Point, b: Point, grazing: f64) -> f64 {
    let mut cuts = Vec::new();
    for ring in rings.clone() {
        cuts.extend(polygon::sides(ring).filter_map(|(p, q)| crossing(a, b, p, q)));
    }
    let at = |c: &[f64], part: f64| polygon::lerp(a, b, c[0] + part * (c[1] - c[0]));
    let inside = |p: Point| rings.clone().map(|ring| winding(ring, p)).sum::<i32>() != 0;
    // Searches judge millions of pieces, and most of them cross nothing.
    if cuts.is_empty() && inside(at(&[0.0, 1.0], 0.5)) {
        return 0.0;
    }
    cuts.extend([0.0, 1.0]);
    cuts.sort_by(f64::total_cmp);
    let grazes = |p: Point| rings.clone().any(|ring| polygon::distance(ring, p) <= grazing);
    let parts = cuts
        .windows(2)
        .filter(|c| c[1] > c[0] && !inside(at(c, 0.5)) && [0.25, 0.5, 0.75].iter().any(|&part| !grazes(at(c, part))));
    // From 0, as a sum of nothing is -0.
    parts.fold(0.0, |sum, c| sum + (c[1] - c[0])) * polygon::length(a, b)
}

/// How often a ring runs around `p`, counter-clockwise.
fn winding(ring: &[Point], p: Point) -> i32 {
    let side = |(a, b): (Point, Point)| {
        let left = (b[0] - a[0]) * (p[1] - a[1]) - (p[0] - a[0]) * (b[1] - a[1]);
        match (a[1] <= p[1], b[1] <= p[1]) {
            (true, false) if left > 0.0 => 1,
            (false, true) if left < 0.0 => -1,
            _ => 0,
        }
    };
    polygon::sides(ring).map(side).sum()
}

/// The parameter on `ab` at which it crosses `pq`, where it does.
fn crossing(a: Point, b: Point, p: Point, q: Point) -> Option<f64> {
    // Most sides are nowhere near.
    let apart = |k: usize| a[k].max(b[k]) + ON_RIM_MM < p[k].min(q[k]) || p[k].max(q[k]) + ON_RIM_MM < a[k].min(b[k]);
    if apart(0) || apart(1) {
        return None;
    }
    let (d, e, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - p[0], q[1] - p[1]], [p[0] - a[0], p[1] - a[1]]);
    let across = d[0] * e[1] - d[1] * e[0];
    let t = (w[0] * e[1] - w[1] * e[0]) / across;
    let s = (w[0] * d[1] - w[1] * d[0]) / across;
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&s)).then_some(t)
}
