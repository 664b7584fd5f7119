//! Neo-Hookean triangles, many at a time: what [`super::Body`] asks of every triangle, in loops that become vector
//! instructions ([`super::wide`]).
//!
//! With the shape function gradients `b_a`, `C = cof F`, `c = kappa ln J - mu` and weight `A`: the force on node `a` is `A P b_a`,
//! `P = mu F + (c/J) C`, and the block of nodes `a` and `b` of the Hessian is
//! `A (mu (b_a b_b) I + (kappa - c)/J^2 (C b_a)(C b_b)^T + (c/J) (b_a x b_b) eps)`, `eps` the rotation by a right angle.
//!
//! A chunk in which a triangle is outside the domain of the logarithm is left to the caller, triangle by triangle.

use super::energy::{ROUNDING, Scales};
use super::hyperelastic::Moduli;
use super::pattern::Scatter;
use super::wide::{self, CHUNK, Lanes, Work, has_ln, ln, multiply_add};
use nalgebra::Vector2;
use std::ops::Range;

/// What never changes about the triangles, entry after entry of each.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    nodes: Vec<[u32; 3]>,
    /// `b_1x, b_1y, b_2x, b_2y`.
    shape: [Vec<f64>; 4],
    weights: Vec<f64>,
    /// `|b_a|`.
    lengths: [Vec<f64>; 3],
}

/// `F` (`F00, F10, F01, F11`) and `J` of a chunk.
struct Deformed {
    f: [Lanes; 4],
    j: Lanes,
}

/// Adds the forces of one triangle to the gradient, and to the scales where there are any.
type Alone<'a> = dyn FnMut(usize, &mut [f64], Option<&mut Scales>) + 'a;

impl Triangles {
    pub fn new(triangles: &[[usize; 3]], gradients: &[[Vector2<f64>; 3]], weights: &[f64]) -> Self {
        Self {
            nodes: triangles.iter().map(|t| t.map(|n| n as u32)).collect(),
            shape: [(1, 0), (1, 1), (2, 0), (2, 1)].map(|(a, axis)| gradients.iter().map(|g| g[a][axis]).collect()),
            weights: weights.to_vec(),
            lengths: [0, 1, 2].map(|a| gradients.iter().map(|g| g[a].norm()).collect()),
        }
    }

    fn chunks(&self) -> impl Iterator<Item = Range<usize>> {
        let count = self.nodes.len();
        (0..count).step_by(CHUNK).map(move |from| from..count.min(from + CHUNK))
    }

    #[inline(always)]
    fn deform<const FUSED: bool>(&self, chunk: Range<usize>, x: &[f64]) -> Deformed {
        let fma = multiply_add::<FUSED>;
        let count = chunk.len().min(CHUNK);
        let mut edges = [[0.0; CHUNK]; 4];
        let (points, _) = x.as_chunks::<2>();
        for (l, t) in self.nodes[chunk.clone()].iter().enumerate().take(count) {
            let [i, j, k] = t.map(|n| points[n as usize]);
            // From differences: far from the origin, sums of whole coordinates would lose what tells the corners apart.
            (edges[0][l], edges[1][l]) = (j[0] - i[0], j[1] - i[1]);
            (edges[2][l], edges[3][l]) = (k[0] - i[0], k[1] - i[1]);
        }
        let [b0, b1, c0, c1] = self.shape.each_ref().map(|s| &s[chunk.clone()][..count]);
        let mut out = Deformed { f: [[0.0; CHUNK]; 4], j: [0.0; CHUNK] };
        for l in 0..count {
            let [px, py, qx, qy] = [edges[0][l], edges[1][l], edges[2][l], edges[3][l]];
            let (f00, f10) = (fma(qx, c0[l], px * b0[l]), fma(qy, c0[l], py * b0[l]));
            let (f01, f11) = (fma(qx, c1[l], px * b1[l]), fma(qy, c1[l], py * b1[l]));
            (out.f[0][l], out.f[1][l], out.f[2][l], out.f[3][l]) = (f00, f10, f01, f11);
            out.j[l] = fma(f00, f11, -(f01 * f10));
        }
        out
    }

