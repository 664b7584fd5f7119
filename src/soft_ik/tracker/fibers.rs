//! The fibres' method, frame after frame: a run follows the hand, a challenger from rest tries the resting targets anew.

use crate::physics::{Cause, Law, StaticsSettings, statics};
use crate::soft_ik::tension::{RETURNS, Run, Workspace, snapped};
use crate::soft_ik::{Frame, Posture, Quality, Question};
use std::time::Instant;

/// Frames without a move of the targets after which the challenger starts, converged or not.
const CHALLENGE_AFTER: usize = 8;
/// Iterations after which a challenger gives up.
const CHALLENGE_ITERATIONS: usize = 120;
/// A pose is settled to this residual, as a part of the forces at work.
pub(super) const SETTLED: f64 = 1e-10;
/// Scenes with at least this balanced budget are always settled to the end: a few factorisations more cost little there.
pub(super) const SMALL: usize = 8;
/// In large scenes a frame under the hand goes on for so many factorisations where `O` ended higher than its iteration promised, by
/// as much as if a target were missed by this part of the body more: out of reach, limbs turn, and one iteration trails. Reachable
/// targets never ask for it.
const LAGGING: f64 = 3e-3;
const SECOND_TRIES: usize = 1;

/// The state that the fibres' method keeps between frames.
pub(super) struct Fibers {
    pub work: Workspace,
    pub run: Run,
    challenger: Run,
    rest: Posture,
    /// Whether fixed contractions have changed since the rest pose was found.
    stale: bool,
    statics: statics::Workspace,
    pub stage: Stage,
    /// Frames since the targets moved.
    waited: usize,
    /// The run is the challenger's until its pose was compared; whether it has converged.
    pub deciding: Option<bool>,
    /// How far `O` is above what the last iteration promised.
    lag: f64,
    /// Whether the run has converged in this frame, and how often such a state has snapped since the targets moved.
    ended: bool,
    snaps: usize,
}

/// Whose turn it is while the targets rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    Following,
    /// Looks for the rest pose under the present fixed contractions. From that under others, winches that turn all at once
    /// would throw the challenger about.
    Resting,
    /// Iterations that the challenger has taken.
    Challenging(usize),
    /// The better of the two goes on to its end.
    Finishing,
    Done,
}

impl Fibers {
    /// Starts at a posture in equilibrium, and works out the rest pose unless `stop` ends it.
    pub fn new(question: &mut Question, start: &Posture, stop: &dyn Fn() -> bool) -> Self {
        let mut zero = vec![0.0; start.beta.len()];
        question.actuation.clamp(&mut zero);
        let coordinates = question.model.rest.clone();
        let (rest, _) = question.settle(&zero, &coordinates, stop);
        let stale = rest.unsettled == Some(Cause::Cancelled);
        let mut work = Workspace::new(question);
        let challenger = Run::new(question, &rest, &mut work);
        let run = Run::new(question, start, &mut work);
        let statics = statics::Workspace::new(start.x.len());
        let stage = Stage::Following;
        Self {
            work,
            run,
            challenger,
            rest,
            stale,
            statics,
            stage,
            waited: 0,
            deciding: None,
            lag: 0.0,
            ended: false,
            snaps: 0,
        }
    }

