//! Elements of one segment, many at a time: what [`super::Contractile`] asks of most of its elements, in loops that become vector
//! instructions ([`super::wide`]).
//!
//! Every law is the sum of two: with `c = clamp(l - alpha + eps, 0, 2 eps)` and `e = max(l - alpha - eps, 0)` a spring has the
//! tension `K/(2 eps) c^2 + 2 K e` and the stiffness `K/eps c`, a cable the tension `max(t + s (l - l_0), 0)` and there the
//! stiffness `s`.

use super::element::{Element, Law};
use super::energy::{ROUNDING, Scales};
use super::material_point::MaterialPoint;
use super::pattern::Scatter;
use super::wide::{self, CHUNK, Lanes, Work, multiply_add};
use std::ops::Range;

/// Elements of one segment between two nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Segments {
    /// Their places among all elements, ascending, and the nodes of each.
    elements: Vec<u32>,
    ends: Vec<[u32; 2]>,
}

/// Directions, lengths, tensions and stiffnesses of a chunk.
struct Pulled {
    ux: Lanes,
    uy: Lanes,
    /// Squared width of a point over squared length.
    ww: Lanes,
    lengths: Lanes,
    tensions: Lanes,
    tangents: Lanes,
}

impl Segments {
    /// The elements that have one segment between different nodes.
    pub fn new(elements: &[Element]) -> Self {
        let mut out = Self::default();
        for (k, element) in elements.iter().enumerate() {
            if let Some(ends) = straight(element) {
                out.elements.push(k as u32);
                out.ends.push(ends.map(|n| n as u32));
            }
        }
        out
    }

    fn chunks(&self) -> impl Iterator<Item = Range<usize>> {
        let count = self.ends.len();
        (0..count).step_by(CHUNK).map(move |from| from..count.min(from + CHUNK))
    }

    /// `None` where nothing pulls.
    #[inline(always)]
    fn pull<const FUSED: bool>(
        &self,
        chunk: Range<usize>,
        elements: &[Element],
        laws: &[Law],
        x: &[f64],
    ) -> Option<Pulled> {
        let fma = multiply_add::<FUSED>;
        let count = chunk.len().min(CHUNK);
        let mut spring = [[0.0; CHUNK]; 3];
        let mut cable = [[0.0; CHUNK]; 3];
        let (mut dx, mut dy, mut widths) = ([0.0; CHUNK], [0.0; CHUNK], [0.0; CHUNK]);
        let mut slack = true;
        let (points, _) = x.as_chunks::<2>();
        for (l, (&k, ends)) in self.elements[chunk.clone()].iter().zip(&self.ends[chunk]).enumerate().take(count) {
            let (element, law) = (&elements[k as usize], &laws[k as usize]);
            let [a, b] = ends.map(|n| points[n as usize]);
            (dx[l], dy[l]) = (b[0] - a[0], b[1] - a[1]);
            widths[l] = element.point();
            spring[2][l] = 1.0;
            match *law {
                Law::Spring { alpha } => {
                    slack = false;
                    (spring[0][l], spring[1][l], spring[2][l]) = (alpha, element.stiffness, element.epsilon);
                }
                Law::Tension(tension) => {
                    slack &= tension == 0.0;
                    cable[0][l] = tension;
                }
                Law::Elastic { tension, length, stiffness } => {
                    slack = false;
                    (cable[0][l], cable[1][l], cable[2][l]) = (tension, length, stiffness);
                }
            }
        }
        if slack {
            return None;
        }
        let zero = [0.0; CHUNK];
        let mut out = Pulled { ux: zero, uy: zero, ww: zero, lengths: zero, tensions: zero, tangents: zero };
        for l in 0..count {
            let length = fma(dx[l], dx[l], fma(dy[l], dy[l], widths[l] * widths[l])).sqrt();
            let inverse = length.recip();
            (out.ux[l], out.uy[l]) = (dx[l] * inverse, dy[l] * inverse);
            let uw = widths[l] * inverse;
            (out.ww[l], out.lengths[l]) = (uw * uw, length);
            let (gamma, stiffness, epsilon) = (length - spring[0][l], spring[1][l], spring[2][l]);
            let bent = (gamma + epsilon).max(0.0).min(2.0 * epsilon);
            let straight = (gamma - epsilon).max(0.0);
            let rate = stiffness / epsilon * bent;
            let stretched = fma(cable[2][l], length - cable[1][l], cable[0][l]);
            let taut = if stretched > 0.0 { 1.0 } else { 0.0 };
            out.tensions[l] = fma(0.5 * rate, bent, fma(2.0 * stiffness, straight, stretched.max(0.0)));
            out.tangents[l] = fma(taut, cable[2][l], rate);
        }
        Some(out)
    }

    pub fn add_gradient(
        &self,
        elements: &[Element],
        laws: &[Law],
        x: &[f64],
        gradient: &mut [f64],
        scales: Option<&mut Scales>,
    ) {
        wide::run(Gradient { segments: self, elements, laws, x, gradient, scales });
    }

