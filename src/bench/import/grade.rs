//! A mesh against the outline it came from.

use crate::mesh::Mesh;
use crate::mesh::quality::{self, MeshQuality};
use crate::outline::{Outline, Point, polygon};

/// Samples along a side of the outline, at least, and along its box's height: how finely the boundary is compared.
const SAMPLES: f64 = 400.0;
/// Angles of triangles in corners of the outline sharper than this are the outline's own, degrees.
const SHARP_DEG: f64 = 20.0;

/// How good a mesh is.
#[derive(Clone, Debug)]
pub(super) struct Grade {
    pub fibers: usize,
    pub triangles: usize,
    /// Whether [`Mesh::validate`] passes.
    pub sound: bool,
    /// Triangles with an angle below 20 degrees, those in sharp corners of the outline included.
    pub below_20_deg: usize,
    /// Triangles with an angle below 5 degrees that are not in a sharp corner of the outline.
    pub below_5_deg: usize,
    pub least_angle_deg: f64,
    /// Area against the outline's, as a part of it.
    pub area_off: f64,
    /// Largest distance between the boundaries, either way, over the outline's height.
    pub boundary_off: f64,
}

impl Grade {
    pub fn of(mesh: &Mesh, outline: &Outline) -> Self {
        let quality = MeshQuality::of(mesh);
        let rim: Vec<Vec<Point>> =
            mesh.boundary().iter().map(|ring| ring.iter().map(|&n| mesh.nodes[n]).collect()).collect();
        let sharp = sharp_nodes(mesh);
        let slim = |t: &&[usize; 3]| {
            quality::min_angle(t.map(|n| mesh.nodes[n])) < 5.0 && !t.iter().any(|n| sharp.contains(n))
        };
        let (_, high) = outline.bounding_box();
        Self {
            fibers: quality.edges,
            triangles: mesh.triangles.len(),
            sound: mesh.validate().is_ok(),
            below_20_deg: quality.below_20_deg,
            below_5_deg: mesh.triangles.iter().filter(slim).count(),
            least_angle_deg: quality.min_angle_deg,
            area_off: (mesh.area() / outline.area() - 1.0).abs(),
            boundary_off: distance(outline, &rim, high[1] / SAMPLES) / high[1],
        }
    }
}

/// Boundary nodes at which the mesh's boundary has a sharp corner.
fn sharp_nodes(mesh: &Mesh) -> Vec<usize> {
    let mut sharp = Vec::new();
    for ring in mesh.boundary() {
        let n = ring.len();
        for i in 0..n {
            let [a, p, b] = [ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]].map(|node| mesh.nodes[node]);
            let (u, v) = ([a[0] - p[0], a[1] - p[1]], [b[0] - p[0], b[1] - p[1]]);
            // From the next side round to the one before, through the body.
            let angle = (v[0] * u[1] - v[1] * u[0]).atan2(v[0] * u[0] + v[1] * u[1]);
            if (0.0..SHARP_DEG.to_radians()).contains(&angle) {
                sharp.push(ring[i]);
            }
        }
    }
    sharp
}

/// The Hausdorff distance between the outline and the rim, sampled every `step`.
fn distance(outline: &Outline, rim: &[Vec<Point>], step: f64) -> f64 {
    let rim_outline =
        Outline { outer: rim.first().cloned().unwrap_or_default(), holes: rim.iter().skip(1).cloned().collect() };
    one_way(outline, &rim_outline, step).max(one_way(&rim_outline, outline, step))
}

/// The farthest that a point of `a` lies from `b`.
fn one_way(a: &Outline, b: &Outline, step: f64) -> f64 {
    let near = b.near();
    let mut farthest = 0.0_f64;
    for (p, q) in a.polygons().flat_map(polygon::sides) {
        let pieces = (polygon::length(p, q) / step).ceil().clamp(1.0, SAMPLES) as usize;
        for i in 0..pieces {
            farthest = farthest.max(near.distance(polygon::lerp(p, q, i as f64 / pieces as f64)));
        }
    }
    farthest
}
