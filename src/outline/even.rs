//! Boundaries finer than scissors can follow, brought to what they can.
//!
//! Scans, traces and jittered exports have more points than the hand has steps, off their line by less than a hand sees. Before areas are
//! resolved (which takes time by how often lines cross), runs of points that stay near their first one become one point, their mean: with
//! `n` points in a run, independent errors shrink by the square root of `n`. One pass, in the order of the line.

use super::regions::Shapes;
use super::{Point, polygon};

/// How far points may lie from the first of their run, as a fraction of the drawing's size: 0.25 mm on 250 mm, about what scissors follow.
pub(super) const EVEN_FRACTION: f64 = 1e-3;
/// Lines of fewer points are never so fine that they cost time.
const LEAST_POINTS: usize = 1000;
/// A line is fine if its sides measure less than this part of the distance on the mean.
const FINE: f64 = 0.5;
/// It is noisy if evening makes it shorter than this part of itself; a smooth line stays as long as it is.
const SHORTER: f64 = 0.97;
/// A vertex that turns by more than this, rad, is one of a rough boundary if its sides are short.
const ROUGH_RAD: f64 = 0.3;
/// A boundary with so many of those, and so large a part of them, is rough.
const ROUGH_POINTS: usize = 150;
const ROUGH_PART: f64 = 0.15;

/// What was evened.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Evened {
    /// Points before.
    pub points: usize,
    /// How far points moved at most, about.
    pub within: f64,
}

impl Evened {
    pub fn add(&mut self, more: Self) {
        self.points += more.points;
        self.within = self.within.max(more.within);
    }
}

/// Evens the fine and noisy ones of closed lines, within about `reach`.
pub(super) fn evened(lines: &mut [Vec<Point>], reach: f64) -> Evened {
    let mut all = Evened::default();
    for line in lines.iter_mut().filter(|line| line.len() >= LEAST_POINTS) {
        let length = polygon::perimeter(line);
        if length.is_nan() || length / line.len() as f64 > FINE * reach {
            continue;
        }
        let means = run_means(line, reach);
        if means.len() >= 3 && polygon::perimeter(&means) < SHORTER * length {
            all.add(Evened { points: line.len(), within: 0.5 * reach });
            *line = means;
        }
    }
    all
}

/// The means of runs of points that stay within `reach` of the first of their run.
fn run_means(line: &[Point], reach: f64) -> Vec<Point> {
    let mut means = Vec::new();
    let mut run = 0..0;
    let mean = |run: std::ops::Range<usize>| {
        let n = run.len() as f64;
        [0, 1].map(|axis| line[run.clone()].iter().map(|p| p[axis]).sum::<f64>() / n)
    };
    for (k, p) in line.iter().enumerate() {
        if !run.is_empty() && polygon::length(line[run.start], *p) > reach {
            means.push(mean(run.clone()));
            run = k..k;
        }
        run.end = k + 1;
    }
    if !run.is_empty() {
        means.push(mean(run));
    }
    means
}

/// Whether the boundary turns to and fro in steps shorter than `step` for a good part of its points.
pub(super) fn is_rough(shapes: &Shapes, step: f64) -> bool {
    let (mut rough, mut points) = (0, 0);
    for ring in shapes.iter().flatten() {
        let n = ring.len();
        points += n;
        for i in 0..n {
            let (a, p, b) = (ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
            let (u, v) = ([p[0] - a[0], p[1] - a[1]], [b[0] - p[0], b[1] - p[1]]);
            let turn = (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]).abs();
            rough += usize::from(turn > ROUGH_RAD && u[0].hypot(u[1]) < step && v[0].hypot(v[1]) < step);
        }
    }
    rough >= ROUGH_POINTS && rough as f64 >= ROUGH_PART * points as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// A circle of radius 100 whose points are off by up to `off`, always the same way.
    fn circle(points: usize, off: f64) -> Vec<Point> {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            2.0 * (state >> 11) as f64 / (1_u64 << 53) as f64 - 1.0
        };
        let at = |i: usize| TAU * i as f64 / points as f64;
        (0..points).map(|i| [100.0 * at(i).cos() + off * random(), 100.0 * at(i).sin() + off * random()]).collect()
    }

    #[test]
    fn noise_shrinks_and_a_smooth_line_stays() {
        let mut lines = vec![circle(80_000, 0.02), circle(80_000, 0.0), circle(900, 0.02)];
        let before = lines.clone();
        let told = evened(&mut lines, 0.2);
        assert_eq!((told.points, told.within), (80_000, 0.1));
        assert_eq!(lines[1..], before[1..]);
        let off = lines[0].iter().map(|p| (p[0].hypot(p[1]) - 100.0).abs()).fold(0.0, f64::max);
        assert!(off < 0.01, "{off}");
        assert!((polygon::signed_area(&lines[0]) / (PI * 1e4) - 1.0).abs() < 1e-4);
        assert!(is_rough(&vec![vec![circle(5000, 0.05)]], 0.2) && !is_rough(&vec![vec![circle(5000, 0.0)]], 0.2));
    }
}
