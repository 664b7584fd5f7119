//! Figures of a mesh's quality.

use super::Mesh;
use super::triangulate::doubled_area;
use crate::outline::{Point, polygon};

/// Figures of a rest mesh; lengths in mm, angles in degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    pub edges: usize,
    /// Smallest angle of any triangle.
    pub min_angle_deg: f64,
    /// Triangles with an angle below 20 degrees.
    pub below_20_deg: usize,
    pub min_edge: f64,
    pub mean_edge: f64,
    pub max_edge: f64,
    pub min_area: f64,
    pub max_area: f64,
    /// Inner edges between two boundary nodes that part more than one triangle from the rest: there the body is one
    /// triangle across.
    pub bridges: usize,
}

impl Quality {
    /// Measures the rest shape of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let edges = mesh.edges();
        let lengths: Vec<f64> = edges.iter().map(|&[a, b]| polygon::length(mesh.nodes[a], mesh.nodes[b])).collect();
        let corners = |t: &[usize; 3]| t.map(|n| mesh.nodes[n]);
        let angles: Vec<f64> = mesh.triangles.iter().map(|t| min_angle(corners(t))).collect();
        let areas: Vec<f64> = mesh.triangles.iter().map(|t| area(corners(t))).collect();
        Self {
            edges: edges.len(),
            min_angle_deg: least(&angles),
            below_20_deg: angles.iter().filter(|&&a| a < 20.0).count(),
            min_edge: least(&lengths),
            mean_edge: lengths.iter().sum::<f64>() / lengths.len().max(1) as f64,
            max_edge: most(&lengths),
            min_area: least(&areas),
            max_area: most(&areas),
            bridges: bridges(mesh, &edges),
        }
    }
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// Signed area of a triangle.
pub fn area([a, b, c]: [Point; 3]) -> f64 {
    0.5 * doubled_area(a, b, c)
}

/// Smallest angle of a triangle, degrees; 0 or less for one that is flat or turned over.
pub fn min_angle(t: [Point; 3]) -> f64 {
    let doubled = doubled_area(t[0], t[1], t[2]);
    let angle = |i: usize| {
        let (a, b, c) = (t[i], t[(i + 1) % 3], t[(i + 2) % 3]);
        let dot = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
        doubled.atan2(dot)
    };
    if doubled <= 0.0 {
        return doubled.min(0.0);
    }
    (0..3).map(angle).fold(f64::INFINITY, f64::min).to_degrees()
}

fn bridges(mesh: &Mesh, edges: &[[usize; 2]]) -> usize {
    let mut sides: Vec<([usize; 2], usize)> = Vec::with_capacity(3 * mesh.triangles.len());
    for (t, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        sides.extend([[a, b], [b, c], [c, a]].map(|[i, j]| ([i.min(j), i.max(j)], t)));
    }
    sides.sort_unstable();
    let uses = |edge: &[usize; 2]| {
        let from = sides.partition_point(|s| s.0 < *edge);
        sides[from..].iter().take_while(|s| s.0 == *edge).map(|s| s.1).collect::<Vec<_>>()
    };
    let used: Vec<Vec<usize>> = edges.iter().map(uses).collect();
    let mut rim = vec![false; mesh.nodes.len()];
    let mut rims = vec![0; mesh.triangles.len()];
    for (edge, triangles) in edges.iter().zip(&used) {
        if let [only] = triangles[..] {
            rims[only] += 1;
            rim[edge[0]] = true;
            rim[edge[1]] = true;
        }
    }
    let ear = |t: usize| rims[t] >= 2;
    edges.iter().zip(&used).filter(|(e, t)| rim[e[0]] && rim[e[1]] && t.len() == 2 && !ear(t[0]) && !ear(t[1])).count()
}
