//! A solid in mm, to be printed.

use std::collections::BTreeMap;

/// A body by its surface: triangles counter-clockwise seen from outside, closed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solid {
    /// mm.
    pub nodes: Vec<[f64; 3]>,
    pub triangles: Vec<[usize; 3]>,
}

impl Solid {
    /// Volume by the divergence theorem, mm^3.
    pub fn volume_mm3(&self) -> f64 {
        let corner = |n: usize| self.nodes[n];
        let six = self.triangles.iter().map(|t| {
            let [a, b, c] = t.map(corner);
            let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]
        });
        six.sum::<f64>() / 6.0
    }

    /// Whether every edge belongs to two triangles, once in each direction.
    pub fn is_closed(&self) -> bool {
        let mut edges: BTreeMap<(usize, usize), i32> = BTreeMap::new();
        for t in &self.triangles {
            for k in 0..3 {
                *edges.entry((t[k], t[(k + 1) % 3])).or_default() += 1;
            }
        }
        edges.iter().all(|(&(a, b), &count)| count == 1 && edges.get(&(b, a)) == Some(&1))
    }
}
