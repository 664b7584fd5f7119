//! St. Venant-Kirchhoff material: linear in the Green strain `E = (F^T F - I)/2`, with a barrier in the place of contact.
//!
//! ```text
//! psi = mu |E|^2 + lambda/2 (tr E)^2 + m b(J)        P = F S + m b'(J) cof F,  S = 2 mu E + lambda tr(E) I
//! b   = -(J - J0)^2 ln(J/J0) / J0  for J < J0 = 0.01, else 0
//! ```
//!
//! By itself this material softens under compression and does not resist inversion: a triangle that is pressed hard goes flat, and
//! there is no equilibrium on the way. Stuffing pressed to a hundredth of its area touches itself. The barrier (of the
//! kind that Li et al. 2020, *Incremental Potential Contact*, put between surfaces) stands for that: twice continuously
//! differentiable, nothing at all above `J0`, infinite at `J = 0`. `m` is the largest of the moduli, so that it holds against
//! the material's own fall.

use crate::defaults;
use crate::physics::catalogue::{Dimension, MaterialKind, Parameter};
use crate::physics::hyperelastic::{Hyperelastic, STIFFENING, cofactor, determinant_hessian};
use crate::physics::setting::Setting;
use nalgebra::{Matrix2, Matrix4, Vector4};

/// `J0`: the part of its area at which a triangle begins to resist being pressed flat.
const TOUCHING: f64 = 1e-2;

/// St. Venant-Kirchhoff material, for comparison and for moderate compression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StVenantKirchhoff {
    /// Shear modulus, force per length.
    pub mu: f64,
    /// First Lame parameter, force per length.
    pub lambda: f64,
}

/// Its entry in the catalogue.
pub(super) static KIND: MaterialKind = MaterialKind {
    name: "StVenantKirchhoff",
    label: "St. Venant-Kirchhoff",
    parameters: &[
        Parameter {
            name: "mu",
            label: "Mu",
            tip: "Shear modulus, thickness multiplied in",
            unit: "N/mm",
            default: [defaults::MU, 0.0],
            range: [1e-6, 1e6],
            why: "foam is 0.1 to 10; steel 1 mm thick 8e4",
            offered: [1e-3, 1e3],
            dimension: Dimension::MODULUS,
            ..Parameter::NUMBER
        },
        Parameter {
            name: "lambda",
            label: "Lambda",
            tip: "Resistance to change of area, thickness multiplied in",
            unit: "N/mm",
            default: [defaults::KAPPA, 0.0],
            range: [0.0, 1e6],
            why: "as mu",
            most_times_first: Some(STIFFENING),
            offered: [1e-3, 1e3],
            dimension: Dimension::MODULUS,
            ..Parameter::NUMBER
        },
    ],
    build: |values| Box::new(StVenantKirchhoff { mu: values[0], lambda: values[1] }),
    tested: &[&[0.7, 1.1]],
};

impl From<StVenantKirchhoff> for Setting<MaterialKind> {
    fn from(StVenantKirchhoff { mu, lambda }: StVenantKirchhoff) -> Self {
        Self::new(&KIND, &[mu, lambda])
    }
}

impl StVenantKirchhoff {
    fn strain(f: &Matrix2<f64>) -> Matrix2<f64> {
        (f.transpose() * f - Matrix2::identity()) * 0.5
    }

    /// `m` of the barrier.
    fn barrier_modulus(&self) -> f64 {
        self.largest_modulus().max(self.mu)
    }

    fn second_stress(&self, strain: &Matrix2<f64>) -> Matrix2<f64> {
        strain * (2.0 * self.mu) + Matrix2::from_diagonal_element(self.lambda * strain.trace())
    }
}

impl Hyperelastic for StVenantKirchhoff {
    fn density(&self, f: &Matrix2<f64>) -> f64 {
        let j = f.determinant();
        if j.is_nan() || j <= 0.0 {
            return f64::INFINITY;
        }
        let strain = Self::strain(f);
        let mut psi = self.mu * strain.norm_squared() + 0.5 * self.lambda * strain.trace().powi(2);
        if j < TOUCHING {
            psi += self.barrier_modulus() * barrier(j)[0];
        }
        if psi.is_nan() { f64::INFINITY } else { psi }
    }

