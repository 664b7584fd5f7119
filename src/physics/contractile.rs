//! All contractile elements of a model as one energy term: those of one segment many at a time, the others one by one.

use super::element::{Element, Law, segment};
use super::energy::{Energy, HessianForm, Scales};
use super::pattern::Scatter;
use super::segments::{Segments, is_straight};

/// A step may take at most this part of the way on which a taut segment would turn over.
const TURNING_MARGIN: f64 = 0.9;
/// Segments up to this many points wide may turn over: there the length is smooth.
const ROUND: f64 = 10.0;

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
