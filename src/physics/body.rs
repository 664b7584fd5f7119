//! The elastic body: linear triangles of one material (section 4.1).
//!
//! Per triangle `F = d D^-1` is constant, `E = sum_e A_e s_e psi(F_e)` with rest area `A_e` and an optional stiffness
//! factor `s_e`. With the shape function gradients `b_a` (rows of `D^-1`, and minus their sum for node 0):
//! `F = sum_a x_a b_a^T`, `dE/dx_a = A P b_a`.

use super::double_double::DoubleDouble;
use super::energy::{Energy, HessianForm, ROUNDING, Scales};
use super::hyperelastic::{Hyperelastic, cofactor, project};
use super::pattern::Scatter;
use super::triangles::Triangles;
use nalgebra::{Matrix2, Vector2};

/// Step cap: the fraction of the way to the first inversion that a step may go.
const INVERSION_MARGIN: f64 = 0.9;

/// A strain of this size counts as force at work even at rest: rounding leaves 1e-16 of `mu`, and a residual is asked to be
/// 1e-12 of the forces at work.
const ROUNDING_STRAIN: f64 = 1e-4;

pub struct Body {
    material: Box<dyn Hyperelastic>,
    triangles: Vec<[usize; 3]>,
    /// Shape function gradients of the three nodes, 1/length.
    gradients: Vec<[Vector2<f64>; 3]>,
    /// Rest area times stiffness factor.
    weights: Vec<f64>,
    areas: Vec<f64>,
    /// Triangles for loops over many of them.
    wide: Triangles,
}

impl Body {
    /// A body with rest positions `nodes`. `stiffness` is a factor per triangle (all one if absent).
    ///
    /// # Errors
    /// The index of the first triangle that is clockwise, degenerate or not finite.
    pub fn new(
        nodes: &[[f64; 2]],
        triangles: &[[usize; 3]],
        material: Box<dyn Hyperelastic>,
        stiffness: Option<&[f64]>,
    ) -> Result<Self, usize> {
        let mut gradients = Vec::with_capacity(triangles.len());
        let mut areas = Vec::with_capacity(triangles.len());
        for (k, t) in triangles.iter().enumerate() {
            let [p, q, r] = t.map(|n| Vector2::from(nodes[n]));
            let d = Matrix2::from_columns(&[q - p, r - p]);
            let area = 0.5 * d.determinant();
            let inverse = d.try_inverse().filter(|_| area > 0.0 && area.is_finite()).ok_or(k)?;
            if !inverse.iter().all(|v| v.is_finite()) {
                return Err(k);
            }
            let (b1, b2) = (inverse.row(0).transpose(), inverse.row(1).transpose());
            gradients.push([-b1 - b2, b1, b2]);
            areas.push(area);
        }
        let weights: Vec<f64> = areas.iter().enumerate().map(|(k, a)| a * stiffness.map_or(1.0, |s| s[k])).collect();
        let wide = Triangles::new(triangles, &gradients, &weights);
        Ok(Self { material, triangles: triangles.to_vec(), gradients, weights, areas, wide })
    }

    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Rest area of the body.
    pub fn area(&self) -> f64 {
        self.areas.iter().sum()
    }

    /// Rest area that belongs to each node: a third of its triangles'.
    pub fn nodal_areas(&self, nodes: usize) -> Vec<f64> {
        let mut out = vec![0.0; nodes];
        for (t, a) in self.triangles.iter().zip(&self.areas) {
            for &n in t {
                out[n] += a / 3.0;
            }
        }
        out
    }

    pub fn material(&self) -> &dyn Hyperelastic {
        self.material.as_ref()
    }

    /// Limits the resistance to changes of area; returns the material that was there, if that changed it.
    pub(super) fn soften(&mut self, limit: f64) -> Option<Box<dyn Hyperelastic>> {
        let softer = self.material.softened(limit)?;
        Some(std::mem::replace(&mut self.material, softer))
    }

    pub(super) fn set_material(&mut self, material: Box<dyn Hyperelastic>) {
        self.material = material;
    }

    /// `F` of triangle `k` at coordinates `x`.
    #[inline]
    pub fn deformation_gradient(&self, k: usize, x: &[f64]) -> Matrix2<f64> {
        // From differences: far from the origin, sums of whole coordinates would lose what tells the corners apart.
        let [_, b, c] = &self.gradients[k];
        let [i, j, l] = self.triangles[k];
        let (px, py) = (x[2 * j] - x[2 * i], x[2 * j + 1] - x[2 * i + 1]);
        let (qx, qy) = (x[2 * l] - x[2 * i], x[2 * l + 1] - x[2 * i + 1]);
        Matrix2::new(px * b[0] + qx * c[0], px * b[1] + qx * c[1], py * b[0] + qy * c[0], py * b[1] + qy * c[1])
    }

