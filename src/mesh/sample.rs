//! Boundary nodes: an outline sampled at about a wanted spacing.
//!
//! Corners become nodes. Between them the spacing follows the density `rho(s) = sqrt(1 + (a h kappa)^2) / h`, so that
//! rounded tips get more nodes than straight flanks; `kappa` is the turning of the outline in a window about `s`,
//! divided by its length. Then nodes are added where a chord strays from the outline by more than a fraction of `h`,
//! so that features finer than `h` stay, and where it is needed to keep the area.

use crate::outline::{Outline, Point, polygon};

/// Half the window in which turning is measured, in spacings.
const WINDOW: f64 = 0.3;
/// Turning within the window that makes a corner, rad (45 degrees): a limb's tip of radius h stays round.
const CORNER_TURN: f64 = std::f64::consts::FRAC_PI_4;
/// Corners closer than this along the outline, in spacings, count as one.
const CORNER_GAP: f64 = 0.55;
/// Weights `a` of curvature in the density, tried in turn until the area is kept.
const CURVATURE_WEIGHTS: [f64; 4] = [0.4, 0.7, 1.0, 1.4];
/// Farthest that a chord may stray from the outline, in spacings, and as a fraction of the longer side of the box (4.5 mm
/// on 300 mm): however few fibres are asked for, a limb is not left out.
const STRAY: f64 = 0.12;
const STRAY_FRACTION: f64 = 0.015;
/// Area that the polygon of boundary nodes may lose or win, as a fraction of the outline's.
const AREA_FRACTION: f64 = 0.0095;

/// Sampled boundary. Nodes of a ring are consecutive and in the ring's order.
#[derive(Clone, Debug, Default)]
pub(super) struct Boundary {
    pub nodes: Vec<Point>,
    /// Index pairs of consecutive nodes: the constrained edges.
    pub segments: Vec<[usize; 2]>,
}

/// Samples all polygons of the outline at spacing `h`, with `extra` nodes beyond what the spacing asks for. `None`
/// where no choice gives a boundary free of crossings.
pub(super) fn sample(outline: &Outline, h: f64, extra: usize) -> Option<Boundary> {
    let curves: Vec<Curve> = outline.polygons().map(Curve::new).collect();
    let area = outline.area();
    let (low, high) = outline.bounding_box();
    let stray = (STRAY * h).min(STRAY_FRACTION * (high[0] - low[0]).max(high[1] - low[1]));
    let lost = |rings: &[Vec<f64>]| {
        let sampled: f64 = curves.iter().zip(rings).map(|(c, ring)| polygon::signed_area(&c.points(ring))).sum();
        1.0 - sampled / area
    };
    let mut rings = Vec::new();
    for weight in CURVATURE_WEIGHTS {
        // The outer polygon takes the extra nodes.
        rings = curves
            .iter()
            .enumerate()
            .map(|(k, c)| c.sample(h, weight, stray, if k == 0 { extra } else { 0 }))
            .collect();
        if lost(&rings).abs() < AREA_FRACTION {
            break;
        }
    }
    while lost(&rings).abs() > AREA_FRACTION {
        let (k, i) = widest_lens(&curves, &rings, lost(&rings).signum())?;
        curves[k].split(&mut rings[k], i)?;
    }
    // Chords across narrow gaps may cross: halve what does until nothing is left to halve.
    loop {
        let boundary = join(&curves, &rings);
        let crossing = super::triangulate::crossings(&boundary);
        if crossing.is_empty() {
            return Some(boundary);
        }
        let mut starts = Vec::new();
        for (k, ring) in rings.iter().enumerate() {
            starts.extend((0..ring.len()).map(|i| (k, i)));
        }
        for &node in crossing.iter().rev() {
            let (k, i) = starts[node];
            curves[k].split(&mut rings[k], i)?;
        }
    }
}

/// The chord that cuts off the largest area (`sign` 1) or adds the largest (-1), as ring and index of its first node.
fn widest_lens(curves: &[Curve], rings: &[Vec<f64>], sign: f64) -> Option<(usize, usize)> {
    let mut widest = (0.0, None);
    for (k, (curve, ring)) in curves.iter().zip(rings).enumerate() {
        for i in 0..ring.len() {
            let (from, to) = curve.arc(ring, i);
            let lens = sign * polygon::signed_area(&curve.arc_points(from, to));
            if lens > widest.0 {
                widest = (lens, Some((k, i)));
            }
        }
    }
    widest.1
}