    /// Calls `alone` for every triangle that is not done here.
    pub fn add_gradient(
        &self,
        material: &Moduli,
        x: &[f64],
        gradient: &mut [f64],
        scales: Option<(&mut Scales, f64)>,
        alone: &mut Alone,
    ) {
        wide::run(Gradient { triangles: self, material, x, gradient, scales, alone });
    }

    pub fn add_hessian(
        &self,
        material: &Moduli,
        x: &[f64],
        out: &mut Scatter,
        alone: &mut dyn FnMut(usize, &mut Scatter),
    ) {
        wide::run(Hessian { triangles: self, material, x, out, alone });
    }

    /// The energy; infinite where a triangle is outside the domain.
    pub fn energy(&self, material: &Moduli, x: &[f64], alone: &dyn Fn(usize) -> f64) -> f64 {
        wide::run(Value { triangles: self, material, x, alone })
    }

    /// The smallest `det F`, minus infinity for NaN.
    pub fn smallest_determinant(&self, x: &[f64]) -> f64 {
        wide::run(Smallest { triangles: self, x })
    }

    /// Calls `near` with the triangles in which `det(F + t dF)` may vanish for `0 < t <= limit`, and with that limit; it returns the
    /// limit from there on.
    pub fn first_inversion(&self, x: &[f64], dx: &[f64], limit: f64, near: &mut dyn FnMut(usize, f64) -> f64) {
        wide::run(Inversion { triangles: self, x, dx, limit, near });
    }
}

/// Whether all determinants of a chunk have a logarithm.
#[inline(always)]
fn in_domain(j: &[f64]) -> bool {
    j.iter().fold(true, |all, j| all & has_ln(*j))
}

struct Gradient<'a, 's> {
    triangles: &'a Triangles,
    material: &'a Moduli,
    x: &'a [f64],
    gradient: &'a mut [f64],
    /// With the strain that counts as a force at work.
    scales: Option<(&'a mut Scales<'s>, f64)>,
    alone: &'a mut Alone<'a>,
}

impl Work for Gradient<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        let fma = multiply_add::<FUSED>;
        let Moduli { mu, kappa } = *self.material;
        let all = self.triangles;
        for chunk in all.chunks() {
            let count = chunk.len().min(CHUNK);
            let Deformed { f, j } = all.deform::<FUSED>(chunk.clone(), self.x);
            if !in_domain(&j[..count]) {
                for k in chunk {
                    (self.alone)(k, self.gradient, self.scales.as_mut().map(|(scales, _)| &mut **scales));
                }
                continue;
            }
            let [b0, b1, c0, c1] = all.shape.each_ref().map(|s| &s[chunk.clone()][..count]);
            let weights = &all.weights[chunk.clone()][..count];
            let mut force = [[0.0; CHUNK]; 4];
            for l in 0..count {
                let pressure = fma(kappa, ln::<FUSED>(j[l]), -mu) / j[l];
                let (p00, p11) = (fma(mu, f[0][l], pressure * f[3][l]), fma(mu, f[3][l], pressure * f[0][l]));
                let (p10, p01) = (fma(mu, f[1][l], -pressure * f[2][l]), fma(mu, f[2][l], -pressure * f[1][l]));
                let w = weights[l];
                force[0][l] = w * fma(p00, b0[l], p01 * b1[l]);
                force[1][l] = w * fma(p10, b0[l], p11 * b1[l]);
                force[2][l] = w * fma(p00, c0[l], p01 * c1[l]);
                force[3][l] = w * fma(p10, c0[l], p11 * c1[l]);
            }
            for (l, t) in all.nodes[chunk.clone()].iter().enumerate().take(count) {
                let [px, py, qx, qy] = [force[0][l], force[1][l], force[2][l], force[3][l]];
                let forces = [[-(px + qx), -(py + qy)], [px, py], [qx, qy]];
                let (gradient, _) = self.gradient.as_chunks_mut::<2>();
                for (&n, force) in t.iter().zip(forces) {
                    let g = &mut gradient[n as usize];
                    *g = [g[0] + force[0], g[1] + force[1]];
                }
            }
            let Some((scales, floor)) = &mut self.scales else { continue };
            let modulus = ROUNDING * (2.0 * mu + kappa);
            for (l, k) in chunk.enumerate() {
                let t = all.nodes[k].map(|n| n as usize);
                let [px, py, qx, qy] = [force[0][l], force[1][l], force[2][l], force[3][l]];
                let forces = [[(px + qx).abs(), (py + qy).abs()], [px.abs(), py.abs()], [qx.abs(), qy.abs()]];
                let x = self.x;
                let size = t.iter().fold(0.0, |m: f64, n| m.max(x[2 * n].abs()).max(x[2 * n + 1].abs()));
                let lengths = all.lengths.each_ref().map(|v| v[k]);
                let change = modulus * size * lengths[0].max(lengths[1]).max(lengths[2]) * all.weights[k];
                for ((&n, force), length) in t.iter().zip(forces).zip(lengths) {
                    let rounding = *floor * all.weights[k] * length;
                    scales.add(n, force.map(|f| f + rounding), change * length);
                }
            }
        }
    }
}