    /// The gradient at coordinates of two words, for [`super::refine`].
    pub(super) fn add_precise_gradient(&self, x: &[DoubleDouble], gradient: &mut [f64]) {
        for (k, t) in self.triangles.iter().enumerate() {
            let [i, j, l] = *t;
            let [_, b, c] = &self.gradients[k];
            let [p, q] = [j, l].map(|n| [0, 1].map(|axis| x[2 * n + axis] - x[2 * i + axis]));
            let entry = |row: usize, column: usize| {
                p[row] * DoubleDouble::from(b[column]) + q[row] * DoubleDouble::from(c[column])
            };
            let f = [entry(0, 0), entry(1, 0), entry(0, 1), entry(1, 1)];
            let stress = self.material.precise_stress(&f) * self.weights[k];
            for (a, &n) in t.iter().enumerate() {
                let force = stress * self.gradients[k][a];
                gradient[2 * n] += force[0];
                gradient[2 * n + 1] += force[1];
            }
        }
    }

    /// Area at rest of the triangles whose `det F` is below a bound.
    pub fn pressed_area(&self, x: &[f64], below: f64) -> f64 {
        let pressed = |k: &usize| self.deformation_gradient(*k, x).determinant() < below;
        (0..self.triangles.len()).filter(pressed).map(|k| self.areas[k]).sum()
    }

    /// The smallest `det F`; positive for an uninverted state, NaN never.
    pub fn smallest_determinant(&self, x: &[f64]) -> f64 {
        self.wide.smallest_determinant(x)
    }
}

impl Energy for Body {
    fn stencils(&self) -> usize {
        self.triangles.len()
    }

    fn stencil(&self, k: usize) -> &[usize] {
        &self.triangles[k]
    }

    fn value(&self, x: &[f64]) -> f64 {
        let one = |k: usize| self.weights[k] * self.material.density(&self.deformation_gradient(k, x));
        let energy = match self.material.neo_hookean() {
            Some(material) => self.wide.energy(&material, x, &one),
            None => (0..self.triangles.len()).map(one).sum(),
        };
        if energy.is_nan() { f64::INFINITY } else { energy }
    }

    fn add_gradient(&self, x: &[f64], gradient: &mut [f64]) {
        let mut one = |k: usize, gradient: &mut [f64], _: Option<&mut Scales>| {
            self.forces(k, x, |n, force| {
                gradient[2 * n] += force[0];
                gradient[2 * n + 1] += force[1];
            });
        };
        match self.material.neo_hookean() {
            Some(material) => self.wide.add_gradient(&material, x, gradient, None, &mut one),
            None => (0..self.triangles.len()).for_each(|k| one(k, gradient, None)),
        }
    }

    fn add_hessian(&self, x: &[f64], form: HessianForm, out: &mut Scatter) {
        match self.material.neo_hookean() {
            Some(material) if form == HessianForm::Exact => {
                self.wide.add_hessian(&material, x, out, &mut |k, out| self.add_one_hessian(k, x, form, out));
            }
            _ => (0..self.triangles.len()).for_each(|k| self.add_one_hessian(k, x, form, out)),
        }
    }

    /// `det(F + t dF) = J + t cof F : dF + t^2 det dF`; the cap is a fraction of its first positive root.
    fn step_limit(&self, x: &[f64], dx: &[f64]) -> f64 {
        let mut limit = 1.0_f64;
        let mut one = |k: usize, _: f64| {
            let f = self.deformation_gradient(k, x);
            let df = self.deformation_gradient(k, dx);
            let root = first_positive_root(df.determinant(), cofactor(&f).dot(&df), f.determinant());
            limit = limit.min(INVERSION_MARGIN * root);
            limit / INVERSION_MARGIN
        };
        self.wide.first_inversion(x, dx, 1.0 / INVERSION_MARGIN, &mut one);
        limit
    }

    /// The forces of a single triangle, before they balance with its neighbours', and the floor that rounding sets. `F` changes
    /// with the coordinates, and the stress by the largest modulus with it.
    fn add_scales(&self, x: &[f64], scales: &mut Scales) {
        (0..self.triangles.len()).for_each(|k| self.add_one_force(k, x, |_, _| {}, scales));
    }

