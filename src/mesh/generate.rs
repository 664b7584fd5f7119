//! Outline to triangle mesh with a given number of edges.
//!
//! A triangulation with `B` boundary nodes, `I` interior nodes and `H` holes has `E = 2 B + 3 I - 3 + 3 H` edges (Euler:
//! `V - E + T = 1 - H`, and `3 T = 2 E - B`). So once the boundary is sampled, the number of interior nodes for the
//! asked edge count follows, and no search for a mesh size is needed; a node or two more on the boundary make the
//! division by three come out. What is searched is the spacing along the boundary, among a few about the one at which
//! boundary and interior would be equally dense, for the mesh with the best triangles.

use super::quality::Quality;
use super::{Mesh, MeshError, fill, sample, smooth};
use crate::outline::Outline;

/// Most muscle fibres that are meshed: far beyond what a pose could be solved with.
pub const MAX_FIBERS: usize = 200_000;
/// Boundary spacings tried, relative to the evenly dense one, for small meshes and for large ones, where the boundary is
/// few of the nodes and the even spacing is good.
const SPACINGS: [f64; 12] = [1.0, 0.94, 1.06, 0.88, 1.12, 0.97, 1.03, 1.18, 1.24, 1.3, 1.09, 1.15];
const SPACINGS_LARGE: [f64; 1] = [1.0];
/// Longest wanted edges inside, in boundary spacings, tried in turn while the body is one triangle across somewhere: a
/// coarser trunk leaves more nodes for the limbs.
const COARSEST: [f64; 3] = [1.25, 1.5, 1.8];
/// Fibres from which a mesh is large.
const LARGE: usize = 3000;
/// Steps of 2 % taken upward to find a possible count: a factor of 3.3.
const NEAREST_STEPS: usize = 60;
/// Number of spacings tried where the boundary alone has too many edges at those, and the factor from one to the next.
const COARSER: i32 = 40;
const COARSENING: f64 = 1.12;

/// A mesh of the outline with `fibers` edges, exactly so where nothing stands in the way.
///
/// Boundary nodes lie on the outline, its corners are nodes, the area is kept within 1 %, and triangles are as near to
/// equilateral as the outline permits. The same outline gives the same bits. About n log n in the number of fibres.
///
/// # Errors
/// [`MeshError::Unreachable`] names the nearest possible count where the outline needs more edges than asked for.
pub fn generate(outline: &Outline, fibers: usize) -> Result<Mesh, MeshError> {
    check(outline)?;
    if fibers > MAX_FIBERS {
        return Err(MeshError::Unreachable { asked: fibers, nearest: MAX_FIBERS });
    }
    if let Some(mesh) = with_count(outline, fibers) {
        return Ok(mesh);
    }
    Err(MeshError::Unreachable { asked: fibers, nearest: nearest(outline, fibers) })
}

/// The best mesh found that has exactly `fibers` edges.
fn with_count(outline: &Outline, fibers: usize) -> Option<Mesh> {
    let even = even_spacing(outline, fibers);
    let spacings: &[f64] = if fibers < LARGE { &SPACINGS } else { &SPACINGS_LARGE };
    let mut found: Vec<Candidate> = Vec::new();
    for coarsest in COARSEST {
        found.extend(spacings.iter().filter_map(|factor| attempt(outline, fibers, factor * even, coarsest)));
        if found.is_empty() || found.iter().any(|c| c.quality.bridges + c.quality.below_20_deg == 0) {
            break;
        }
    }
    if let Some(mesh) = best(found) {
        return Some(mesh);
    }
    // The boundary's own features ask for many nodes: sample it more and more coarsely.
    let coarser: Vec<f64> = (1..=COARSER).map(|k| even * COARSENING.powi(k)).collect();
    let found = coarser.iter().filter_map(|&h| attempt(outline, fibers, h, COARSEST[0])).take(SPACINGS.len());
    best(found)
}

fn check(outline: &Outline) -> Result<(), MeshError> {
    let finite = outline.polygons().flatten().flatten().all(|v| v.is_finite());
    let sound = outline.polygons().all(|ring| ring.len() >= 3);
    if finite && sound && outline.area() > 0.0 { Ok(()) } else { Err(MeshError::BadOutline) }
}

