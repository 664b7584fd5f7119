//! Lengths and directions of the free elements at one state, flat in memory.

use crate::physics::wide::{self, Work, multiply_add};
use crate::physics::{Element, MaterialPoint};

/// Segments of the free elements: element `k` owns those from `starts[k]` to `starts[k + 1]`.
pub(super) struct Cables {
    starts: Vec<u32>,
    ends: Vec<Ends>,
    /// The segments with an end inside a triangle.
    inside: Vec<[MaterialPoint; 2]>,
    /// Squared width of a point of each element, as in the energy.
    points: Vec<f64>,
    /// `dl/dx` at the second end of each segment: its unit vector.
    directions: Vec<[f64; 2]>,
    pub lengths: Vec<f64>,
    /// The state that lengths and directions are of.
    at: Vec<f64>,
}

/// The ends of a segment: two nodes, or which of those that are not.
#[derive(Clone, Copy)]
enum Ends {
    Nodes([u32; 2]),
    Inside(u32),
}

impl Cables {
    pub fn new<'a>(elements: impl Iterator<Item = &'a Element>) -> Self {
        let mut out = Self {
            starts: vec![0],
            ends: Vec::new(),
            inside: Vec::new(),
            points: Vec::new(),
            directions: Vec::new(),
            lengths: Vec::new(),
            at: Vec::new(),
        };
        for element in elements {
            for s in element.routing.windows(2) {
                out.ends.push(match s {
                    [MaterialPoint::Node(a), MaterialPoint::Node(b)] => Ends::Nodes([*a as u32, *b as u32]),
                    _ => {
                        out.inside.push([s[0].clone(), s[1].clone()]);
                        Ends::Inside(out.inside.len() as u32 - 1)
                    }
                });
            }
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
                let (dx, dy) = match self.ends[s] {
                    Ends::Nodes(ends) => {
                        let [a, b] = ends.map(|n| 2 * n as usize);
                        (x[b] - x[a], x[b + 1] - x[a + 1])
                    }
                    Ends::Inside(k) => {
                        let [a, b] = [0, 1].map(|end| self.inside[k as usize][end].at(x));
                        (b[0] - a[0], b[1] - a[1])
                    }
                };
                let l = (dx * dx + dy * dy + self.points[k]).sqrt();
                self.directions[s] = [dx / l, dy / l];
                *length += l;
            }
        }
    }

    /// Adds `factor dl_k/dx` to `out`.
    pub fn add_gradient(&self, k: usize, factor: f64, out: &mut [f64]) {
        for s in self.starts[k] as usize..self.starts[k + 1] as usize {
            let force = self.directions[s].map(|d| factor * d);
            match self.ends[s] {
                Ends::Nodes(ends) => {
                    let [a, b] = ends.map(|n| 2 * n as usize);
                    for (axis, f) in force.into_iter().enumerate() {
                        out[a + axis] -= f;
                        out[b + axis] += f;
                    }
                }
                Ends::Inside(k) => {
                    let [a, b] = &self.inside[k as usize];
                    a.add(force.map(|f| -f), out);
                    b.add(force, out);
                }
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
                        let ends = match cables.ends[s] {
                            Ends::Nodes(ends) => ends,
                            Ends::Inside(k) => {
                                let rates = &mut rates[..wanted];
                                add_inside(&cables.inside[k as usize], [ux, uy], w, columns, from, rates);
                                continue;
                            }
                        };
                        let [a, b] = ends.map(|n| 2 * columns * n as usize + from);
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

/// Adds the columns' rates `u . (W_a - W_b)` along a segment with an end inside a triangle, of the columns after `from`.
fn add_inside(ends: &[MaterialPoint; 2], u: [f64; 2], w: &[f64], columns: usize, from: usize, rates: &mut [f64]) {
    for (sign, end) in [1.0, -1.0].into_iter().zip(ends) {
        for (n, weight) in end.parts() {
            let at = 2 * columns * n + from;
            for (c, rate) in rates.iter_mut().enumerate() {
                *rate += sign * weight * (u[0] * w[at + c] + u[1] * w[at + columns + c]);
            }
        }
    }
}

#[inline(always)]
fn whole(part: &[f64]) -> Result<&[f64; TILE], std::array::TryFromSliceError> {
    part.try_into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rates and gradients against those of the elements, with ends on nodes and inside triangles.
    #[test]
    fn rates_and_gradients_are_those_of_the_elements() {
        let inside = |nodes, weights| MaterialPoint::of_triangle(nodes, weights);
        let routings = [
            MaterialPoint::through([0, 5]),
            vec![1.into(), inside([2, 3, 4], [0.2, 0.3, 0.5])],
            vec![inside([0, 1, 2], [0.6, 0.3, 0.1]), 3.into(), 6.into(), inside([4, 5, 6], [0.1, 0.1, 0.8])],
        ];
        let element =
            |routing: &Vec<_>| Element { routing: routing.clone(), stiffness: 1.0, epsilon: 0.1, alpha0: 1.0 };
        let elements: Vec<Element> = (0..12).map(|k| element(&routings[k % 3])).collect();
        let (nodes, columns, rows) = (7, 12, 11);
        let x: Vec<f64> = (0..2 * nodes).map(|d| (1.7 * d as f64).sin() + 0.1 * d as f64).collect();
        let w: Vec<f64> = (0..2 * nodes * columns).map(|d| (0.37 * d as f64).cos()).collect();
        let mut cables = Cables::new(elements.iter());
        cables.update(&x);
        let (mut jacobian, mut linear) = (vec![0.0; rows * elements.len()], vec![0.0; elements.len()]);
        cables.rates(&w, columns, &mut jacobian, &mut linear);
        for (k, e) in elements.iter().enumerate() {
            assert!((cables.lengths[k] - e.length(&x)).abs() < 1e-15 * e.length(&x) * 8.0);
            let (mut mine, mut theirs) = (vec![0.0; x.len()], vec![0.0; x.len()]);
            cables.add_gradient(k, 0.7, &mut mine);
            e.add_length_gradient(&x, 0.7, &mut theirs);
            assert!(mine.iter().zip(&theirs).all(|(a, b)| (a - b).abs() < 1e-15));
            for c in 0..=rows {
                let column: Vec<f64> = (0..x.len()).map(|d| w[d * columns + c]).collect();
                let rate = if c < rows { jacobian[c * elements.len() + k] } else { linear[k] };
                assert!((rate + e.length_rate(&x, &column)).abs() < 1e-14, "element {k}, column {c}");
            }
        }
    }
}
