//! Contractile elements: muscle fibres and tendons (sections 4.2 and 4.3).
//!
//! An element of routing `r_0 ... r_n` has the length `l(x) = sum |x_{r_i} - x_{r_{i+1}}|` (eq. 6) and, as a spring of rest
//! length `alpha`, the unilateral energy `U(Gamma)`, `Gamma = l - alpha` (eq. 8, whose cubic is a perfect cube):
//!
//! ```text
//! U = 0                                    Gamma <= -eps
//! U = K/(6 eps) (Gamma + eps)^3     -eps < Gamma <= eps
//! U = K Gamma^2 + K eps^2/3                Gamma > eps      (taut stiffness 2K)
//! ```
//!
//! An element may instead carry a prescribed tension `tau`, with the energy `tau l`: the unknown of the fast posing method.
//! Segments are convex in `x` and `tau >= 0`, so the Hessian `U'' G^T G + tau d2l` is always positive semi-definite.

use super::energy::{Energy, HessianForm, ROUNDING, Scales};
use super::pattern::Scatter;
use super::segments::{Segments, is_straight};

/// Width of a point, as a fraction of the element's initial rest length: a segment of coordinate difference `d` counts as
/// `sqrt(d^2 + w^2)` long. Where its ends meet, it has no direction and the plain length has a kink, at which no Newton method
/// comes to rest; this one is smooth. From `1e-8` of the rest length on, the two differ by less than rounding.
const POINT: f64 = 1e-9;

/// A step may take at most this part of the way on which a taut segment would turn over.
const TURNING_MARGIN: f64 = 0.9;
/// Segments up to this many points wide may turn over: there the length is smooth.
const ROUND: f64 = 10.0;

/// What never changes about an element.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Mesh nodes: attachment point, via points, attachment point.
    pub routing: Vec<usize>,
    /// `K` of eq. 8, force per length.
    pub stiffness: f64,
    /// `epsilon` of eq. 8, length.
    pub epsilon: f64,
    /// Initial rest length `alpha_0`.
    pub alpha0: f64,
}

/// How an element pulls at present.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// A unilateral spring of rest length `alpha`.
    Spring { alpha: f64 },
    /// A cable under constant tension, whatever its length.
    Tension(f64),
    /// A cable that is under `tension` at `length` and has the given stiffness there; slack where that leads below zero. It
    /// stands for a stiff spring in whose place a softer one steadies the body.
    Elastic { tension: f64, length: f64, stiffness: f64 },
}

impl Element {
    /// `U(Gamma)`.
    pub fn energy(&self, gamma: f64) -> f64 {
        let (k, eps) = (self.stiffness, self.epsilon);
        if gamma <= -eps {
            0.0
        } else if gamma <= eps {
            k / (6.0 * eps) * (gamma + eps).powi(3)
        } else {
            k * gamma * gamma + k * eps * eps / 3.0
        }
    }

    /// Tension `U'(Gamma)`.
    pub fn tension(&self, gamma: f64) -> f64 {
        let (k, eps) = (self.stiffness, self.epsilon);
        if gamma <= -eps {
            0.0
        } else if gamma <= eps {
            k / (2.0 * eps) * (gamma + eps).powi(2)
        } else {
            2.0 * k * gamma
        }
    }

    /// Stiffness `U''(Gamma)`.
    pub fn tangent(&self, gamma: f64) -> f64 {
        let (k, eps) = (self.stiffness, self.epsilon);
        if gamma <= -eps {
            0.0
        } else if gamma <= eps {
            k / eps * (gamma + eps)
        } else {
            2.0 * k
        }
    }

    /// The deformation `Gamma = U'^-1(tau)`; at zero tension the just-slack one, `-eps`.
    pub fn deformation(&self, tension: f64) -> f64 {
        let (k, eps) = (self.stiffness, self.epsilon);
        if tension <= 2.0 * k * eps { (2.0 * eps * tension.max(0.0) / k).sqrt() - eps } else { tension / (2.0 * k) }
    }

