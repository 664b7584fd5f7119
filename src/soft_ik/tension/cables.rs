//! Lengths and directions of the free elements at one state, flat in memory.

use crate::physics::Element;

/// Segments of the free elements: element `k` owns those from `starts[k]` to `starts[k + 1]`.
pub(super) struct Cables {
    starts: Vec<u32>,
    ends: Vec<[u32; 2]>,
    /// Squared width of a point of each element, as in the energy.
    points: Vec<f64>,
    /// `dl/dx` at the second end of each segment: its unit vector.
    directions: Vec<[f64; 2]>,
    pub lengths: Vec<f64>,
    /// The state that lengths and directions are of.
    at: Vec<f64>,
}

impl Cables {
    pub fn new<'a>(elements: impl Iterator<Item = &'a Element>) -> Self {
        let mut out = Self {
            starts: vec![0],
            ends: Vec::new(),
            points: Vec::new(),
            directions: Vec::new(),
            lengths: Vec::new(),
            at: Vec::new(),
        };
        for element in elements {
            out.ends.extend(element.routing.windows(2).map(|s| [s[0] as u32, s[1] as u32]));
            out.starts.push(out.ends.len() as u32);
            out.points.push(element.point().powi(2));
            out.lengths.push(element.alpha0);
        }
        out.directions.resize(out.ends.len(), [0.0; 2]);
        out
    }

    /// Takes lengths and directions at `x`, if they are not of `x` already.
    pub fn update(&mut self, x: &[f64]) {
        if self.at == x {
            return;
        }
        self.at.clear();
        self.at.extend_from_slice(x);
        for (k, length) in self.lengths.iter_mut().enumerate() {
            *length = 0.0;
            for s in self.starts[k] as usize..self.starts[k + 1] as usize {
                let [a, b] = self.ends[s].map(|n| 2 * n as usize);
                let (dx, dy) = (x[b] - x[a], x[b + 1] - x[a + 1]);
                let l = (dx * dx + dy * dy + self.points[k]).sqrt();
                self.directions[s] = [dx / l, dy / l];
                *length += l;
            }
        }
    }

    /// Adds `factor dl_k/dx` to `out`.
    pub fn add_gradient(&self, k: usize, factor: f64, out: &mut [f64]) {
        for s in self.starts[k] as usize..self.starts[k + 1] as usize {
            let [a, b] = self.ends[s].map(|n| 2 * n as usize);
            for axis in 0..2 {
                let f = factor * self.directions[s][axis];
                out[a + axis] -= f;
                out[b + axis] += f;
            }
        }
    }

    /// `-(dl_k/dx) W` into `out`, for `W` of `out.len()` columns stored node by node: of each node the `x` components of all
    /// columns, then the `y` components.
    pub fn rates(&self, k: usize, w: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        let columns = out.len();
        for s in self.starts[k] as usize..self.starts[k + 1] as usize {
            let [a, b] = self.ends[s].map(|n| 2 * columns * n as usize);
            let [ux, uy] = self.directions[s];
            let (ax, ay) = w[a..a + 2 * columns].split_at(columns);
            let (bx, by) = w[b..b + 2 * columns].split_at(columns);
            for (c, o) in out.iter_mut().enumerate() {
                *o += ux * (ax[c] - bx[c]) + uy * (ay[c] - by[c]);
            }
        }
    }
}
