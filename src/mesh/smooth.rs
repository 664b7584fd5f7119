//! Moves nodes so that triangles come close to equilateral: those inside freely, those of the boundary along it.

use super::curve::Curve;
use super::quality::min_tangent;
use super::refine::Place;
use super::tri::{NONE, Tri};
use super::triangulate::doubled_area;
use crate::outline::Point;

/// Rounds of optimal-Delaunay smoothing: the angles gain little after a dozen.
const ROUNDS: usize = 12;
/// Rounds of angle climbing, each followed by flips.
const CLIMBS: usize = 6;
/// Triangles with a smaller least angle than this have their interior nodes climbed, degrees.
const CLIMB_BELOW_DEG: f64 = 36.0;

/// Turning at a node of the boundary that makes it a corner, which stays, rad (20 degrees).
const CORNER_TURN: f64 = 0.35;

/// The boundary that nodes may slide along.
pub(super) struct Sliding<'a> {
    pub places: Vec<Place>,
    pub curves: &'a [Curve<'a>],
    /// Farthest that a chord may stray from its arc, mm.
    pub stray: f64,
    /// Whether nodes at y = 0 are on the axis of a half, and stay there.
    pub mirror: bool,
}

/// Smooths the triangulation.
///
/// Rounds of the optimal Delaunay triangulation (Chen and Holst, *Efficient mesh optimization schemes based on optimal
/// Delaunay triangulations*, 2011): each inner node goes to the mean of the circumcentres of its triangles, weighted by
/// area. Then nodes at poor triangles climb to where the least angle around them is largest.
pub(super) fn smooth(tri: &mut Tri, rim: &mut Sliding) {
    let free: Vec<usize> = (0..rim.places.len()).filter(|&n| rim.places[n] == Place::Inside).collect();
    let mut star = Vec::new();
    for _ in 0..ROUNDS {
        for &node in &free {
            tri.star(node, &mut star);
            let Some(goal) = circumcentre_mean(&tri.points, &tri.corners, &star) else { continue };
            step(&mut tri.points, &tri.corners, &star, node, goal);
        }
        tri.legalise_all();
    }
    for _ in 0..CLIMBS {
        let climbed = climb(tri, &free);
        if !slide(tri, rim) && !climbed {
            break;
        }
        tri.legalise_all();
    }
}

/// One pass of sliding nodes of the boundary that are at poor triangles; whether any moved.
fn slide(tri: &mut Tri, rim: &mut Sliding) -> bool {
    let mut star = Vec::new();
    let mut moved = false;
    for node in 0..rim.places.len() {
        let Place::Rim(ring, own) = rim.places[node] else { continue };
        tri.star(node, &mut star);
        let mut best = worst(tri, &star);
        if best >= CLIMB_BELOW_DEG.to_radians().tan() {
            continue;
        }
        let curve = &rim.curves[ring];
        let tiny = 1e-6 * curve.length();
        if curve.turning(own - tiny, own + tiny).abs() > CORNER_TURN || curve.length() <= 0.0 {
            continue;
        }
        let Some((before, after)) = neighbours(tri, &star, node) else { continue };
        let (Place::Rim(r1, from), Place::Rim(r2, to)) = (rim.places[before], rim.places[after]) else { continue };
        let on_axis = |n: usize| rim.mirror && tri.points[n][1] == 0.0;
        if r1 != ring || r2 != ring || (on_axis(node) && !(on_axis(before) && on_axis(after))) {
            continue;
        }
        // Unrolled about the node, so that from < own < to.
        let from = if from < own { from } else { from - curve.length() };
        let to = if to > own { to } else { to + curve.length() };
        let mut own = own;
        let mut reach = 0.2 * (own - from).min(to - own);
        let fits = |a: f64, b: f64| curve.stray(a, b).is_none_or(|(_, away)| away <= rim.stray);
        for _ in 0..5 {
            let mut improved = false;
            for s in [own - reach, own + reach] {
                if s - from < reach || to - s < reach {
                    continue;
                }
                let here = tri.points[node];
                tri.points[node] = curve.at(s);
                let value = worst(tri, &star);
                if value > best + 1e-3 && fits(from, s) && fits(s, to) {
                    (best, own, improved) = (value, s, true);
                } else {
                    tri.points[node] = here;
                }
            }
            moved |= improved;
            if !improved {
                reach *= 0.5;
            }
        }
        rim.places[node] = Place::Rim(ring, own.rem_euclid(curve.length()));
    }
    moved
}

