//! Soft IK under the hand: one frame after another, each warm-started from the one before.
//!
//! What a frame shows is always finite, free of inverted triangles, within the limits of its actuators and near equilibrium:
//! the best state that the run has seen there, settled with what is left of the frame's budget.
//!
//! A frame has no memory of bad states. Once the targets rest, a second run starts from the rest shape, in the frames that the
//! first one no longer needs; unless it ends far worse, its pose is taken. So the pose in which a drag comes to rest is the
//! one that the targets alone lead to.
//!
//! Winches of several elements follow the hand by Gauss-Newton; once the targets rest, the wound states are looked at as a whole
//! ([`super::winding`]), so many factorisations a frame, and the best that winding from rest reaches is taken.

use super::contraction::GaussNewton;
use super::tension::{RETURNS, Run, Workspace, snapped};
use super::winding::{Care, Search};
use super::{Budget, Method, Posture, Question, Winch};
use crate::physics::statics::Reuse;
use crate::physics::{Cause, Law, StaticsSettings, statics};
use std::time::Instant;

/// How much work a frame may take: the user's trade between speed and accuracy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// A quarter of the work of `Balanced`: follows the hand on slow machines, lags behind fast moves.
    Draft,
    /// What a core does in a sixtieth of a second, up to 10 000 fibres; converged in most frames of small scenes.
    #[default]
    Balanced,
    /// Until nothing moves any more.
    Accurate,
}

/// Fibres times factorisations of a balanced frame: about 16 ms on one core.
const BALANCED_WORK: usize = 12_000;
/// Most factorisations of a balanced frame: more than converge a warm one.
const BALANCED_FACTORIZATIONS: usize = 24;
const DRAFT_PART: usize = 4;
const ACCURATE_FACTORIZATIONS: usize = 200;

impl Quality {
    /// Numeric factorisations that a frame with this many free elements may take.
    pub fn factorizations(self, elements: usize) -> usize {
        let balanced = (BALANCED_WORK / elements.max(1)).clamp(1, BALANCED_FACTORIZATIONS);
        match self {
            Self::Draft => (balanced / DRAFT_PART).max(1),
            Self::Balanced => balanced,
            Self::Accurate => ACCURATE_FACTORIZATIONS,
        }
    }

    /// A frame is done when no node moves further than this part of the body in an iteration, or no target would come nearer
    /// by more than that. A thousandth of a millimetre in a plushie of 100 mm cannot be seen.
    pub fn step_tolerance(self) -> f64 {
        match self {
            Self::Draft => 1e-4,
            Self::Balanced => 1e-5,
            Self::Accurate => 1e-7,
        }
    }
}

/// Where the time of a frame went, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phases {
    pub assembly: f64,
    pub factorization: f64,
    pub solves: f64,
    pub dual: f64,
    pub line_search: f64,
}

/// What a frame took and reached.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    pub iterations: usize,
    pub factorizations: usize,
    /// Whether nothing moves any more.
    pub converged: bool,
    /// `max |dE/dx|` of the state shown, and the forces at work against which it is small.
    pub residual: f64,
    pub force_scale: f64,
    pub phases: Phases,
}

/// Poses one view, frame after frame.
///
/// With free fibres, whatever else pulls, a frame allocates nothing once every stage has run (`tests/suite/allocations.rs`). Winches
/// of several elements (Gauss-Newton) allocate in every frame.
pub struct Tracker {
    posture: Posture,
    goals: Vec<[f64; 2]>,
    /// Contractions of what does not belong to the free winches.
    fixed: Vec<f64>,
    /// Whether the winches' method had converged.
    wound: bool,
    /// Looks for the best wound state while the targets rest.
    search: Option<Search>,
    fibers: Option<Fibers>,
    statics: statics::Workspace,
    contractions: Vec<f64>,
    /// Lengths or tensions of all elements.
    along: Vec<f64>,
    /// The posture of the frame is being changed here, so that a failure leaves the last one.
    trial: Vec<f64>,
    beta: Vec<f64>,
    /// The sum of all squared tensions of the pose to show, once it is known.
    squares: Option<f64>,
    force_scale: f64,
}

