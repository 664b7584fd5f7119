//! A finer mesh over the same edges.

use super::Mesh;
use super::order::order;
use crate::outline::polygon;
use std::collections::BTreeMap;

/// Each triangle cut into `parts` times `parts` similar ones. The nodes of the mesh keep their numbers, so that its edges can
/// serve as a coarse set of fibres on the fine mesh.
pub fn subdivided(mesh: &Mesh, parts: usize) -> Mesh {
    let n = parts.max(1);
    let mut nodes = mesh.nodes.clone();
    // The nodes between the ends of each edge, from the smaller end to the larger.
    let mut between: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for [a, b] in mesh.edges() {
        between.insert([a, b], nodes.len());
        nodes.extend((1..n).map(|k| polygon::lerp(mesh.nodes[a], mesh.nodes[b], k as f64 / n as f64)));
    }
    let on_edge = |a: usize, b: usize, k: usize| {
        let first = between.get(&[a.min(b), a.max(b)]).copied().unwrap_or(0);
        match k {
            0 => a,
            _ if k == n => b,
            _ => first + if a < b { k - 1 } else { n - 1 - k },
        }
    };
    let mut triangles = Vec::with_capacity(mesh.triangles.len() * n * n);
    for &[a, b, c] in &mesh.triangles {
        let (pa, pb, pc) = (mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]);
        // Row `i` runs from the side ab to the side ac, `i` parts from a; it has i + 1 nodes.
        let mut before = vec![a];
        for i in 1..=n {
            let (from, to) = (on_edge(a, b, i), on_edge(a, c, i));
            let mut row = vec![from];
            for j in 1..i {
                if i == n {
                    row.push(on_edge(b, c, j));
                } else {
                    let (s, t) = (i as f64 / n as f64, j as f64 / i as f64);
                    row.push(nodes.len());
                    nodes.push(polygon::lerp(polygon::lerp(pa, pb, s), polygon::lerp(pa, pc, s), t));
                }
            }
            row.push(to);
            for j in 0..i {
                triangles.push([before[j], row[j], row[j + 1]]);
                if j + 1 < i {
                    triangles.push([before[j], row[j + 1], before[j + 1]]);
                }
            }
            before = row;
        }
    }
    order(&mut triangles);
    Mesh { nodes, triangles }
}

#[cfg(test)]
mod tests {
    use super::super::quality::MeshQuality;
    use super::*;

    #[test]
    fn angles_area_and_numbers_stay() {
        let coarse = Mesh {
            nodes: vec![[0.0, 0.0], [30.0, 0.0], [28.0, 20.0], [4.0, 24.0], [50.0, 14.0]],
            triangles: vec![[0, 1, 2], [0, 2, 3], [1, 4, 2]],
        };
        for parts in 1..=5 {
            let fine = subdivided(&coarse, parts);
            assert_eq!(fine.validate(), Ok(()));
            assert_eq!(fine.triangles.len(), 3 * parts * parts);
            assert_eq!(fine.nodes[..5], coarse.nodes);
            assert!((fine.area() - coarse.area()).abs() < 1e-9);
            let (a, b) = (MeshQuality::of(&fine), MeshQuality::of(&coarse));
            assert!((a.min_angle_deg - b.min_angle_deg).abs() < 1e-9);
        }
    }
}
