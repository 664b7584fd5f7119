//! Constrained Delaunay triangulation of nodes and boundary segments.

use super::boundary::Boundary;
use super::search::WorkBudget;
use crate::outline::Point;
use spade::handles::{FixedFaceHandle, FixedVertexHandle};
use spade::handles::{InnerTag, UndirectedEdgeHandle};
use spade::{CdtEdge, ConstrainedDelaunayTriangulation, Point2, Triangulation};

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The triangulation of `nodes` with the segments as edges; nodes keep their numbers. `None` where nodes coincide or
/// are not finite, or segments cross.
fn cdt(nodes: &[Point], segments: &[[usize; 2]]) -> Option<Cdt> {
    let vertices: Vec<Point2<f64>> = nodes.iter().map(|p| Point2::new(p[0], p[1])).collect();
    let mut conflict = false;
    let cdt = Cdt::try_bulk_load_cdt(vertices, segments.to_vec(), |_| conflict = true).ok()?;
    (!conflict && cdt.num_vertices() == nodes.len()).then_some(cdt)
}

/// Numbers of the segments that cross others or run through other nodes, ascending; `None` where nodes coincide, which
/// no further node can cure.
pub(super) fn crossings(boundary: &Boundary, budget: &WorkBudget) -> Option<Vec<usize>> {
    let vertices: Vec<Point2<f64>> = boundary.nodes.iter().map(|p| Point2::new(p[0], p[1])).collect();
    let mut bad = Vec::new();
    let cdt = Cdt::try_bulk_load_cdt(vertices, boundary.segments.clone(), |e| bad.push(e)).ok()?;
    if cdt.num_vertices() != boundary.nodes.len() {
        return None;
    }
    if bad.is_empty() && cdt.num_constraints() != boundary.segments.len() {
        // A segment through a node comes as two.
        let whole = |[a, b]: [usize; 2]| {
            cdt.exists_constraint(FixedVertexHandle::from_index(a), FixedVertexHandle::from_index(b))
        };
        let all = 0..boundary.segments.len();
        let through: Vec<usize> = all.clone().filter(|&k| !whole(boundary.segments[k])).collect();
        return Some(if through.is_empty() { all.collect() } else { through });
    }
    // Some 2 ns for each pair.
    budget.spend(bad.len() * boundary.segments.len() / 40);
    let mut crossing: Vec<usize> = Vec::new();
    for pair in bad {
        let [a, b] = pair.map(|node| boundary.nodes[node]);
        for (k, &[c, d]) in boundary.segments.iter().enumerate() {
            let same = pair.contains(&c) && pair.contains(&d);
            if same || (!pair.contains(&c) && !pair.contains(&d) && cross(a, b, boundary.nodes[c], boundary.nodes[d])) {
                crossing.push(k);
            }
        }
    }
    crossing.sort_unstable();
    crossing.dedup();
    Some(crossing)
}

fn cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| doubled_area(p, q, r);
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

/// Twice the signed area of a triangle.
pub(super) fn doubled_area(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// The triangles inside the closed `rim`, counter-clockwise, the smallest node first, in lexicographic order; `tracks` are
/// edges too. `None` where segments cross or nodes coincide.
pub(super) fn triangles(nodes: &[Point], rim: &[[usize; 2]], tracks: &[[usize; 2]]) -> Option<Vec<[usize; 3]>> {
    let cdt = cdt(nodes, &[rim, tracks].concat())?;
    let inside = inside_faces(&cdt, rim);
    let mut triangles: Vec<[usize; 3]> = cdt
        .inner_faces()
        .filter(|face| inside[face.fix().index()])
        .map(|face| {
            let mut t = face.vertices().map(|v| v.fix().index());
            let smallest = (0..3).min_by_key(|&k| t[k]).unwrap_or(0);
            t.rotate_left(smallest);
            t
        })
        .collect();
    triangles.sort_unstable();
    Some(triangles)
}

/// For each inner face of the triangulation, by its index, whether it lies inside the rim: an even-odd flood from the
/// outside over its edges.
fn inside_faces(cdt: &Cdt, rim: &[[usize; 2]]) -> Vec<bool> {
    let mut walls: Vec<[usize; 2]> = rim.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    walls.sort_unstable();
    let is_wall = |edge: UndirectedEdgeHandle<'_, Point2<f64>, (), CdtEdge<()>, ()>| {
        let [a, b] = edge.vertices().map(|v| v.fix().index());
        edge.is_constraint_edge() && walls.binary_search(&[a.min(b), a.max(b)]).is_ok()
    };
    let mut depth: Vec<Option<bool>> = vec![None; cdt.num_all_faces()];
    let outer = cdt.outer_face().fix().index();
    depth[outer] = Some(false);
    let mut open: Vec<FixedFaceHandle<InnerTag>> = Vec::new();
    for edge in cdt.convex_hull() {
        if let Some(face) = edge.rev().face().as_inner().filter(|face| depth[face.fix().index()].is_none()) {
            depth[face.fix().index()] = Some(is_wall(edge.as_undirected()));
            open.push(face.fix());
        }
    }
    while let Some(face) = open.pop() {
        let here = depth[face.index()] == Some(true);
        for edge in cdt.face(face).adjacent_edges() {
            if let Some(next) = edge.rev().face().as_inner().filter(|next| depth[next.fix().index()].is_none()) {
                depth[next.fix().index()] = Some(here ^ is_wall(edge.as_undirected()));
                open.push(next.fix());
            }
        }
    }
    depth.into_iter().map(|d| d == Some(true)).collect()
}
