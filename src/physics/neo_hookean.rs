//! Compressible neo-Hookean material (eq. 5).
//!
//! `psi = mu/2 (tr F^T F - 2) - mu ln J + kappa/2 (ln J)^2`, infinite for `J <= 0`.
//!
//! With `c = kappa ln J - mu` and `C = cof F = dJ/dF`: `P = mu F + (c/J) C`, and
//! `d2psi = mu I + (kappa - c)/J^2 C C^T + (c/J) d2J/dF2`.

use super::double::Double;
use super::material::{Material, cofactor, determinant_hessian};
use nalgebra::{Matrix2, Matrix4, Vector4};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    /// Shear modulus, force per length.
    pub mu: f64,
    /// First Lame parameter, force per length.
    pub kappa: f64,
}

/// Largest pressure, in shear moduli, that counts as stiffness in a descent step.
const LARGEST_PRESSURE: f64 = 10.0;

impl NeoHookean {
    /// The second derivative with `kappa ln J` given where it is a pressure.
    fn tangent_under(&self, f: &Matrix2<f64>, pressure: f64) -> Matrix4<f64> {
        let j = f.determinant();
        let c = pressure - self.mu;
        let g = Vector4::from_column_slice(cofactor(f).as_slice());
        Matrix4::from_diagonal_element(self.mu)
            + g * g.transpose() * ((self.kappa - c) / (j * j))
            + determinant_hessian() * (c / j)
    }
}

impl Material for NeoHookean {
    fn density(&self, f: &Matrix2<f64>) -> f64 {
        let j = f.determinant();
        if j.is_nan() || j <= 0.0 {
            return f64::INFINITY;
        }
        let ln_j = j.ln();
        let psi = 0.5 * self.mu * (f.norm_squared() - 2.0) - self.mu * ln_j + 0.5 * self.kappa * ln_j * ln_j;
        if psi.is_nan() { f64::INFINITY } else { psi }
    }

    fn stress(&self, f: &Matrix2<f64>) -> Matrix2<f64> {
        let j = f.determinant();
        let c = self.kappa * j.ln() - self.mu;
        f * self.mu + cofactor(f) * (c / j)
    }

    fn tangent(&self, f: &Matrix2<f64>) -> Matrix4<f64> {
        self.tangent_under(f, self.kappa * f.determinant().ln())
    }

    /// Where `kappa` is large, a step that is right to first order changes the area to second order, and `kappa ln J` becomes
    /// a pressure of many shear moduli that the next step removes. As stiffness against bending it would hold that step
    /// back, so it is limited there.
    fn descent_tangent(&self, f: &Matrix2<f64>) -> Matrix4<f64> {
        let limit = LARGEST_PRESSURE * self.mu;
        self.tangent_under(f, (self.kappa * f.determinant().ln()).clamp(-limit, limit))
    }

    /// `P = mu (F - C) + (mu (J - 1) + kappa ln J) C / J`, in which what cancels near `J = 1` and near rest is taken first.
    fn precise_stress(&self, f: &[Double; 4]) -> Matrix2<f64> {
        let [a, b, c, d] = *f;
        let cofactor = [d, -c, -b, a];
        let growth = a * d - b * c - Double::ONE;
        let (g, j) = (growth.value(), (growth + Double::ONE).value());
        let pressure = (self.mu * g + self.kappa * g.ln_1p()) / j;
        let entry = |k: usize| self.mu * (f[k] - cofactor[k]).value() + pressure * cofactor[k].value();
        Matrix2::from_column_slice(&[0, 1, 2, 3].map(entry))
    }

    fn softened(&self, limit: f64) -> Option<Box<dyn Material>> {
        (self.kappa > limit).then(|| Box::new(Self { kappa: limit, ..*self }) as Box<dyn Material>)
    }

    fn neo_hookean(&self) -> Option<&NeoHookean> {
        Some(self)
    }

    fn shear_modulus(&self) -> f64 {
        self.mu
    }

    fn largest_modulus(&self) -> f64 {
        2.0 * self.mu + self.kappa
    }
}
