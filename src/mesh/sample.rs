//! Boundary nodes: an outline sampled at about a wanted spacing.
//!
//! Corners become nodes. Between them the spacing follows the density `rho(s) = sqrt(1 + (a h kappa)^2) / h`, so that
//! rounded tips get more nodes than straight flanks; `kappa` is the turning of the outline in a window about `s`,
//! divided by its length. Then nodes are added where a chord strays from the outline too far, and where it is needed to
//! keep the area.

use super::boundary::Boundary;
use super::curve::Curve;
use super::search::WorkBudget;
use crate::outline::{Outline, Point, polygon};

/// Weights `a` of curvature in the density, tried in turn until the area is kept.
const CURVATURE_WEIGHTS: [f64; 10] = [0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0, 1.2, 1.5, 1.9];
/// Farthest that a chord may stray from the outline, in spacings: features finer than `h` stay.
const STRAY: f64 = 0.12;

/// A feature this close to a node, as a fraction of the arc, moves the node rather than adding one.
const NEAR: f64 = 0.3;
/// Most change of the spacing along the boundary per length of way: neighbouring edges differ by a third.
const GRADATION: f64 = 0.35;

/// How closely the boundary is followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closeness {
    /// Farthest that a chord may stray from the outline, mm.
    pub stray: f64,
    /// Area that the polygon of boundary nodes may lose or win, as a fraction of the outline's.
    pub area: f64,
}

/// The boundary to sample.
#[derive(Clone, Copy)]
pub(super) struct Rim<'a> {
    pub outline: &'a Outline,
    /// One for each polygon.
    pub curves: &'a [Curve<'a>],
    /// Vertices of the outer polygon that must be nodes: there the body meets the axis of its mirror symmetry.
    pub on_axis: &'a [usize],
}

/// Nodes beyond what the spacing asks for, on the outer polygon and on the axis.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Extra {
    pub rim: usize,
    pub axis: usize,
}

/// The bends of a boundary as they are seen at a spacing: the same for all numbers of nodes.
pub(super) struct Bends<'a> {
    rim: Rim<'a>,
    pub h: f64,
    /// One for each polygon.
    rings: Vec<RingBends>,
    area: f64,
    vertices: usize,
}

struct RingBends {
    /// Where sections start: the corners, or one place.
    starts: Vec<f64>,
    /// The stretches of all sections: length, curvature.
    stretches: Vec<(f64, f64)>,
    /// First stretch of each section, and the number of all.
    firsts: Vec<usize>,
}

impl<'a> Bends<'a> {
    pub fn new(rim: Rim<'a>, h: f64) -> Self {
        let ring = |(k, curve): (usize, &Curve)| {
            let corners = curve.corners(h, if k == 0 { rim.on_axis } else { &[] });
            let starts = if corners.is_empty() { vec![0.0] } else { corners };
            let mut stretches = Vec::new();
            let mut firsts = Vec::with_capacity(starts.len() + 1);
            for i in 0..starts.len() {
                firsts.push(stretches.len());
                stretches.extend(section(curve, curve.arc(&starts, i), h));
            }
            firsts.push(stretches.len());
            RingBends { starts, stretches, firsts }
        };
        let rings = rim.curves.iter().enumerate().map(ring).collect();
        let vertices = rim.outline.polygons().map(<[Point]>::len).sum();
        Self { area: rim.outline.area(), rim, h, rings, vertices }
    }

    /// Number of stretches.
    pub fn size(&self) -> usize {
        self.rings.iter().map(|ring| ring.stretches.len()).sum()
    }
}

