//! A plushie ready to be solved: terms, fixed sparsity pattern, factorisation.

use super::cholesky::{Cholesky, NotPositiveDefinite};
use super::energy::{Energy, HessianForm};
use super::pattern::{Pattern, Scatter, Slots};
use super::{Body, Contractile, Pins};

/// Stiffness that holds a rigid motion no pin holds, as a fraction of the shear modulus: far below any real stiffness,
/// far above rounding. It acts on steps only (it is not part of `E`), so that equilibria are exact.
const RIGID_SHIFT: f64 = 1e-8;

/// Stiffness that holds a mechanism (everything slack) where even the projected Hessian is singular, as a fraction of the shear
/// modulus. Only the step feels it: larger would slow Newton down, smaller drowns in rounding.
const MECHANISM_SHIFT: f64 = 1e-6;

/// Why no model can be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ModelError {
    #[error("triangle {0} is clockwise, flat or not finite")]
    Triangle(usize),
    #[error("the model is too large for the memory of this machine")]
    Memory,
}

/// The terms of `E`, the pattern of its Hessian, and the factor of the last one.
pub struct Model {
    pub body: Body,
    pub contractile: Contractile,
    pub pins: Pins,
    /// Optional terms; absent ones cost nothing.
    pub terms: Vec<Box<dyn Energy>>,
    /// Rest coordinates `X`, flat.
    pub rest: Vec<f64>,
    pattern: Pattern,
    slots: Vec<Slots>,
    values: Vec<f64>,
    cholesky: Cholesky,
    /// Diagonal shift of every node that a free rigid motion can move; zero elsewhere.
    shift: Vec<f64>,
    free_pieces: usize,
}

impl Model {
    /// Compiles the terms: pattern, symbolic factorisation, free rigid motions.
    pub fn new(
        nodes: &[[f64; 2]],
        body: Body,
        contractile: Contractile,
        pins: Pins,
        terms: Vec<Box<dyn Energy>>,
    ) -> Result<Self, ModelError> {
        let rest: Vec<f64> = nodes.iter().flatten().copied().collect();
        let (pattern, slots) = {
            let all: Vec<&dyn Energy> = all_terms(&body, &contractile, &pins, &terms).collect();
            let pattern =
                Pattern::new(nodes.len(), all.iter().flat_map(|t| (0..t.stencils()).map(move |k| t.stencil(k))));
            let slots = all.iter().map(|t| pattern.slots((0..t.stencils()).map(|k| t.stencil(k)))).collect();
            (pattern, slots)
        };
        let cholesky = Cholesky::new(&pattern).ok_or(ModelError::Memory)?;
        let values = vec![0.0; pattern.nonzeros()];
        let (shift, free_pieces) = rigid_shift(nodes, &body, &pins);
        Ok(Self { body, contractile, pins, terms, rest, pattern, slots, values, cholesky, shift, free_pieces })
    }

    pub fn dimension(&self) -> usize {
        self.rest.len()
    }

    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// The lower-triangle values of the Hessian assembled last.
    pub fn hessian_values(&self) -> &[f64] {
        &self.values
    }

    /// Number of pieces of the body that no pins hold fully (a rotation about one pin counts as free).
    pub fn free_pieces(&self) -> usize {
        self.free_pieces
    }

    fn all(&self) -> impl Iterator<Item = &dyn Energy> {
        all_terms(&self.body, &self.contractile, &self.pins, &self.terms)
    }

    /// `E(x)`, infinite where a term is outside its domain.
    pub fn energy(&self, x: &[f64]) -> f64 {
        self.all().map(|t| t.value(x)).sum()
    }

    /// `dE/dx` into `gradient`.
    pub fn gradient(&self, x: &[f64], gradient: &mut [f64]) {
        gradient.fill(0.0);
        for term in self.all() {
            term.add_gradient(x, gradient);
        }
    }

    /// The forces at work: the largest sum of magnitudes of the single forces that meet in a node's component.
    pub fn force_scale(&self, x: &[f64]) -> f64 {
        self.force_scale_into(x, &mut vec![0.0; x.len()])
    }

    /// The same, with the sums left in `scale`.
    pub fn force_scale_into(&self, x: &[f64], scale: &mut [f64]) -> f64 {
        scale.fill(0.0);
        for term in self.all() {
            term.add_force_scale(x, scale);
        }
        scale.iter().copied().fold(0.0, f64::max)
    }