/// The edge length at which equilateral triangles fill the area and the boundary with `fibers` edges in all:
/// `2 E = 3 T + B` with `T = A / (sqrt(3)/4 h^2)` and `B = P / h`, solved for `h`.
fn even_spacing(outline: &Outline, fibers: usize) -> f64 {
    let a = 4.0 * 3.0_f64.sqrt() * outline.area();
    let p = outline.perimeter();
    let e2 = 2.0 * fibers.max(1) as f64;
    (p + (p * p + 4.0 * a * e2).sqrt()) / (2.0 * e2)
}

struct Candidate {
    mesh: Mesh,
    quality: Quality,
}

/// The candidate with the fewest poor triangles, and among those the one with the least of what else is unwanted: an
/// inner edge across a limb weighs as much as ten degrees of the least angle, or edges that differ by a factor of two
/// more.
fn best(candidates: impl IntoIterator<Item = Candidate>) -> Option<Mesh> {
    let unwanted = |q: &Quality| q.bridges as f64 - 0.1 * q.min_angle_deg + 0.5 * q.max_edge / q.min_edge;
    let order =
        |a: &Quality, b: &Quality| a.below_20_deg.cmp(&b.below_20_deg).then(unwanted(a).total_cmp(&unwanted(b)));
    candidates.into_iter().min_by(|a, b| order(&a.quality, &b.quality)).map(|c| c.mesh)
}

/// A mesh at boundary spacing `h`, if there is one with the asked count.
fn attempt(outline: &Outline, fibers: usize, h: f64, coarsest: f64) -> Option<Candidate> {
    let holes = 3 * outline.holes.len();
    for extra in 0..6 {
        let boundary = sample::sample(outline, h, extra)?;
        let fixed = boundary.nodes.len();
        let interior3 = (fibers + 3).checked_sub(2 * fixed + holes)?;
        if interior3 % 3 != 0 {
            continue;
        }
        let mut nodes = fill::fill(&boundary, interior3 / 3, h, coarsest)?;
        let triangles = smooth::smooth(&mut nodes, fixed, &boundary.segments)?;
        let mesh = Mesh { nodes, triangles };
        let quality = Quality::of(&mesh);
        let sound =
            quality.edges == fibers && (mesh.area() / outline.area() - 1.0).abs() < 0.01 && mesh.validate().is_ok();
        if sound {
            return Some(Candidate { mesh, quality });
        }
    }
    None
}

