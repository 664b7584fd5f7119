//! Compressible neo-Hookean material (eq. 5).
//!
//! `psi = mu/2 (tr F^T F - 2) - mu ln J + kappa/2 (ln J)^2`, infinite for `J <= 0`.
//!
//! With `c = kappa ln J - mu` and `C = cof F = dJ/dF`: `P = mu F + (c/J) C`, and
//! `d2psi = mu I + (kappa - c)/J^2 C C^T + (c/J) d2J/dF2`.

use crate::defaults;
use crate::physics::catalogue::{Dimension, MaterialKind, Parameter};
use crate::physics::double_double::DoubleDouble;
use crate::physics::hyperelastic::{Hyperelastic, Moduli, STIFFENING, cofactor, determinant_hessian};
use crate::physics::setting::Setting;
use nalgebra::{Matrix2, Matrix4, Vector4};

/// Compressible neo-Hookean material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    /// Shear modulus, force per length.
    pub mu: f64,
    /// First Lame parameter, force per length.
    pub kappa: f64,
}

/// Its entry in the catalogue.
pub(super) static KIND: MaterialKind = MaterialKind {
    name: "NeoHookean",
    label: "Neo-Hookean",
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
            name: "kappa",
            label: "Kappa",
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
    build: |values| Box::new(NeoHookean { mu: values[0], kappa: values[1] }),
    tested: &[&[0.7, 1.9], &[0.7, 700.0], &[0.7, 0.0]],
};

impl From<NeoHookean> for Setting<MaterialKind> {
    fn from(NeoHookean { mu, kappa }: NeoHookean) -> Self {
        Self::new(&KIND, &[mu, kappa])
    }
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

impl Hyperelastic for NeoHookean {
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
    fn precise_stress(&self, f: &[DoubleDouble; 4]) -> Matrix2<f64> {
        let [a, b, c, d] = *f;
        let cofactor = [d, -c, -b, a];
        let growth = a * d - b * c - DoubleDouble::ONE;
        let (g, j) = (growth.value(), (growth + DoubleDouble::ONE).value());
        let pressure = (self.mu * g + self.kappa * g.ln_1p()) / j;
        let entry = |k: usize| self.mu * (f[k] - cofactor[k]).value() + pressure * cofactor[k].value();
        Matrix2::from_column_slice(&[0, 1, 2, 3].map(entry))
    }

    fn softened(&self, limit: f64) -> Option<Box<dyn Hyperelastic>> {
        (self.kappa > limit).then(|| Box::new(Self { kappa: limit, ..*self }) as Box<dyn Hyperelastic>)
    }

    fn neo_hookean(&self) -> Option<Moduli> {
        Some(Moduli { mu: self.mu, kappa: self.kappa })
    }

    fn shear_modulus(&self) -> f64 {
        self.mu
    }

    fn largest_modulus(&self) -> f64 {
        2.0 * self.mu + self.kappa
    }
}