/// What the fibres' method keeps between frames.
struct Fibers {
    work: Workspace,
    run: Run,
    challenger: Run,
    rest: Posture,
    /// Whether fixed contractions have changed since the rest pose was found.
    stale: bool,
    statics: statics::Workspace,
    stage: Stage,
    /// Frames since the targets moved.
    waited: usize,
    /// The run is the challenger's until its pose was compared; whether it has converged.
    deciding: Option<bool>,
    /// How far `O` is above what the last iteration promised.
    lag: f64,
    /// Whether the run has converged in this frame, and how often such a state has snapped since the targets moved.
    ended: bool,
    snaps: usize,
}

/// Whose turn it is while the targets rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
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

/// Frames without a move of the targets after which the challenger starts, converged or not.
const CHALLENGE_AFTER: usize = 8;
/// Iterations after which a challenger gives up.
const CHALLENGE_ITERATIONS: usize = 120;
/// The pose found from rest is taken where its `O` is at most this factor of that of the pose under the hand: close to the
/// same value there are often several poses, and the one to rest in is the one that does not depend on the way there.
const AS_GOOD: f64 = 2.0;
/// The same for the pose of the next frame, which may be worse by rounding alone.
const NO_WORSE: f64 = 1.0 + 1e-6;
/// A pose is settled to this residual, as a part of the forces at work.
const SETTLED: f64 = 1e-10;
/// Scenes with at least this balanced budget are always settled to the end: a few factorisations more cost little there.
const SMALL: usize = 8;
/// What must be reached before a pose is shown, whatever the budget.
const SHOWN: f64 = 1e-3;
/// In large scenes the factor of the iteration settles it, in steps that cost a tenth of a factorisation: to this residual, so
/// that the forces at work may change a little on the way, as long as a step leaves this part of the residual, so many at most.
const SHOWN_WITH_MARGIN: f64 = 0.9e-3;
const STILL_SETTLING: f64 = 0.6;
const REUSES: usize = 6;
/// In large scenes a frame under the hand goes on for so many factorisations where `O` ended higher than its iteration promised, by
/// as much as if a target were missed by this part of the body more: out of reach, limbs turn, and one iteration trails. Reachable
/// targets never ask for it.
const LAGGING: f64 = 3e-3;
const SECOND_TRIES: usize = 1;
/// Newton steps spent on that at most, before the pose of the last frame stays: in small scenes, and in large ones, where the
/// hand would feel them.
const SETTLING_STEPS: usize = 60;
const HASTY_STEPS: usize = 8;

impl Tracker {
    /// Starts at a posture in equilibrium. Works out the rest pose (activations zero) too.
    pub fn new(question: &mut Question, start: &Posture) -> Self {
        Self::within(question, start, &|| false)
    }