    /// Length of the element at coordinates `x`.
    pub fn length(&self, x: &[f64]) -> f64 {
        let point = self.point();
        self.routing.windows(2).map(|s| segment(x, s, point).2).sum()
    }

    /// Width below which two points are one, length.
    pub(crate) fn point(&self) -> f64 {
        POINT * self.alpha0
    }

    /// What a residual at its nodes is compared with, where it has this length, tension and tangent.
    fn add_scales(&self, x: &[f64], length: f64, (tau, tangent): (f64, f64), scales: &mut Scales) {
        if tau == 0.0 && tangent == 0.0 {
            return;
        }
        for &n in &self.routing {
            scales.add_force(n, [tau; 2]);
        }
        // The tension changes with the length, and the direction of a segment the more, the shorter it is.
        let along = tangent * length;
        for s in self.routing.windows(2) {
            let size = s.iter().fold(0.0, |m: f64, n| m.max(x[2 * n].abs()).max(x[2 * n + 1].abs()));
            let force = ROUNDING * (along + tau / segment(x, s, self.point()).2 * size);
            for &n in s {
                scales.add_rounding(n, [force; 2]);
            }
        }
    }

    /// Adds `factor * dl/dx` to `out`.
    pub fn add_length_gradient(&self, x: &[f64], factor: f64, out: &mut [f64]) {
        let point = self.point();
        for s in self.routing.windows(2) {
            add_direction([s[0], s[1]], segment(x, s, point), factor, out);
        }
    }

    /// `dl/dx . v`.
    pub fn length_rate(&self, x: &[f64], v: &[f64]) -> f64 {
        let (mut rate, point) = (0.0, self.point());
        for s in self.routing.windows(2) {
            let (dx, dy, length) = segment(x, s, point);
            let (vx, vy) = (v[2 * s[1]] - v[2 * s[0]], v[2 * s[1] + 1] - v[2 * s[0] + 1]);
            rate += (dx * vx + dy * vy) / length;
        }
        rate
    }
}

/// Adds `factor` times the unit vector of a segment (`dx`, `dy`, length) at its second end, and the opposite at its first.
fn add_direction([a, b]: [usize; 2], (dx, dy, length): (f64, f64, f64), factor: f64, out: &mut [f64]) {
    let (fx, fy) = (factor * dx / length, factor * dy / length);
    out[2 * a] -= fx;
    out[2 * a + 1] -= fy;
    out[2 * b] += fx;
    out[2 * b + 1] += fy;
}

/// Coordinate differences of a segment, and its length between points of this width.
fn segment(x: &[f64], s: &[usize], point: f64) -> (f64, f64, f64) {
    let (dx, dy) = (x[2 * s[1]] - x[2 * s[0]], x[2 * s[1] + 1] - x[2 * s[0] + 1]);
    (dx, dy, (dx * dx + dy * dy + point * point).sqrt())
}

/// All elements of a model and their present laws.
pub struct Contractile {
    pub elements: Vec<Element>,
    pub laws: Vec<Law>,
    stencils: Vec<Vec<usize>>,
    /// For each element, the stencil position of each routing entry.
    positions: Vec<Vec<usize>>,
    /// The elements of one segment, and the places of all others.
    straight: Segments,
    routed: Vec<usize>,
}

impl Contractile {
    /// Elements at zero contraction.
    pub fn new(elements: Vec<Element>) -> Self {
        let mut stencils = Vec::with_capacity(elements.len());
        let mut positions = Vec::with_capacity(elements.len());
        for e in &elements {
            let mut nodes = e.routing.clone();
            nodes.sort_unstable();
            nodes.dedup();
            positions.push(e.routing.iter().map(|n| nodes.partition_point(|m| m < n)).collect());
            stencils.push(nodes);
        }
        let laws = elements.iter().map(|e| Law::Spring { alpha: e.alpha0 }).collect();
        let straight = Segments::new(&elements);
        let routed = (0..elements.len()).filter(|&k| !is_straight(&elements[k])).collect();
        Self { elements, laws, stencils, positions, straight, routed }
    }

