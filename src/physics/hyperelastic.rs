//! What a material is: an energy density of the deformation gradient.

use super::double_double::DoubleDouble;
use nalgebra::{Matrix2, Matrix4, Vector4};

/// Shear modulus and first Lame parameter, force per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli {
    pub mu: f64,
    pub kappa: f64,
}

/// An isotropic, hyperelastic energy density per unit rest area.
///
/// `F` is the 2 x 2 deformation gradient. Second derivatives are 4 x 4 over `vec F = [F00, F10, F01, F11]` (column by
/// column). Implementations return infinity (density) outside their domain and finite derivatives inside it.
pub trait Hyperelastic: Send + Sync {
    /// `psi(F)`.
    fn density(&self, f: &Matrix2<f64>) -> f64;
    /// First Piola-Kirchhoff stress `P = dpsi/dF`.
    fn stress(&self, f: &Matrix2<f64>) -> Matrix2<f64>;
    /// `d2psi/dF2`.
    fn tangent(&self, f: &Matrix2<f64>) -> Matrix4<f64>;
    /// The tangent for descent steps, before it is projected: a material may leave out stiffness that goes as soon as a step is
    /// taken.
    fn descent_tangent(&self, f: &Matrix2<f64>) -> Matrix4<f64> {
        self.tangent(f)
    }
    /// `P` of an `F` known to twice the digits (column by column), where the difference of large terms needs them.
    fn precise_stress(&self, f: &[DoubleDouble; 4]) -> Matrix2<f64> {
        self.stress(&Matrix2::from_column_slice(&f.map(DoubleDouble::value)))
    }
    /// This material with its resistance to changes of area limited to `limit`, if it is above that.
    fn softened(&self, limit: f64) -> Option<Box<dyn Hyperelastic>> {
        let _ = limit;
        None
    }
    /// `mu` and `kappa`, where it is the neo-Hookean material: its triangles are worked on many at a time (`super::triangles`).
    fn neo_hookean(&self) -> Option<Moduli> {
        None
    }
    /// The shear modulus at rest: the unit of stress of this material.
    fn shear_modulus(&self) -> f64;
    /// How much stress a change of `F` makes at most, at rest: what rounding of `F` is multiplied by.
    fn largest_modulus(&self) -> f64;
}

/// Largest resistance to change of area, in shear moduli, that a design may ask for: beyond, triangles lock and the solver takes
/// minutes.
pub const STIFFENING: f64 = 1e4;

/// The nearest positive semi-definite matrix to a tangent of an isotropic material at `F`: negative eigenvalues set to zero.
///
/// `F` is the sum of a turned and scaled identity and of a turned and scaled reflection, of sizes `c` and `d`; its singular values are
/// `c + d` and `|c - d|`, and `psi` depends on `c` and `d` alone. So turning either part is an eigenvector, and the other two lie
/// where their sizes change.
pub fn project(tangent: Matrix4<f64>, f: &Matrix2<f64>) -> Matrix4<f64> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let direction = |x: f64, y: f64| {
        let size = x.hypot(y);
        if size > 0.0 { [half * x / size, half * y / size] } else { [half, 0.0] }
    };
    let [c, s] = direction(f[(0, 0)] + f[(1, 1)], f[(1, 0)] - f[(0, 1)]);
    let grown = Vector4::new(c, s, -s, c);
    let turned = Vector4::new(-s, c, -c, -s);
    let [c, s] = direction(f[(0, 0)] - f[(1, 1)], f[(1, 0)] + f[(0, 1)]);
    let sheared = Vector4::new(c, s, s, -c);
    let flipped = Vector4::new(-s, c, c, s);
    let value = |v: &Vector4<f64>| v.dot(&(tangent * v));
    let (along, across) = (value(&grown), value(&sheared));
    let coupling = sheared.dot(&(tangent * grown));
    let mut out = tangent;
    let mut lift = |value: f64, v: Vector4<f64>| {
        if value < 0.0 {
            out -= v * v.transpose() * value;
        }
    };
    lift(value(&turned), turned);
    lift(value(&flipped), flipped);
    let (mean, apart) = (0.5 * (along + across), (0.5 * (along - across)).hypot(coupling));
    if mean < apart {
        let (s, c) = (0.5 * (2.0 * coupling).atan2(along - across)).sin_cos();
        lift(mean + apart, c * grown + s * sheared);
        lift(mean - apart, c * sheared - s * grown);
    }
    out
}

