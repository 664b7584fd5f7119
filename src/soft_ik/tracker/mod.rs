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

mod fibers;
mod show;
mod winches;

use super::winding::Search;
use super::{Frame, Phases, Posture, Quality, Question};
use crate::physics::statics;
use fibers::{Fibers, Stage};

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

impl Tracker {
    /// Starts at a posture in equilibrium. Works out the rest pose (activations zero) too.
    pub fn new(question: &mut Question, start: &Posture) -> Self {
        Self::within(question, start, &|| false)
    }

    /// [`Self::new`]; once `stop` says so, the rest pose is left for later.
    pub fn within(question: &mut Question, start: &Posture, stop: &dyn Fn() -> bool) -> Self {
        let elements = question.model.contractile.elements.len();
        let fibers = question.actuation.is_fibers_only() && !question.actuation.winches.is_empty();
        let fibers = fibers.then(|| Fibers::new(question, start, stop));
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
}
