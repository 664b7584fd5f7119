//! Outline to triangle mesh with a given number of edges.
//!
//! A triangulation with `B` boundary nodes, `I` interior nodes and `H` holes has `E = 2 B + 3 I - 3 + 3 H` edges (Euler:
//! `V - E + T = 1 - H`, and `3 T = 2 E - B`). So once the boundary is sampled, the number of interior nodes for the
//! asked edge count follows, and no search for a mesh size is needed; a node or two more on the boundary make the
//! division by three come out. What is searched is the spacing along the boundary, among a few about the one at which
//! boundary and interior would be equally dense, for the mesh with the best triangles.

use super::curve::Curve;
use super::quality::Quality;
use super::refine::{Place, Refiner};
use super::sample::{Closeness, sample};
use super::{Mesh, MeshError, smooth};
use crate::outline::Outline;

/// Most muscle fibres that are meshed: far beyond what a pose could be solved with.
pub const MAX_FIBERS: usize = 200_000;
/// Boundary spacings tried, relative to the evenly dense one, for small meshes and for large ones, where the boundary is
/// few of the nodes and the even spacing is good.
const SPACINGS: [f64; 7] = [1.0, 1.08, 0.94, 1.16, 1.24, 1.34, 1.5];
const SPACINGS_LARGE: [f64; 1] = [1.0];
/// Longest wanted edges inside, in boundary spacings, tried in turn while the body is one triangle across somewhere: a
/// coarser trunk leaves more nodes for the limbs.
const COARSEST: [f64; 3] = [1.25, 1.5, 1.8];
/// Fibres from which a mesh is large.
const LARGE: usize = 3000;
/// A mesh without bridges and with no angle below this is taken at once, degrees.
const FINE_DEG: f64 = 30.5;
/// Steps of 2 % taken upward to find a possible count: a factor of 3.3.
const NEAREST_STEPS: usize = 6;
/// Largest multiple of the asked count that is looked for instead.
const NEAREST_MOST: usize = 10;
/// Farthest that a chord may stray from the outline, as fractions of its height, tried in turn: with few fibres fine features
/// are rounded off rather than refused.
const STRAYS: [f64; 4] = [0.0047, 0.008, 0.016, 0.03];
/// Area that the mesh may lose or win at each of those, as a fraction.
const AREAS: [f64; 4] = [0.0095, 0.0095, 0.0095, 0.03];
/// How far the number of edges may be from the asked one where no mesh has it exactly.
const COUNT_FRACTION: f64 = 0.03;
/// Number of spacings tried where the boundary alone has too many edges at those, and the factor from one to the next.
const COARSER: i32 = 12;
const COARSENING: f64 = 1.25;

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
    let curves: Vec<Curve> = outline.polygons().map(Curve::new).collect();
    if let Some(mesh) = with_count(outline, &curves, fibers) {
        return Ok(mesh);
    }
    Err(MeshError::Unreachable { asked: fibers, nearest: nearest(outline, &curves, fibers) })
}

/// The best mesh found with `fibers` edges.
fn with_count(outline: &Outline, curves: &[Curve], fibers: usize) -> Option<Mesh> {
    let even = even_spacing(outline, fibers);
    let (low, high) = outline.bounding_box();
    let height = high[1] - low[1];
    let mut found = Vec::new();
    for (stray, area) in STRAYS.into_iter().zip(AREAS) {
        let close = Closeness { stray: stray * height, area };
        let body = Body { outline, curves, forced: &[], close, fibers };
        if body.search(even, &mut found) {
            break;
        }
    }
    best(found, fibers)
}

struct Body<'a> {
    outline: &'a Outline,
    curves: &'a [Curve<'a>],
    forced: &'a [usize],
    close: Closeness,
    fibers: usize,
}