    fn stress(&self, f: &Matrix2<f64>) -> Matrix2<f64> {
        let stress = f * self.second_stress(&Self::strain(f));
        let j = f.determinant();
        if j < TOUCHING { stress + cofactor(f) * (self.barrier_modulus() * barrier(j)[1]) } else { stress }
    }

    fn tangent(&self, f: &Matrix2<f64>) -> Matrix4<f64> {
        let s = self.second_stress(&Self::strain(f));
        let mut tangent = Matrix4::zeros();
        for k in 0..4 {
            let mut df = Matrix2::zeros();
            df[k] = 1.0;
            let d_strain = (df.transpose() * f + f.transpose() * df) * 0.5;
            let dp = df * s + f * self.second_stress(&d_strain);
            tangent.set_column(k, &Vector4::from_column_slice(dp.as_slice()));
        }
        let j = f.determinant();
        if j < TOUCHING {
            let [_, slope, curvature] = barrier(j);
            let c = Vector4::from_column_slice(cofactor(f).as_slice());
            tangent += (c * c.transpose() * curvature + determinant_hessian() * slope) * self.barrier_modulus();
        }
        tangent
    }

    fn shear_modulus(&self) -> f64 {
        self.mu
    }

    fn largest_modulus(&self) -> f64 {
        2.0 * self.mu + self.lambda
    }
}

/// `b`, `b'` and `b''` below [`TOUCHING`].
fn barrier(j: f64) -> [f64; 3] {
    let (gap, log) = (j - TOUCHING, (j / TOUCHING).ln());
    let part = gap / j;
    [-gap * gap * log, -gap * (2.0 * log + part), -2.0 * log - 4.0 * part + part * part].map(|v| v / TOUCHING)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{Body, Contractile, Element, MaterialPoint, Model, PinSpring, Pins, StaticsSettings, statics};

    /// A square of two triangles, held at its lower side; cables draw its upper corners down to the lower ones.
    fn pressed(lambda: f64, stiffness: f64) -> Model {
        let nodes = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let material = Box::new(StVenantKirchhoff { mu: 1.0, lambda });
        let body = Body::new(&nodes, &[[0, 1, 2], [0, 2, 3]], material, None).unwrap();
        let cable = |routing: [usize; 2]| Element {
            routing: MaterialPoint::through(routing),
            stiffness,
            epsilon: 1e-3,
            alpha0: 1.0,
        };
        let mut cables = Contractile::new(vec![cable([0, 3]), cable([1, 2])]);
        cables.set_contractions(&[0.999; 2]);
        let pins = Pins { pins: vec![PinSpring::node(0, nodes[0], 1e3), PinSpring::node(1, nodes[1], 1e3)] };
        Model::new(&nodes, body, cables, pins, Vec::new()).unwrap()
    }

    #[test]
    fn a_body_that_is_pressed_flat_comes_to_rest() {
        for (lambda, stiffness) in [(1.0, 1.0), (1.0, 100.0), (1e4, 1e4), (0.0, 1e6), (-0.5, 1e3)] {
            let mut model = pressed(lambda, stiffness);
            let rest = model.rest.clone();
            let state = statics::solve(&mut model, &rest, &StaticsSettings::default(), &|| false)
                .unwrap_or_else(|e| panic!("lambda {lambda}, K {stiffness}: {e} after {} steps", e.best.iterations));
            let j = model.body.smallest_determinant(&state.x);
            assert!(j > 0.0 && j < 0.05, "lambda {lambda}, K {stiffness}: det F {j:e}");
            assert!(state.iterations < 200, "lambda {lambda}, K {stiffness}: {} steps", state.iterations);
        }
    }

    #[test]
    fn the_barrier_begins_without_a_jump() {
        let at = barrier(TOUCHING * (1.0 - 1e-9));
        assert!(at[0].abs() < 1e-18 && at[1].abs() < 1e-12 && at[2].abs() < 1e-5, "{at:?}");
        // Above it the material is what its name says.
        let material = StVenantKirchhoff { mu: 1.0, lambda: 0.0 };
        let f = Matrix2::new(1.0, 0.0, 0.0, 1.01 * TOUCHING);
        assert_eq!(material.density(&f), StVenantKirchhoff::strain(&f).norm_squared());
    }
}