struct Hessian<'a, 's> {
    triangles: &'a Triangles,
    material: &'a Moduli,
    x: &'a [f64],
    out: &'a mut Scatter<'s>,
    alone: &'a mut dyn FnMut(usize, &mut Scatter),
}

/// Pairs of nodes in the order of the slots of a stencil.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)];

impl Work for Hessian<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let fma = multiply_add::<FUSED>;
        let Moduli { mu, kappa } = *self.material;
        let all = self.triangles;
        for chunk in all.chunks() {
            let count = chunk.len().min(CHUNK);
            let Deformed { f, j } = all.deform::<FUSED>(chunk.clone(), self.x);
            if !in_domain(&j[..count]) {
                for k in chunk {
                    (self.alone)(k, self.out);
                }
                continue;
            }
            let [b0, b1, c0, c1] = all.shape.each_ref().map(|s| &s[chunk.clone()][..count]);
            let weights = &all.weights[chunk.clone()][..count];
            let mut blocks = [[[0.0; CHUNK]; 4]; 6];
            for l in 0..count {
                let c = fma(kappa, ln::<FUSED>(j[l]), -mu);
                let inverse = j[l].recip();
                let w = weights[l];
                let (along, across) = (w * (kappa - c) * inverse * inverse, w * c * inverse);
                let mu = w * mu;
                let b = [[-b0[l] - c0[l], -b1[l] - c1[l]], [b0[l], b1[l]], [c0[l], c1[l]]];
                let v = b.map(|b| [fma(f[3][l], b[0], -f[1][l] * b[1]), fma(f[0][l], b[1], -f[2][l] * b[0])]);
                for ((p, q), block) in PAIRS.into_iter().zip(&mut blocks) {
                    let shear = mu * fma(b[p][0], b[q][0], b[p][1] * b[q][1]);
                    let turn = across * fma(b[p][0], b[q][1], -b[p][1] * b[q][0]);
                    let [x, y] = [along * v[p][0], along * v[p][1]];
                    block[0][l] = fma(x, v[q][0], shear);
                    block[1][l] = fma(x, v[q][1], turn);
                    block[2][l] = fma(y, v[q][0], -turn);
                    block[3][l] = fma(y, v[q][1], shear);
                }
            }
            for (l, k) in chunk.enumerate() {
                self.out.add_all(k, PAIRS, |pair| blocks[pair].each_ref().map(|lanes| lanes[l]));
            }
        }
    }
}

struct Value<'a> {
    triangles: &'a Triangles,
    material: &'a Moduli,
    x: &'a [f64],
    alone: &'a dyn Fn(usize) -> f64,
}