/// Samples all polygons of the outline. `None` where no choice of at most `most` nodes gives a boundary free of crossings.
/// Nor where the budget does not suffice.
pub(super) fn sample(
    bends: &Bends,
    extra: Extra,
    close: Closeness,
    most: usize,
    budget: &WorkBudget,
) -> Option<Boundary> {
    let Rim { curves, on_axis, .. } = bends.rim;
    let stray = (STRAY * bends.h).min(close.stray);
    let lost = |rings: &[Vec<f64>]| {
        let sampled: f64 = curves.iter().zip(rings).map(|(c, ring)| polygon::signed_area(&c.points(ring))).sum();
        1.0 - sampled / bends.area
    };
    let count = |rings: &[Vec<f64>]| rings.iter().map(Vec::len).sum::<usize>();
    let mut rings = Vec::new();
    for weight in CURVATURE_WEIGHTS {
        // The outer polygon takes the extra nodes.
        let ring = |(k, c): (usize, &Curve)| match k {
            0 => along(c, bends, k, on_axis, weight, stray, extra),
            _ => along(c, bends, k, &[], weight, stray, Extra::default()),
        };
        rings = curves.iter().enumerate().map(ring).collect();
        budget.spend(bends.size() / 2 + 8 * count(&rings) + bends.vertices);
        // More weight gives more nodes.
        if count(&rings) > most {
            return None;
        }
        if lost(&rings).abs() < close.area {
            break;
        }
    }
    loop {
        let lost = lost(&rings);
        if count(&rings) > most {
            return None;
        }
        if lost.abs() <= close.area {
            break;
        }
        budget.spend(2 * count(&rings) + bends.vertices);
        split_widest(curves, &mut rings, lost.signum())?;
    }
    // Chords across narrow gaps may cross: halve what does until nothing is left to halve.
    loop {
        if count(&rings) > most || budget.is_exhausted() {
            return None;
        }
        budget.spend(20 * count(&rings));
        let boundary = join(curves, &rings);
        let crossing = super::triangulate::crossings(&boundary, budget)?;
        if crossing.is_empty() {
            return Some(boundary);
        }
        let mut starts = Vec::new();
        for (k, ring) in rings.iter().enumerate() {
            starts.extend((0..ring.len()).map(|i| (k, i)));
        }
        for &node in crossing.iter().rev() {
            let (k, i) = starts[node];
            split(&curves[k], &mut rings[k], i)?;
        }
    }
}

/// Halves the arcs whose chords cut off the largest areas (`sign` 1) or add the largest (-1), a tenth of them at once.
fn split_widest(curves: &[Curve], rings: &mut [Vec<f64>], sign: f64) -> Option<()> {
    let mut lenses: Vec<(f64, usize, usize)> = Vec::new();
    for (k, (curve, ring)) in curves.iter().zip(rings.iter()).enumerate() {
        for i in 0..ring.len() {
            let (from, to) = curve.arc(ring, i);
            let lens = sign * polygon::signed_area(&curve.arc_points(from, to));
            if lens > 0.0 {
                lenses.push((lens, k, i));
            }
        }
    }
    lenses.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    lenses.truncate(lenses.len().div_ceil(10));
    // From behind, so that the numbers before stay.
    lenses.sort_by_key(|&(_, k, i)| std::cmp::Reverse((k, i)));
    for &(_, k, i) in &lenses {
        split(&curves[k], &mut rings[k], i)?;
    }
    (!lenses.is_empty()).then_some(())
}

fn join(curves: &[Curve], rings: &[Vec<f64>]) -> Boundary {
    let mut boundary = Boundary::default();
    for (k, (curve, ring)) in curves.iter().zip(rings).enumerate() {
        let first = boundary.nodes.len();
        boundary.nodes.extend(curve.points(ring));
        boundary.places.extend(ring.iter().map(|&s| (k, s)));
        let n = ring.len();
        boundary.segments.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
    }
    boundary
}

/// Ascending arc lengths of the nodes of ring `k`, its corners among them.
///
/// The spacing is that of the density, and short enough for the chords of an arc of the local curvature to stray no more
/// than `stray`: `l = sqrt(8 stray / kappa)`.
fn along(curve: &Curve, bends: &Bends, k: usize, on_axis: &[usize], weight: f64, stray: f64, extra: Extra) -> Vec<f64> {
    let RingBends { starts, stretches, firsts } = &bends.rings[k];
    let h = bends.h;
    // A ring without corners still needs a few nodes to be round.
    let least = if starts.len() == 1 { 5 } else { 1 };
    let step = |&(length, curvature): &(f64, f64)| {
        let bend = weight * h * curvature;
        let chord = (8.0 * stray / curvature).sqrt();
        Step { length, spacing: (h / (1.0 + bend * bend).sqrt()).min(chord) }
    };
    let mut steps: Vec<Step> = stretches.iter().map(step).collect();
    grade(&mut steps);
    let mut sections: Vec<(&[Step], f64, usize)> = firsts
        .windows(2)
        .map(|w| {
            let section = &steps[w[0]..w[1]];
            let total: f64 = section.iter().map(|s| s.length / s.spacing).sum();
            (section, total, (total.round() as usize).max(least))
        })
        .collect();
    let is_axis = |k: usize| {
        let (from, to) = curve.arc(starts, k);
        !on_axis.is_empty() && curve.at(from)[1] == 0.0 && curve.at(0.5 * (from + to))[1] == 0.0
    };
    for (axis, extra) in [(false, extra.rim), (true, extra.axis)] {
        for _ in 0..extra {
            let wanting = |k: &usize| sections[*k].1 - sections[*k].2 as f64;
            let allowed = (0..sections.len()).filter(|&k| is_axis(k) == axis);
            if let Some(k) = allowed.max_by(|a, b| wanting(a).total_cmp(&wanting(b)).then(b.cmp(a))) {
                sections[k].2 += 1;
            }
        }
    }
    let mut nodes = Vec::new();
    for (i, (section, total, n)) in sections.iter().enumerate() {
        let (from, to) = curve.arc(starts, i);
        nodes.push(from);
        let (mut k, mut mass, mut s) = (0, 0.0, from);
        for j in 1..*n {
            let wanted = total * j as f64 / *n as f64;
            while k + 1 < section.len() && mass + section[k].length / section[k].spacing < wanted {
                mass += section[k].length / section[k].spacing;
                s += section[k].length;
                k += 1;
            }
            nodes.push((s + (wanted - mass) * section[k].spacing).min(to));
        }
    }
    for s in &mut nodes {
        *s = s.rem_euclid(curve.length());
    }
    nodes.sort_by(f64::total_cmp);
    nodes.dedup();
    let fixed: Vec<f64> = on_axis.iter().map(|&i| curve.vertex(i)).collect();
    keep_features(curve, nodes, &fixed, stray)
}

