//! Lengths and directions of the free elements at one state, flat in memory.

use crate::physics::Element;
use crate::physics::wide::{self, Work, multiply_add};

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

    /// `-G W` for `W` of `columns` columns, of each degree of freedom all of them: the first into the rows of `jacobian`, the one
    /// after these into `linear`.
    pub fn rates(&self, w: &[f64], columns: usize, jacobian: &mut [f64], linear: &mut [f64]) {
        wide::run(Rates { cables: self, w, columns, jacobian, linear });
    }
}

/// See [`Cables::rates`].
struct Rates<'a> {
    cables: &'a Cables,
    w: &'a [f64],
    columns: usize,
    jacobian: &'a mut [f64],
    linear: &'a mut [f64],
}

/// Elements and columns that are worked on together: a line of memory each way.
const TILE: usize = 8;

impl Work for Rates<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let Rates { cables, w, columns, jacobian, linear } = self;
        let count = linear.len();
        let rows = jacobian.len() / count.max(1);
        for first in (0..count).step_by(TILE) {
            let tile = first..count.min(first + TILE);
            for from in (0..rows + 1).step_by(TILE) {
                let wanted = TILE.min(rows + 1 - from);
                let mut rates = [[0.0; TILE]; TILE];
                for (k, rates) in tile.clone().zip(&mut rates) {
                    for s in cables.starts[k] as usize..cables.starts[k + 1] as usize {
                        let [ux, uy] = cables.directions[s];
                        let [a, b] = cables.ends[s].map(|n| 2 * columns * n as usize + from);
                        let part = |at: usize| &w[at..at + wanted];
                        let (ax, ay, bx, by) = (part(a), part(a + columns), part(b), part(b + columns));
                        if let (Ok(ax), Ok(ay), Ok(bx), Ok(by)) = (whole(ax), whole(ay), whole(bx), whole(by)) {
                            for c in 0..TILE {
                                let along = multiply_add::<FUSED>(uy, ay[c] - by[c], ux * (ax[c] - bx[c]));
                                rates[c] += along;
                            }
                            continue;
                        }
                        for c in 0..wanted {
                            rates[c] += multiply_add::<FUSED>(uy, ay[c] - by[c], ux * (ax[c] - bx[c]));
                        }
                    }
                }
                for c in 0..wanted {
                    let row = if from + c < rows {
                        &mut jacobian[(from + c) * count..][tile.clone()]
                    } else {
                        &mut linear[tile.clone()]
                    };
                    for (out, rates) in row.iter_mut().zip(&rates) {
                        *out = rates[c];
                    }
                }
            }
        }
    }
}

#[inline(always)]
fn whole(part: &[f64]) -> Result<&[f64; TILE], std::array::TryFromSliceError> {
    part.try_into()
}
