//! Limbs of a body, and how much each narrows when it is stuffed.

use crate::mesh::Mesh;
use crate::outline::polygon::length;
use crate::outline::{Outline, Point};

/// A limb is what a disc of this part of the body's deepest place does not reach, the band along the rim left out: a quarter more.
const OF_DEEPEST: f64 = 0.5;
const BAND: f64 = 1.25;
/// Smallest limb that is told, as a part of the body's area.
const LEAST_AREA: f64 = 0.01;
/// Largest angle off the straight line across a limb at which its other side is looked for: its cosine.
const STRAIGHT: f64 = 0.9;

/// A limb by its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limb {
    pub at: Point,
    /// Its ends of the width across, flat, mm.
    pub across: [Point; 2],
    pub flat_mm: f64,
    pub stuffed_mm: f64,
}

/// The limbs of a mesh, whose nodes are seen at `seen` when it is stuffed; from left to right. Of a body without limbs its widest place.
pub fn limbs(mesh: &Mesh, outline: &Outline, seen: &[Point]) -> Vec<Limb> {
    let near = outline.near();
    let depth: Vec<f64> = mesh.nodes.iter().map(|&p| near.distance(p)).collect();
    let deepest = depth.iter().copied().fold(0.0, f64::max);
    let core: Vec<Point> =
        mesh.nodes.iter().zip(&depth).filter(|(_, d)| **d >= OF_DEEPEST * deepest).map(|(p, _)| *p).collect();
    let away: Vec<f64> =
        mesh.nodes.iter().map(|&p| core.iter().map(|&q| length(p, q)).fold(f64::INFINITY, f64::min)).collect();
    let is_limb: Vec<bool> = away.iter().map(|&d| d > BAND * OF_DEEPEST * deepest).collect();
    let rim: Vec<usize> = mesh.boundary().into_iter().flatten().collect();
    let share = (LEAST_AREA * mesh.nodes.len() as f64).max(3.0) as usize;
    let parts = components(mesh, &is_limb).into_iter().filter(|part| part.len() >= share);
    let mut limbs: Vec<Limb> = parts.filter_map(|part| limb(mesh, seen, &part, &depth, &away, &rim)).collect();
    if limbs.is_empty() {
        let all: Vec<usize> = (0..mesh.nodes.len()).collect();
        limbs.extend(limb(mesh, seen, &all, &depth, &vec![0.0; all.len()], &rim));
    }
    limbs.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]));
    limbs
}

/// The width of a limb at the deepest place of its outer half.
fn limb(mesh: &Mesh, seen: &[Point], part: &[usize], depth: &[f64], away: &[f64], rim: &[usize]) -> Option<Limb> {
    let farthest = part.iter().map(|&i| away[i]).fold(0.0, f64::max);
    let nearest = part.iter().map(|&i| away[i]).fold(f64::INFINITY, f64::min);
    let outer = part.iter().copied().filter(|&i| away[i] >= 0.5 * (nearest + farthest));
    let middle = outer.max_by(|&a, &b| depth[a].total_cmp(&depth[b]))?;
    let p = mesh.nodes[middle];
    let a = rim.iter().copied().min_by(|&a, &b| length(mesh.nodes[a], p).total_cmp(&length(mesh.nodes[b], p)))?;
    let q = mesh.nodes[a];
    let reach = length(p, q);
    let opposite = |&b: &usize| {
        let r = mesh.nodes[b];
        let far = length(p, r);
        let cosine =
            ((r[0] - p[0]) * (p[0] - q[0]) + (r[1] - p[1]) * (p[1] - q[1])) / (far * reach).max(f64::MIN_POSITIVE);
        cosine > STRAIGHT
    };
    let others = rim.iter().copied().filter(opposite);
    let b = others.min_by(|&a, &b| length(mesh.nodes[a], p).total_cmp(&length(mesh.nodes[b], p)))?;
    let across = [q, mesh.nodes[b]];
    Some(Limb { at: p, across, flat_mm: length(q, mesh.nodes[b]), stuffed_mm: length(seen[a], seen[b]) })
}

/// Nodes of limbs that hang together.
fn components(mesh: &Mesh, is_limb: &[bool]) -> Vec<Vec<usize>> {
    let mut beside = vec![Vec::new(); mesh.nodes.len()];
    for [a, b] in mesh.edges() {
        if is_limb[a] && is_limb[b] {
            beside[a].push(b);
            beside[b].push(a);
        }
    }
    let mut seen = vec![false; mesh.nodes.len()];
    let mut parts = Vec::new();
    for first in (0..mesh.nodes.len()).filter(|&i| is_limb[i]) {
        if seen[first] {
            continue;
        }
        let (mut part, mut open) = (Vec::new(), vec![first]);
        seen[first] = true;
        while let Some(node) = open.pop() {
            part.push(node);
            for &next in &beside[node] {
                if !seen[next] {
                    seen[next] = true;
                    open.push(next);
                }
            }
        }
        parts.push(part);
    }
    parts
}
