//! Interior nodes: a given number of them, spread by farthest-point insertion.

use super::sample::Boundary;
use super::triangulate::{self, Cdt};
use crate::outline::{Point, polygon};
use spade::handles::FaceHandle;
use spade::handles::InnerTag;
use spade::{Point2, PositionInTriangulation, Triangulation};

/// Growth of the wanted edge length per length of way from a finely sampled stretch of the boundary.
const GRADATION: f64 = 0.35;
/// Nearest that an interior node may come to the boundary, in wanted edge lengths: below, triangles grow flat.
const BOUNDARY_GAP: f64 = 0.42;
/// Preference for triangles between boundary nodes alone, as a factor on that ratio: a limb is to be two across before
/// the trunk is filled evenly.
const LIMB_FIRST: f64 = 1.35;
/// Smallest ratio of circumradius to wanted edge length that takes a node, from round to round: an equilateral triangle
/// of the wanted size has 0.577.
const RATIOS: [f64; 12] = [1.2, 1.0, 0.9, 0.8, 0.75, 0.7, 0.66, 0.62, 0.58, 0.54, 0.5, 0.45];

/// Boundary nodes, then `count` interior nodes, for edges about `h` long near the boundary and up to `coarsest` times that
/// away from it. `None` where so many find no room.
///
/// Each round triangulates, and puts nodes at the circumcentres of the triangles largest for their place. The first
/// ones so fall on the middle lines of limbs, where they let the limbs bend.
pub(super) fn fill(boundary: &Boundary, count: usize, h: f64, coarsest: f64) -> Option<Vec<Point>> {
    let mut cdt = triangulate::cdt(&boundary.nodes, &boundary.segments)?;
    let mut sizes = boundary_sizes(boundary, h);
    let mut nodes = boundary.nodes.clone();
    let wanted = nodes.len() + count;
    for ratio in RATIOS {
        // Insertions change their surroundings: a ratio is done when it finds no more.
        while nodes.len() < wanted {
            let before = nodes.len();
            let taken = accept(
                candidates(&cdt, &nodes, &sizes, boundary.nodes.len(), coarsest * h, ratio),
                wanted - nodes.len(),
            );
            for (point, size) in taken {
                cdt.insert(Point2::new(point[0], point[1])).ok()?;
                nodes.push(point);
                sizes.push(size);
            }
            if cdt.num_vertices() != nodes.len() {
                return None;
            }
            if nodes.len() == before {
                break;
            }
        }
    }
    (nodes.len() == wanted).then_some(nodes)
}

struct Candidate {
    ratio: f64,
    at: Point,
    size: f64,
}

/// The mean length of the two boundary edges at each node, at most `h`.
fn boundary_sizes(boundary: &Boundary, h: f64) -> Vec<f64> {
    let mut sizes = vec![0.0; boundary.nodes.len()];
    for &[a, b] in &boundary.segments {
        let half = 0.5 * polygon::length(boundary.nodes[a], boundary.nodes[b]);
        sizes[a] += half;
        sizes[b] += half;
    }
    sizes.into_iter().map(|s: f64| s.min(h)).collect()
}

/// Circumcentres of triangles whose circumradius is more than `least` wanted edge lengths, the largest first. The first
/// `rim` nodes are those of the boundary.
fn candidates(cdt: &Cdt, nodes: &[Point], sizes: &[f64], rim: usize, longest: f64, least: f64) -> Vec<Candidate> {
    let inside = triangulate::inside_faces(cdt);
    let mut found = Vec::new();
    for face in cdt.inner_faces().filter(|face| inside[face.fix().index()]) {
        let (centre, radius2) = face.circumcircle();
        let at = [centre.x, centre.y];
        let radius = radius2.sqrt();
        let corners = face.vertices().map(|v| v.fix().index());
        let size = corners.iter().map(|&v| sizes[v] + GRADATION * radius).fold(longest, f64::min);
        let limb = if corners.iter().all(|&v| v < rim) { LIMB_FIRST } else { 1.0 };
        let ratio = limb * radius / size;
        if ratio <= least || !centre.x.is_finite() || !centre.y.is_finite() {
            continue;
        }
        let home = match cdt.locate(centre) {
            PositionInTriangulation::OnFace(home) => Some(cdt.face(home)),
            PositionInTriangulation::OnEdge(edge) => cdt.directed_edge(edge).face().as_inner(),
            _ => None,
        };
        let Some(home) = home.filter(|home| inside[home.fix().index()]) else { continue };
        if boundary_distance(home, nodes, at) > BOUNDARY_GAP * size {
            found.push(Candidate { ratio, at, size });
        }
    }
    found.sort_by(|a, b| {
        b.ratio.total_cmp(&a.ratio).then(a.at[0].total_cmp(&b.at[0])).then(a.at[1].total_cmp(&b.at[1]))
    });
    found
}

/// Distance to the constrained edges of the face around `p` and of its neighbours.
fn boundary_distance(
    face: FaceHandle<'_, InnerTag, Point2<f64>, (), spade::CdtEdge<()>, ()>,
    nodes: &[Point],
    p: Point,
) -> f64 {
    let mut nearest = f64::INFINITY;
    let mut see = |edge: spade::handles::DirectedEdgeHandle<'_, Point2<f64>, (), spade::CdtEdge<()>, ()>| {
        if edge.is_constraint_edge() {
            let [a, b] = edge.vertices().map(|v| nodes[v.fix().index()]);
            nearest = nearest.min(polygon::distance_to_segment(a, b, p));
        }
    };
    for edge in face.adjacent_edges() {
        see(edge);
        if !edge.is_constraint_edge() {
            see(edge.rev().next());
            see(edge.rev().prev());
        }
    }
    nearest
}

/// The first `room` candidates that keep their distance from each other.
fn accept(candidates: Vec<Candidate>, room: usize) -> Vec<(Point, f64)> {
    let cell = candidates.iter().map(|c| c.size).fold(f64::INFINITY, f64::min);
    let mut taken: Vec<(Point, f64)> = Vec::new();
    let mut grid: std::collections::BTreeMap<(i64, i64), Vec<usize>> = std::collections::BTreeMap::new();
    for c in candidates {
        if taken.len() == room {
            break;
        }
        let gap = (c.ratio.min(1.0) * c.size).max(0.6 * c.size);
        let key = |v: f64| (v / cell).floor() as i64;
        let reach = (gap / cell).ceil() as i64;
        let (x, y) = (key(c.at[0]), key(c.at[1]));
        let crowded = (x - reach..=x + reach).any(|i| {
            grid.range((i, y - reach)..=(i, y + reach))
                .flat_map(|(_, ids)| ids)
                .any(|&k| polygon::length(taken[k].0, c.at) < gap)
        });
        if !crowded {
            grid.entry((x, y)).or_default().push(taken.len());
            taken.push((c.at, c.size));
        }
    }
    taken
}
