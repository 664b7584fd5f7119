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
/// Fibres from which a mesh is large.
const LARGE: usize = 3000;
/// Spacings tried, growing, where the boundary alone has too many edges.
const COARSER: usize = 40;

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
    let even = even_spacing(outline, fibers);
    let spacings: &[f64] = if fibers < LARGE { &SPACINGS } else { &SPACINGS_LARGE };
    let candidates = spacings.iter().filter_map(|factor| attempt(outline, fibers, factor * even));
    if let Some((_, mesh)) = best(candidates) {
        return Ok(mesh);
    }
    // The boundary's own features ask for many nodes: sample it more and more coarsely.
    let mut h = even;
    for _ in 0..COARSER {
        h *= 1.12;
        if let Some((_, mesh)) = attempt(outline, fibers, h) {
            return Ok(mesh);
        }
    }
    Err(MeshError::Unreachable { asked: fibers, nearest: fewest(outline, h) })
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

/// Lower is better: poor triangles first, then limbs one triangle across, then the least angle.
type Rank = (usize, f64);

fn best(candidates: impl Iterator<Item = (Rank, Mesh)>) -> Option<(Rank, Mesh)> {
    candidates.min_by(|(a, _), (b, _)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)))
}

/// A mesh at boundary spacing `h`, if there is one with the asked count.
fn attempt(outline: &Outline, fibers: usize, h: f64) -> Option<(Rank, Mesh)> {
    let holes = 3 * outline.holes.len();
    for extra in 0..6 {
        let boundary = sample::sample(outline, h, extra)?;
        let fixed = boundary.nodes.len();
        let interior3 = (fibers + 3).checked_sub(2 * fixed + holes)?;
        if interior3 % 3 != 0 {
            continue;
        }
        let mut nodes = fill::fill(&boundary, interior3 / 3, h)?;
        let triangles = smooth::smooth(&mut nodes, fixed, &boundary.segments)?;
        let mesh = Mesh { nodes, triangles };
        let quality = Quality::of(&mesh);
        let sound =
            quality.edges == fibers && (mesh.area() / outline.area() - 1.0).abs() < 0.01 && mesh.validate().is_ok();
        if sound {
            let rank = (quality.below_20_deg, quality.bridges as f64 - 0.1 * quality.min_angle_deg);
            return Some((rank, mesh));
        }
    }
    None
}

/// The fewest edges found for the outline: those of its coarsest boundary without interior nodes.
fn fewest(outline: &Outline, h: f64) -> usize {
    let holes = 3 * outline.holes.len();
    let counts = [1.0, 2.0, 4.0, 8.0].into_iter().filter_map(|factor| sample::sample(outline, factor * h, 0));
    counts.map(|b| (2 * b.nodes.len() + holes).saturating_sub(3)).min().unwrap_or(MAX_FIBERS)
}