fn join(curves: &[Curve], rings: &[Vec<f64>]) -> Boundary {
    let mut boundary = Boundary::default();
    for (curve, ring) in curves.iter().zip(rings) {
        let first = boundary.nodes.len();
        boundary.nodes.extend(curve.points(ring));
        let n = ring.len();
        boundary.segments.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
    }
    boundary
}

/// A polygon by arc length.
struct Curve<'a> {
    ring: &'a [Point],
    /// Arc length at each vertex; the length of the whole ring at the end.
    s: Vec<f64>,
    /// Running sum of the turning angles at the vertices: `turns[i]` is that of the vertices before `i`.
    turns: Vec<f64>,
}

impl<'a> Curve<'a> {
    fn new(ring: &'a [Point]) -> Self {
        let n = ring.len();
        let mut s = vec![0.0];
        for (i, (a, b)) in polygon::sides(ring).enumerate() {
            s.push(s[i] + polygon::length(a, b));
        }
        let mut turns = vec![0.0];
        for i in 0..n {
            let (a, b, c) = (ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
            turns.push(turns[i] + (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]));
        }
        Self { ring, s, turns }
    }

    fn length(&self) -> f64 {
        self.s[self.ring.len()]
    }

    /// The point at arc length `s`, which may run past the end by up to one round.
    fn at(&self, s: f64) -> Point {
        let n = self.ring.len();
        let s = s.rem_euclid(self.length());
        let i = self.s.partition_point(|&t| t <= s).clamp(1, n) - 1;
        let side = self.s[i + 1] - self.s[i];
        let t = if side > 0.0 { (s - self.s[i]) / side } else { 0.0 };
        // A node that is meant to be a vertex is exactly it.
        if t <= 0.0 { self.ring[i] } else { polygon::lerp(self.ring[i], self.ring[(i + 1) % n], t.min(1.0)) }
    }

    fn points(&self, ring: &[f64]) -> Vec<Point> {
        ring.iter().map(|&s| self.at(s)).collect()
    }

    /// Sum of the turning angles from `from` (included) to `to` (not included), any window up to one round.
    fn turning(&self, from: f64, to: f64) -> f64 {
        let upto = |s: f64| {
            let round = (s / self.length()).floor();
            let within = s - round * self.length();
            let n = self.ring.len();
            round * self.turns[n] + self.turns[self.s[..n].partition_point(|&t| t < within)]
        };
        upto(to) - upto(from)
    }

    /// Arc lengths of the corners at spacing `h`, ascending: the sharpest first claim their place.
    fn corners(&self, h: f64) -> Vec<f64> {
        let window = (WINDOW * h).min(self.length() / 8.0);
        let mut candidates: Vec<(f64, f64)> = (0..self.ring.len())
            .map(|i| {
                let s = self.s[i];
                let before = self.turning(s - window, s);
                let after = self.turning(s, s + window);
                let own = self.turns[i + 1] - self.turns[i];
                let turn = (before + after).abs();
                // In a rounded corner the turning before and after the middle are equal.
                let uneven = (before - (after - own)).abs().min(turn);
                (turn, s, uneven)
            })
            .filter(|c| c.0 > CORNER_TURN)
            .map(|(turn, s, uneven)| (turn - 0.25 * uneven, s))
            .collect();
        candidates.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
        let gap = |a: f64, b: f64| (a - b).abs().min(self.length() - (a - b).abs());
        let mut corners: Vec<f64> = Vec::new();
        for (_, s) in candidates {
            if corners.iter().all(|&c| gap(c, s) > CORNER_GAP * h) {
                corners.push(s);
            }
        }
        corners.sort_by(f64::total_cmp);
        corners
    }