/// A short stretch of a ring and the spacing wanted there.
struct Step {
    length: f64,
    spacing: f64,
}

/// The stretches between two corners: length and curvature.
fn section(curve: &Curve, (from, to): (f64, f64), h: f64) -> impl Iterator<Item = (f64, f64)> {
    let window = curve.window(h);
    let count = ((to - from) / (0.08 * h)).ceil().max(8.0) as usize;
    let length = (to - from) / count as f64;
    (0..count).map(move |k| {
        let s = from + (k as f64 + 0.5) * length;
        // A corner is a node already: its turning must not crowd the nodes beside it.
        let (a, b) = ((s - window).max(from + 1e-9 * h), (s + window).min(to - 1e-9 * h));
        (length, curve.turning(a, b).abs() / (2.0 * window))
    })
}

/// Lets the spacing change along a closed ring by no more than [`GRADATION`] a length.
fn grade(steps: &mut [Step]) {
    let n = steps.len();
    let next = |i: usize| if i + 1 == n { 0 } else { i + 1 };
    for i in (0..n).chain(0..n) {
        let j = next(i);
        let most = steps[i].spacing + GRADATION * 0.5 * (steps[i].length + steps[j].length);
        steps[j].spacing = steps[j].spacing.min(most);
    }
    for j in (0..n).rev().chain((0..n).rev()) {
        let i = next(j);
        let most = steps[i].spacing + GRADATION * 0.5 * (steps[i].length + steps[j].length);
        steps[j].spacing = steps[j].spacing.min(most);
    }
}

/// Adds the farthest vertex of every arc that strays from its chord by more than `stray`, again and again. A node close by
/// (none of the `fixed`) is moved there instead if both its arcs are then close enough.
fn keep_features(curve: &Curve, mut ring: Vec<f64>, fixed: &[f64], stray: f64) -> Vec<f64> {
    let mut i = 0;
    while i < ring.len() {
        let (from, to) = curve.arc(&ring, i);
        let Some((s, _)) = curve.stray(from, to).filter(|&(_, away)| away > stray) else {
            i += 1;
            continue;
        };
        let n = ring.len();
        let near = |k: usize, away: f64| away < NEAR * (to - from) && n > 4 && !fixed.contains(&ring[k]);
        let strays = |a: f64, b: f64| curve.stray(a, b).is_some_and(|(_, away)| away > stray);
        let moved = if near(i, s - from) && i > 0 && !strays(ring[i - 1], s) && !strays(s, to) {
            Some(i)
        } else if i + 1 < n && near(i + 1, to - s) && !strays(from, s) && !strays(s, curve.arc(&ring, i + 1).1) {
            Some(i + 1)
        } else {
            None
        };
        match moved.filter(|_| s < curve.length()) {
            Some(k) => ring[k] = s,
            None => insert(&mut ring, s.rem_euclid(curve.length()), &mut i),
        }
    }
    ring
}

/// Halves the arc after node `i`; `None` where it is too short to.
fn split(curve: &Curve, ring: &mut Vec<f64>, i: usize) -> Option<()> {
    let (from, to) = curve.arc(ring, i);
    if to - from < 1e-6 * curve.length() {
        return None;
    }
    let mut i = i;
    insert(ring, (0.5 * (from + to)).rem_euclid(curve.length()), &mut i);
    Some(())
}

/// Inserts keeping the order; `i` goes on pointing to the same node.
fn insert(ring: &mut Vec<f64>, s: f64, i: &mut usize) {
    let place = ring.partition_point(|&t| t < s);
    ring.insert(place, s);
    if place <= *i {
        *i += 1;
    }
}
