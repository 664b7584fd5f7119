//! The iteration of the all-at-once method, and the state that it moves.
//!
//! Where no reason is given for a constant, here or in `gain`, it is the best of those tried on seeded cold drags of 40 %
//! of the body length on the bundled shapes (1 to 4 targets, 414 fibres; other seeds than those of `plushwright bench cold`).

use super::fiber::Fiber;
use super::gain::Verdict;
use super::secant::Secant;
use super::state::{Best, LARGEST_PROXIMAL, REJECTION_GROWTH, Run, STANDSTILL, value};
use super::workspace::{Workspace, longest};
use crate::physics::{HessianForm, Model};
use crate::soft_ik::{Phases, Posture, Question};
use std::time::Instant;

/// First proximal weight `nu`, in units of `rho`: robust from a cold start.
const FIRST_PROXIMAL: f64 = 40.0;
/// Largest `nu`, in units of `rho`, with which new targets are met.
const LARGEST_FIRST: f64 = 1e3;
/// A run stands still after so many iterations without a gain of [`STANDSTILL`].
const STAGNANT: usize = 10;
/// After this many iterations in a row that end farther from it, the next ones balance the forces before they move on.
const UNBALANCED: usize = 5;
/// Longest step of a node in one iteration, as a part of the body: beyond it the linearised lengths mean nothing.
const LONGEST_STEP: f64 = 0.2;
/// First limit on the pull of a single target, as a part of the body; it doubles until it limits nothing.
const FIRST_PULL: f64 = 0.7;

/// The outcome of an iteration.
pub(in crate::soft_ik) struct Progress {
    pub factorizations: usize,
    /// Longest displacement of a node, as a part of the body.
    pub moved: f64,
    /// Whether no limit of pull or of step length, no change of bounds and no large `nu` played a part in it; or nothing is
    /// left to gain.
    pub settled: bool,
    /// The decrease of `O` that the iteration promised; infinite where the promise is not to be trusted.
    pub gain: f64,
    /// How far `O` is above what was promised: what another iteration might still gain. Infinite where no step was chosen.
    pub lag: f64,
}

impl Run {
    pub fn new(question: &mut Question, start: &Posture, work: &mut Workspace) -> Self {
        let elements = &question.model.contractile.elements;
        let fibers: Vec<Fiber> = question
            .actuation
            .winches
            .iter()
            .zip(&start.beta)
            .map(|(winch, beta)| Fiber::new(winch, *beta, elements, &start.x, work.softness))
            .collect();
        let rows = 2 * question.objective.targets.len();
        let mut run = Self {
            x: start.x.clone(),
            gradient: vec![0.0; start.x.len()],
            nu: FIRST_PROXIMAL * work.rho,
            steadiness: 1.0,
            next_steadiness: 1.0,
            forces: 0.0,
            reach: LONGEST_STEP,
            pull: FIRST_PULL * work.size,
            before: None,
            secant: Secant::new(fibers.len(), rows),
            q: vec![0.0; rows + 1],
            warm: false,
            best: Best { objective: f64::INFINITY, x: start.x.clone(), fibers: fibers.clone() },
            fibers,
            now: f64::INFINITY,
            adrift: 0,
            unverified: 0,
            stagnant: 0,
            mark: f64::INFINITY,
            returned: false,
        };
        run.retarget(question, true, work);
        run.returned = false;
        run
    }

    /// Begins anew at a posture, without allocation.
    pub fn restart(&mut self, question: &mut Question, x: &[f64], beta: &[f64], work: &mut Workspace) {
        self.x.copy_from_slice(x);
        let elements = &question.model.contractile.elements;
        for ((fiber, winch), beta) in self.fibers.iter_mut().zip(&question.actuation.winches).zip(beta) {
            *fiber = Fiber::new(winch, *beta, elements, x, work.softness);
        }
        self.nu = FIRST_PROXIMAL * work.rho;
        self.steadiness = 1.0;
        self.next_steadiness = 1.0;
        self.unverified = 0;
        self.warm = false;
        self.take_best(f64::INFINITY);
        self.retarget(question, true, work);
        self.returned = false;
    }

    /// Goes on from a posture that turned out better than the run's best, with shorter steps.
    pub fn go_on_from(&mut self, question: &mut Question, x: &[f64], beta: &[f64], work: &mut Workspace) {
        let nu = (self.nu * REJECTION_GROWTH).min(LARGEST_PROXIMAL * work.rho);
        self.restart(question, x, beta, work);
        self.nu = nu;
    }

