//! The second derivative of a sheet's energy, factorised.

use super::membrane::Membrane;
use crate::physics::cholesky::Cholesky;
use crate::physics::pattern::{Pattern, Scatter, Slots};

/// What is added to the diagonal where the pressure takes away no stiffness, dimensionless: the whole is free to move and to turn. And where it does, at first.
const LEAST_SHIFT: f64 = 1e-7;
const FIRST_SHIFT: f64 = 1e-4;
/// From try to try; tries.
const GROWTH: f64 = 8.0;
const TRIES: usize = 24;

/// A node of the sparse pattern has two unknowns. Number `i` has x and y of node `i`; each node off the rim has another one for its height, with an
/// unknown that is idle.
pub struct Stiffness {
    pattern: Pattern,
    cholesky: Cholesky,
    slots: Slots,
    /// The pattern's node for the height of each node; none on the rim.
    height: Vec<Option<usize>>,
    /// For each triangle what the nodes of its stencil are: a corner's place in the plane, or its height.
    places: Vec<Vec<(usize, Axis)>>,
    values: Vec<f64>,
    side: Vec<f64>,
    shift: f64,
}

#[derive(Clone, Copy)]
enum Axis {
    Plane,
    Height,
}

impl Stiffness {
    /// Of a sheet's unknowns; nothing is factorised yet. `None` where a factor would not fit into memory.
    pub fn new(membrane: &Membrane) -> Option<Self> {
        let mut count = membrane.is_rim().len();
        let height: Vec<Option<usize>> = membrane
            .is_rim()
            .iter()
            .map(|is_rim| {
                let own = count;
                count += usize::from(!is_rim);
                (!is_rim).then_some(own)
            })
            .collect();
        let (mut stencils, mut places) = (Vec::new(), Vec::new());
        for t in membrane.triangles() {
            let plane = (0..3).map(|k| (t[k], (k, Axis::Plane)));
            let high = (0..3).filter_map(|k| Some((height[t[k]]?, (k, Axis::Height))));
            let (stencil, place): (Vec<usize>, Vec<(usize, Axis)>) = plane.chain(high).unzip();
            stencils.push(stencil);
            places.push(place);
        }
        let each = || stencils.iter().map(Vec::as_slice);
        let (pattern, cholesky) = Cholesky::ordered(&Pattern::new(count, each()))?;
        let slots = pattern.slots(each());
        let values = vec![0.0; pattern.nonzeros()];
        let side = vec![0.0; pattern.dimension()];
        Some(Self { pattern, cholesky, slots, height, places, values, side, shift: FIRST_SHIFT })
    }

    /// Factorises the stiffness at `x`, shifted as far as makes it positive definite; whether that was possible.
    pub fn factorize(&mut self, membrane: &Membrane, x: &[[f64; 3]]) -> bool {
        self.assemble(membrane, x);
        let (mut shift, mut added) = (LEAST_SHIFT, 0.0);
        for tries in 0..TRIES {
            for d in 0..self.pattern.dimension() {
                self.values[self.pattern.diagonal(d)] += shift - added;
            }
            added = shift;
            if self.cholesky.factorize(&self.pattern, &self.values).is_ok() {
                if tries > 0 {
                    self.shift = shift / GROWTH;
                }
                return true;
            }
            // Then the one that was needed the last time, a size smaller.
            shift = if tries == 0 { self.shift.max(GROWTH * LEAST_SHIFT) } else { GROWTH * shift };
        }
        false
    }

    fn assemble(&mut self, membrane: &Membrane, x: &[[f64; 3]]) {
        self.values.fill(0.0);
        let mut scatter = Scatter::new(&self.slots, &mut self.values);
        for (k, places) in self.places.iter().enumerate() {
            let second = membrane.second(k, x);
            scatter.add(k, |p, q| {
                let ((a, first), (b, last)) = (places[p], places[q]);
                let m = &second[a][b];
                match (first, last) {
                    (Axis::Plane, Axis::Plane) => [m[0][0], m[0][1], m[1][0], m[1][1]],
                    (Axis::Height, Axis::Plane) => [m[2][0], m[2][1], 0.0, 0.0],
                    (Axis::Plane, Axis::Height) => [m[0][2], 0.0, m[1][2], 0.0],
                    (Axis::Height, Axis::Height) => [m[2][2], 0.0, 0.0, 0.0],
                }
            });
        }
        for height in self.height.iter().flatten() {
            self.values[self.pattern.diagonal(2 * height + 1)] = 1.0;
        }
    }

    /// `H^-1 v` in place; heights on the rim become 0.
    pub fn solve(&mut self, v: &mut [[f64; 3]]) {
        for (i, (v, height)) in v.iter().zip(&self.height).enumerate() {
            self.side[2 * i..2 * i + 2].copy_from_slice(&v[..2]);
            if let Some(height) = height {
                self.side[2 * height..2 * height + 2].copy_from_slice(&[v[2], 0.0]);
            }
        }
        self.cholesky.solve(&mut self.side);
        for (i, (v, height)) in v.iter_mut().zip(&self.height).enumerate() {
            *v = [self.side[2 * i], self.side[2 * i + 1], height.map_or(0.0, |height| self.side[2 * height])];
        }
    }
}
