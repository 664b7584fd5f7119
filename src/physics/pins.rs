//! Pins: stiff zero-length springs from points of the body to world anchors (section 4.4).
//!
//! `E = sum K/2 |S x - p|^2`, `S x` the pinned point. A pin holds a node or any point of a triangle. One that slides along the unit
//! vector `d` holds across it alone: `E = K/2 |(I - d d^T)(S x - p)|^2`.

use super::energy::{Energy, HessianForm, ROUNDING, Scales};
use super::pattern::Scatter;

#[derive(Clone, Debug, PartialEq)]
pub struct PinSpring {
    /// Distinct nodes and their weights, which sum to one.
    pub nodes: Vec<usize>,
    pub weights: Vec<f64>,
    /// World anchor.
    pub anchor: [f64; 2],
    /// `K`, force per length.
    pub stiffness: f64,
    /// Unit vector along which the point moves freely.
    pub slide: Option<[f64; 2]>,
}

#[derive(Clone, Debug, Default)]
pub struct Pins {
    pub pins: Vec<PinSpring>,
}

impl PinSpring {
    /// A pin on one node.
    pub fn node(node: usize, anchor: [f64; 2], stiffness: f64) -> Self {
        Self { nodes: vec![node], weights: vec![1.0], anchor, stiffness, slide: None }
    }

    /// The part of a vector across the way of a pin that slides, `(I - d d^T) v`; all of it where it does not.
    pub fn across(&self, v: [f64; 2]) -> [f64; 2] {
        self.slide.map_or(v, |[dx, dy]| {
            let along = dx * v[0] + dy * v[1];
            [v[0] - along * dx, v[1] - along * dy]
        })
    }

    /// The force of the pin on the body, `K (p - S x)`, across its way.
    pub fn force(&self, x: &[f64]) -> [f64; 2] {
        let mut force = [0.0; 2];
        for axis in 0..2 {
            let at: f64 = self.nodes.iter().zip(&self.weights).map(|(n, w)| w * x[2 * n + axis]).sum();
            force[axis] = self.stiffness * (self.anchor[axis] - at);
        }
        self.across(force)
    }
}

impl Energy for Pins {
    fn stencils(&self) -> usize {
        self.pins.len()
    }

    fn stencil(&self, k: usize) -> &[usize] {
        &self.pins[k].nodes
    }

    fn value(&self, x: &[f64]) -> f64 {
        let mut energy = 0.0;
        for pin in self.pins.iter().filter(|p| p.stiffness > 0.0) {
            let [fx, fy] = pin.force(x);
            energy += 0.5 * (fx * fx + fy * fy) / pin.stiffness;
        }
        if energy.is_nan() { f64::INFINITY } else { energy }
    }

    fn add_gradient(&self, x: &[f64], gradient: &mut [f64]) {
        for pin in &self.pins {
            let force = pin.force(x);
            for (&n, w) in pin.nodes.iter().zip(&pin.weights) {
                gradient[2 * n] -= w * force[0];
                gradient[2 * n + 1] -= w * force[1];
            }
        }
    }

    fn add_scales(&self, x: &[f64], scales: &mut Scales) {
        for pin in &self.pins {
            let force = pin.force(x).map(f64::abs);
            for &n in &pin.nodes {
                let size = [0, 1].map(|axis| pin.anchor[axis].abs().max(x[2 * n + axis].abs()));
                scales.add_force(n, force);
                scales.add_rounding(n, size.map(|size| ROUNDING * pin.stiffness * size));
            }
        }
    }

    fn add_hessian(&self, _x: &[f64], _form: HessianForm, out: &mut Scatter) {
        for (k, pin) in self.pins.iter().enumerate() {
            out.add(k, |a, b| {
                let s = pin.stiffness * pin.weights[a] * pin.weights[b];
                let ([xx, yx], [xy, yy]) = (pin.across([s, 0.0]), pin.across([0.0, s]));
                [xx, xy, yx, yy]
            });
        }
    }
}
