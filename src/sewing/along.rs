//! Cables that run along each other.

use super::{Breach, Place, Rig, Rules};
use crate::outline::Point;
use crate::outline::polygon::{bounding_box, length};

/// Length of the polyline `p` that is nearer than `beside` to the polyline `q`, mm, its first `lead` mm left out.
///
/// Exact: what a line has in common with the points near a segment, a rectangle with two round ends, is one interval.
pub fn shared_mm(p: &[Point], q: &[Point], beside: f64, lead: f64) -> f64 {
    let (mut start, mut shared) = (0.0, 0.0);
    let mut near: Vec<(f64, f64)> = Vec::new();
    for piece in p.windows(2) {
        let whole = length(piece[0], piece[1]);
        let first = (lead - start).clamp(0.0, whole);
        start += whole;
        near.clear();
        let own = bounding_box(piece);
        let close = q.windows(2).filter(|s| !apart(&own, &bounding_box(s), beside));
        near.extend(close.filter_map(|s| interval(piece[0], piece[1], s[0], s[1], beside)));
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut end = first;
        for &(from, to) in &near {
            let (from, to) = (from.max(end), to.min(whole));
            if to > from {
                shared += to - from;
                end = to;
            }
        }
    }
    shared
}

/// Where on the segment `ab`, in lengths from `a`, points are nearer than `r` to the segment `cd`.
fn interval(a: Point, b: Point, c: Point, d: Point, r: f64) -> Option<(f64, f64)> {
    let whole = length(a, b);
    if whole == 0.0 {
        return None;
    }
    let u = [(b[0] - a[0]) / whole, (b[1] - a[1]) / whole];
    let round = [c, d].map(|end| disc(a, u, end, r));
    let bounds = round.into_iter().chain([strip(a, u, c, d, r)]).flatten();
    // The union of three intervals whose hull is convex with them.
    let (low, high) = bounds.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), (from, to)| (l.min(from), h.max(to)));
    (low < high && high > 0.0 && low < whole).then(|| (low.max(0.0), high.min(whole)))
}

/// Where the line `a + t u` is in the disc of radius `r` around `m`.
fn disc(a: Point, u: Point, m: Point, r: f64) -> Option<(f64, f64)> {
    let w = [m[0] - a[0], m[1] - a[1]];
    let (middle, off) = (w[0] * u[0] + w[1] * u[1], w[0] * u[1] - w[1] * u[0]);
    let half2 = r * r - off * off;
    (half2 > 0.0).then(|| (middle - half2.sqrt(), middle + half2.sqrt()))
}

/// Where the line `a + t u` is in the rectangle of all points beside the segment `cd`, up to `r` from it.
fn strip(a: Point, u: Point, c: Point, d: Point, r: f64) -> Option<(f64, f64)> {
    let whole = length(c, d);
    if whole == 0.0 {
        return None;
    }
    let v = [(d[0] - c[0]) / whole, (d[1] - c[1]) / whole];
    let w = [a[0] - c[0], a[1] - c[1]];
    let along = slab(w[0] * v[0] + w[1] * v[1], u[0] * v[0] + u[1] * v[1], 0.0, whole)?;
    let across = slab(w[1] * v[0] - w[0] * v[1], u[1] * v[0] - u[0] * v[1], -r, r)?;
    let (low, high) = (along.0.max(across.0), along.1.min(across.1));
    (low < high).then_some((low, high))
}

/// Where `x + t v` is between `low` and `high`.
fn slab(x: f64, v: f64, low: f64, high: f64) -> Option<(f64, f64)> {
    if v == 0.0 {
        return (low < x && x < high).then_some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let (s, t) = ((low - x) / v, (high - x) / v);
    Some((s.min(t), s.max(t)))
}

/// Stretches of cables along each other: each pair once, from the side of the one that is longer beside the other.
pub(super) fn judge(rules: &Rules, rigs: &[Rig], found: &mut Vec<Breach>) {
    let cables = rigs.iter().enumerate().flat_map(|(winch, rig)| {
        rig.cables.iter().enumerate().map(move |(cable, points)| (Place { winch, cable }, points, bounding_box(points)))
    });
    let all: Vec<_> = cables.collect();
    for (k, (at, p, p_box)) in all.iter().enumerate() {
        for (other, q, q_box) in &all[k + 1..] {
            if apart(p_box, q_box, rules.beside_mm) {
                continue;
            }
            let there = shared_mm(p, q, rules.beside_mm, rules.lead_mm);
            let back = shared_mm(q, p, rules.beside_mm, rules.lead_mm);
            let (at, other, length_mm) = if back > there { (*other, *at, back) } else { (*at, *other, there) };
            if length_mm > rules.along_mm {
                found.push(Breach::Along { at, other, length_mm, most_mm: rules.along_mm });
            }
        }
    }
}

/// Whether nothing in one box is nearer than `beside` to anything in the other.
fn apart(p: &(Point, Point), q: &(Point, Point), beside: f64) -> bool {
    (0..2).any(|axis| p.0[axis] - q.1[axis] > beside || q.0[axis] - p.1[axis] > beside)
}
