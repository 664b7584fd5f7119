//! Gravity, an optional term: `E = - sum_i m_i g . x_i`, the mass of each triangle lumped at its nodes.

use crate::physics::catalogue::{Dimension, Parameter, TermKind};
use crate::physics::energy::{Energy, HessianForm, Scales};
use crate::physics::pattern::Scatter;

/// Its entry in the catalogue.
pub(super) static KIND: TermKind = TermKind {
    name: "Gravity",
    label: "Gravity",
    tip: "Weight of the stuffed body",
    parameters: &[
        Parameter {
            name: "acceleration",
            label: "Acceleration",
            tip: "Across and up the page",
            unit: "m/s^2",
            size: 2,
            default: [0.0, -9.81],
            range: [-1e3, 1e3],
            why: "a hundred times that of the earth",
            offered: [-100.0, 100.0],
            ..Parameter::NUMBER
        },
        Parameter {
            name: "surface_density",
            label: "Surface density",
            tip: "Mass of the stuffed body, its thickness multiplied in",
            unit: "kg/mm^2",
            default: [2e-6, 0.0],
            range: [0.0, 1e-3],
            why: "60 mm of stuffing is 2e-6, of lead 7e-4",
            offered: [0.0, 1e-4],
            shown: Some(("kg/m²", 1e6)),
            dimension: Dimension::FORCE_PER_AREA,
            ..Parameter::NUMBER
        },
    ],
    build: |ground, values| Box::new(Gravity::new(ground.nodal_areas, values[2], [values[0], values[1]])),
    tested: &[&[0.3, -9.8, 0.6]],
};

/// Gravity on the nodes of a body.
#[derive(Clone, Debug)]
pub struct Gravity {
    /// `m_i g`, force on every node.
    forces: Vec<[f64; 2]>,
}

impl Gravity {
    /// `nodal_areas` (length^2), `surface_density` (mass per length^2), `acceleration`; units must give forces.
    pub fn new(nodal_areas: &[f64], surface_density: f64, acceleration: [f64; 2]) -> Self {
        Self { forces: nodal_areas.iter().map(|a| acceleration.map(|g| a * surface_density * g)).collect() }
    }
}

impl Energy for Gravity {
    fn stencils(&self) -> usize {
        0
    }

    fn stencil(&self, _k: usize) -> &[usize] {
        &[]
    }

    fn value(&self, x: &[f64]) -> f64 {
        -self.forces.iter().zip(x.chunks_exact(2)).map(|(f, p)| f[0] * p[0] + f[1] * p[1]).sum::<f64>()
    }

    fn of_shift(&self, by: [f64; 2]) -> f64 {
        -self.forces.iter().map(|f| f[0] * by[0] + f[1] * by[1]).sum::<f64>()
    }

    fn add_gradient(&self, _x: &[f64], gradient: &mut [f64]) {
        for (f, g) in self.forces.iter().zip(gradient.chunks_exact_mut(2)) {
            g[0] -= f[0];
            g[1] -= f[1];
        }
    }

    fn add_hessian(&self, _x: &[f64], _form: HessianForm, _out: &mut Scatter) {}

    fn add_scales(&self, _x: &[f64], scales: &mut Scales) {
        for (node, force) in self.forces.iter().enumerate() {
            scales.add_force(node, force.map(f64::abs));
        }
    }
}