impl Work for Value<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> f64 {
        let fma = multiply_add::<FUSED>;
        let Moduli { mu, kappa } = *self.material;
        let all = self.triangles;
        let mut energy = 0.0;
        for chunk in all.chunks() {
            let count = chunk.len().min(CHUNK);
            let Deformed { f, j } = all.deform::<FUSED>(chunk.clone(), self.x);
            if !in_domain(&j[..count]) {
                energy += chunk.map(self.alone).sum::<f64>();
                continue;
            }
            let weights = &all.weights[chunk][..count];
            let mut density = [0.0; CHUNK];
            for l in 0..count {
                let logarithm = ln::<FUSED>(j[l]);
                let [a, b, c, d] = [f[0][l], f[1][l], f[2][l], f[3][l]];
                let norm = fma(a, a, b * b) + fma(c, c, d * d);
                let shear = 0.5 * mu * (norm - 2.0);
                density[l] = weights[l] * (shear + logarithm * fma(0.5 * kappa, logarithm, -mu));
            }
            energy += density[..count].iter().sum::<f64>();
        }
        energy
    }
}

struct Smallest<'a> {
    triangles: &'a Triangles,
    x: &'a [f64],
}

impl Work for Smallest<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> f64 {
        let mut smallest = f64::INFINITY;
        for chunk in self.triangles.chunks() {
            let count = chunk.len();
            let Deformed { j, .. } = self.triangles.deform::<FUSED>(chunk, self.x);
            let least = j[..count].iter().fold(f64::INFINITY, |m: f64, j| m.min(*j));
            let number = j[..count].iter().fold(true, |all, j| all & !j.is_nan());
            smallest = smallest.min(if number { least } else { f64::NEG_INFINITY });
        }
        smallest
    }
}

struct Inversion<'a> {
    triangles: &'a Triangles,
    x: &'a [f64],
    dx: &'a [f64],
    limit: f64,
    near: &'a mut dyn FnMut(usize, f64) -> f64,
}

