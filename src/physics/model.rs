//! A plushie ready to be solved: terms, fixed sparsity pattern, factorisation.

use super::cholesky::{Cholesky, NotPositiveDefinite};
use super::energy::{Energy, HessianForm, Scales};
use super::pattern::{Pattern, Scatter, Slots};
use super::{Body, Contractile, Pins};
use std::ops::Range;

/// Stiffness that holds a rigid motion no pin holds, as a fraction of the shear modulus: far below any real stiffness,
/// far above rounding. It acts on steps only (it is not part of `E`), so that equilibria are exact.
const RIGID_SHIFT: f64 = 1e-8;

/// Stiffness that holds a mechanism (everything slack) where even the projected Hessian is singular, as a fraction of the shear
/// modulus. Only the step feels it: larger would slow Newton down, smaller drowns in rounding.
const MECHANISM_SHIFT: f64 = 1e-6;
/// Where it does not suffice, it grows by this factor, so many times: up to `1e9` shear moduli.
const SHIFT_GROWTH: f64 = 1e3;
const SHIFTS: usize = 6;

/// A free part whose forces add up to this fraction of their magnitudes is pulled away: far above rounding.
const PULLED_AWAY: f64 = 1e-9;

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
    pieces: usize,
    loose: Vec<Loose>,
    /// Nodes of every part of the plushie (pieces that elements tie together count as one) that no pin holds.
    unpinned: Vec<Vec<usize>>,
}

/// A piece of the body that no pins hold fully.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loose {
    /// Its smallest node.
    pub node: usize,
    /// Distinct pinned points: 0, or 1 about which it can turn.
    pub pinned: usize,
}

impl Model {
    /// Compiles the terms: pattern, symbolic factorisation, free rigid motions.
    ///
    /// # Errors
    /// [`ModelError::Memory`] for a model whose factor does not fit.
    pub fn new(
        nodes: &[[f64; 2]],
        body: Body,
        contractile: Contractile,
        pins: Pins,
        terms: Vec<Box<dyn Energy>>,
    ) -> Result<Self, ModelError> {
        let rest: Vec<f64> = nodes.iter().flatten().copied().collect();
        let (pattern, slots, cholesky) = {
            let all: Vec<&dyn Energy> = all_terms(&body, &contractile, &pins, &terms).collect();
            let pattern =
                Pattern::new(nodes.len(), all.iter().flat_map(|t| (0..t.stencils()).map(move |k| t.stencil(k))));
            let (pattern, cholesky) = Cholesky::ordered(&pattern).ok_or(ModelError::Memory)?;
            let slots = all.iter().map(|t| pattern.slots((0..t.stencils()).map(|k| t.stencil(k)))).collect();
            (pattern, slots, cholesky)
        };
        let values = vec![0.0; pattern.nonzeros()];
        let Freedom { shift, pieces, loose, unpinned } = Freedom::of(nodes, &body, &contractile, &pins);
        Ok(Self {
            body,
            contractile,
            pins,
            terms,
            rest,
            pattern,
            slots,
            values,
            cholesky,
            shift,
            pieces,
            loose,
            unpinned,
        })
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
        self.loose.len()
    }

    /// The pieces that [`Self::free_pieces`] counts, by their smallest nodes.
    pub fn loose(&self) -> &[Loose] {
        &self.loose
    }

    /// Number of pieces that the triangles make up. A node that neither triangles nor elements use counts for nothing.
    pub fn pieces(&self) -> usize {
        self.pieces
    }

