//! All contractile elements of a model as one energy term: those of one segment many at a time, the others one by one.

use super::element::{Element, Law, difference, segment};
use super::energy::{Energy, HessianForm, Scales};
use super::material_point::MaterialPoint;
use super::pattern::Scatter;
use super::routed::Routed;
use super::segments::{Segments, straight};

/// A step may take at most this part of the way on which a taut segment would turn over.
const TURNING_MARGIN: f64 = 0.9;
/// Segments up to this many points wide may turn over: there the length is smooth.
const ROUND: f64 = 10.0;

/// All elements of a model and their present laws.
pub struct Contractile {
    pub elements: Vec<Element>,
    pub laws: Vec<Law>,
    stencils: Vec<Vec<usize>>,
    /// The elements of one segment between nodes, and all others.
    straight: Segments,
    routed: Vec<Routed>,
}

impl Contractile {
    /// Elements at zero contraction.
    pub fn new(elements: Vec<Element>) -> Self {
        let stencils: Vec<Vec<usize>> = elements.iter().map(stencil).collect();
        let laws = elements.iter().map(|e| Law::Spring { alpha: e.alpha0 }).collect();
        let others = elements.iter().enumerate().filter(|(_, e)| straight(e).is_none());
        let routed = others.map(|(k, e)| Routed::new(k, e, &stencils[k])).collect();
        let straight = Segments::new(&elements);
        Self { elements, laws, stencils, straight, routed }
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
        for routed in &self.routed {
            let (e, law) = (&self.elements[routed.element], &self.laws[routed.element]);
            let (tau, tangent) = law.tension_and_tangent(e, e.length(x));
            if tau != 0.0 || tangent != 0.0 {
                routed.add_hessian(e, x, tau, tangent, out);
            }
        }
    }

    /// A taut segment on its way to nothing would be thrown back and forth across its end, where the length has its kink: it may
    /// come nearer to it by a factor of ten a step.
    fn step_limit(&self, x: &[f64], dx: &[f64]) -> f64 {
        let one = |(e, law): (&Element, &Law), limit: f64| {
            e.routing.windows(2).fold(limit, |limit, s| {
                let ((px, py), (vx, vy)) = (difference(x, s), difference(dx, s));
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
        for &Routed { element: k, .. } in &self.routed {
            lengths[k] = self.elements[k].length(x);
        }
    }

    /// Tension of every element at `x` into `tensions`.
    pub fn tensions_into(&self, x: &[f64], tensions: &mut [f64]) {
        self.straight.tensions(&self.elements, &self.laws, x, tensions);
        for (Routed { element: k, .. }, (e, law)) in self.routed.iter().zip(self.routed()) {
            tensions[*k] = law.tension_and_tangent(e, e.length(x)).0;
        }
    }

    /// All elements but the straight ones, and their laws.
    fn routed(&self) -> impl Iterator<Item = (&Element, &Law)> {
        self.routed.iter().map(|r| (&self.elements[r.element], &self.laws[r.element]))
    }
}

/// The distinct nodes that carry an element, ascending.
fn stencil(element: &Element) -> Vec<usize> {
    let mut nodes: Vec<usize> = element.routing.iter().flat_map(MaterialPoint::parts).map(|(n, _)| n).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
