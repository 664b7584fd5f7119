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
mod shape;
mod stiffness;
mod stretch;

pub use compensate::{Impossible, compensated};
pub use limbs::Limb;

use crate::design::Design;
use crate::outline::Point;
use crate::outline::polygon::length;
use shape::{Shape, over, refined, rings};

/// Most triangles that a body is solved with; one of more gets another mesh of so many fibres for that. They bound the time of an export.
const MOST_TRIANGLES: usize = 4000;
const COARSE_FIBERS: usize = 1500;

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
    /// The farthest that its rim is from the drawn one, mm.
    pub off_mm: f64,
    /// The farthest that a point of the rim is from where it was drawn, mm: along the rim, too.
    pub moved_mm: f64,
    /// Whether the search for it came to its end: else it is a rough one.
    pub is_settled: bool,
}

/// The stuffed body of a design as it was `drawn`: the same one, unless its pattern was [`compensated`]. It lies over the drawn one.
pub fn stuffed(design: &Design, drawn: &Design) -> Stuffed {
    // A finer mesh tells no more of a silhouette.
    let coarse = (design.mesh.triangles.len() > MOST_TRIANGLES)
        .then(|| crate::mesh::generate(&design.outline, COARSE_FIBERS).ok())
        .flatten();
    let fine = refined(coarse.as_ref().unwrap_or(&design.mesh));
    let shape = Shape::of(&fine, None);
    // Patterns are compensated on the body's own mesh, whose nodes keep their numbers in both designs and in finer meshes.
    let drawn_mesh = coarse.as_ref().unwrap_or(&drawn.mesh);
    let as_drawn = refined(drawn_mesh).nodes;
    let seen = over(&drawn_mesh.boundary(), &drawn_mesh.nodes, &shape.seen);
    let near = drawn.outline.near();
    let on_rim: Vec<usize> = fine.boundary().into_iter().flatten().collect();
    let farthest = |off: &dyn Fn(usize) -> f64| on_rim.iter().map(|&node| off(node)).fold(0.0, f64::max);
    Stuffed {
        off_mm: farthest(&|node| near.distance(seen[node])),
        moved_mm: farthest(&|node| length(seen[node], as_drawn[node])),
        is_settled: shape.is_settled,
        rings: rings(&fine, &seen),
        flat: rings(&fine, &fine.nodes),
        volume_mm3: shape.volume_mm3,
        thickness_mm: shape.thickness_mm,
        limbs: limbs::limbs(&fine, &design.outline, &seen),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::Outline;
    use std::f64::consts::PI;

    fn body(outer: Vec<Point>, fibers: usize) -> Design {
        let outline = Outline { outer, holes: vec![] };
        let mesh = crate::mesh::generate(&outline, fibers).unwrap();
        Design::new("body", outline, mesh)
    }

    fn alone(design: &Design) -> Stuffed {
        let found = stuffed(design, design);
        assert!(found.is_settled);
        found
    }

    /// The mylar balloon: radius 0.7627 R, thickness 0.9139 R, volume 1.2185 R^3.
    #[test]
    fn two_discs_become_a_mylar_balloon() {
        let r = 100.0;
        let ring = (0..90).map(|i| 2.0 * PI * f64::from(i) / 90.0).map(|a| [r * a.cos(), r * a.sin()]).collect();
        let found = alone(&body(ring, 414));
        let middle = found.rings[0].iter().map(|p| p[0].hypot(p[1])).sum::<f64>() / found.rings[0].len() as f64;
        assert!((middle / (0.7627 * r) - 1.0).abs() < 0.03, "{middle}");
        assert!((found.thickness_mm / (0.9139 * r) - 1.0).abs() < 0.03, "{}", found.thickness_mm);
        assert!((found.volume_mm3 / (1.2185 * r * r * r) - 1.0).abs() < 0.03, "{}", found.volume_mm3);
    }

    #[test]
    fn a_long_strip_becomes_a_tube() {
        let (l, w) = (400.0, 40.0);
        let found = alone(&body(vec![[0.0, 0.0], [l, 0.0], [l, w], [0.0, w]], 1200));
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

    #[test]
    fn a_limb_is_as_wide_as_the_shortest_way_across_it() {
        for angle in [0.0_f64, 0.6, 1.3] {
            let (sine, cosine) = angle.sin_cos();
            let corners = [
                [0.0, 0.0],
                [120.0, 0.0],
                [120.0, 40.0],
                [200.0, 40.0],
                [200.0, 70.0],
                [120.0, 70.0],
                [120.0, 120.0],
                [0.0, 120.0],
            ];
            let ring = corners.map(|[x, y]| [cosine * x - sine * y, sine * x + cosine * y]);
            let found = alone(&body(ring.to_vec(), 600));
            let [limb] = found.limbs.as_slice() else { panic!("{:?}", found.limbs) };
            assert!((limb.flat_mm - 30.0).abs() < 0.1, "{limb:?}");
            assert!(limb.stuffed_mm < 0.9 * limb.flat_mm, "{limb:?}");
        }
    }
}