    /// Whether a part of the plushie that no pin holds is pulled away as a whole: its forces add up to more than rounding
    /// leaves of them, and no deformation can balance that. `gradient` and `scale` are those of the state.
    pub fn is_pulled_away(&self, gradient: &[f64], scale: &[f64]) -> bool {
        self.unpinned.iter().any(|nodes| {
            (0..2).any(|axis| {
                let sum = |v: &[f64]| nodes.iter().map(|n| v[2 * n + axis]).sum::<f64>();
                sum(gradient).abs() > PULLED_AWAY * sum(scale)
            })
        })
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

    /// The forces at work: the largest sum of magnitudes of the single forces that meet in a node's component, with what a
    /// change of the coordinates in the sixth digit does to stiff springs.
    pub fn force_scale(&self, x: &[f64]) -> f64 {
        self.force_scale_into(x, &mut vec![0.0; x.len()])
    }

    /// [`Self::force_scale`], with the sums left in `scale`.
    pub fn force_scale_into(&self, x: &[f64], scale: &mut [f64]) -> f64 {
        let mut scales = Scales::together(scale);
        self.all().for_each(|term| term.add_scales(x, &mut scales));
        scale.iter().copied().fold(0.0, f64::max)
    }

    /// [`Self::gradient`] and [`Self::force_scale_into`] in one pass, up to rounding.
    pub fn gradient_and_scale(&self, x: &[f64], gradient: &mut [f64], scale: &mut [f64]) -> f64 {
        gradient.fill(0.0);
        let mut scales = Scales::together(scale);
        self.all().for_each(|term| term.add_gradient_and_scales(x, gradient, &mut scales));
        scale.iter().copied().fold(0.0, f64::max)
    }

    /// The sums apart, entry by entry: the forces at work, and what a change of the coordinates in the sixth digit does to stiff
    /// springs. Returns the largest of the forces at work.
    pub fn scales_into(&self, x: &[f64], at_work: &mut [f64], rounding: &mut [f64]) -> f64 {
        let mut scales = Scales::apart(at_work, rounding);
        self.all().for_each(|term| term.add_scales(x, &mut scales));
        at_work.iter().copied().fold(0.0, f64::max)
    }

    /// Largest step along `dx` that keeps every term inside its domain.
    pub fn step_limit(&self, x: &[f64], dx: &[f64]) -> f64 {
        self.all().map(|t| t.step_limit(x, dx)).fold(1.0, f64::min)
    }

    /// Assembles `H(x)` and factorises it.
    ///
    /// # Errors
    /// `H` is not positive definite.
    pub fn factorize(&mut self, x: &[f64], form: HessianForm) -> Result<(), NotPositiveDefinite> {
        self.assemble(x, form);
        self.factorize_assembled()
    }

    /// Factorises the Hessian assembled last.
    ///
    /// # Errors
    /// It is not positive definite.
    pub fn factorize_assembled(&mut self) -> Result<(), NotPositiveDefinite> {
        self.cholesky.factorize(&self.pattern, &self.values)
    }

    /// Assembles `H(x)` with `shift` on the whole diagonal and factorises it.
    pub(super) fn factorize_shifted(
        &mut self,
        x: &[f64],
        form: HessianForm,
        shift: f64,
    ) -> Result<(), NotPositiveDefinite> {
        self.assemble(x, form);
        for d in 0..self.pattern.dimension() {
            self.values[self.pattern.diagonal(d)] += shift;
        }
        self.cholesky.factorize(&self.pattern, &self.values)
    }

    /// Assembles `H(x)`.
    pub fn assemble(&mut self, x: &[f64], form: HessianForm) {
        self.values.fill(0.0);
        for (term, slots) in all_terms(&self.body, &self.contractile, &self.pins, &self.terms).zip(&self.slots) {
            term.add_hessian(x, form, &mut Scatter::new(slots, &mut self.values));
        }
        for (d, shift) in self.shift.iter().enumerate() {
            if *shift > 0.0 {
                self.values[self.pattern.diagonal(d)] += shift;
            }
        }
    }

    /// Adds to the Hessian assembled last what is no term of `E`.
    pub(super) fn add_assembled(&mut self, slots: &Slots, add: impl FnOnce(&mut Scatter)) {
        add(&mut Scatter::new(slots, &mut self.values));
    }

    /// The exact Hessian where it is positive definite, else the projected one. Says which it was; an error means that
    /// even the projected one failed.
    ///
    /// # Errors
    /// Neither is positive definite.
    pub fn factorize_for_descent(&mut self, x: &[f64]) -> Result<HessianForm, NotPositiveDefinite> {
        match self.factorize(x, HessianForm::Exact) {
            Ok(()) => Ok(HessianForm::Exact),
            Err(_) => self.factorize_projected(x).map(|()| HessianForm::Projected),
        }
    }

    /// The projected Hessian, held where even that is singular.
    ///
    /// # Errors
    /// It is not positive definite even when held.
    pub fn factorize_projected(&mut self, x: &[f64]) -> Result<(), NotPositiveDefinite> {
        if self.factorize(x, HessianForm::Projected).is_ok() {
            return Ok(());
        }
        // A mechanism without stiffness (slack everywhere): hold it by a small part of the shear modulus, or by more where
        // rounding of far stiffer parts drowns that.
        let mut shift = MECHANISM_SHIFT * self.body.material().shear_modulus();
        let mut shifted = 0.0;
        for _ in 0..SHIFTS {
            for d in 0..self.pattern.dimension() {
                self.values[self.pattern.diagonal(d)] += shift - shifted;
            }
            if self.cholesky.factorize(&self.pattern, &self.values).is_ok() {
                return Ok(());
            }
            (shifted, shift) = (shift, SHIFT_GROWTH * shift);
        }
        Err(NotPositiveDefinite)
    }

    /// Whether the last factorisation has succeeded.
    pub fn has_factor(&self) -> bool {
        self.cholesky.is_valid()
    }

    /// Solves with the factor of the last assembled Hessian, in place.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.cholesky.solve(rhs);
    }

