//! Figures of a mesh's quality, and of how well it fits its outline.

use super::Mesh;
use super::grid::Grid;
use super::triangulate::doubled_area;
use crate::outline::{Outline, Point, polygon};
use serde::Serialize;

/// Width of the bars of the angle histogram, degrees; the last bar ends at 60, the most that a smallest angle can be.
pub const HISTOGRAM_STEP_DEG: f64 = 5.0;
pub const HISTOGRAM_BARS: usize = 12;

/// Figures of a rest mesh; lengths in mm, angles in degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct MeshQuality {
    pub nodes: usize,
    pub triangles: usize,
    pub edges: usize,
    /// Smallest angle of any triangle.
    pub min_angle_deg: f64,
    /// Mean over the triangles of the smallest angle.
    pub mean_min_angle_deg: f64,
    /// Triangles with an angle below 20 degrees.
    pub below_20_deg: usize,
    /// Those of them whose smallest angle is a corner of the boundary.
    pub corners_below_20_deg: usize,
    /// Triangles with an angle below 5 degrees that is not a corner of the boundary.
    pub below_5_deg: usize,
    /// Triangles by their smallest angle, in steps of [`HISTOGRAM_STEP_DEG`].
    pub histogram: [usize; HISTOGRAM_BARS],
    pub min_edge: f64,
    pub mean_edge: f64,
    pub max_edge: f64,
    pub min_area: f64,
    pub max_area: f64,
    /// Inner edges between two boundary nodes that part more than one triangle from the rest: there the body is one
    /// triangle across.
    pub bridges: usize,
}

impl MeshQuality {
    /// Measures the rest shape of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let edges = mesh.edges();
        let lengths: Vec<f64> = edges.iter().map(|&[a, b]| polygon::length(mesh.nodes[a], mesh.nodes[b])).collect();
        let corners = |t: &[usize; 3]| t.map(|n| mesh.nodes[n]);
        let angles: Vec<f64> = mesh.triangles.iter().map(|t| min_angle(corners(t))).collect();
        let areas: Vec<f64> = mesh.triangles.iter().map(|t| area(corners(t))).collect();
        let mut histogram = [0; HISTOGRAM_BARS];
        for angle in &angles {
            histogram[((angle / HISTOGRAM_STEP_DEG) as usize).min(HISTOGRAM_BARS - 1)] += 1;
        }
        let sharp: Vec<usize> = (0..angles.len()).filter(|&t| angles[t] < 20.0).collect();
        let sides = if sharp.is_empty() { Vec::new() } else { directed(mesh) };
        let inner: Vec<usize> = sharp.iter().copied().filter(|&t| !is_given(mesh, &sides, t)).collect();
        Self {
            nodes: mesh.nodes.len(),
            triangles: mesh.triangles.len(),
            edges: edges.len(),
            mean_min_angle_deg: angles.iter().sum::<f64>() / angles.len().max(1) as f64,
            below_5_deg: inner.iter().filter(|&&t| angles[t] < 5.0).count(),
            corners_below_20_deg: sharp.len() - inner.len(),
            histogram,
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
    min_tangent(t).atan().to_degrees()
}

/// Tangent of the smallest angle, which is opposite of the shortest side and at most 60 degrees; 0 or less for a triangle
/// that is flat or turned over.
pub(super) fn min_tangent(t: [Point; 3]) -> f64 {
    let length2 = |a: Point, b: Point| (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2);
    let sides = [length2(t[1], t[2]), length2(t[2], t[0]), length2(t[0], t[1])];
    let shortest = sides[0].min(sides[1]).min(sides[2]);
    // Twice the product of two sides and the cosine between them.
    let dot = 0.5 * (sides[0] + sides[1] + sides[2]) - shortest;
    let doubled = doubled_area(t[0], t[1], t[2]);
    if doubled > 0.0 { doubled / dot } else { doubled.min(0.0) }
}

/// How far a mesh is from the outline that it was made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Fit {
    /// Area of the mesh over that of the outline, less 1.
    pub area_error: f64,
    /// Farthest distance between the boundary of the mesh and the outline, from either side, mm.
    pub boundary_mm: f64,
    /// That distance as a fraction of the outline's height.
    pub boundary_fraction: f64,
}

impl Fit {
    /// Measures from every vertex of the outline to the boundary of the mesh, and from points all along that to the
    /// outline.
    pub fn of(mesh: &Mesh, outline: &Outline) -> Self {
        let rim: Vec<(Point, Point)> = mesh
            .boundary()
            .iter()
            .flat_map(|ring| {
                ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| (mesh.nodes[a], mesh.nodes[b]))
            })
            .collect();
        let drawn = Grid::new(outline.polygons().flat_map(polygon::sides).collect());
        const ALONG: usize = 4;
        let places =
            rim.iter().flat_map(|&(a, b)| (0..ALONG).map(move |k| polygon::lerp(a, b, k as f64 / ALONG as f64)));
        let outward = places.map(|p| drawn.distance(p)).fold(0.0, f64::max);
        let meshed = Grid::new(rim.clone());
        let inward = outline.polygons().flatten().map(|&p| meshed.distance(p)).fold(0.0, f64::max);
        let (low, high) = outline.bounding_box();
        let boundary_mm = outward.max(inward);
        Self {
            area_error: mesh.area() / outline.area() - 1.0,
            boundary_mm,
            boundary_fraction: boundary_mm / (high[1] - low[1]),
        }
    }
}

fn directed(mesh: &Mesh) -> Vec<[usize; 2]> {
    let mut sides: Vec<[usize; 2]> = mesh.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    sides.sort_unstable();
    sides
}

/// Whether the smallest angle of a triangle lies between two edges of the boundary.
fn is_given(mesh: &Mesh, sides: &[[usize; 2]], t: usize) -> bool {
    let c = mesh.triangles[t];
    let length = |k: usize| polygon::length(mesh.nodes[c[k]], mesh.nodes[c[(k + 1) % 3]]);
    let shortest = (0..3).min_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or(0);
    let rim = |k: usize| sides.binary_search(&[c[(k + 1) % 3], c[k % 3]]).is_err();
    rim(shortest + 1) && rim(shortest + 2)
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
