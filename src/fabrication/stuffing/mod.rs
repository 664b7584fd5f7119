//! The body as it is when it is stuffed: narrower than the pattern, and round.
//!
//! Two sheets of felt, sewn at their rims and stuffed firmly, hold as much as they can without stretching. Felt does not stretch but wrinkles
//! freely, so that the shape is the one of largest volume whose sheets are nowhere longer than they were cut: a tension field (Pipkin 1986;
//! Skouras et al., *Designing Inflatable Structures*, 2014). Two discs of radius R become a body of radius 0.763 R and thickness 0.914 R; a long
//! strip of width w becomes a tube of diameter 2 w / pi. Both sheets are mirror images, so that one is solved, its rim in the plane z = 0.

mod compensate;
mod limbs;
mod membrane;
mod relax;

pub use compensate::{Impossible, compensated};
pub use limbs::Limb;

use crate::design::Design;
use crate::mesh::{Mesh, subdivided};
use crate::outline::{Outline, Point};
use membrane::Membrane;

/// Triangles that a body is solved with, at least: fewer leave thin limbs a row of triangles wide, which cannot round up.
const LEAST_TRIANGLES: usize = 500;
/// Most parts that each edge of a mesh is cut into for that.
const MOST_PARTS: usize = 4;

/// A stuffed body.
#[derive(Clone, Debug, PartialEq)]
pub struct Stuffed {
    /// Its rim seen from the front, where the body lies as the drawn one does, mm: outer ring first, then those of holes.
    pub rings: Vec<Vec<Point>>,
    /// The same rims as they are cut.
    pub flat: Vec<Vec<Point>>,
    pub volume_mm3: f64,
    pub thickness_mm: f64,
    pub limbs: Vec<Limb>,
}

/// The stuffed body of a design.
pub fn stuffed(design: &Design) -> Stuffed {
    let fine = refined(&design.mesh);
    let shape = Shape::of(&fine, None);
    let flat: Vec<Vec<Point>> = rings(&fine, &fine.nodes);
    Stuffed {
        rings: rings(&fine, &shape.seen),
        flat,
        volume_mm3: shape.volume_mm3,
        thickness_mm: shape.thickness_mm,
        limbs: limbs::limbs(&fine, &design.outline, &shape.seen),
    }
}

impl Stuffed {
    /// The rims as an outline.
    pub fn outline(&self) -> Outline {
        let mut rings = self.rings.clone();
        let outer = if rings.is_empty() { Vec::new() } else { rings.remove(0) };
        Outline { outer, holes: rings }
    }
}

/// A solved sheet.
struct Shape {
    /// Nodes in space, the rim at z = 0, mm.
    nodes: Vec<[f64; 3]>,
    /// Nodes seen from the front, moved and turned to lie over the flat ones.
    seen: Vec<Point>,
    volume_mm3: f64,
    thickness_mm: f64,
}

impl Shape {
    /// The stuffed sheet of a mesh, from an earlier one of the same mesh if there is one.
    fn of(mesh: &Mesh, before: Option<&[[f64; 3]]>) -> Self {
        let rim = mesh.boundary();
        let membrane = Membrane::new(mesh, &rim);
        let start = before.map_or_else(|| membrane.dome(mesh), <[_]>::to_vec);
        let nodes = relax::relaxed(&membrane, start);
        let thickness_mm = 2.0 * nodes.iter().map(|p| p[2]).fold(0.0, f64::max);
        let seen = smoothed(&rim, aligned(&rim, &mesh.nodes, &nodes));
        Self { volume_mm3: membrane.volume(&nodes), seen, thickness_mm, nodes }
    }
}

/// A mesh fine enough to be solved.
fn refined(mesh: &Mesh) -> Mesh {
    let needed = (LEAST_TRIANGLES as f64 / mesh.triangles.len().max(1) as f64).sqrt().ceil() as usize;
    subdivided(mesh, needed.clamp(1, MOST_PARTS))
}

fn rings(mesh: &Mesh, places: &[Point]) -> Vec<Vec<Point>> {
    mesh.boundary().into_iter().map(|ring| ring.into_iter().map(|node| places[node]).collect()).collect()
}