    /// [`Self::solve`] for several right-hand sides stored one after the other.
    pub fn solve_many(&mut self, rhs: &mut [f64], columns: usize) {
        self.cholesky.solve_many(rhs, columns);
    }

    /// [`Self::solve`] for the right-hand sides `solved` of `columns`, stored row after row: of each degree of freedom all columns.
    pub fn solve_rows(&mut self, rhs: &mut [f64], columns: usize, solved: Range<usize>) {
        self.cholesky.solve_rows(rhs, columns, solved);
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

/// What holds the pieces of a plushie, and what does not.
struct Freedom {
    shift: Vec<f64>,
    pieces: usize,
    loose: Vec<Loose>,
    unpinned: Vec<Vec<usize>>,
}

impl Freedom {
    /// A piece needs pins at two distinct points, or slides that hold as much; else its nodes are shifted.
    fn of(nodes: &[[f64; 2]], body: &Body, contractile: &Contractile, pins: &Pins) -> Self {
        let mut pieces = Groups::new(nodes.len());
        for t in body.triangles() {
            pieces.join(t[0], t[1]);
            pieces.join(t[0], t[2]);
        }
        let mut held: Vec<Vec<[f64; 2]>> = vec![Vec::new(); nodes.len()];
        let mut slides: Vec<Vec<Slide>> = vec![Vec::new(); nodes.len()];
        let pinning = || pins.pins.iter().filter(|p| p.stiffness > 0.0);
        for pin in pinning() {
            let mut at = [0.0; 2];
            for (&n, w) in pin.nodes.iter().zip(&pin.weights) {
                at[0] += w * nodes[n][0];
                at[1] += w * nodes[n][1];
            }
            let root = pieces.root(pin.nodes[0]);
            match pin.slide {
                Some([dx, dy]) => slides[root].push(Slide { at, across: [-dy, dx] }),
                None if !held[root].contains(&at) => held[root].push(at),
                None => {}
            }
        }
        let (mut in_body, mut used) = (vec![false; nodes.len()], vec![false; nodes.len()]);
        body.triangles().iter().flatten().for_each(|&n| in_body[n] = true);
        let routed = (0..contractile.stencils()).flat_map(|k| contractile.stencil(k));
        body.triangles().iter().flatten().chain(routed).for_each(|&n| used[n] = true);
        let shift_by = RIGID_SHIFT * body.material().shear_modulus();
        let mut shift = vec![0.0; 2 * nodes.len()];
        let (mut count, mut loose) = (0, Vec::new());
        for i in 0..nodes.len() {
            let root = pieces.root(i);
            count += (root == i && used[i]) as usize;
            let pinned = held[root].len();
            // A single point cannot turn.
            let needed = if in_body[i] { 2 } else { 1 };
            if pinned < needed && !holds(&held[root], &slides[root], needed) {
                shift[2 * i] = shift_by;
                shift[2 * i + 1] = shift_by;
                if root == i && used[i] {
                    loose.push(Loose { node: i, pinned });
                }
            }
        }
        // Elements tie pieces together: a part is all that hangs together somehow.
        let mut parts = pieces.clone();
        for k in 0..contractile.stencils() {
            let stencil = contractile.stencil(k);
            stencil.iter().for_each(|&n| parts.join(stencil[0], n));
        }
        let mut is_pinned = vec![false; nodes.len()];
        for pin in pinning() {
            is_pinned[parts.root(pin.nodes[0])] = true;
        }
        let mut members: Vec<Vec<usize>> = vec![Vec::new(); nodes.len()];
        for i in 0..nodes.len() {
            let root = parts.root(i);
            if !is_pinned[root] {
                members[root].push(i);
            }
        }
        members.retain(|m| !m.is_empty());
        Self { shift, pieces: count, loose, unpinned: members }
    }
}

/// A pin that holds its point across a line alone.
#[derive(Clone, Copy)]
struct Slide {
    at: [f64; 2],
    /// Unit vector.
    across: [f64; 2],
}

/// Part of the largest of rows below which what is left of a row is rounding.
const DEPENDENT: f64 = 1e-9;

/// Whether points and slides hold a piece: the rows `n^T (t + omega x p)` of its rigid motions `(t, omega)` have full rank. Of a single
/// node (`needed` is 1) the two rows of `t` do.
fn holds(points: &[[f64; 2]], slides: &[Slide], needed: usize) -> bool {
    if slides.is_empty() {
        return false;
    }
    let both = points.iter().flat_map(|&at| [[1.0, 0.0], [0.0, 1.0]].map(|across| Slide { at, across }));
    let all: Vec<Slide> = both.chain(slides.iter().copied()).collect();
    // About the first point, in units of the farthest: rotations count as much as translations.
    let from = all[0].at;
    let away = |s: &Slide| [s.at[0] - from[0], s.at[1] - from[1]];
    let size = all.iter().map(|s| away(s)[0].hypot(away(s)[1])).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let columns = if needed == 1 { 2 } else { 3 };
    let mut basis: Vec<[f64; 3]> = Vec::new();
    for slide in &all {
        let ([x, y], [nx, ny]) = (away(slide), slide.across);
        let mut row = [nx, ny, if columns == 3 { (ny * x - nx * y) / size } else { 0.0 }];
        for b in &basis {
            let along: f64 = (0..3).map(|k| row[k] * b[k]).sum();
            (0..3).for_each(|k| row[k] -= along * b[k]);
        }
        let left = row.iter().map(|v| v * v).sum::<f64>().sqrt();
        if left > DEPENDENT {
            basis.push(row.map(|v| v / left));
        }
    }
    basis.len() >= columns
}

/// Disjoint sets of nodes, each known by its smallest.
#[derive(Clone)]
struct Groups {
    parent: Vec<usize>,
}

impl Groups {
    fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    fn root(&mut self, mut i: usize) -> usize {
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }

    fn join(&mut self, i: usize, j: usize) {
        let (a, b) = (self.root(i), self.root(j));
        self.parent[a.max(b)] = a.min(b);
    }
}