    /// Largest step along `dx` that keeps every term inside its domain.
    pub fn step_limit(&self, x: &[f64], dx: &[f64]) -> f64 {
        self.all().map(|t| t.step_limit(x, dx)).fold(1.0, f64::min)
    }

    /// Assembles `H(x)` and factorises it.
    pub fn factorize(&mut self, x: &[f64], form: HessianForm) -> Result<(), NotPositiveDefinite> {
        self.values.fill(0.0);
        for (term, slots) in all_terms(&self.body, &self.contractile, &self.pins, &self.terms).zip(&self.slots) {
            term.add_hessian(x, form, &mut Scatter::new(slots, &mut self.values));
        }
        for (d, shift) in self.shift.iter().enumerate() {
            if *shift > 0.0 {
                self.values[self.pattern.diagonal(d)] += shift;
            }
        }
        self.cholesky.factorize(&self.pattern, &self.values)
    }

    /// The exact Hessian where it is positive definite, else the projected one. Says which it was; an error means that
    /// even the projected one failed.
    pub fn factorize_for_descent(&mut self, x: &[f64]) -> Result<HessianForm, NotPositiveDefinite> {
        if self.factorize(x, HessianForm::Exact).is_ok() {
            return Ok(HessianForm::Exact);
        }
        if self.factorize(x, HessianForm::Projected).is_ok() {
            return Ok(HessianForm::Projected);
        }
        // A mechanism without stiffness (slack everywhere): hold it by a small part of the shear modulus.
        let shift = MECHANISM_SHIFT * self.body.material().shear_modulus();
        for d in 0..self.pattern.dimension() {
            self.values[self.pattern.diagonal(d)] += shift;
        }
        self.cholesky.factorize(&self.pattern, &self.values).map(|()| HessianForm::Projected)
    }

    /// Solves with the factor of the last assembled Hessian, in place.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.cholesky.solve(rhs);
    }

    /// The same for several right-hand sides stored one after the other.
    pub fn solve_many(&mut self, rhs: &mut [f64], columns: usize) {
        self.cholesky.solve_many(rhs, columns);
    }
}

fn all_terms<'a>(
    body: &'a Body,
    contractile: &'a Contractile,
    pins: &'a Pins,
    terms: &'a [Box<dyn Energy>],
) -> impl Iterator<Item = &'a dyn Energy> {
    [body as &dyn Energy, contractile, pins].into_iter().chain(terms.iter().map(|t| t.as_ref()))
}

/// Finds the pieces of the body that fewer than two distinct pinned points hold, and shifts their nodes.
fn rigid_shift(nodes: &[[f64; 2]], body: &Body, pins: &Pins) -> (Vec<f64>, usize) {
    let mut piece: Vec<usize> = (0..nodes.len()).collect();
    fn find(piece: &mut [usize], mut i: usize) -> usize {
        while piece[i] != i {
            piece[i] = piece[piece[i]];
            i = piece[i];
        }
        i
    }
    for t in body.triangles() {
        for &n in &t[1..] {
            let (a, b) = (find(&mut piece, t[0]), find(&mut piece, n));
            piece[a.max(b)] = a.min(b);
        }
    }
    let mut held: Vec<Vec<[f64; 2]>> = vec![Vec::new(); nodes.len()];
    for pin in pins.pins.iter().filter(|p| p.stiffness > 0.0) {
        let mut at = [0.0; 2];
        for (&n, w) in pin.nodes.iter().zip(&pin.weights) {
            at[0] += w * nodes[n][0];
            at[1] += w * nodes[n][1];
        }
        let root = find(&mut piece, pin.nodes[0]);
        if !held[root].contains(&at) {
            held[root].push(at);
        }
    }
    let shift = RIGID_SHIFT * body.material().shear_modulus();
    let mut out = vec![0.0; 2 * nodes.len()];
    let mut free = 0;
    for i in 0..nodes.len() {
        let root = find(&mut piece, i);
        if held[root].len() < 2 {
            out[2 * i] = shift;
            out[2 * i + 1] = shift;
            free += (root == i) as usize;
        }
    }
    (out, free)
}