impl Work for Inversion<'_> {
    type Output = ();

    /// No root of `a t^2 + b t + c` up to `t` where `|a| t^2 + |b| t < c`.
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let fma = multiply_add::<FUSED>;
        let mut limit = self.limit;
        for chunk in self.triangles.chunks() {
            let count = chunk.len().min(CHUNK);
            let Deformed { f, j } = self.triangles.deform::<FUSED>(chunk.clone(), self.x);
            let Deformed { f: d, j: a } = self.triangles.deform::<FUSED>(chunk.clone(), self.dx);
            let mut safe = true;
            for l in 0..count {
                let b = fma(f[3][l], d[0][l], f[0][l] * d[3][l]) - fma(f[1][l], d[2][l], f[2][l] * d[1][l]);
                safe &= fma(a[l].abs(), limit, b.abs()) * limit < j[l];
            }
            if !safe {
                for k in chunk {
                    limit = (self.near)(k, limit);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::double_double::DoubleDouble;
    use super::super::energy::{Energy, HessianForm};
    use super::super::pattern::Pattern;
    use super::super::{Body, Hyperelastic, NeoHookean};
    use super::*;
    use nalgebra::{Matrix2, Matrix4};

    /// A neo-Hookean material that does not say what it is: its triangles are worked on one by one.
    struct Disguised(NeoHookean);

    impl Hyperelastic for Disguised {
        fn density(&self, f: &Matrix2<f64>) -> f64 {
            self.0.density(f)
        }
        fn stress(&self, f: &Matrix2<f64>) -> Matrix2<f64> {
            self.0.stress(f)
        }
        fn tangent(&self, f: &Matrix2<f64>) -> Matrix4<f64> {
            self.0.tangent(f)
        }
        fn precise_stress(&self, f: &[DoubleDouble; 4]) -> Matrix2<f64> {
            self.0.precise_stress(f)
        }
        fn shear_modulus(&self) -> f64 {
            self.0.shear_modulus()
        }
        fn largest_modulus(&self) -> f64 {
            self.0.largest_modulus()
        }
    }

    /// A strip of triangles, deformed; more than two chunks of them, and not whole ones.
    fn strip() -> (Vec<[f64; 2]>, Vec<[usize; 3]>, Vec<f64>) {
        let columns = 80;
        let nodes: Vec<[f64; 2]> = (0..2 * columns).map(|k| [(k / 2) as f64, (k % 2) as f64]).collect();
        let triangles =
            (0..columns - 1).flat_map(|c| [[2 * c, 2 * c + 2, 2 * c + 1], [2 * c + 1, 2 * c + 2, 2 * c + 3]]);
        let wave = |k: usize| 0.2 * (1.7 * k as f64).sin();
        let x = nodes.iter().flatten().enumerate().map(|(d, v)| 1.1 * v + wave(d * d % 97)).collect();
        (nodes.clone(), triangles.collect(), x)
    }

    fn close(a: &[f64], b: &[f64], what: &str) {
        let scale = a.iter().filter(|v| v.is_finite()).fold(1e-300, |m: f64, v| m.max(v.abs()));
        for (k, (a, b)) in a.iter().zip(b).enumerate() {
            assert!(
                (a - b).abs() <= 1e-14 * scale || a == b || (a.is_nan() && b.is_nan()),
                "{what} {k}: {a} is not {b}"
            );
        }
    }

    #[test]
    fn many_at_a_time_are_what_they_are_one_by_one() {
        let (nodes, triangles, mut x) = strip();
        let material = NeoHookean { mu: 0.7, kappa: 1.9 };
        let stiffness: Vec<f64> = (0..triangles.len()).map(|k| 1.0 + 0.1 * (k % 5) as f64).collect();
        let wide = Body::new(&nodes, &triangles, Box::new(material), Some(&stiffness)).unwrap();
        let alone = Body::new(&nodes, &triangles, Box::new(Disguised(material)), Some(&stiffness)).unwrap();
        let pattern = Pattern::new(nodes.len(), triangles.iter().map(|t| &t[..]));
        let slots = pattern.slots(triangles.iter().map(|t| &t[..]));
        let dx: Vec<f64> = (0..x.len()).map(|d| 3.0 * (0.9 * d as f64).cos()).collect();
        for inverted in [false, true] {
            if inverted {
                x[61] += 40.0;
            }
            let all = [&wide, &alone].map(|body| {
                let mut gradient = vec![0.0; x.len()];
                let (mut together, mut scales) = (gradient.clone(), gradient.clone());
                body.add_gradient(&x, &mut gradient);
                body.add_gradient_and_scales(&x, &mut together, &mut Scales::together(&mut scales));
                let mut values = vec![0.0; pattern.nonzeros()];
                body.add_hessian(&x, HessianForm::Exact, &mut Scatter::new(&slots, &mut values));
                let single = [body.value(&x), body.smallest_determinant(&x), body.step_limit(&x, &dx)];
                (single, gradient, together, scales, values)
            });
            let [a, b] = &all;
            assert_eq!(a.0[0].is_infinite(), inverted);
            close(&a.0, &b.0, "energy, determinant, step");
            close(&a.1, &b.1, "gradient");
            close(&a.2, &b.2, "gradient with scales");
            close(&a.3, &b.3, "scale");
            close(&a.4, &b.4, "Hessian");
        }
    }

    #[test]
    fn a_number_that_is_none_is_no_determinant() {
        let (nodes, triangles, mut x) = strip();
        let body = Body::new(&nodes, &triangles, Box::new(NeoHookean { mu: 1.0, kappa: 1.0 }), None).unwrap();
        assert!(body.smallest_determinant(&x) > 0.0);
        x[100] = f64::NAN;
        assert_eq!(body.smallest_determinant(&x), f64::NEG_INFINITY);
        assert_eq!(body.value(&x), f64::INFINITY);
    }
}