/// The cofactor matrix `dJ/dF`; `F^-T = cof F / J`.
pub fn cofactor(f: &Matrix2<f64>) -> Matrix2<f64> {
    Matrix2::new(f[(1, 1)], -f[(1, 0)], -f[(0, 1)], f[(0, 0)])
}

/// `d2J/dF2` over `vec F`: constant in two dimensions.
pub fn determinant_hessian() -> Matrix4<f64> {
    let mut k = Matrix4::zeros();
    k[(0, 3)] = 1.0;
    k[(3, 0)] = 1.0;
    k[(1, 2)] = -1.0;
    k[(2, 1)] = -1.0;
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::catalogue::{Kind, MaterialKind};
    use nalgebra::Rotation2;

    /// Every material of the catalogue, with all values that it is tested with.
    fn materials() -> Vec<(String, Box<dyn Hyperelastic>)> {
        let all = MaterialKind::all().iter().flat_map(|kind| kind.tested.iter().map(move |values| (kind, values)));
        all.map(|(kind, values)| (format!("{} {values:?}", kind.label), (kind.build)(values))).collect()
    }

    fn states() -> Vec<Matrix2<f64>> {
        vec![
            Matrix2::identity(),
            Matrix2::new(1.3, 0.2, -0.1, 0.85),
            Matrix2::new(0.6, 0.5, -0.4, 0.9),
            Matrix2::new(0.3, 0.0, 0.1, 2.0),
            // Pressed nearly flat, where a barrier may stand.
            Matrix2::new(1.1, 0.1, 0.02, 0.008),
        ]
    }

    /// Error of central differences at two steps: it must fall by about four when the step halves.
    fn decays(error: impl Fn(f64) -> f64, scale: f64, what: &str) {
        let (coarse, fine) = (error(2e-3), error(1e-3));
        let noise = 1e-9 * scale;
        assert!(fine <= noise || coarse / fine > 3.3, "{what}: {coarse:e} then {fine:e}");
    }

    #[test]
    fn stress_and_tangent_are_the_derivatives_with_second_order_decay() {
        for (name, material) in materials() {
            for f in states() {
                let direction = Matrix2::new(0.4, -0.3, 0.8, 0.5);
                let p = material.stress(&f);
                let along = p.dot(&direction);
                let scale = along.abs() + material.tangent(&f).norm();
                decays(
                    |h| {
                        let (plus, minus) = (f + direction * h, f - direction * h);
                        ((material.density(&plus) - material.density(&minus)) / (2.0 * h) - along).abs()
                    },
                    scale,
                    &format!("{name}: stress"),
                );
                let d = Vector4::from_column_slice(direction.as_slice());
                let dp = material.tangent(&f) * d;
                decays(
                    |h| {
                        let difference =
                            (material.stress(&(f + direction * h)) - material.stress(&(f - direction * h))) / (2.0 * h);
                        (Vector4::from_column_slice(difference.as_slice()) - dp).norm()
                    },
                    scale,
                    &format!("{name}: tangent"),
                );
            }
        }
    }

    #[test]
    fn energy_ignores_rotations_and_vanishes_at_rest() {
        for (name, material) in materials() {
            assert!(material.density(&Matrix2::identity()).abs() < 1e-15, "{name}");
            assert!(material.stress(&Matrix2::identity()).norm() < 1e-14, "{name}");
            for f in states() {
                let (r, s) = (Rotation2::new(0.7).into_inner(), Rotation2::new(-1.9).into_inner());
                let (a, b) = (material.density(&f), material.density(&(r * f * s)));
                assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs()), "{name}");
            }
        }
    }

    #[test]
    fn projection_keeps_a_convex_tangent_and_repairs_the_rest() {
        for (name, material) in materials() {
            for f in states() {
                let tangent = material.tangent(&f);
                let eigen = tangent.symmetric_eigen();
                let q = eigen.eigenvectors;
                let nearest = q * Matrix4::from_diagonal(&eigen.eigenvalues.map(|v| v.max(0.0))) * q.transpose();
                let apart = (project(tangent, &f) - nearest).norm();
                assert!(apart < 1e-12 * tangent.norm(), "{name} at {f}: {apart}");
            }
        }
    }
}