    /// Makes every element a spring at contraction `alpha_c`.
    pub fn set_contractions(&mut self, contractions: &[f64]) {
        for ((law, e), c) in self.laws.iter_mut().zip(&self.elements).zip(contractions) {
            *law = Law::Spring { alpha: e.alpha0 - c };
        }
    }

    /// Tension of every element at `x`.
    pub fn tensions(&self, x: &[f64]) -> Vec<f64> {
        self.elements.iter().zip(&self.laws).map(|(e, law)| law.tension_and_tangent(e, e.length(x)).0).collect()
    }
}

impl Law {
    /// `(tau, dtau/dl)` at length `l`.
    pub fn tension_and_tangent(&self, element: &Element, length: f64) -> (f64, f64) {
        match *self {
            Law::Spring { alpha } => (element.tension(length - alpha), element.tangent(length - alpha)),
            Law::Tension(tau) => (tau, 0.0),
            Law::Elastic { tension, length: at, stiffness } => {
                let tau = tension + stiffness * (length - at);
                if tau > 0.0 { (tau, stiffness) } else { (0.0, 0.0) }
            }
        }
    }

    /// The energy at length `l`, whose derivative the tension is.
    fn energy(&self, element: &Element, length: f64) -> f64 {
        match *self {
            Law::Spring { alpha } => element.energy(length - alpha),
            Law::Tension(tau) => tau * length,
            Law::Elastic { tension, length: at, stiffness } => {
                let stretch = if stiffness > 0.0 { (length - at).max(-tension / stiffness) } else { length - at };
                (tension + 0.5 * stiffness * stretch) * stretch
            }
        }
    }
}

impl Energy for Contractile {
    fn stencils(&self) -> usize {
        self.stencils.len()
    }

    fn stencil(&self, k: usize) -> &[usize] {
        &self.stencils[k]
    }

    fn value(&self, x: &[f64]) -> f64 {
        let mut energy = 0.0;
        for (e, law) in self.elements.iter().zip(&self.laws) {
            if *law != Law::Tension(0.0) {
                energy += law.energy(e, e.length(x));
            }
        }
        if energy.is_nan() { f64::INFINITY } else { energy }
    }

    fn add_gradient(&self, x: &[f64], gradient: &mut [f64]) {
        self.straight.add_gradient(&self.elements, &self.laws, x, gradient, None);
        for (e, law) in self.routed() {
            let tau = law.tension_and_tangent(e, e.length(x)).0;
            if tau != 0.0 {
                e.add_length_gradient(x, tau, gradient);
            }
        }
    }

    fn add_hessian(&self, x: &[f64], _form: HessianForm, out: &mut Scatter) {
        self.straight.add_hessian(&self.elements, &self.laws, x, out);
        let mut stack = [[0.0; 3]; ON_STACK];
        let mut heap = Vec::new();
        for (&k, (e, law)) in self.routed.iter().zip(self.routed()) {
            let (tau, tangent) = law.tension_and_tangent(e, e.length(x));
            if tau == 0.0 && tangent == 0.0 {
                continue;
            }
            let positions = &self.positions[k];
            let count = e.routing.len();
            let scratch = if 2 * count <= ON_STACK {
                &mut stack[..2 * count]
            } else {
                heap.resize(2 * count, [0.0; 3]);
                &mut heap[..]
            };
            add_routed(k, e, positions, x, tau, tangent, scratch, out);
        }
    }