    /// Ascending arc lengths of the nodes.
    fn sample(&self, h: f64, weight: f64, stray: f64, extra: usize) -> Vec<f64> {
        let corners = self.corners(h);
        let starts = if corners.is_empty() { vec![0.0] } else { corners };
        let window = (WINDOW * h).min(self.length() / 8.0);
        // A ring without corners still needs a few nodes to be round.
        let least = if starts.len() == 1 { 5 } else { 1 };
        let mut sections: Vec<(Vec<f64>, f64, usize)> = Vec::new();
        for (i, &from) in starts.iter().enumerate() {
            let to = if i + 1 < starts.len() { starts[i + 1] } else { starts[0] + self.length() };
            let steps = ((to - from) / (0.08 * h)).ceil().max(8.0) as usize;
            let step = (to - from) / steps as f64;
            let mut mass = vec![0.0];
            for k in 0..steps {
                let s = from + (k as f64 + 0.5) * step;
                // A corner is a node already: its turning must not crowd the nodes beside it.
                let (a, b) = ((s - window).max(from + 1e-9 * h), (s + window).min(to - 1e-9 * h));
                let bend = weight * h * self.turning(a, b) / (2.0 * window);
                mass.push(mass[k] + step / h * (1.0 + bend * bend).sqrt());
            }
            let total = mass[steps];
            let n = (total.round() as usize).max(least);
            sections.push((mass, total, n));
        }
        for _ in 0..extra {
            let wanting = |k: &usize| sections[*k].1 - sections[*k].2 as f64;
            if let Some(k) = (0..sections.len()).max_by(|a, b| wanting(a).total_cmp(&wanting(b)).then(b.cmp(a))) {
                sections[k].2 += 1;
            }
        }
        let mut nodes = Vec::new();
        for (i, (mass, total, n)) in sections.iter().enumerate() {
            let from = starts[i];
            let to = if i + 1 < starts.len() { starts[i + 1] } else { starts[0] + self.length() };
            let step = (to - from) / (mass.len() - 1) as f64;
            nodes.push(from);
            for j in 1..*n {
                let wanted = total * j as f64 / *n as f64;
                let k = mass.partition_point(|&m| m < wanted).clamp(1, mass.len() - 1);
                let t = (wanted - mass[k - 1]) / (mass[k] - mass[k - 1]);
                nodes.push(from + (k as f64 - 1.0 + t) * step);
            }
        }
        for s in &mut nodes {
            *s = s.rem_euclid(self.length());
        }
        nodes.sort_by(f64::total_cmp);
        nodes.dedup();
        self.keep_features(nodes, stray)
    }

    /// Adds the farthest vertex of every arc that strays from its chord by more than `stray`, again and again.
    fn keep_features(&self, mut ring: Vec<f64>, stray: f64) -> Vec<f64> {
        let mut i = 0;
        while i < ring.len() {
            let (from, to) = self.arc(&ring, i);
            let (a, b) = (self.at(from), self.at(to));
            let away = |s: f64| polygon::distance_to_segment(a, b, self.at(s));
            let inner = self.vertices_between(from, to);
            match inner.into_iter().max_by(|&p, &q| away(p).total_cmp(&away(q))) {
                Some(s) if away(s) > stray => insert(&mut ring, s.rem_euclid(self.length()), &mut i),
                _ => i += 1,
            }
        }
        ring
    }

    /// Start and end of the arc after node `i`; the end may lie past the end of the ring.
    fn arc(&self, ring: &[f64], i: usize) -> (f64, f64) {
        let to = if i + 1 < ring.len() { ring[i + 1] } else { ring[0] + self.length() };
        (ring[i], to)
    }

    /// Arc lengths of the ring's vertices strictly between two.
    fn vertices_between(&self, from: f64, to: f64) -> Vec<f64> {
        let n = self.ring.len();
        let once = self.s[..n].iter().copied();
        once.clone().chain(once.map(|s| s + self.length())).filter(|&s| s > from && s < to).collect()
    }

    /// The arc as points, both ends included.
    fn arc_points(&self, from: f64, to: f64) -> Vec<Point> {
        let inner = self.vertices_between(from, to);
        std::iter::once(from).chain(inner).chain(std::iter::once(to)).map(|s| self.at(s)).collect()
    }

    /// Halves the arc after node `i`; `None` where it is too short to.
    fn split(&self, ring: &mut Vec<f64>, i: usize) -> Option<()> {
        let (from, to) = self.arc(ring, i);
        if to - from < 1e-6 * self.length() {
            return None;
        }
        let mut i = i;
        insert(ring, (0.5 * (from + to)).rem_euclid(self.length()), &mut i);
        Some(())
    }
}

/// Inserts keeping the order; `i` goes on pointing to the same node.
fn insert(ring: &mut Vec<f64>, s: f64, i: &mut usize) {
    let place = ring.partition_point(|&t| t < s);
    ring.insert(place, s);
    if place <= *i {
        *i += 1;
    }
}
