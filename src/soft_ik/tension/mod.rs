//! All-at-once Soft IK with tension as the unknown: the fast method for many fibres.
//!
//! Unknowns are the positions `x` and the tensions `tau >= 0` of the free fibres; an element at one of its bounds is a
//! spring held at that bound's rest length. One factorisation an iteration:
//!
//! 1. Assemble `g = dE/dx` and the exact `H` at `(x, tau)`, where a free element contributes `tau d2l` only.
//! 2. Solve `H [Y, u, v] = [S^T, g, Q (x - X)]`.
//! 3. With `G` the rows `dl/dx` of free elements: `J = -Y^T G^T`, `c = -G v`, `r_0 = S (x - u) - x'`.
//! 4. The step in tension minimises `1/2 |r_0 + J dtau|^2 + 1/2 (z dtau)^2 + c dtau + rho/2 |tau|^2 + nu/2 |dtau|^2` with every
//!    tension between those at its bounds: a convex dual of the size of the targets, solved by a semismooth Newton method.
//!    `z` is what the last step has shown of the curvature that `J^T J` leaves out (`secant`).
//! 5. `dx = -u - H^-1 G^T dtau` is a Newton step of the statics under the new tensions, capped and line-searched on
//!    `E(.; tau)`.
//! 6. Elements that reach a bound are held there as springs. A held element stays part of step 4, in the same units: with
//!    its spring in `H`, `dtau = U'' dalpha_c` at fixed `x`. Where the step moves it off its bound it is freed. So held and
//!    free elements are decided on together, against the same targets.
//!
//! A stiff element whose tension is the unknown keeps a softer spring's stiffness, or the body would buckle where the real cable
//! does not let it. Such springs resist the choice of tensions, so the stiffness shrinks where steps turn out timid.
//!
//! Tension does not vanish from the model where an element is slack, so the slack stall does not exist here. Contractions
//! follow as `alpha_c = alpha_0 - l + U'^-1(tau)`, and a statics polish ends the work.
//!
//! `E` is no merit function for `O`, so a step is not judged by itself: the run keeps the best state near equilibrium, lets
//! `nu` follow success, and goes back to that state where nothing better came for a while.

mod cables;
mod dual;
mod fiber;
mod gain;
mod run;
mod secant;
mod snap;
mod state;
mod step;
mod workspace;

pub(super) use snap::{RETURNS, snapped};
pub(super) use state::Run;
pub(super) use workspace::Workspace;

use super::{Answer, Budget, Method, Posture, Question};
use crate::physics::Cause;

/// The all-at-once method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AllAtOnce {
    /// Converged when no node moves further than this part of the body in an iteration.
    pub step_tolerance: f64,
}

impl Default for AllAtOnce {
    fn default() -> Self {
        Self { step_tolerance: 1e-7 }
    }
}

impl Method for AllAtOnce {
    fn name(&self) -> &'static str {
        "tension"
    }

    /// `O` without `lambda`, with `rho` (`defaults::TENSION_WEIGHT / mu^2` where the question has none).
    fn objective(&self) -> &'static str {
        "tension-regularised"
    }

    /// Panics if a winch winds several elements (a caller's mistake: see `Actuation::is_fibers_only`).
    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
        assert!(question.actuation.is_fibers_only(), "tension is the unknown of single elements only");
        let mut work = Workspace::new(question);
        let mut run = Run::new(question, start, &mut work);
        let mut answer = Answer::at(start);
        for _ in 0..=RETURNS {
            answer.converged = false;
            while answer.iterations < budget.iterations && !(budget.stop)() {
                answer.iterations += 1;
                let Some(progress) = run.iterate(question, &mut work, budget.stop) else { break };
                answer.factorizations += progress.factorizations;
                if progress.settled && progress.moved <= self.step_tolerance {
                    answer.converged = true;
                    break;
                }
            }
            let mut beta = start.beta.clone();
            let mut lengths = vec![0.0; question.model.contractile.elements.len()];
            run.best.activations_into(question, &mut lengths, &mut beta);
            let (posture, factorizations) = question.settle(&beta, &run.best.x, budget.stop);
            answer.factorizations += factorizations;
            let snapped = posture.in_equilibrium() && snapped(posture.objective, run.best.objective, work.size);
            if snapped && answer.converged {
                run.go_on_from(question, &posture.x, &posture.beta, &mut work);
            }
            let done = !snapped || !answer.converged;
            let better = posture.objective < answer.posture.objective || !answer.posture.in_equilibrium();
            // Out of time, the best state is what it is.
            if better && (posture.in_equilibrium() || posture.unsettled == Some(Cause::Cancelled)) {
                answer.posture = posture;
            }
            if done {
                break;
            }
        }
        let contractions = question.actuation.contractions(&answer.posture.beta);
        question.model.contractile.set_contractions(&contractions);
        answer
    }
}