/// The least count above `asked` that was found to give a mesh, searched upward in steps of 2 % from the edges that the
/// coarsest boundary has alone; [`MAX_FIBERS`] if none was found.
fn nearest(outline: &Outline, asked: usize) -> usize {
    let h = even_spacing(outline, asked);
    let holes = 3 * outline.holes.len();
    let coarse = [1.0, 4.0, 16.0, 64.0].into_iter().filter_map(|factor| sample::sample(outline, factor * h, 0));
    let alone = coarse.map(|b| (2 * b.nodes.len() + holes).saturating_sub(3)).min().unwrap_or(asked);
    let mut count = alone.max(asked + 1);
    for _ in 0..NEAREST_STEPS {
        if with_count(outline, count).is_some() {
            return count;
        }
        count += (count / 50).max(1);
    }
    MAX_FIBERS
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::{Point, polygon};

    fn rectangle(w: f64, h: f64) -> Outline {
        Outline { outer: vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]], holes: Vec::new() }
    }

    fn circle(centre: Point, r: f64, n: usize) -> Vec<Point> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n).map(|i| [centre[0] + r * angle(i).cos(), centre[1] + r * angle(i).sin()]).collect()
    }

    /// A star-shaped polygon with smooth lobes; each seed another.
    fn lobes(seed: u64) -> Outline {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let waves: Vec<(f64, f64, f64)> = (2..7).map(|k| (f64::from(k), 0.13 * random(), 6.3 * random())).collect();
        let outer = circle([0.0; 2], 1.0, 240).into_iter().map(|p| {
            let angle = p[1].atan2(p[0]);
            let r = 100.0 * (1.0 + waves.iter().map(|(k, a, phase)| a * (k * angle + phase).sin()).sum::<f64>());
            [r * p[0], r * p[1]]
        });
        Outline { outer: outer.collect(), holes: Vec::new() }
    }

    fn assert_good(outline: &Outline, fibers: usize, what: &str) {
        let mesh = generate(outline, fibers).unwrap_or_else(|e| panic!("{what}: {e}"));
        let quality = Quality::of(&mesh);
        assert_eq!(mesh.validate(), Ok(()), "{what}");
        assert_eq!((mesh.edges().len(), quality.edges), (fibers, fibers), "{what}");
        assert!(quality.below_20_deg * 1000 <= mesh.triangles.len(), "{what}: {quality:?}");
        assert!((mesh.area() / outline.area() - 1.0).abs() < 0.01, "{what}: {} {}", mesh.area(), outline.area());
        let loops = mesh.boundary();
        assert_eq!(loops.len(), 1 + outline.holes.len(), "{what}");
        for (k, ring) in loops.iter().enumerate() {
            let points: Vec<Point> = ring.iter().map(|&n| mesh.nodes[n]).collect();
            assert_eq!(polygon::signed_area(&points) > 0.0, k == 0, "{what}");
            for p in points {
                assert!(outline.distance(p) < 1e-9, "{what}: {p:?} is off the outline");
            }
        }
    }

    #[test]
    fn counts_are_exact_and_triangles_good_on_random_lobes() {
        for seed in 1..=8 {
            for fibers in [276, 307, 571] {
                assert_good(&lobes(seed), fibers, &format!("lobes {seed}, {fibers}"));
            }
        }
    }

    #[test]
    fn every_count_is_reached() {
        for fibers in 150..180 {
            assert_good(&rectangle(300.0, 60.0), fibers, &format!("bar, {fibers}"));
        }
    }

    #[test]
    fn holes_and_large_meshes_are_good() {
        let mut plate = rectangle(200.0, 150.0);
        plate.holes.push(circle([60.0, 70.0], 25.0, 90).into_iter().rev().collect());
        plate.holes.push(vec![[120.0, 50.0], [120.0, 100.0], [160.0, 100.0], [160.0, 50.0]]);
        for fibers in [400, 1000, 5000] {
            assert_good(&plate, fibers, &format!("plate, {fibers}"));
        }
        assert_good(&lobes(3), 10_000, "lobes, 10000");
    }

    #[test]
    fn corners_are_nodes_and_bars_are_two_triangles_across() {
        let bar = rectangle(300.0, 30.0);
        let mesh = generate(&bar, 200).unwrap();
        for corner in &bar.outer {
            assert!(mesh.nodes.contains(corner));
        }
        assert_eq!(Quality::of(&mesh).bridges, 0);
    }

    #[test]
    fn the_same_outline_gives_the_same_bits() {
        let outline = lobes(5);
        assert_eq!(generate(&outline, 414), generate(&outline.clone(), 414));
    }

    #[test]
    fn scale_does_not_matter() {
        let scaled = |k: f64| Outline {
            outer: lobes(2).outer.iter().map(|p| [k * p[0], k * p[1]]).collect(),
            holes: Vec::new(),
        };
        for k in [1e-3, 1e3] {
            assert_good(&scaled(k), 414, &format!("scale {k}"));
        }
    }

    #[test]
    fn impossible_counts_name_the_nearest() {
        let comb: Vec<Point> = (0..40)
            .flat_map(|i| {
                let x = 10.0 * f64::from(i);
                [[x, 60.0], [x + 5.0, 60.0], [x + 5.0, 10.0], [x + 10.0, 10.0]]
            })
            .rev()
            .collect();
        let outline = Outline { outer: [vec![[0.0, 0.0], [400.0, 0.0]], comb].concat(), holes: Vec::new() };
        let Err(MeshError::Unreachable { asked: 20, nearest }) = generate(&outline, 20) else { panic!() };
        assert!(nearest > 150 && nearest < 500, "{nearest}");
        assert!(generate(&outline, nearest).is_ok());
        assert!(matches!(
            generate(&rectangle(1.0, 1.0), usize::MAX),
            Err(MeshError::Unreachable { nearest: MAX_FIBERS, .. })
        ));
        assert_eq!(generate(&Outline::default(), 100), Err(MeshError::BadOutline));
        let flat = Outline { outer: vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], holes: Vec::new() };
        assert_eq!(generate(&flat, 100), Err(MeshError::BadOutline));
    }
}
