//! The gain ratio of a step: how far `O` fell at the equilibrium that it leads to, over what its model promised.

use super::state::{LARGEST_PROXIMAL, LEAST_PROXIMAL, REJECTION_GROWTH, Run, STANDSTILL, value};
use super::workspace::{Workspace, longest};
use crate::physics::{HessianForm, statics};
use crate::soft_ik::Question;

/// A step is good where `O` fell by at least this part of what its model promised, and poor below that part.
const GOOD: f64 = 0.6;
const POOR: f64 = 0.2;
/// A step is excellent where `O` fell by what its model promised, to this part.
const EXCELLENT: f64 = 0.2;
/// Divisors of `nu` after an excellent and a good step, factors after a poor one and after one that made things worse.
const EXCELLENT_DECAY: f64 = 5.0;
const PROXIMAL_DECAY: f64 = 2.0;
const PROXIMAL_GROWTH: f64 = 2.0;
/// A step is timid where `O` fell by more than this times what its model promised, with nothing left to hold it back: a
/// quadratic taken for one of `1/c` times its curvature falls by `2 - c` times the promise. What makes the model stiffer than
/// the scene is the stiffness that stands for that of stiff elements: springs resist a tension while it is chosen. It
/// shrinks by `c`, not faster than by this factor and not below this part; it grows again where steps fail.
const TIMID: f64 = 1.3;
const STEADINESS_DECAY: f64 = 0.25;
const LEAST_STEADINESS: f64 = 1e-3;
/// Iterations in a row that end far from equilibrium, after which the run goes back to its best state; at once where they
/// seem to lead to a worse one.
const MOST_ADRIFT: usize = 6;
/// A state is kept as the best where its Newton step towards equilibrium is at most this part of the body: farther away,
/// another equilibrium may be nearer than the one expected.
const VERIFIED: f64 = 1e-2;
/// `O` at an equilibrium is told from a state whose Newton step towards it is at most this part of the body.
const WITHIN_SIGHT: f64 = 0.017;
/// To this it shrinks, by halves, where iterations end far from equilibrium.
const SHORTEST_STEP: f64 = 0.03;
/// Residual, as a part of the forces at work, up to which `O` of a state is taken for that of the equilibrium nearby.
const NEAR_EQUILIBRIUM: f64 = 1e-2;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    On,
    /// To the best state, with shorter steps.
    Back,
}

impl Run {
    /// Compares `O` at the equilibrium that the state is on its way to, `x - u`, with what the last step promised. Keeps it if
    /// it is the best, and lets `nu` follow success.
    pub(super) fn compare(&mut self, question: &Question, form: HessianForm, work: &mut Workspace) -> Verdict {
        let u = &work.newton;
        for ((p, x), u) in work.pulled.iter_mut().zip(&self.x).zip(u) {
            *p = x - u;
        }
        let distance = longest(u) / work.size;
        let within_sight = distance <= WITHIN_SIGHT;
        let verified = distance <= VERIFIED;
        self.unverified = if verified { 0 } else { self.unverified + 1 };
        let most = LARGEST_PROXIMAL * work.rho;
        self.now = value(&work.pulled, &self.fibers, question, work.rho);
        if !within_sight {
            self.reach = (self.reach * 0.5).max(SHORTEST_STEP);
            self.adrift += 1;
            self.nu = (self.nu * PROXIMAL_GROWTH).min(most);
            let astray = self.now > self.best.objective && !self.returned;
            let lost = self.best.objective.is_finite() && (astray || self.adrift > MOST_ADRIFT);
            return if lost { Verdict::Back } else { Verdict::On };
        }
        self.adrift = 0;
        if self.returned {
            // What it was kept for was foreseen one step ahead; this is what it is.
            self.returned = false;
            self.best.objective = f64::INFINITY;
        }
        if let Some(step) = self.before.filter(|step| step.telling) {
            let ratio = (step.objective - self.now) / step.promised.max(f64::MIN_POSITIVE);
            if verified && self.now > self.best.objective * (1.0 + 1e-9) && ratio < 0.0 {
                self.stagnant += 1;
                return Verdict::Back;
            }
            if ratio >= GOOD {
                if ratio > TIMID && verified && self.nu <= LEAST_PROXIMAL * work.rho {
                    let excess = (2.0 - ratio).max(STEADINESS_DECAY);
                    self.next_steadiness = (self.steadiness * excess).max(LEAST_STEADINESS);
                }
                let decay = if (ratio - 1.0).abs() < EXCELLENT { EXCELLENT_DECAY } else { PROXIMAL_DECAY };
                self.nu = (self.nu / decay).max(LEAST_PROXIMAL * work.rho);
            } else if ratio < POOR {
                self.nu = (self.nu * PROXIMAL_GROWTH).min(most);
            }
        }
        if verified {
            if self.now < (1.0 - STANDSTILL) * self.mark {
                self.mark = self.now;
                self.stagnant = 0;
            } else {
                self.stagnant += 1;
            }
        }
        // Where the Hessian had to be projected the body may snap on its way there.
        let foreseen = verified && form == HessianForm::Exact && self.now < self.best.objective;
        if foreseen && question.model.body.smallest_determinant(&work.pulled) > 0.0 {
            self.best.objective = self.now;
            self.best.x.copy_from_slice(&work.pulled);
            self.best.fibers.copy_from_slice(&self.fibers);
        }
        Verdict::On
    }

    pub(super) fn go_back(&mut self, question: &mut Question, work: &mut Workspace) {
        self.x.copy_from_slice(&self.best.x);
        self.fibers.copy_from_slice(&self.best.fibers);
        self.nu = (self.nu * REJECTION_GROWTH).min(LARGEST_PROXIMAL * work.rho);
        self.steadiness = (self.steadiness / STEADINESS_DECAY).min(1.0);
        self.next_steadiness = self.steadiness;
        self.adrift = 0;
        self.returned = true;
        self.before = None;
        self.secant.interrupt();
        self.set_laws(question, work);
        self.gradient_now(question, work);
    }

    /// Keeps a state that the last step took close to equilibrium, before the next factorisation.
    pub(super) fn note(&mut self, question: &Question, work: &Workspace) {
        let forces = self.fibers.iter().fold(self.forces, |m, f| m.max(f.tension));
        if statics::norm(&self.gradient) <= NEAR_EQUILIBRIUM * forces {
            let objective = value(&self.x, &self.fibers, question, work.rho);
            if objective < self.best.objective {
                self.take_best(objective);
            }
        }
    }

    pub(super) fn take_best(&mut self, objective: f64) {
        self.best.objective = objective;
        self.best.x.copy_from_slice(&self.x);
        self.best.fibers.copy_from_slice(&self.fibers);
    }
}