    /// The same; once `stop` says so, the rest pose is left for later.
    pub fn within(question: &mut Question, start: &Posture, stop: &dyn Fn() -> bool) -> Self {
        let elements = question.model.contractile.elements.len();
        let fibers = question.actuation.is_fibers_only() && !question.actuation.winches.is_empty();
        let fibers = fibers.then(|| {
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
            Fibers {
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
        });
        Self {
            posture: start.clone(),
            goals: question.objective.targets.iter().map(|t| t.goal).collect(),
            fixed: question.actuation.fixed.clone(),
            wound: false,
            search: None,
            fibers,
            statics: statics::Workspace::new(start.x.len()),
            contractions: vec![0.0; elements],
            along: vec![0.0; elements],
            trial: start.x.clone(),
            squares: None,
            force_scale: 0.0,
            beta: start.beta.clone(),
        }
    }

    /// The pose to show.
    pub fn posture(&self) -> &Posture {
        &self.posture
    }

    /// One frame towards the targets of the question: those of the frames before (the same points of the body, with the same
    /// weights), at their present goals; fixed contractions may have changed. `stop` is asked between factorisations. Leaves
    /// the contractions of the pose in the model.
    pub fn frame(&mut self, question: &mut Question, quality: Quality, stop: &dyn Fn() -> bool) -> Frame {
        let budget = quality.factorizations(self.posture.beta.len());
        let targets = &question.objective.targets;
        let pulled = self.fixed != question.actuation.fixed;
        let moved = pulled || self.goals.iter().zip(targets).any(|(g, t)| *g != t.goal);
        self.goals.clear();
        self.goals.extend(targets.iter().map(|t| t.goal));
        self.fixed.copy_from_slice(&question.actuation.fixed);
        let Some(mut fibers) = self.fibers.take() else {
            return self.wind(question, moved, budget, stop);
        };
        fibers.work.phases = Phases::default();
        let mut frame = Frame::default();
        let fresh = fibers.follow(question, moved, pulled, budget, quality.step_tolerance(), &mut frame, stop);
        if fresh {
            let shown = self.show(question, &mut fibers, pulled, quality, budget, &mut frame, stop);
            fibers.learn(question, shown, &self.posture);
        }
        frame.converged = fibers.stage == Stage::Done;
        frame.residual = self.posture.residual;
        frame.force_scale = self.force_scale;
        frame.phases = fibers.work.phases;
        self.fibers = Some(fibers);
        question.actuation.contractions_into(&self.posture.beta, &mut self.contractions);
        question.model.contractile.set_contractions(&self.contractions);
        frame
    }

    /// Takes the best state of the run, its actuators within their limits, settled: to the end where the budget allows, near
    /// enough in any case. The pose of the last frame stays where it is better, or where the new one does not settle.
    /// Returns `O` of the new pose where that was taken.
    #[allow(clippy::too_many_arguments)]
    fn show(
        &mut self,
        question: &mut Question,
        fibers: &mut Fibers,
        pulled: bool,
        quality: Quality,
        budget: usize,
        frame: &mut Frame,
        stop: &dyn Fn() -> bool,
    ) -> Option<f64> {
        let clock = Instant::now();
        let best = &fibers.run.best;
        self.trial.copy_from_slice(&best.x);
        best.activations_into(question, &mut self.along, &mut self.beta);
        question.actuation.contractions_into(&self.beta, &mut self.contractions);
        question.model.contractile.set_contractions(&self.contractions);
        let small = Quality::Balanced.factorizations(self.beta.len()) >= SMALL;
        let whole = small || quality == Quality::Accurate;
        let left = if whole { SETTLING_STEPS } else { budget.saturating_sub(frame.factorizations) };
        let (mut residual, mut scale) = self.statics.forces_at(question.model, &self.trial);
        if left == 0 && residual > SHOWN * scale {
            let reuse = Reuse { enough: SHOWN_WITH_MARGIN * scale, left: STILL_SETTLING, steps: REUSES };
            residual = reuse.settle(question.model, &mut self.trial, &mut self.statics);
        }
        let mut cause = None;
        let mut settle = |tolerance: f64, max_iterations: usize, x: &mut [f64]| {
            let settings = StaticsSettings { tolerance, stagnation_tolerance: tolerance.max(1e-8), max_iterations };
            let done = statics::settle(question.model, x, &settings, stop, &mut self.statics);
            frame.factorizations += done.factorizations;
            cause = done.cause;
            (done.residual, done.force_scale)
        };
        if left > 0 {
            (residual, scale) = settle(SETTLED, left, &mut self.trial);
        }
        if residual > SHOWN * scale {
            (residual, scale) = settle(SHOWN, if whole { SETTLING_STEPS } else { HASTY_STEPS }, &mut self.trial);
        }
        self.force_scale = scale;
        let settled = residual <= SHOWN * scale;
        let squares = self.squares.unwrap_or_else(|| squared_tensions(question, &self.posture.x, &self.posture.beta));
        // They are springs at `beta` now.
        question.model.contractile.tensions_into(&self.trial, &mut self.along);
        let tensions = question.actuation.winches.iter().map(|winch| self.along[winch.members[0].0]);
        let squares_after: f64 = tensions.map(|t| t * t).sum();
        let objective = question.objective;
        let value = |x: &[f64], squares: f64| objective.position_value(x) + 0.5 * objective.tension_weight * squares;
        let (before, after) = (value(&self.posture.x, squares), value(&self.trial, squares_after));
        let margin = if fibers.deciding.is_some() { AS_GOOD } else { NO_WORSE };
        let taken = !self.posture.in_equilibrium() || settled && (pulled || after <= margin * before);
        if taken {
            std::mem::swap(&mut self.posture.x, &mut self.trial);
            std::mem::swap(&mut self.posture.beta, &mut self.beta);
            self.posture.residual = residual;
            self.posture.unsettled = (!settled).then(|| cause.unwrap_or(Cause::Stalled));
        }
        self.posture.objective = if taken { after } else { before };
        self.squares = Some(if taken { squares_after } else { squares });
        fibers.work.phases.line_search += clock.elapsed().as_secs_f64();
        taken.then_some(after)
    }

    /// Winches of several elements: Gauss-Newton in their few activations, every trial an equilibrium.
    fn wind(&mut self, question: &mut Question, moved: bool, budget: usize, stop: &dyn Fn() -> bool) -> Frame {
        let clock = Instant::now();
        question.actuation.contractions_into(&self.posture.beta, &mut self.contractions);
        question.model.contractile.set_contractions(&self.contractions);
        self.posture.objective = question.objective_at(&self.posture.x, &self.contractions);
        let iterations = if moved || !self.wound { budget } else { 0 };
        let mut answer = GaussNewton::default().solve(question, &self.posture, &Budget { iterations, stop });
        // It has ended, too, where no step leads on.
        self.wound = answer.converged || iterations == 0 || answer.iterations < iterations && !stop();
        self.posture = answer.posture;
        if moved {
            self.search = None;
        } else if iterations == 0 {
            answer.factorizations += self.look_around(question, budget, stop);
        }
        let phases = Phases { line_search: clock.elapsed().as_secs_f64(), ..Phases::default() };
        Frame {
            iterations: answer.iterations,
            factorizations: answer.factorizations,
            converged: self.wound && self.search.as_ref().is_some_and(Search::is_done),
            residual: self.posture.residual,
            force_scale: question.model.force_scale_into(&self.posture.x, &mut self.trial),
            phases,
        }
    }
}

impl Tracker {
    /// A frame's part of the search for the best wound state; at its end that is shown. Returns the factorisations spent.
    fn look_around(&mut self, question: &mut Question, budget: usize, stop: &dyn Fn() -> bool) -> usize {
        let mut spent = 0;
        // A body that can turn freely ends in another position of the same pose each time: there is nothing to prove.
        let proved = question.model.free_pieces() == 0;
        let mut search = match self.search.take() {
            Some(search) => search,
            None => {
                let mut zero = vec![0.0; self.posture.beta.len()];
                question.actuation.clamp(&mut zero);
                let rest = question.model.rest.clone();
                let (rest, count) = question.settle(&zero, &rest, stop);
                if stop() {
                    return count;
                }
                spent += count;
                let mut search = Search::new(question, &rest, Care { proved, ..Care::THOROUGH });
                search.offer(&self.posture, true);
                search
            }
        };
        if !search.is_done() {
            spent += search.advance(question, budget.saturating_sub(spent), stop);
            let best = search.best();
            if search.is_done() && (proved || best.objective < self.posture.objective) {
                self.posture.clone_from(best);
            }
            question.actuation.contractions_into(&self.posture.beta, &mut self.contractions);
            question.model.contractile.set_contractions(&self.contractions);
        }
        self.search = Some(search);
        spent
    }
}

impl Fibers {
    /// Iterates within the budget. Whether there may be something new to show.
    #[allow(clippy::too_many_arguments)]
    fn follow(
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
    fn learn(&mut self, question: &mut Question, shown: Option<f64>, posture: &Posture) {
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

/// The sum of the squared tensions of all free elements, springs at activations `beta`, each of which winds one element.
/// Without allocation.
fn squared_tensions(question: &Question, x: &[f64], beta: &[f64]) -> f64 {
    let elements = &question.model.contractile.elements;
    let tension = |(winch, beta): (&Winch, &f64)| {
        let (element, ratio) = winch.members[0];
        let element = &elements[element];
        element.tension(element.length(x) - element.alpha0 + ratio * beta)
    };
    question.actuation.winches.iter().zip(beta).map(tension).map(|t| t * t).sum()
}