    fn add_gradient_and_scales(&self, x: &[f64], gradient: &mut [f64], scales: &mut Scales) {
        let one = |k: usize, gradient: &mut [f64], scales: &mut Scales| {
            let add = |n: usize, force: Vector2<f64>| {
                gradient[2 * n] += force[0];
                gradient[2 * n + 1] += force[1];
            };
            self.add_one_force(k, x, add, scales);
        };
        let Some(material) = self.material.neo_hookean() else {
            (0..self.triangles.len()).for_each(|k| one(k, gradient, scales));
            return;
        };
        let floor = ROUNDING_STRAIN * material.mu;
        let mut alone = |k: usize, gradient: &mut [f64], scales: Option<&mut Scales>| {
            scales.into_iter().for_each(|scales| one(k, gradient, scales));
        };
        self.wide.add_gradient(&material, x, gradient, Some((scales, floor)), &mut alone);
    }
}

impl Body {
    /// Gives the force of triangle `k` on each of its nodes to `add`.
    fn forces(&self, k: usize, x: &[f64], mut add: impl FnMut(usize, Vector2<f64>)) {
        let p = self.material.stress(&self.deformation_gradient(k, x)) * self.weights[k];
        for (&n, g) in self.triangles[k].iter().zip(&self.gradients[k]) {
            add(n, p * g);
        }
    }

    fn add_one_hessian(&self, k: usize, x: &[f64], form: HessianForm, out: &mut Scatter) {
        let f = self.deformation_gradient(k, x);
        let c = match form {
            HessianForm::Exact => self.material.tangent(&f),
            HessianForm::Projected => project(self.material.descent_tangent(&f), &f),
        } * self.weights[k];
        // Columns of `C h`, the change of stress per displacement of each node along x and y.
        let g = &self.gradients[k];
        let by_node = g.map(|h| {
            let column = |j: usize| [0, 1, 2, 3].map(|i| c[(i, j)] * h[0] + c[(i, j + 2)] * h[1]);
            [column(0), column(1)]
        });
        out.add(k, |p, q| {
            let (g, [x, y]) = (g[p], &by_node[q]);
            [g[0] * x[0] + g[1] * x[2], g[0] * y[0] + g[1] * y[2], g[0] * x[1] + g[1] * x[3], g[0] * y[1] + g[1] * y[3]]
        });
    }

    /// Gives the force of triangle `k` on each of its nodes to `add`, and adds to what a residual is compared with.
    fn add_one_force(&self, k: usize, x: &[f64], mut add: impl FnMut(usize, Vector2<f64>), scales: &mut Scales) {
        let floor = ROUNDING_STRAIN * self.material.shear_modulus();
        let modulus = ROUNDING * self.material.largest_modulus();
        let (t, weight) = (&self.triangles[k], self.weights[k]);
        let size = t.iter().fold(0.0, |m: f64, n| m.max(x[2 * n].abs()).max(x[2 * n + 1].abs()));
        let lengths = self.gradients[k].map(|g| g.norm());
        let change = modulus * size * lengths.into_iter().fold(0.0, f64::max) * weight;
        let mut lengths = lengths.into_iter();
        self.forces(k, x, |n, force| {
            add(n, force);
            let length = lengths.next().unwrap_or_default();
            let rounding = floor * weight * length;
            scales.add_force(n, [force[0].abs() + rounding, force[1].abs() + rounding]);
            scales.add_rounding(n, [change * length; 2]);
        });
    }
}

/// The smallest positive root of `a t^2 + b t + c` with `c > 0`, infinite if there is none. Free of cancellation.
fn first_positive_root(a: f64, b: f64, c: f64) -> f64 {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant.is_nan() || discriminant < 0.0 {
        return f64::INFINITY;
    }
    let q = -0.5 * (b + b.signum() * discriminant.sqrt());
    [q / a, c / q].into_iter().filter(|t| t.is_finite() && *t > 0.0).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_the_first_positive_ones() {
        assert_eq!(first_positive_root(0.0, -2.0, 1.0), 0.5);
        assert_eq!(first_positive_root(1.0, -3.0, 2.0), 1.0);
        assert_eq!(first_positive_root(1.0, 3.0, 2.0), f64::INFINITY);
        assert_eq!(first_positive_root(-1.0, 0.0, 4.0), 2.0);
        assert_eq!(first_positive_root(1.0, 0.0, 4.0), f64::INFINITY);
    }

    #[test]
    fn clockwise_and_flat_triangles_are_refused() {
        let nodes = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [2.0, 0.0]];
        let material = || Box::new(super::super::NeoHookean { mu: 1.0, kappa: 1.0 });
        assert_eq!(Body::new(&nodes, &[[0, 1, 2], [0, 2, 1]], material(), None).err(), Some(1));
        assert_eq!(Body::new(&nodes, &[[0, 1, 3]], material(), None).err(), Some(0));
    }
}