    /// Length of each into its element's place in `lengths`.
    pub fn lengths(&self, elements: &[Element], x: &[f64], lengths: &mut [f64]) {
        for (&k, ends) in self.elements.iter().zip(&self.ends) {
            let ([a, b], width) = (ends.map(|n| 2 * n as usize), elements[k as usize].point());
            let (dx, dy) = (x[b] - x[a], x[b + 1] - x[a + 1]);
            lengths[k as usize] = (dx * dx + dy * dy + width * width).sqrt();
        }
    }

    /// Tension of each into its element's place in `tensions`.
    pub fn tensions(&self, elements: &[Element], laws: &[Law], x: &[f64], tensions: &mut [f64]) {
        wide::run(Tensions { segments: self, elements, laws, x, tensions });
    }

    /// Calls `near` with the elements that may turn over within the step `limit dx`, and with that limit; it returns the limit
    /// from there on. `margin`: the part of the way that a step may take.
    pub fn first_turn(&self, x: &[f64], dx: &[f64], margin: f64, near: &mut dyn FnMut(usize, f64) -> f64) {
        let mut limit = 1.0;
        for (&k, ends) in self.elements.iter().zip(&self.ends) {
            let [a, b] = ends.map(|n| 2 * n as usize);
            let (px, py, vx, vy) = (x[b] - x[a], x[b + 1] - x[a + 1], dx[b] - dx[a], dx[b + 1] - dx[a + 1]);
            if -(px * vx + py * vy) * limit > margin * (px * px + py * py) {
                limit = near(k as usize, limit);
            }
        }
    }

    pub fn add_hessian(&self, elements: &[Element], laws: &[Law], x: &[f64], out: &mut Scatter) {
        wide::run(Hessian { segments: self, elements, laws, x, out });
    }
}

/// The ends of an element that is one segment between different nodes.
pub(super) fn straight(element: &Element) -> Option<[usize; 2]> {
    match element.routing[..] {
        [MaterialPoint::Node(a), MaterialPoint::Node(b)] if a != b => Some([a, b]),
        _ => None,
    }
}

struct Gradient<'a, 's> {
    segments: &'a Segments,
    elements: &'a [Element],
    laws: &'a [Law],
    x: &'a [f64],
    gradient: &'a mut [f64],
    scales: Option<&'a mut Scales<'s>>,
}

impl Work for Gradient<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        for chunk in self.segments.chunks() {
            let ends = &self.segments.ends[chunk.clone()];
            let Some(pulled) = self.segments.pull::<FUSED>(chunk, self.elements, self.laws, self.x) else { continue };
            for (l, ends) in ends.iter().enumerate().take(CHUNK) {
                let [a, b] = ends.map(|n| 2 * n as usize);
                let (tau, tangent, length) = (pulled.tensions[l], pulled.tangents[l], pulled.lengths[l]);
                if tau == 0.0 && tangent == 0.0 {
                    continue;
                }
                let (fx, fy) = (tau * pulled.ux[l], tau * pulled.uy[l]);
                self.gradient[a] -= fx;
                self.gradient[a + 1] -= fy;
                self.gradient[b] += fx;
                self.gradient[b + 1] += fy;
                if let Some(scales) = &mut self.scales {
                    let x = self.x;
                    let size = [a, a + 1, b, b + 1].iter().fold(0.0, |m: f64, &d| m.max(x[d].abs()));
                    let rounding = ROUNDING * (tangent * length + tau / length * size);
                    for n in ends.map(|n| n as usize) {
                        scales.add(n, [tau; 2], rounding);
                    }
                }
            }
        }
    }
}

struct Tensions<'a> {
    segments: &'a Segments,
    elements: &'a [Element],
    laws: &'a [Law],
    x: &'a [f64],
    tensions: &'a mut [f64],
}

impl Work for Tensions<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        for chunk in self.segments.chunks() {
            let places = &self.segments.elements[chunk.clone()];
            let pulled = self.segments.pull::<FUSED>(chunk, self.elements, self.laws, self.x);
            let tensions = pulled.map_or([0.0; CHUNK], |pulled| pulled.tensions);
            for (&k, tension) in places.iter().zip(&tensions) {
                self.tensions[k as usize] = *tension;
            }
        }
    }
}

struct Hessian<'a, 's> {
    segments: &'a Segments,
    elements: &'a [Element],
    laws: &'a [Law],
    x: &'a [f64],
    out: &'a mut Scatter<'s>,
}

/// Pairs of nodes in the order of the slots of a stencil.
const PAIRS: [(usize, usize); 3] = [(0, 0), (1, 0), (1, 1)];

impl Work for Hessian<'_, '_> {
    type Output = ();

