//! Moves interior nodes so that triangles come close to equilateral.

use super::quality::min_tangent;
use super::tri::Tri;
use super::triangulate::doubled_area;
use crate::outline::Point;

/// Rounds of optimal-Delaunay smoothing: the angles gain little after a dozen.
const ROUNDS: usize = 12;
/// Rounds of angle climbing, each followed by flips.
const CLIMBS: usize = 6;
/// Triangles with a smaller least angle than this have their interior nodes climbed, degrees.
const CLIMB_BELOW_DEG: f64 = 36.0;

/// Smooths the nodes that are `free`.
///
/// Rounds of the optimal Delaunay triangulation (Chen and Holst, *Efficient mesh optimization schemes based on optimal
/// Delaunay triangulations*, 2011): each node goes to the mean of the circumcentres of its triangles, weighted by area.
/// Then nodes at poor triangles climb to where the least angle around them is largest.
pub(super) fn smooth(tri: &mut Tri, free: &[usize]) {
    let mut star = Vec::new();
    for _ in 0..ROUNDS {
        for &node in free {
            tri.star(node, &mut star);
            let Some(goal) = circumcentre_mean(&tri.points, &tri.corners, &star) else { continue };
            step(&mut tri.points, &tri.corners, &star, node, goal);
        }
        tri.legalise_all();
    }
    for _ in 0..CLIMBS {
        if !climb(tri, free) {
            break;
        }
        tri.legalise_all();
    }
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
    let worst = |tri: &Tri, star: &[usize]| star.iter().map(|&t| min_tangent(tri.places(t))).fold(f64::INFINITY, f64::min);
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