    /// Takes note of new targets: `O` of the state, and of the best one, is no longer what it was. `pulled`: fixed contractions
    /// changed too, so that neither is in equilibrium any more.
    pub fn retarget(&mut self, question: &mut Question, pulled: bool, work: &mut Workspace) {
        self.pull = FIRST_PULL * work.size;
        self.nu = self.nu.min(LARGEST_FIRST * work.rho);
        self.reach = LONGEST_STEP;
        self.adrift = 0;
        self.stagnant = 0;
        self.mark = f64::INFINITY;
        self.before = None;
        self.secant.forget();
        for fiber in &mut self.fibers {
            fiber.releases = 0;
        }
        self.best.objective = value(&self.best.x, &self.best.fibers, question, work.rho);
        if pulled {
            self.returned = true;
            self.set_laws(question, work);
            self.forces = question.model.force_scale_into(&self.x, &mut work.trial);
            self.gradient_now(question, work);
        }
    }

    /// Puts the present laws of all elements into the model.
    pub(super) fn set_laws(&self, question: &mut Question, work: &Workspace) {
        let steady = self.steady(work);
        let contractile = &mut question.model.contractile;
        if self.fibers.len() < contractile.laws.len() {
            contractile.set_contractions(&question.actuation.fixed);
        }
        for fiber in &self.fibers {
            contractile.laws[fiber.element] = fiber.law(steady);
        }
    }

    pub(super) fn steady(&self, work: &Workspace) -> f64 {
        self.steadiness * work.softness
    }

    pub(super) fn gradient_now(&mut self, question: &Question, work: &mut Workspace) {
        let clock = Instant::now();
        question.model.gradient(&self.x, &mut self.gradient);
        work.phases.assembly += clock.elapsed().as_secs_f64();
    }

    /// One iteration; `None` where the stiffness matrix cannot be factorised, or `stop` has ended it: with many targets it is long.
    pub fn iterate(
        &mut self,
        question: &mut Question,
        work: &mut Workspace,
        stop: &dyn Fn() -> bool,
    ) -> Option<Progress> {
        let clock = Instant::now();
        work.cables.update(&self.x);
        let elements = &question.model.contractile.elements;
        for (fiber, length) in self.fibers.iter_mut().zip(&work.cables.lengths) {
            fiber.release_slack(&elements[fiber.element], *length);
        }
        self.steadiness = self.next_steadiness;
        self.set_laws(question, work);
        work.phases.assembly += clock.elapsed().as_secs_f64();
        let mut form = factorize(question.model, &self.x, &mut work.phases)?;
        let mut factorizations = 1 + (form == HessianForm::Projected) as usize;
        if form == HessianForm::Projected && self.steadiness < 1.0 {
            self.next_steadiness = 1.0;
            self.steadiness = 1.0;
            self.set_laws(question, work);
            self.gradient_now(question, work);
            form = factorize(question.model, &self.x, &mut work.phases)?;
            factorizations += 1 + (form == HessianForm::Projected) as usize;
        }

        if !self.solve_sides(question, work, stop) {
            return None;
        }
        if self.compare(question, form, work) == Verdict::Back {
            let stuck = self.nu >= LARGEST_PROXIMAL * work.rho;
            self.go_back(question, work);
            let moved = if stuck { 0.0 } else { f64::INFINITY };
            return Some(Progress { factorizations, moved, settled: stuck, gain: f64::INFINITY, lag: f64::INFINITY });
        }
        let limited = self.linearise(question, work);
        self.append_secant(work);
        self.before = None;
        if self.unverified <= UNBALANCED && !self.choose(question, work, stop) {
            return None;
        }
        if self.before.is_none() {
            self.balance(work);
        }
        let (step, changed) = self.take(question, form, work);
        if self.before.is_some() {
            self.secant.leave(&mut work.jacobian, &work.now, &work.next, step);
        }
        if limited && step >= 0.5 {
            self.pull *= 2.0;
        }
        self.note(question, work);
        let lag = match &self.before {
            Some(step) => value(&self.x, &self.fibers, question, work.rho) - (step.objective - step.promised),
            None => f64::INFINITY,
        };
        let gentle = self.nu <= LARGEST_FIRST * work.rho;
        let promised = self.before.map_or(f64::INFINITY, |step| step.promised);
        if !limited && (gentle && promised <= STANDSTILL * self.now.abs() || self.stagnant > STAGNANT) {
            return Some(Progress { factorizations, moved: 0.0, settled: true, gain: promised, lag: 0.0 });
        }
        let moved = step * longest(&work.dx) / work.size;
        let gain = if gentle && !limited && self.unverified == 0 { promised } else { f64::INFINITY };
        let settled = !limited && !changed && step >= 0.5 && gentle;
        Some(Progress { factorizations, moved, settled, gain, lag })
    }
}

/// The exact Hessian where it is positive definite, else the projected one (whose assembly counts as factorisation).
fn factorize(model: &mut Model, x: &[f64], phases: &mut Phases) -> Option<HessianForm> {
    let clock = Instant::now();
    model.assemble(x, HessianForm::Exact);
    phases.assembly += clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let form = match model.factorize_assembled() {
        Ok(()) => Some(HessianForm::Exact),
        Err(_) => model.factorize_projected(x).ok().map(|()| HessianForm::Projected),
    };
    phases.factorization += clock.elapsed().as_secs_f64();
    form
}