impl Body<'_> {
    /// Tries boundary spacings about the even one, and coarser ones where the boundary's own features ask for many nodes;
    /// whether a mesh without poor triangles was among them.
    fn search(&self, even: f64, found: &mut Vec<Candidate>) -> bool {
        let spacings: &[f64] = if self.fibers < LARGE { &SPACINGS } else { &SPACINGS_LARGE };
        let good = |found: &[Candidate]| found.iter().any(|c| c.quality.below_20_deg == 0);
        for coarsest in COARSEST {
            let before = found.len();
            for factor in spacings {
                let candidate = self.attempt(factor * even, coarsest);
                if candidate.is_none() && found.is_empty() {
                    // Not even at the spacing meant for it: there is no need to look closely.
                    break;
                }
                found.extend(candidate);
                if found.last().is_some_and(|c| c.is_fine(self.fibers)) {
                    found.drain(..found.len() - 1);
                    return true;
                }
            }
            if found.len() == before || spacings.len() == 1 || !good(found) {
                break;
            }
        }
        for k in 1..=COARSER {
            if good(found) {
                return true;
            }
            found.extend(self.attempt(even * COARSENING.powi(k), COARSEST[0]));
        }
        good(found)
    }

    /// A mesh at boundary spacing `h`, if there is one with the asked count, or nearly.
    fn attempt(&self, h: f64, coarsest: f64) -> Option<Candidate> {
        let mut near: Option<Refiner> = None;
        let most = most_nodes(self.outline, self.fibers)?;
        for extra in 0..6 {
            let boundary = sample(self.outline, self.curves, self.forced, h, extra, self.close, most)?;
            let mut refiner = Refiner::new(&boundary, self.curves, h, coarsest)?;
            if refiner.run(self.fibers).is_none() {
                if near.is_none() {
                    return None;
                }
                continue;
            }
            if refiner.tri.edges() == self.fibers {
                return finish(refiner);
            }
            near = near.or(Some(refiner));
        }
        near.filter(|r| within(r.tri.edges(), self.fibers)).and_then(finish)
    }
}

/// Boundary nodes of a mesh with `edges` edges: those without an interior node. `None` where the rings cannot have so few.
fn most_nodes(outline: &Outline, edges: usize) -> Option<usize> {
    let rings = outline.holes.len() + 1;
    let most = (edges + 3).checked_sub(3 * outline.holes.len())? / 2;
    (most >= 3 * rings).then_some(most)
}

/// Whether a count is as good as the asked one.
fn within(count: usize, asked: usize) -> bool {
    count.abs_diff(asked) as f64 <= COUNT_FRACTION * asked as f64
}

/// Smooths, and checks what came out.
fn finish(refiner: Refiner) -> Option<Candidate> {
    let Refiner { mut tri, places, .. } = refiner;
    let free: Vec<usize> = (0..places.len()).filter(|&n| places[n] == Place::Inside).collect();
    smooth::smooth(&mut tri, &free);
    let mut triangles = tri.corners;
    for t in &mut triangles {
        let smallest = (0..3).min_by_key(|&k| t[k]).unwrap_or(0);
        t.rotate_left(smallest);
    }
    triangles.sort_unstable();
    let mesh = Mesh { nodes: tri.points, triangles };
    let quality = Quality::of(&mesh);
    (quality.below_5_deg == 0 && mesh.validate().is_ok()).then_some(Candidate { mesh, quality })
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

impl Candidate {
    /// Whether no better one need be sought.
    fn is_fine(&self, fibers: usize) -> bool {
        let q = &self.quality;
        q.edges == fibers && q.bridges == 0 && q.min_angle_deg > FINE_DEG
    }
}

/// The candidate with the fewest poor triangles, and among those the one with the least of what else is unwanted: an
/// inner edge across a limb weighs as much as ten degrees of the least angle, or edges that differ by a factor of two
/// more.
fn best(candidates: Vec<Candidate>, fibers: usize) -> Option<Mesh> {
    let unwanted = |q: &Quality| q.bridges as f64 - 0.1 * q.min_angle_deg + 0.5 * q.max_edge / q.min_edge;
    let order =
        |a: &Quality, b: &Quality| a.below_20_deg.cmp(&b.below_20_deg).then((a.edges != fibers).cmp(&(b.edges != fibers))).then(unwanted(a).total_cmp(&unwanted(b)));
    candidates.into_iter().min_by(|a, b| order(&a.quality, &b.quality)).map(|c| c.mesh)
}

/// The least count above `asked` that was found to give a mesh.
fn nearest(outline: &Outline, curves: &[Curve], asked: usize) -> usize {
    let (low, high) = outline.bounding_box();
    let height = high[1] - low[1];
    let mut least = (NEAREST_MOST * asked.max(100)).min(MAX_FIBERS);
    for (stray, area) in STRAYS.into_iter().zip(AREAS) {
        let close = Closeness { stray: stray * height, area };
        for k in 0..8 {
            let h = even_spacing(outline, asked) * 1.5_f64.powi(k);
            let Some(most) = most_nodes(outline, least) else { break };
            let Some(boundary) = sample(outline, curves, &[], h, 0, close, most) else { continue };
            let Some(mut refiner) = Refiner::new(&boundary, curves, h, COARSEST[0]) else { continue };
            if refiner.run_angles(least).is_some() {
                least = least.min(refiner.tri.edges());
            }
        }
    }
    // Smoothing and the count's parity may ask for a little more.
    let mut count = least.max(asked + 1);
    for _ in 0..NEAREST_STEPS {
        if with_count(outline, curves, count).is_some() {
            return count;
        }
        count += (count / 12).max(1);
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
