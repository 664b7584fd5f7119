//! Limbs of a body, and how much each narrows when it is stuffed.

use crate::mesh::Mesh;
use crate::outline::polygon::{length, lerp};
use crate::outline::{Outline, Point};

/// A limb is what a disc of this part of the body's deepest place does not reach, the band along the rim left out: half as much
/// again, beyond the reach of a corner of 90 degrees, sqrt 2 = 1.41.
const OF_DEEPEST: f64 = 0.5;
const BAND: f64 = 1.5;
/// Smallest limb that is told, as a part of the body's area.
const LEAST_AREA: f64 = 0.01;
/// Directions in which the way across a limb is looked for, over half a turn: 2 degrees apart, by which a width is 0.02 % too large at most.
const DIRECTIONS: usize = 90;

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
    let rim: Vec<[usize; 2]> = mesh
        .boundary()
        .iter()
        .flat_map(|ring| (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]))
        .collect();
    let share = (LEAST_AREA * mesh.nodes.len() as f64).max(3.0) as usize;
    let parts = components(mesh, &is_limb).into_iter().filter(|part| part.len() >= share);
    // A lobe as wide as the trunk, such as a head with a square snout, is none.
    let most = 2.0 * BAND * OF_DEEPEST * deepest;
    let mut limbs: Vec<Limb> = parts
        .filter_map(|part| limb(mesh, seen, &part, &depth, &away, &rim))
        .filter(|limb| limb.flat_mm <= most)
        .collect();
    if limbs.is_empty() {
        let all: Vec<usize> = (0..mesh.nodes.len()).collect();
        limbs.extend(limb(mesh, seen, &all, &depth, &vec![0.0; all.len()], &rim));
    }
    limbs.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]));
    limbs
}

/// The width of a limb at the deepest place of its outer half: the shortest way through it from rim to rim.
fn limb(mesh: &Mesh, seen: &[Point], part: &[usize], depth: &[f64], away: &[f64], rim: &[[usize; 2]]) -> Option<Limb> {
    let farthest = part.iter().map(|&i| away[i]).fold(0.0, f64::max);
    let nearest = part.iter().map(|&i| away[i]).fold(f64::INFINITY, f64::min);
    let outer = part.iter().copied().filter(|&i| away[i] >= 0.5 * (nearest + farthest));
    let middle = outer.max_by(|&a, &b| depth[a].total_cmp(&depth[b]))?;
    let at = mesh.nodes[middle];
    let ways = (0..DIRECTIONS).filter_map(|k| {
        let (sine, cosine) = (std::f64::consts::PI * k as f64 / DIRECTIONS as f64).sin_cos();
        Some([hit(mesh, rim, at, [cosine, sine])?, hit(mesh, rim, at, [-cosine, -sine])?])
    });
    let [a, b] = ways.min_by(|a, b| (a[0].reach + a[1].reach).total_cmp(&(b[0].reach + b[1].reach)))?;
    let across = [a.on(&mesh.nodes), b.on(&mesh.nodes)];
    Some(Limb { at, across, flat_mm: length(across[0], across[1]), stuffed_mm: length(a.on(seen), b.on(seen)) })
}

/// A point of the rim, by a side and the part of it that lies before the point.
struct Hit {
    side: [usize; 2],
    part: f64,
    reach: f64,
}

impl Hit {
    fn on(&self, nodes: &[Point]) -> Point {
        let [a, b] = self.side.map(|node| nodes[node]);
        lerp(a, b, self.part)
    }
}

/// Where a ray from inside first meets the rim.
fn hit(mesh: &Mesh, rim: &[[usize; 2]], from: Point, direction: Point) -> Option<Hit> {
    let cross = |a: Point, b: Point| a[0] * b[1] - a[1] * b[0];
    let meets = |&side: &[usize; 2]| {
        let [a, b] = side.map(|node| [mesh.nodes[node][0] - from[0], mesh.nodes[node][1] - from[1]]);
        let along = [b[0] - a[0], b[1] - a[1]];
        let area = cross(direction, along);
        let (part, reach) = (cross(a, direction) / area, cross(a, along) / area);
        (area != 0.0 && (0.0..=1.0).contains(&part) && reach > 0.0).then_some(Hit { side, part, reach })
    };
    rim.iter().filter_map(meets).min_by(|a, b| a.reach.total_cmp(&b.reach))
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
