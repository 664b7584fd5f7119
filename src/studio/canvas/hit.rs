//! What lies under the pointer.

use crate::design::{Design, Target};
use crate::mesh::{BodyPoint, Mesh};
use crate::operations::network::Part;
use crate::outline::Point;

/// How near the pointer must be to a handle, logical pixels.
pub const HANDLE_REACH: f32 = 10.0;
/// Within this distance of a node the node itself is taken, logical pixels.
pub const NODE_REACH: f32 = 5.0;
/// How far outside the body it can still be grabbed, logical pixels.
pub const EDGE_REACH: f32 = 7.0;

/// The thing that the pointer would act on, most specific first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hit {
    /// Target of the current pose, by its index: its goal or its handle on the body.
    Target(usize),
    /// Pin, by its index.
    Pin(usize),
    /// Any other point of the body.
    Body(BodyPoint),
    /// A winch, or a hole or a piece of its tendons: of tools and menus that are about them.
    Part(Part),
    Nothing,
}

/// Looks under `p` (mm) in a view that shows `nodes`; `mm_per_pixel` turns the reaches into mm.
pub fn test(design: &Design, targets: &[Target], nodes: &[Point], p: Point, mm_per_pixel: f64) -> Hit {
    let mesh = &design.mesh;
    if nodes.len() != mesh.nodes.len() {
        return Hit::Nothing;
    }
    let reach = f64::from(HANDLE_REACH) * mm_per_pixel;
    let goals = targets.iter().map(|t| t.to);
    let handles = targets.iter().filter(|t| t.at.triangle < mesh.triangles.len()).map(|t| mesh.position(&t.at, nodes));
    if let Some(index) = nearest(goals, p, reach).or_else(|| nearest(handles, p, reach)) {
        return Hit::Target(index);
    }
    let pins = design.pins.iter().filter(|t| t.at.triangle < mesh.triangles.len());
    if let Some(index) = nearest(pins.map(|pin| mesh.position(&pin.at, nodes)), p, reach) {
        return Hit::Pin(index);
    }
    body_point(mesh, nodes, p, mm_per_pixel).map_or(Hit::Nothing, Hit::Body)
}

/// The point of the body under `p`; a node within reach is preferred, and a miss by little is forgiven.
pub fn body_point(mesh: &Mesh, nodes: &[Point], p: Point, mm_per_pixel: f64) -> Option<BodyPoint> {
    let (nearest, miss) = mesh.locate_nearest(p, nodes)?;
    if miss > f64::from(EDGE_REACH) * mm_per_pixel {
        return None;
    }
    let node = mesh.nearest_node(p, nodes);
    let reach = f64::from(if miss > 0.0 { EDGE_REACH } else { NODE_REACH }) * mm_per_pixel;
    let near_node = nodes.get(node).is_some_and(|&q| distance(q, p) <= reach);
    if near_node { mesh.node_point(node).or(Some(nearest)) } else { Some(nearest) }
}

/// Index of the nearest of `points` within `reach` of `p`.
fn nearest(points: impl Iterator<Item = Point>, p: Point, reach: f64) -> Option<usize> {
    points
        .map(|q| distance(q, p))
        .enumerate()
        .filter(|(_, d)| *d <= reach)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(index, _)| index)
}

fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh() -> Mesh {
        Mesh { nodes: vec![[0.0, 0.0], [100.0, 0.0], [0.0, 100.0]], triangles: vec![[0, 1, 2]] }
    }

    #[test]
    fn any_point_of_the_body_can_be_taken() {
        let mesh = mesh();
        let at = body_point(&mesh, &mesh.nodes, [25.0, 40.0], 0.1).unwrap();
        let p = mesh.position(&at, &mesh.nodes);
        assert!(distance(p, [25.0, 40.0]) < 1e-12);
    }

    #[test]
    fn a_node_is_taken_exactly_and_a_near_miss_is_forgiven() {
        let mesh = mesh();
        for p in [[0.2, 0.3], [-0.5, -0.1]] {
            let at = body_point(&mesh, &mesh.nodes, p, 0.1).unwrap();
            assert_eq!(at.weights, [1.0, 0.0, 0.0]);
        }
        assert_eq!(body_point(&mesh, &mesh.nodes, [80.0, 80.0], 0.1), None);
    }

    #[test]
    fn the_deformed_body_is_what_counts() {
        let mesh = mesh();
        let moved: Vec<Point> = mesh.nodes.iter().map(|p| [p[0] + 500.0, p[1]]).collect();
        assert_eq!(body_point(&mesh, &moved, [25.0, 40.0], 0.1), None);
        assert!(body_point(&mesh, &moved, [525.0, 40.0], 0.1).is_some());
    }
}