    /// `U'' u u^T + tau/l (I - u u^T)` between the ends; away from `d = 0` the bracket is `n n^T`, `n` normal to `u`.
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let fma = multiply_add::<FUSED>;
        for chunk in self.segments.chunks() {
            let count = chunk.len().min(CHUNK);
            let pulled = self.segments.pull::<FUSED>(chunk.clone(), self.elements, self.laws, self.x);
            let Some(pulled) = pulled else { continue };
            let mut block = [[0.0; CHUNK]; 3];
            let [along, mixed, across] = &mut block;
            for l in 0..count {
                let (ux, uy, tangent) = (pulled.ux[l], pulled.uy[l], pulled.tangents[l]);
                let bend = pulled.tensions[l] / pulled.lengths[l];
                let (xx, yy) = (ux * ux, uy * uy);
                along[l] = fma(tangent, xx, bend * (yy + pulled.ww[l]));
                mixed[l] = (tangent - bend) * ux * uy;
                across[l] = fma(tangent, yy, bend * (xx + pulled.ww[l]));
            }
            for (l, &k) in self.segments.elements[chunk].iter().enumerate().take(count) {
                let [xx, xy, yy] = [block[0][l], block[1][l], block[2][l]];
                if pulled.tensions[l] != 0.0 || pulled.tangents[l] != 0.0 {
                    let blocks = [[xx, xy, xy, yy], [-xx, -xy, -xy, -yy], [xx, xy, xy, yy]];
                    self.out.add_all(k as usize, PAIRS, |pair| blocks[pair]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Contractile;
    use super::super::energy::{Energy, HessianForm};
    use super::super::pattern::Pattern;
    use super::*;

    /// Springs (slack, bent and straight), cables and what stands for stiff ones; more than a chunk of them.
    fn elements() -> (Contractile, Vec<f64>) {
        let nodes = 90;
        let x: Vec<f64> = (0..2 * nodes).map(|d| (d / 2) as f64 * 0.3 + (1.3 * d as f64).sin()).collect();
        let element = |k: usize| {
            let routing =
                if k.is_multiple_of(2) { vec![k.into(), (k + 1).into()] } else { vec![(k + 3).into(), k.into()] };
            Element { routing, stiffness: 0.5 + (k % 7) as f64, epsilon: 0.2, alpha0: 1.0 }
        };
        let mut contractile = Contractile::new((0..nodes - 3).map(element).collect());
        for (k, (e, law)) in contractile.elements.iter().zip(&mut contractile.laws).enumerate() {
            let length = e.length(&x);
            *law = match k % 5 {
                0 => Law::Spring { alpha: length - 0.6 },
                1 => Law::Spring { alpha: length + 0.05 },
                2 => Law::Tension(if k % 2 == 0 { 0.0 } else { 0.8 }),
                3 => Law::Elastic { tension: 0.4, length: length - 0.1, stiffness: 2.0 },
                _ => Law::Elastic { tension: 0.4, length: length + 1.1, stiffness: 2.0 },
            };
        }
        (contractile, x)
    }

    #[test]
    fn many_at_a_time_are_what_the_laws_say_of_each() {
        let (contractile, x) = elements();
        let n = x.len();
        let count = contractile.elements.len();
        let (mut gradient, mut lengths, mut tensions) = (vec![0.0; n], vec![0.0; count], vec![0.0; count]);
        contractile.add_gradient(&x, &mut gradient);
        contractile.lengths_into(&x, &mut lengths);
        contractile.tensions_into(&x, &mut tensions);
        let pattern = Pattern::new(n / 2, (0..count).map(|k| contractile.stencil(k)));
        let slots = pattern.slots((0..count).map(|k| contractile.stencil(k)));
        let mut values = vec![0.0; pattern.nonzeros()];
        contractile.add_hessian(&x, HessianForm::Exact, &mut Scatter::new(&slots, &mut values));
        let v: Vec<f64> = (0..n).map(|d| (0.7 * d as f64).cos()).collect();
        let (mut product, mut right) = (vec![0.0; n], vec![0.0; n]);
        pattern.multiply(&values, &v, &mut product);
        let mut expected = vec![0.0; n];
        for (k, (e, law)) in contractile.elements.iter().zip(&contractile.laws).enumerate() {
            let (tau, tangent) = law.tension_and_tangent(e, e.length(&x));
            assert!((lengths[k] - e.length(&x)).abs() < 1e-14 && (tensions[k] - tau).abs() < 1e-13, "{k}");
            e.add_length_gradient(&x, tau, &mut expected);
            // Along and across the segment.
            e.add_length_gradient(&x, (tangent - tau / lengths[k]) * e.length_rate(&x, &v), &mut right);
            let [a, b] = straight(e).unwrap();
            for axis in 0..2 {
                let bend = tau / lengths[k] * (v[2 * b + axis] - v[2 * a + axis]);
                right[2 * a + axis] -= bend;
                right[2 * b + axis] += bend;
            }
        }
        for d in 0..n {
            assert!((gradient[d] - expected[d]).abs() < 1e-12, "force {d}: {} is not {}", gradient[d], expected[d]);
            assert!((product[d] - right[d]).abs() < 1e-11, "Hessian {d}: {} is not {}", product[d], right[d]);
        }
    }
}