    /// Iterates within the budget. Whether there may be something new to show.
    #[allow(clippy::too_many_arguments)]
    pub fn follow(
        &mut self,
        question: &mut Question,
        moved: bool,
        pulled: bool,
        budget: usize,
        tolerance: f64,
        frame: &mut Frame,
        stop: &dyn Fn() -> bool,
    ) -> bool {
        if moved {
            self.stage = Stage::Following;
            self.waited = 0;
            self.snaps = 0;
            self.stale |= pulled;
            self.run.retarget(question, pulled, &mut self.work);
        } else {
            self.waited += 1;
        }
        let mut fresh = moved || self.waited == 1;
        self.ended = false;
        self.lag = 0.0;
        let more = if moved && budget < SMALL { SECOND_TRIES } else { 0 };
        let lagging = self.work.worth(LAGGING);
        let within = |spent: usize, lag: f64| spent < budget || lag > lagging && spent < budget + more;
        while within(frame.factorizations, self.lag) && self.stage != Stage::Done && !stop() {
            match self.stage {
                Stage::Following => {
                    fresh = true;
                    let converged = self.step(question, frame, false, tolerance, stop);
                    self.ended = converged;
                    if converged || (self.waited > CHALLENGE_AFTER && frame.factorizations >= budget) {
                        if self.stale {
                            self.stage = Stage::Resting;
                            self.rest.x.copy_from_slice(&question.model.rest);
                        } else {
                            self.challenge(question);
                        }
                        // What the hand has found is shown, settled, before it is challenged.
                        break;
                    }
                }
                Stage::Resting => {
                    if self.find_rest(question, budget - frame.factorizations, frame, stop) {
                        self.stale = false;
                        self.challenge(question);
                    }
                }
                Stage::Challenging(count) => {
                    let converged = self.step(question, frame, true, tolerance, stop);
                    self.stage = Stage::Challenging(count + 1);
                    if converged || count >= CHALLENGE_ITERATIONS {
                        // Whether it is as good is seen once it is settled.
                        std::mem::swap(&mut self.run, &mut self.challenger);
                        self.deciding = Some(converged);
                        self.ended = converged;
                        return true;
                    }
                }
                Stage::Finishing => {
                    fresh = true;
                    // Nobody waits for it: as far as the most accurate would.
                    self.ended = self.step(question, frame, false, Quality::Accurate.step_tolerance(), stop);
                    if self.ended {
                        self.stage = Stage::Done;
                    }
                }
                Stage::Done => {}
            }
        }
        fresh
    }

    /// Takes note of what became of the best state when it was settled and shown (`None`: it was not taken).
    pub fn learn(&mut self, question: &mut Question, shown: Option<f64>, posture: &Posture) {
        let deciding = self.deciding.take();
        let best = &mut self.run.best;
        let snapped =
            shown.is_some_and(|o| self.ended && self.snaps < RETURNS && snapped(o, best.objective, self.work.size));
        match (shown, deciding) {
            (Some(_), _) if snapped => {
                self.snaps += 1;
                self.run.go_on_from(question, &posture.x, &posture.beta, &mut self.work);
            }
            (Some(objective), _) => best.objective = best.objective.max(objective),
            (None, Some(_)) => std::mem::swap(&mut self.run, &mut self.challenger),
            (None, None) => self.run.go_on_from(question, &posture.x, &posture.beta, &mut self.work),
        }
        self.stage = match deciding {
            Some(_) => Stage::Finishing,
            None if snapped && self.stage == Stage::Done => Stage::Finishing,
            None if snapped => Stage::Following,
            None => self.stage,
        };
    }

    fn challenge(&mut self, question: &mut Question) {
        self.stage = Stage::Challenging(0);
        self.challenger.restart(question, &self.rest.x, &self.rest.beta, &mut self.work);
    }

    /// Takes up to `most` Newton steps towards the rest pose; whether it is found, or no step leads nearer.
    fn find_rest(&mut self, question: &mut Question, most: usize, frame: &mut Frame, stop: &dyn Fn() -> bool) -> bool {
        let clock = Instant::now();
        let actuation = question.actuation;
        let contractile = &mut question.model.contractile;
        contractile.set_contractions(&actuation.fixed);
        for (winch, beta) in actuation.winches.iter().zip(&self.rest.beta) {
            let (element, ratio) = winch.members[0];
            contractile.laws[element] = Law::Spring { alpha: contractile.elements[element].alpha0 - ratio * beta };
        }
        let settings = StaticsSettings { tolerance: SETTLED, max_iterations: most, ..StaticsSettings::default() };
        let done = statics::settle(question.model, &mut self.rest.x, &settings, stop, &mut self.statics);
        frame.factorizations += done.factorizations;
        self.work.phases.line_search += clock.elapsed().as_secs_f64();
        let unfinished = done.cause == Some(Cause::Cancelled) || done.cause.is_some() && done.iterations >= most;
        !unfinished
    }

    /// One iteration of the run or its challenger; whether it has converged (or cannot go on).
    fn step(
        &mut self,
        question: &mut Question,
        frame: &mut Frame,
        challenger: bool,
        tolerance: f64,
        stop: &dyn Fn() -> bool,
    ) -> bool {
        let run = if challenger { &mut self.challenger } else { &mut self.run };
        frame.iterations += 1;
        match run.iterate(question, &mut self.work, stop) {
            None => !stop(),
            Some(progress) => {
                self.lag = progress.lag;
                frame.factorizations += progress.factorizations;
                progress.settled && progress.moved <= tolerance || progress.gain <= self.work.worth(tolerance)
            }
        }
    }
}