    /// A taut segment on its way to nothing would be thrown back and forth across its end, where the length has its kink: it may
    /// come nearer to it by a factor of ten a step.
    fn step_limit(&self, x: &[f64], dx: &[f64]) -> f64 {
        let one = |(e, law): (&Element, &Law), limit: f64| {
            e.routing.windows(2).fold(limit, |limit, s| {
                let (px, py) = (x[2 * s[1]] - x[2 * s[0]], x[2 * s[1] + 1] - x[2 * s[0] + 1]);
                let (vx, vy) = (dx[2 * s[1]] - dx[2 * s[0]], dx[2 * s[1] + 1] - dx[2 * s[0] + 1]);
                let along = px * vx + py * vy;
                let most = TURNING_MARGIN * (px * px + py * py);
                // Nearly all are far from turning: neither their lengths nor their tensions are needed.
                if along.is_nan() || along >= 0.0 || most >= -along * limit {
                    return limit;
                }
                let point = e.point();
                let taut = || law.tension_and_tangent(e, e.length(x)).0 > 0.0;
                if segment(x, s, point).2 > ROUND * point && taut() { most / -along } else { limit }
            })
        };
        let mut limit = 1.0;
        self.straight.first_turn(x, dx, TURNING_MARGIN, &mut |k, before| {
            limit = one((&self.elements[k], &self.laws[k]), before);
            limit
        });
        self.routed().fold(limit, |limit, element| one(element, limit))
    }

    fn add_scales(&self, x: &[f64], scales: &mut Scales) {
        for (e, law) in self.elements.iter().zip(&self.laws) {
            let length = e.length(x);
            e.add_scales(x, length, law.tension_and_tangent(e, length), scales);
        }
    }

    fn add_gradient_and_scales(&self, x: &[f64], gradient: &mut [f64], scales: &mut Scales) {
        self.straight.add_gradient(&self.elements, &self.laws, x, gradient, Some(&mut *scales));
        for (e, law) in self.routed() {
            let length = e.length(x);
            let (tau, tangent) = law.tension_and_tangent(e, length);
            if tau != 0.0 {
                e.add_length_gradient(x, tau, gradient);
            }
            e.add_scales(x, length, (tau, tangent), scales);
        }
    }
}

impl Contractile {
    /// Length of every element at `x` into `lengths`.
    pub fn lengths_into(&self, x: &[f64], lengths: &mut [f64]) {
        self.straight.lengths(&self.elements, x, lengths);
        for &k in &self.routed {
            lengths[k] = self.elements[k].length(x);
        }
    }

    /// Tension of every element at `x` into `tensions`.
    pub fn tensions_into(&self, x: &[f64], tensions: &mut [f64]) {
        self.straight.tensions(&self.elements, &self.laws, x, tensions);
        for (&k, (e, law)) in self.routed.iter().zip(self.routed()) {
            tensions[k] = law.tension_and_tangent(e, e.length(x)).0;
        }
    }

    /// Elements with via points, and their laws.
    fn routed(&self) -> impl Iterator<Item = (&Element, &Law)> {
        self.routed.iter().map(|&k| (&self.elements[k], &self.laws[k]))
    }
}

/// Entries of scratch memory that need no allocation: 24 KiB, enough for a tendon through 512 nodes.
const ON_STACK: usize = 1024;

