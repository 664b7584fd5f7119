//! St. Venant-Kirchhoff material: linear in the Green strain `E = (F^T F - I)/2`.
//!
//! `psi = mu |E|^2 + lambda/2 (tr E)^2`, `P = F S` with `S = 2 mu E + lambda tr(E) I`. It softens under compression and
//! does not by itself resist inversion; the density is infinite for `J <= 1e-6`, so that no inverted state is ever shown.

use super::material::Material;
use nalgebra::{Matrix2, Matrix4, Vector4};

/// A triangle is not pressed below this part of its area. Nothing in this material resists that, so states at the edge do occur,
/// and rounding of their coordinates must not turn them over.
const FLATTEST: f64 = 1e-6;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StVenantKirchhoff {
    /// Shear modulus, force per length.
    pub mu: f64,
    /// First Lame parameter, force per length.
    pub lambda: f64,
}

impl StVenantKirchhoff {
    fn strain(f: &Matrix2<f64>) -> Matrix2<f64> {
        (f.transpose() * f - Matrix2::identity()) * 0.5
    }

    fn second_stress(&self, strain: &Matrix2<f64>) -> Matrix2<f64> {
        strain * (2.0 * self.mu) + Matrix2::from_diagonal_element(self.lambda * strain.trace())
    }
}

impl Material for StVenantKirchhoff {
    fn density(&self, f: &Matrix2<f64>) -> f64 {
        let j = f.determinant();
        if j.is_nan() || j <= FLATTEST {
            return f64::INFINITY;
        }
        let strain = Self::strain(f);
        let psi = self.mu * strain.norm_squared() + 0.5 * self.lambda * strain.trace().powi(2);
        if psi.is_nan() { f64::INFINITY } else { psi }
    }

    fn stress(&self, f: &Matrix2<f64>) -> Matrix2<f64> {
        f * self.second_stress(&Self::strain(f))
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
        tangent
    }

    fn shear_modulus(&self) -> f64 {
        self.mu
    }

    fn largest_modulus(&self) -> f64 {
        2.0 * self.mu + self.lambda
    }
}