/// Places with those of the rim moved to the middle between themselves and their neighbours: a rim that is gathered puckers from node to node, and
/// what is seen is the line through the middle of that.
fn smoothed(rim: &[Vec<usize>], mut places: Vec<Point>) -> Vec<Point> {
    for ring in rim {
        let own: Vec<Point> = ring.iter().map(|&i| places[i]).collect();
        let n = own.len();
        for (k, &i) in ring.iter().enumerate() {
            let (before, after) = (own[(k + n - 1) % n], own[(k + 1) % n]);
            places[i] = [0, 1].map(|c| 0.25 * before[c] + 0.5 * own[k][c] + 0.25 * after[c]);
        }
    }
    places
}

/// Nodes seen from the front, moved and turned so that their rim lies nearest to the flat one (least squares).
fn aligned(rim: &[Vec<usize>], flat: &[Point], nodes: &[[f64; 3]]) -> Vec<Point> {
    let on_rim: Vec<usize> = rim.iter().flatten().copied().collect();
    let count = on_rim.len().max(1) as f64;
    let mean = |at: &dyn Fn(usize) -> Point| -> Point {
        [0, 1].map(|k| on_rim.iter().map(|&i| at(i)[k]).sum::<f64>() / count)
    };
    let (from, to) = (mean(&|i| [nodes[i][0], nodes[i][1]]), mean(&|i| flat[i]));
    let (mut along, mut across) = (0.0, 0.0);
    for &i in &on_rim {
        let (p, q) = ([nodes[i][0] - from[0], nodes[i][1] - from[1]], [flat[i][0] - to[0], flat[i][1] - to[1]]);
        along += p[0] * q[0] + p[1] * q[1];
        across += p[0] * q[1] - p[1] * q[0];
    }
    let whole = along.hypot(across).max(f64::MIN_POSITIVE);
    let (cosine, sine) = (along / whole, across / whole);
    let turned = |p: &[f64; 3]| {
        let [x, y] = [p[0] - from[0], p[1] - from[1]];
        [to[0] + cosine * x - sine * y, to[1] + sine * x + cosine * y]
    };
    nodes.iter().map(turned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn body(outer: Vec<Point>, fibers: usize) -> Design {
        let outline = Outline { outer, holes: vec![] };
        let mesh = crate::mesh::generate(&outline, fibers).unwrap();
        Design::new("body", outline, mesh)
    }

    /// The mylar balloon: radius 0.7627 R, thickness 0.9139 R, volume 1.2185 R^3.
    #[test]
    fn two_discs_become_a_mylar_balloon() {
        let r = 100.0;
        let ring = (0..90).map(|i| 2.0 * PI * f64::from(i) / 90.0).map(|a| [r * a.cos(), r * a.sin()]).collect();
        let found = stuffed(&body(ring, 414));
        let middle = found.rings[0].iter().map(|p| p[0].hypot(p[1])).sum::<f64>() / found.rings[0].len() as f64;
        assert!((middle / (0.7627 * r) - 1.0).abs() < 0.03, "{middle}");
        assert!((found.thickness_mm / (0.9139 * r) - 1.0).abs() < 0.03, "{}", found.thickness_mm);
        assert!((found.volume_mm3 / (1.2185 * r * r * r) - 1.0).abs() < 0.03, "{}", found.volume_mm3);
    }

    #[test]
    fn a_long_strip_becomes_a_tube() {
        let (l, w) = (400.0, 40.0);
        let found = stuffed(&body(vec![[0.0, 0.0], [l, 0.0], [l, w], [0.0, w]], 300));
        let diameter = 2.0 * w / PI;
        assert!((found.thickness_mm / diameter - 1.0).abs() < 0.03, "{} of {diameter}", found.thickness_mm);
        let rim = &found.rings[0];
        let middle = |p: &&Point| (p[0] - 0.5 * l).abs() < 0.2 * l;
        let side = |upper: bool| {
            let own: Vec<f64> = rim.iter().filter(middle).map(|p| p[1]).filter(|y| (*y > 0.5 * w) == upper).collect();
            own.iter().sum::<f64>() / own.len() as f64
        };
        assert!(((side(true) - side(false)) / diameter - 1.0).abs() < 0.03, "{}", side(true) - side(false));
    }
}