/// The Hessian `U'' G^T G + tau d2l` of an element of any routing, which may pass a node several times. `scratch` has twice as many entries as the routing.
#[allow(clippy::too_many_arguments)]
fn add_routed(
    k: usize,
    e: &Element,
    positions: &[usize],
    x: &[f64],
    tau: f64,
    tangent: f64,
    scratch: &mut [[f64; 3]],
    out: &mut Scatter,
) {
    let half = scratch.len() / 2;
    let point = e.point();
    let (g, units) = scratch.split_at_mut(half);
    g.fill([0.0; 3]);
    for ((s, p), unit) in e.routing.windows(2).zip(positions.windows(2)).zip(units.iter_mut()) {
        let (dx, dy, length) = segment(x, s, point);
        let (ux, uy) = (dx / length, dy / length);
        g[p[0]][0] -= ux;
        g[p[0]][1] -= uy;
        g[p[1]][0] += ux;
        g[p[1]][1] += uy;
        // d2 of a length is (I - u u^T) / l = (n n^T + (w/l)^2 I) / l: the normal and the width, times the root of tau/l.
        let root = (tau / length).sqrt();
        *unit = [-uy * root, ux * root, point / length * root];
    }
    out.add(k, |a, b| {
        let (ga, gb) = (g[a], g[b]);
        let mut block =
            [tangent * ga[0] * gb[0], tangent * ga[0] * gb[1], tangent * ga[1] * gb[0], tangent * ga[1] * gb[1]];
        for (p, n) in positions.windows(2).zip(units.iter()) {
            let sign = ((a == p[0]) as i32 - (a == p[1]) as i32) * ((b == p[0]) as i32 - (b == p[1]) as i32);
            if sign != 0 {
                let s = sign as f64;
                let ww = n[2] * n[2];
                block[0] += s * (n[0] * n[0] + ww);
                block[1] += s * n[0] * n[1];
                block[2] += s * n[1] * n[0];
                block[3] += s * (n[1] * n[1] + ww);
            }
        }
        block
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element() -> Element {
        Element { routing: vec![0, 1], stiffness: 3.0, epsilon: 0.02, alpha0: 1.0 }
    }

    #[test]
    fn the_unilateral_energy_is_twice_continuously_differentiable() {
        let e = element();
        for at in [-e.epsilon, e.epsilon] {
            let (low, high) = (at - 1e-12, at + 1e-12);
            assert!((e.energy(low) - e.energy(high)).abs() < 1e-11);
            assert!((e.tension(low) - e.tension(high)).abs() < 1e-9);
            assert!((e.tangent(low) - e.tangent(high)).abs() < 1e-7);
        }
        assert_eq!(e.energy(-0.03), 0.0);
        assert_eq!(e.tangent(0.5), 6.0);
        assert!((e.tension(0.0) - 3.0 * 0.02 / 2.0).abs() < 1e-16);
    }

    #[test]
    fn derivatives_decay_with_second_order_in_every_zone() {
        let e = element();
        for gamma in [-0.05, -0.01, 0.011, 0.3] {
            let error = |h: f64| ((e.energy(gamma + h) - e.energy(gamma - h)) / (2.0 * h) - e.tension(gamma)).abs();
            assert!(error(5e-4) < 1e-10 || error(1e-3) / error(5e-4) > 3.5);
            let error = |h: f64| ((e.tension(gamma + h) - e.tension(gamma - h)) / (2.0 * h) - e.tangent(gamma)).abs();
            assert!(error(5e-4) < 1e-10);
        }
    }

    #[test]
    fn every_law_has_the_derivatives_that_it_says() {
        let e = element();
        let laws = [
            Law::Spring { alpha: 0.9 },
            Law::Tension(0.7),
            Law::Elastic { tension: 0.4, length: 1.0, stiffness: 2.0 },
            Law::Elastic { tension: 0.4, length: 1.4, stiffness: 2.0 },
        ];
        for law in laws {
            for length in [0.7, 0.95, 1.3] {
                let h = 1e-5;
                let by_energy = (law.energy(&e, length + h) - law.energy(&e, length - h)) / (2.0 * h);
                let (tau, tangent) = law.tension_and_tangent(&e, length);
                assert!((by_energy - tau).abs() < 1e-9, "{law:?} at {length}");
                let [up, down] = [h, -h].map(|h| law.tension_and_tangent(&e, length + h).0);
                assert!(((up - down) / (2.0 * h) - tangent).abs() < 1e-8, "{law:?} at {length}");
            }
        }
    }

    #[test]
    fn deformation_inverts_tension() {
        let e = element();
        assert_eq!(e.deformation(0.0), -e.epsilon);
        for tension in [1e-6, 0.05, 0.12, 0.5, 40.0] {
            assert!((e.tension(e.deformation(tension)) - tension).abs() < 1e-12 * (1.0 + tension));
        }
    }
}
