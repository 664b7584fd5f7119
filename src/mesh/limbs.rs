//! Where a body has its limbs.

use super::Mesh;
use crate::outline::{Point, polygon};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A part of the body is a limb if it has at least and at most so much of its area: into less goes no cable, more is a head or half of the body.
const AREA: [f64; 2] = [0.02, 0.25];

/// One that reaches up counts for so much more, one that reaches down for so much less: a body stands on its legs and waves its arms.
const RAISED: f64 = 0.5;

/// The tip of the slenderest limb as seen from a place: the part of the body farther from there than some distance, measured within the body, whose
/// length squared by its area is largest, where what reaches up is preferred. The farthest node where nothing is a limb; `None` without nodes.
pub fn tip(mesh: &Mesh, from: Point) -> Option<usize> {
    let start = mesh.nearest_node(from, &mesh.nodes);
    let neighbours = mesh.neighbours();
    let far = distances(mesh, &neighbours, start);
    let areas = areas(mesh);
    let whole: f64 = areas.iter().sum();
    let mut order: Vec<usize> = (0..mesh.nodes.len()).filter(|&n| far[n].is_finite()).collect();
    order.sort_by(|&a, &b| far[b].total_cmp(&far[a]));
    // Parts grow from their tips towards the place and flow into each other: each has a root, its area, and its tip.
    let mut parts: Vec<Option<Part>> = vec![None; mesh.nodes.len()];
    let mut best: Option<(f64, usize)> = None;
    for &node in &order {
        parts[node] = Some(Part { parent: node, area: areas[node], tip: node });
        for &other in &neighbours[node] {
            join(&mut parts, node, other, &far);
        }
        let root = root(&parts, node);
        let Some(part) = parts[root] else { continue };
        let length = far[part.tip] - far[node];
        let tip = mesh.nodes[part.tip];
        let raised = (tip[1] - from[1]) / polygon::length(tip, from).max(f64::MIN_POSITIVE);
        let slender = (1.0 + RAISED * raised) * length * length / part.area;
        let is_limb = part.area >= AREA[0] * whole && part.area <= AREA[1] * whole;
        if is_limb && best.is_none_or(|(most, _)| slender > most) {
            best = Some((slender, part.tip));
        }
    }
    best.map(|(_, tip)| tip).or_else(|| order.first().copied())
}

#[derive(Clone, Copy)]
struct Part {
    /// Itself at the root.
    parent: usize,
    area: f64,
    tip: usize,
}

fn root(parts: &[Option<Part>], mut node: usize) -> usize {
    while let Some(part) = parts[node].filter(|part| part.parent != node) {
        node = part.parent;
    }
    node
}

/// Joins the parts of two nodes where both have one.
fn join(parts: &mut [Option<Part>], node: usize, other: usize, far: &[f64]) {
    let (a, b) = (root(parts, node), root(parts, other));
    let (Some(one), Some(two)) = (parts[a], parts[b]) else { return };
    if a == b {
        return;
    }
    // The smaller one under the larger one: chains stay short.
    let (under, over) = if one.area < two.area { (a, b) } else { (b, a) };
    let tip = if far[one.tip] >= far[two.tip] { one.tip } else { two.tip };
    parts[under] = parts[under].map(|part| Part { parent: over, ..part });
    parts[over] = parts[over].map(|part| Part { area: one.area + two.area, tip, ..part });
}

/// A third of the area of its triangles for each node.
fn areas(mesh: &Mesh) -> Vec<f64> {
    let mut areas = vec![0.0; mesh.nodes.len()];
    for triangle in &mesh.triangles {
        let share = polygon::signed_area(&triangle.map(|n| mesh.nodes[n])).abs() / 3.0;
        triangle.iter().for_each(|&n| areas[n] += share);
    }
    areas
}

/// From a node to all others along edges; infinite where none leads.
fn distances(mesh: &Mesh, neighbours: &[Vec<usize>], start: usize) -> Vec<f64> {
    let mut far = vec![f64::INFINITY; mesh.nodes.len()];
    if start >= far.len() {
        return far;
    }
    far[start] = 0.0;
    // Distances are not negative: their bits are in their order.
    let mut open = BinaryHeap::from([Reverse((0_u64, start))]);
    while let Some(Reverse((bits, node))) = open.pop() {
        if f64::from_bits(bits) > far[node] {
            continue;
        }
        for &next in &neighbours[node] {
            let through = far[node] + polygon::length(mesh.nodes[node], mesh.nodes[next]);
            if through < far[next] {
                far[next] = through;
                open.push(Reverse((through.to_bits(), next)));
            }
        }
    }
    far
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generate;
    use crate::outline::Outline;

    #[test]
    fn an_arm_is_a_limb_rather_than_a_head_that_is_farther_away() {
        // A body of 60 x 60 with a head of 50 x 70 on it, and an arm of 16 x 50 on its right.
        let outer = vec![
            [0.0, 0.0],
            [60.0, 0.0],
            [60.0, 36.0],
            [110.0, 36.0],
            [110.0, 52.0],
            [60.0, 52.0],
            [60.0, 60.0],
            [55.0, 60.0],
            [55.0, 130.0],
            [5.0, 130.0],
            [5.0, 60.0],
            [0.0, 60.0],
        ];
        let mesh = generate(&Outline { outer, holes: Vec::new() }, 500).unwrap();
        let [x, y] = mesh.nodes[tip(&mesh, [30.0, 30.0]).unwrap()];
        assert!(x > 109.0 && (36.0..=52.0).contains(&y), "{x} {y}");
        // From within the arm its tip is near, and the head is what is far away.
        let [_, y] = mesh.nodes[tip(&mesh, [108.0, 44.0]).unwrap()];
        assert!(y > 120.0, "{y}");
    }

    #[test]
    fn a_disc_has_a_tip_all_the_same() {
        let outer = (0..48)
            .map(|k| f64::from(k) * std::f64::consts::TAU / 48.0)
            .map(|a| [50.0 * a.cos(), 50.0 * a.sin()])
            .collect();
        let mesh = generate(&Outline { outer, holes: Vec::new() }, 300).unwrap();
        let [x, y] = mesh.nodes[tip(&mesh, [-5.0, 0.0]).unwrap()];
        assert!(x.hypot(y) > 49.0, "{x} {y}");
        assert_eq!(tip(&Mesh { nodes: Vec::new(), triangles: Vec::new() }, [0.0; 2]), None);
    }
}
