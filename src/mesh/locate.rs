//! Which point of the body is at a place.

use super::triangulate::doubled_area;
use super::{BodyPoint, Mesh};
use crate::outline::{Point, polygon};

/// How far outside a triangle, in barycentric weight, a point still counts as inside: bridges the rounding along shared
/// edges, so that no point of the body falls between two triangles.
const EDGE_WEIGHT: f64 = 1e-12;

impl Mesh {
    /// The body point at `p` when the nodes are at `positions`: the first triangle that contains it. `None` outside the
    /// body. Cost: one pass over the triangles.
    pub fn locate(&self, p: Point, positions: &[Point]) -> Option<BodyPoint> {
        (0..self.triangles.len()).find_map(|triangle| {
            let weights = self.weights(triangle, p, positions)?;
            let inside = weights.iter().all(|&w| w >= -EDGE_WEIGHT);
            inside.then(|| BodyPoint { triangle, weights: normalised(weights) })
        })
    }

    /// The body point nearest to `p` and its distance, mm: that of [`Mesh::locate`] and 0 inside the body, one on an edge
    /// otherwise. `None` for a mesh without triangles or where no position is finite.
    pub fn locate_nearest(&self, p: Point, positions: &[Point]) -> Option<(BodyPoint, f64)> {
        if let Some(inside) = self.locate(p, positions) {
            return Some((inside, 0.0));
        }
        let mut nearest: Option<(BodyPoint, f64)> = None;
        for (triangle, nodes) in self.triangles.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (positions[nodes[k]], positions[nodes[(k + 1) % 3]]);
                let t = polygon::nearest_parameter(a, b, p);
                let distance = polygon::length(p, polygon::lerp(a, b, t));
                if distance < nearest.map_or(f64::INFINITY, |(_, d)| d) {
                    let mut weights = [0.0; 3];
                    weights[k] = 1.0 - t;
                    weights[(k + 1) % 3] = t;
                    nearest = Some((BodyPoint { triangle, weights }, distance));
                }
            }
        }
        nearest
    }

    /// Barycentric weights of `p` in a triangle; `None` for one that is flat or turned over at these positions.
    fn weights(&self, triangle: usize, p: Point, positions: &[Point]) -> Option<[f64; 3]> {
        let [a, b, c] = self.triangles[triangle].map(|n| positions[n]);
        let whole = doubled_area(a, b, c);
        (whole > 0.0)
            .then(|| [doubled_area(p, b, c) / whole, doubled_area(a, p, c) / whole, doubled_area(a, b, p) / whole])
    }
}

/// Weights without the little below zero, with sum 1.
fn normalised(weights: [f64; 3]) -> [f64; 3] {
    let weights = weights.map(|w| w.max(0.0));
    let sum: f64 = weights.iter().sum();
    weights.map(|w| w / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Mesh {
        Mesh { nodes: vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]], triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }

    #[test]
    fn what_is_located_is_there() {
        let mesh = square();
        let moved: Vec<Point> = mesh.nodes.iter().map(|p| [p[0] + 0.5 * p[1] + 7.0, 2.0 * p[1] - 3.0]).collect();
        for i in 0..=20 {
            for j in 0..=20 {
                let (x, y) = (0.1 * f64::from(i), 0.1 * f64::from(j));
                let p = [x + 0.5 * y + 7.0, 2.0 * y - 3.0];
                let (at, distance) = mesh.locate_nearest(p, &moved).unwrap();
                let back = mesh.position(&at, &moved);
                assert!(distance < 1e-12 && polygon::length(p, back) < 1e-12, "{p:?} {back:?}");
                assert!((at.weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            }
        }
        assert_eq!(mesh.locate([1.5, 0.5], &mesh.nodes).map(|at| at.triangle), Some(0));
        assert_eq!(mesh.locate([0.5, 1.5], &mesh.nodes).map(|at| at.triangle), Some(1));
    }

    #[test]
    fn outside_the_nearest_point_of_the_body_is_taken() {
        let mesh = square();
        assert_eq!(mesh.locate([3.0, 1.0], &mesh.nodes), None);
        for (p, expected, away) in
            [([3.0, 1.0], [2.0, 1.0], 1.0), ([-3.0, -4.0], [0.0, 0.0], 5.0), ([1.0, 4.0], [1.0, 2.0], 2.0)]
        {
            let (at, distance) = mesh.locate_nearest(p, &mesh.nodes).unwrap();
            assert_eq!((mesh.position(&at, &mesh.nodes), distance), (expected, away));
        }
        assert_eq!(Mesh::default().locate_nearest([0.0, 0.0], &[]), None);
    }
}
