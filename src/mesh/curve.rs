//! A closed polygon by arc length.

use crate::outline::{Point, polygon};

/// Half the window in which turning is measured, in spacings.
const WINDOW: f64 = 0.3;
/// Turning within the window that makes a corner, rad (45 degrees): a limb's tip of radius h stays round.
const CORNER_TURN: f64 = std::f64::consts::FRAC_PI_4;
/// Corners closer than this along the outline, in spacings, count as one.
const CORNER_GAP: f64 = 0.55;

pub(super) struct Curve<'a> {
    ring: &'a [Point],
    /// Arc length at each vertex; the length of the whole ring at the end.
    s: Vec<f64>,
    /// Running sum of the turning angles at the vertices: `turns[i]` is that of the vertices before `i`.
    turns: Vec<f64>,
}

impl<'a> Curve<'a> {
    pub fn new(ring: &'a [Point]) -> Self {
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

    pub fn length(&self) -> f64 {
        self.s[self.ring.len()]
    }

    /// Arc length of a vertex.
    pub fn vertex(&self, i: usize) -> f64 {
        self.s[i]
    }

    /// Half the window in which turning is measured at spacing `h`.
    pub fn window(&self, h: f64) -> f64 {
        (WINDOW * h).min(self.length() / 8.0)
    }

    /// The point at arc length `s`, which may run past the end by up to one round.
    pub fn at(&self, s: f64) -> Point {
        let n = self.ring.len();
        let s = s.rem_euclid(self.length());
        let i = self.s.partition_point(|&t| t <= s).clamp(1, n) - 1;
        let side = self.s[i + 1] - self.s[i];
        let t = if side > 0.0 { (s - self.s[i]) / side } else { 0.0 };
        // A node that is meant to be a vertex is exactly it.
        if t <= 0.0 { self.ring[i] } else { polygon::lerp(self.ring[i], self.ring[(i + 1) % n], t.min(1.0)) }
    }

    pub fn points(&self, ring: &[f64]) -> Vec<Point> {
        ring.iter().map(|&s| self.at(s)).collect()
    }

    /// Sum of the turning angles from `from` (included) to `to` (not included), any window up to one round.
    pub fn turning(&self, from: f64, to: f64) -> f64 {
        let upto = |s: f64| {
            let round = (s / self.length()).floor();
            let within = s - round * self.length();
            let n = self.ring.len();
            round * self.turns[n] + self.turns[self.s[..n].partition_point(|&t| t < within)]
        };
        upto(to) - upto(from)
    }

    /// Arc lengths of the corners at spacing `h`, ascending: those that must be (`forced` vertices) first, then the
    /// sharpest claim their place.
    pub fn corners(&self, h: f64, forced: &[usize]) -> Vec<f64> {
        let window = self.window(h);
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
        let mut corners: Vec<f64> = forced.iter().map(|&i| self.s[i]).collect();
        corners.sort_by(f64::total_cmp);
        for (_, s) in candidates {
            // Around the ring the nearest is the one before or the one after.
            let place = corners.partition_point(|&c| c < s);
            let beside = [corners.get(place).or(corners.first()), corners[..place].last().or(corners.last())];
            if beside.into_iter().flatten().all(|&c| gap(c, s) > CORNER_GAP * h) {
                corners.insert(place, s);
            }
        }
        corners.dedup();
        corners
    }

    /// Start and end of the arc after node `i`; the end may lie past the end of the ring.
    pub fn arc(&self, ring: &[f64], i: usize) -> (f64, f64) {
        let to = if i + 1 < ring.len() { ring[i + 1] } else { ring[0] + self.length() };
        (ring[i], to)
    }

    /// Arc lengths of the ring's vertices strictly between two, of which the second may lie past the end.
    pub fn between(&self, from: f64, to: f64) -> impl Iterator<Item = f64> + '_ {
        let n = self.ring.len();
        let range = |from: f64, to: f64| {
            let first = self.s[..n].partition_point(|&s| s <= from);
            first..self.s[..n].partition_point(|&s| s < to).max(first)
        };
        let length = self.length();
        let (once, again) = (range(from, to), range(from - length, to - length));
        once.map(|i| self.s[i]).chain(again.map(move |i| self.s[i] + length))
    }

    /// The arc as points, both ends included.
    pub fn arc_points(&self, from: f64, to: f64) -> Vec<Point> {
        let ends = |s: f64| std::iter::once(s);
        ends(from).chain(self.between(from, to)).chain(ends(to)).map(|s| self.at(s)).collect()
    }

    /// The vertex of an arc that is farthest from its chord, and how far.
    pub fn stray(&self, from: f64, to: f64) -> Option<(f64, f64)> {
        let (a, b) = (self.at(from), self.at(to));
        let away = |s: f64| polygon::distance_to_segment(a, b, self.at(s));
        self.between(from, to).map(|s| (s, away(s))).max_by(|p, q| p.1.total_cmp(&q.1))
    }
}
