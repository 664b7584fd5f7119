//! The state that the iteration moves.

use super::fiber::Fiber;
use super::secant::Secant;
use crate::soft_ik::Question;

/// Smallest `nu`, in units of `rho`, reached where iterations go well.
pub(super) const LEAST_PROXIMAL: f64 = 0.1;
/// Largest `nu`, in units of `rho`: beyond it nothing moves.
pub(super) const LARGEST_PROXIMAL: f64 = 1e8;
/// Factor of `nu` where a step made things worse.
pub(super) const REJECTION_GROWTH: f64 = 6.0;
/// A run stands still where an iteration promises less than this part of `O`, or after some iterations without a gain of this part.
pub(super) const STANDSTILL: f64 = 1e-6;

/// A step in tension.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen {
    /// `O` at the equilibrium near the state before it.
    pub objective: f64,
    /// How much the step promised to lower it.
    pub promised: f64,
    /// Whether the body moved enough by it for the outcome to be its own, not what settles on the way.
    pub telling: bool,
}

/// A state between iterations.
pub(in crate::soft_ik) struct Run {
    pub x: Vec<f64>,
    pub(super) fibers: Vec<Fiber>,
    /// `dE/dx` under the present tensions.
    pub(super) gradient: Vec<f64>,
    /// Proximal weight.
    pub(super) nu: f64,
    /// Stiffness that stands for a stiff element's own where its tension is the unknown, as a part of `Workspace::softness`;
    /// and that of the next iteration.
    pub(super) steadiness: f64,
    pub(super) next_steadiness: f64,
    /// The forces at work where the run began; tensions since then may be larger.
    pub(super) forces: f64,
    /// Longest step of a node, as a part of the body.
    pub(super) reach: f64,
    /// Present limit on a target's pull, length.
    pub(super) pull: f64,
    /// The last step in tension; none of a fresh run.
    pub(super) before: Option<Chosen>,
    pub(super) secant: Secant,
    /// The multipliers of the step before, and whether there was one since the run began.
    pub(super) q: Vec<f64>,
    pub(super) warm: bool,
    pub best: Best,
    /// `O` at the equilibrium near the present state.
    pub(super) now: f64,
    /// Iterations in a row that ended far from equilibrium, and such that ended too far from it to be kept.
    pub(super) adrift: usize,
    pub(super) unverified: usize,
    /// Iterations since `O` last fell to `mark`, by more than a standstill.
    pub(super) stagnant: usize,
    pub(super) mark: f64,
    /// Whether the run has just gone back to its best state.
    pub(super) returned: bool,
}

/// The state of lowest `O` that a run has seen near equilibrium.
pub(in crate::soft_ik) struct Best {
    pub objective: f64,
    pub x: Vec<f64>,
    pub(super) fibers: Vec<Fiber>,
}

impl Best {
    /// Activations that hold the tensions at the positions, within the bounds, into `beta`. `lengths` becomes those of all elements.
    pub fn activations_into(&self, question: &Question, lengths: &mut [f64], beta: &mut [f64]) {
        let contractile = &question.model.contractile;
        contractile.lengths_into(&self.x, lengths);
        for (b, fiber) in beta.iter_mut().zip(&self.fibers) {
            *b = fiber.activation(&contractile.elements[fiber.element], lengths[fiber.element]);
        }
        question.actuation.clamp(beta);
    }
}

/// `O` of the tension form at `x`.
pub(super) fn value(x: &[f64], fibers: &[Fiber], question: &Question, rho: f64) -> f64 {
    let tensions: f64 = fibers.iter().map(|f| f.tension * f.tension).sum();
    question.objective.position_value(x) + 0.5 * rho * tensions
}