/// The nodes before and after one of the boundary.
fn neighbours(tri: &Tri, star: &[usize], node: usize) -> Option<(usize, usize)> {
    let corner = |t: usize| (0..3).find(|&k| tri.corners[t][k] == node);
    let (first, last) = (*star.first()?, *star.last()?);
    let (k, j) = (corner(first)?, corner(last)?);
    let rim = tri.across[first][k] == NONE && tri.across[last][(j + 2) % 3] == NONE;
    rim.then(|| (tri.corners[last][(j + 2) % 3], tri.corners[first][(k + 1) % 3]))
}

/// Tangent of the least angle of some triangles.
fn worst(tri: &Tri, star: &[usize]) -> f64 {
    star.iter().map(|&t| min_tangent(tri.places(t))).fold(f64::INFINITY, f64::min)
}

fn circumcentre_mean(nodes: &[Point], triangles: &[[usize; 3]], star: &[usize]) -> Option<Point> {
    let mut sum = [0.0; 2];
    let mut weight = 0.0;
    for &t in star {
        let [a, b, c] = triangles[t].map(|n| nodes[n]);
        let d = doubled_area(a, b, c);
        // Circumcentre relative to `a`, times twice its denominator: d stands in both, so that it cancels.
        let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
        sum[0] += a[0] * d + 0.5 * (v[1] * uu - u[1] * vv);
        sum[1] += a[1] * d + 0.5 * (u[0] * vv - v[0] * uu);
        weight += d;
    }
    let goal = [sum[0] / weight, sum[1] / weight];
    (weight > 0.0 && goal[0].is_finite() && goal[1].is_finite()).then_some(goal)
}

/// Moves a node to its goal, or half, or a quarter of the way: as far as its triangles stay well oriented.
fn step(nodes: &mut [Point], triangles: &[[usize; 3]], star: &[usize], node: usize, goal: Point) {
    let start = nodes[node];
    let smallest = |nodes: &[Point]| {
        star.iter()
            .map(|&t| {
                let [a, b, c] = triangles[t].map(|n| nodes[n]);
                doubled_area(a, b, c)
            })
            .fold(f64::INFINITY, f64::min)
    };
    let floor = 0.25 * smallest(nodes);
    for share in [1.0, 0.5, 0.25] {
        nodes[node] = [start[0] + share * (goal[0] - start[0]), start[1] + share * (goal[1] - start[1])];
        if smallest(nodes) > floor {
            return;
        }
    }
    nodes[node] = start;
}

/// One pass of climbing over the nodes at poor triangles; whether any moved.
fn climb(tri: &mut Tri, free: &[usize]) -> bool {
    let mut star = Vec::new();
    let mut poor: Vec<(f64, usize)> = Vec::new();
    for &node in free {
        tri.star(node, &mut star);
        let angle = worst(tri, &star);
        if angle < CLIMB_BELOW_DEG.to_radians().tan() {
            poor.push((angle, node));
        }
    }
    poor.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut moved = false;
    for (_, node) in poor {
        tri.star(node, &mut star);
        let Some(&first) = star.first() else { continue };
        let [a, b, c] = tri.places(first);
        let mut reach = 0.2 * doubled_area(a, b, c).abs().sqrt();
        let mut best = worst(tri, &star);
        for _ in 0..6 {
            let centre = tri.points[node];
            let mut improved = false;
            for direction in
                [[1.0, 0.0], [0.7, 0.7], [0.0, 1.0], [-0.7, 0.7], [-1.0, 0.0], [-0.7, -0.7], [0.0, -1.0], [0.7, -0.7]]
            {
                let here = tri.points[node];
                tri.points[node] = [centre[0] + reach * direction[0], centre[1] + reach * direction[1]];
                let value = worst(tri, &star);
                if value > best + 1e-3 {
                    best = value;
                    improved = true;
                } else {
                    tri.points[node] = here;
                }
            }
            moved |= improved;
            if !improved {
                reach *= 0.5;
            }
        }
    }
    moved
}
