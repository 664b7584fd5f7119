//! A compiled view with what it remembers, and how it is posed.

use super::body_spec::BodySpec;
use super::compile::{Plushie, View, compile, objective};
use super::play::Play;
use super::thorough::{pull_thoroughly, wind_from_all};
use crate::design::{Design, Target};
use crate::soft_ik::{self, Actuation, Answer, Posture, Quality, Tracker};
use std::sync::atomic::{AtomicBool, Ordering};

/// How much work a pose is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Warm-started, within the budget of the request's quality: while a hand drags.
    Interactive,
    /// From rest, several starts: for figures that are kept.
    Thorough,
}

/// A compiled view, the design it came from, and its last posture.
pub(super) struct Compiled {
    pub source: Design,
    pub plushie: Plushie,
    pub last: Option<Posture>,
    /// Follows the hand, with the targets that it follows.
    pub tracker: Option<(Vec<Target>, Tracker)>,
}

/// How much work a view is worth.
pub(super) struct Work<'a> {
    pub effort: Effort,
    pub quality: Quality,
    pub cancel: &'a AtomicBool,
}

impl Compiled {
    /// The effect of a millimetre of cable on a pose that was looked for with all effort; `None` where it was not.
    pub fn play(
        &mut self,
        design: &Design,
        targets: &[Target],
        actuation: &Actuation,
        posture: &Posture,
        work: &Work,
    ) -> Option<Play> {
        let stop = || work.cancel.load(Ordering::Relaxed);
        if targets.is_empty() || actuation.winches.is_empty() || work.effort != Effort::Thorough || stop() {
            return None;
        }
        let objective = objective(design, &self.plushie, targets);
        let mut question = soft_ik::Question { model: &mut self.plushie.model, actuation, objective: &objective };
        Some(Play::of(&mut question, design, targets, posture, &stop))
    }

    /// Solves one view. Without targets there is no inverse problem: statics alone, at activations `beta`.
    pub fn answer(
        &mut self,
        design: &Design,
        targets: &[Target],
        actuation: &Actuation,
        beta: Vec<f64>,
        beside: Option<&[f64]>,
        work: &Work,
    ) -> Answer {
        let objective = objective(design, &self.plushie, targets);
        let fibers = !self.plushie.fiber_elements.is_empty();
        let held = self.plushie.model.loose().is_empty();
        let rest = self.plushie.model.rest.clone();
        let mut question = soft_ik::Question { model: &mut self.plushie.model, actuation, objective: &objective };
        let stop = || work.cancel.load(Ordering::Relaxed);
        let last = self.last.take().filter(|p| p.beta.len() == beta.len());
        let posing = !targets.is_empty() && !actuation.winches.is_empty();
        let same = |followed: &[Target]| {
            followed.len() == targets.len()
                && followed.iter().zip(targets).all(|(a, b)| a.at == b.at && a.weight == b.weight)
        };
        let tracker = self.tracker.take().filter(|(followed, _)| posing && same(followed));
        if let (Effort::Interactive, Some((_, mut tracker))) = (work.effort, tracker) {
            let frame = tracker.frame(&mut question, work.quality, &stop);
            let answer = answered(&tracker, &frame);
            self.tracker = Some((targets.to_vec(), tracker));
            self.last = Some(answer.posture.clone());
            return answer;
        }
        // Without targets nothing but its rest says where a body is that is not held: where a hand had turned it is gone with the pose.
        let last = last.filter(|_| posing || held);
        let (from, x) = match &last {
            Some(last) if posing => (&last.beta, &last.x),
            Some(last) => (&beta, &last.x),
            None => (&beta, &rest),
        };
        let (start, factorizations) = question.settle(from, x, &stop);
        let mut answer = if !posing {
            let converged = start.in_equilibrium();
            Answer { converged, ..Answer::at(&start) }
        } else if work.effort == Effort::Interactive {
            let mut tracker = Tracker::within(&mut question, &start, &stop);
            let frame = tracker.frame(&mut question, work.quality, &stop);
            let answer = answered(&tracker, &frame);
            self.tracker = Some((targets.to_vec(), tracker));
            answer
        } else if fibers {
            // The tracker starts from rest as well. Wound from there all at once, a soft body may end elsewhere than the
            // realizable plushie did.
            let beside = beside.map(|x| question.settle(from, x, &stop).0);
            pull_thoroughly(&mut question, beside.as_ref().unwrap_or(&start), &start, &stop)
        } else {
            wind_from_all(&mut question, last.is_some().then_some(&start), &beta, &stop)
        };
        answer.factorizations += factorizations;
        self.last = Some(answer.posture.clone());
        answer
    }
}

fn answered(tracker: &Tracker, frame: &soft_ik::Frame) -> Answer {
    Answer {
        iterations: frame.iterations,
        factorizations: frame.factorizations,
        converged: frame.converged,
        ..Answer::at(tracker.posture())
    }
}

pub(super) fn compiled<'a>(
    slot: &'a mut Option<Compiled>,
    design: &Design,
    view: View,
) -> Result<&'a mut Compiled, String> {
    let compiled = match slot.take() {
        Some(compiled) if BodySpec::of(&compiled.source) == BodySpec::of(design) => compiled,
        before => {
            let plushie = compile(design, view).map_err(|e| e.to_string())?;
            // Where networks alone are others, its last posture is a start that is nearer than rest: a hole is dragged.
            let strung = |before: &Compiled| bare(&before.source) == bare(design);
            let last = before.filter(strung).and_then(|before| before.last);
            Compiled { source: body_of(design), plushie, last, tracker: None }
        }
    };
    Ok(slot.insert(compiled))
}

/// What a model depends on but for the networks.
fn bare(design: &Design) -> BodySpec<'_> {
    BodySpec { networks: &[], ..BodySpec::of(design) }
}

/// The design without what no model depends on.
fn body_of(design: &Design) -> Design {
    Design { poses: Vec::new(), keyframes: Vec::new(), ..design.clone() }
}
