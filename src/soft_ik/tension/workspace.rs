//! What runs of the all-at-once method work in: kept between frames, so that a warm one allocates nothing.

use super::cables::Cables;
use super::dual::Dual;
use crate::soft_ik::{Phases, Question};

/// Taut stiffness, in shear moduli, up to which an element is a spring wherever it is taut. A prescribed tension has no
/// stiffness of its own and lets the body buckle where the real cable would not, so a stiffer one is given this stiffness.
const SOFT: f64 = 10.0;

/// Arrays that runs work in.
pub(in crate::soft_ik) struct Workspace {
    pub(super) cables: Cables,
    /// Right-hand sides and solutions `[Y, v, u]`, of each degree of freedom all columns (see [`Cables::rates`]).
    pub(super) solved: Vec<f64>,
    /// `u` by itself, the Newton step of the statics.
    pub(super) newton: Vec<f64>,
    /// One right-hand side by itself.
    pub(super) side: Vec<f64>,
    pub(super) jacobian: Vec<f64>,
    pub(super) linear: Vec<f64>,
    pub(super) now: Vec<f64>,
    pub(super) next: Vec<f64>,
    pub(super) limits: Vec<[f64; 2]>,
    pub(super) residual: Vec<f64>,
    pub(super) dx: Vec<f64>,
    pub(super) pulled: Vec<f64>,
    pub(super) trial: Vec<f64>,
    pub(super) forces_there: Vec<f64>,
    /// The largest unbalanced force before the step, under the tensions that it chose.
    pub(super) unbalanced: f64,
    pub(super) dual: Dual,
    /// `rho`, never zero.
    pub(super) rho: f64,
    /// Taut stiffness up to which an element counts as soft.
    pub(super) softness: f64,
    /// Body size: the longer side of the rest box.
    pub size: f64,
    /// Smallest weight of a target.
    weight: f64,
    pub phases: Phases,
}

impl Workspace {
    pub fn new(question: &Question) -> Self {
        let elements = &question.model.contractile.elements;
        let members = question.actuation.winches.iter().map(|w| w.members[0].0);
        let n = question.model.dimension();
        let count = question.actuation.winches.len();
        let rows = 2 * question.objective.targets.len();
        let mu = question.model.body.material().shear_modulus();
        let weight = question.objective.tension_weight;
        Self {
            cables: Cables::new(members.map(|e| &elements[e])),
            solved: vec![0.0; n * (rows + 2)],
            newton: vec![0.0; n],
            side: vec![0.0; n],
            jacobian: vec![0.0; count * (rows + 1)],
            linear: vec![0.0; count],
            now: vec![0.0; count],
            next: vec![0.0; count],
            limits: vec![[0.0; 2]; count],
            residual: vec![0.0; rows + 1],
            dx: vec![0.0; n],
            pulled: vec![0.0; n],
            trial: vec![0.0; n],
            forces_there: vec![0.0; n],
            unbalanced: 0.0,
            dual: Dual::default(),
            rho: if weight > 0.0 { weight } else { crate::defaults::TENSION_WEIGHT / (mu * mu) },
            softness: SOFT * mu,
            size: question.body_size(),
            weight: question.objective.targets.iter().map(|t| t.weight).reduce(f64::min).unwrap_or(1.0),
            phases: Phases::default(),
        }
    }

    /// The decrease of `O` when a target is missed by this part of the body less.
    pub fn worth(&self, part: f64) -> f64 {
        0.5 * self.weight * (part * self.size).powi(2)
    }
}

/// The longest displacement of a node.
pub(super) fn longest(dx: &[f64]) -> f64 {
    dx.chunks_exact(2).map(|d| d[0] * d[0] + d[1] * d[1]).fold(0.0, f64::max).sqrt()
}
