//! Poses both plushies of a design, warm-started from the request before.

use super::body_spec::BodySpec;
use super::compile::{Plushie, View, compile, objective};
use super::play::Play;
use super::{Outcome, Quality, Question, Request, Shape, Warning};
use crate::design::{Design, Target};
use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::winding::{self, Care, Search};
use crate::soft_ik::{self, Actuation, Answer, Budget, Method, Posture, Tracker};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Iterations of the winches' methods where there is time (checks, rigging).
const THOROUGH_ITERATIONS: usize = 200;

/// Frames of the fibres' solver there, at the finest quality: most poses are done in three.
const THOROUGH_FRAMES: usize = 16;

/// How much work a pose is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Warm-started, within the budget of the request's quality: while a hand drags.
    Interactive,
    /// From rest, several starts: for figures that are kept.
    Thorough,
}

/// Keeps compiled models and the last postures between requests.
#[derive(Default)]
pub struct Solver {
    idealized: Option<Compiled>,
    realizable: Option<Compiled>,
}

/// A compiled view, the design it came from, and its last posture.
struct Compiled {
    source: Design,
    plushie: Plushie,
    last: Option<Posture>,
    /// Follows the hand, with the targets that it follows.
    tracker: Option<(Vec<Target>, Tracker)>,
}

/// How much work a view is worth.
struct Work<'a> {
    effort: Effort,
    quality: Quality,
    cancel: &'a AtomicBool,
}

impl Solver {
    /// Answers a request; `cancel` is checked at every Newton step and leaves the best state reached so far.
    pub fn solve(&mut self, request: &Request, cancel: &AtomicBool) -> Outcome {
        self.solve_with(request, Effort::Interactive, cancel)
    }

    /// The same with a stated effort. The realizable plushie comes first; its activations are held in the idealized one.
    pub fn solve_with(&mut self, request: &Request, effort: Effort, cancel: &AtomicBool) -> Outcome {
        let design = &request.design;
        let work = Work { effort, quality: request.quality, cancel };
        let [_, needed] = request.solves();
        let realizable = needed.then(|| realize(&mut self.realizable, design, &request.question, &work));
        let idealized = request.show_idealized.then(|| {
            let activations = match (&realizable, &request.question) {
                (Some(shape), _) => shape.activations_mm.clone(),
                (None, Question::Activations(given)) => given.clone(),
                (None, Question::Targets(_)) => vec![0.0; design.networks.len()],
            };
            let beside = realizable.as_ref().map(|shape| shape.nodes.as_flattened());
            idealize(&mut self.idealized, design, &request.question, &activations, beside, &work)
        });
        let realizable = realizable.filter(|_| request.show_realizable);
        Outcome { id: request.id, idealized, realizable, refined: effort == Effort::Thorough }
    }
}

/// The winches alone, towards the targets or at given activations.
fn realize(slot: &mut Option<Compiled>, design: &Design, question: &Question, work: &Work) -> Shape {
    let clock = Instant::now();
    let compiled = match compiled(slot, design, View::Realizable) {
        Ok(compiled) => compiled,
        Err(message) => return Shape::at_rest(design, message),
    };
    let plushie = &compiled.plushie;
    let (targets, actuation, beta) = match question {
        Question::Targets(targets) => {
            let free = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
            (targets.as_slice(), free, vec![0.0; plushie.winches.len()])
        }
        Question::Activations(beta) => {
            let all = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
            let held = Actuation { winches: Vec::new(), fixed: all.contractions(beta) };
            (&[][..], held, Vec::new())
        }
    };
    let answer = compiled.answer(design, targets, &actuation, beta, None, work);
    let play = compiled.play(design, targets, &actuation, &answer.posture, work);
    let plushie = &compiled.plushie;
    let mut shape = report(design, plushie, targets, &answer.posture, clock).counted(&answer);
    shape.wound = play.is_some() && plushie.model.free_pieces() == 0;
    if shape.warning.is_none() {
        shape.warning = Warning::of_play(design, targets, &shape, play.as_ref());
    }
    shape.play = play;
    if let Question::Activations(beta) = question {
        shape.activations_mm = beta.clone();
    }
    shape
}

/// The fibres, with the winches held at `activations`. `beside`: where these winches alone have brought the realizable plushie.
fn idealize(
    slot: &mut Option<Compiled>,
    design: &Design,
    question: &Question,
    activations: &[f64],
    beside: Option<&[f64]>,
    work: &Work,
) -> Shape {
    let clock = Instant::now();
    let compiled = match compiled(slot, design, View::Idealized) {
        Ok(compiled) => compiled,
        Err(message) => return Shape::at_rest(design, message),
    };
    let plushie = &compiled.plushie;
    let count = plushie.fiber_elements.end;
    let all = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; count] };
    let fixed = all.contractions(activations);
    let (targets, winches) = match question {
        Question::Targets(targets) => (targets.as_slice(), plushie.fibers.clone()),
        Question::Activations(_) => (&[][..], Vec::new()),
    };
    let beta = vec![0.0; winches.len()];
    let actuation = Actuation { winches, fixed };
    let answer = compiled.answer(design, targets, &actuation, beta, beside, work);
    let plushie = &compiled.plushie;
    let mut shape = report(design, plushie, targets, &answer.posture, clock).counted(&answer);
    shape.activations_mm = activations.to_vec();
    let contractions = actuation.contractions(&answer.posture.beta);
    let tensions = plushie.model.contractile.tensions(&answer.posture.x);
    shape.fiber_contractions_mm = contractions[plushie.fiber_elements.clone()].to_vec();
    shape.fiber_tensions = tensions[plushie.fiber_elements.clone()].to_vec();
    shape
}

impl Compiled {
    /// What a millimetre of cable does to a pose that was looked for with all effort; `None` where it was not.
    fn play(
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
    fn answer(
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

/// The best state that winding from rest reaches, what the hand has found included where winding leads there.
fn wind_from_all(
    question: &mut soft_ik::Question,
    hand: Option<&Posture>,
    zero: &[f64],
    stop: &dyn Fn() -> bool,
) -> Answer {
    let rest = question.model.rest.clone();
    let (rest, mut spent) = question.settle(zero, &rest, stop);
    // A body that can turn freely ends in another position of the same pose each time: there is nothing to prove.
    let proved = question.model.free_pieces() == 0;
    let mut search = Search::new(question, &rest, Care { proved, ..Care::THOROUGH });
    let budget = Budget { iterations: THOROUGH_ITERATIONS, stop };
    if zero.len() > winding::LATTICE {
        let found = winding::from_several(question, &rest, &budget);
        spent += found.factorizations;
        search.offer(&found.posture, found.converged);
    }
    if let Some(hand) = hand {
        let onwards = GaussNewton::default().solve(question, hand, &budget);
        spent += onwards.factorizations;
        search.offer(&onwards.posture, onwards.converged);
        search.offer(hand, false);
    }
    let mut answer = search.run(question, stop);
    if let Some(hand) = hand.filter(|hand| stop() && hand.objective < answer.posture.objective) {
        answer.posture = hand.clone();
        let contractions = question.actuation.contractions(&answer.posture.beta);
        question.model.contractile.set_contractions(&contractions);
    }
    answer.factorizations += spent;
    answer
}

/// The fibres, frame by frame to the end: each ends in equilibrium, so that a state which would snap elsewhere is noticed and
/// left. The best pose on the way counts, and what the hand has found.
fn pull_thoroughly(
    question: &mut soft_ik::Question,
    start: &Posture,
    hand: &Posture,
    stop: &dyn Fn() -> bool,
) -> Answer {
    let mut tracker = Tracker::within(question, start, stop);
    let found = if hand.in_equilibrium() && hand.objective < start.objective { hand } else { start };
    let mut best = Answer::at(found);
    for _ in 0..THOROUGH_FRAMES {
        let frame = tracker.frame(question, Quality::Accurate, stop);
        best.iterations += frame.iterations;
        best.factorizations += frame.factorizations;
        let now = tracker.posture();
        if now.in_equilibrium() && (now.objective < best.posture.objective || !best.posture.in_equilibrium()) {
            best.posture = now.clone();
        }
        best.converged = frame.converged;
        if frame.converged || stop() {
            break;
        }
    }
    let contractions = question.actuation.contractions(&best.posture.beta);
    question.model.contractile.set_contractions(&contractions);
    best
}

fn compiled<'a>(slot: &'a mut Option<Compiled>, design: &Design, view: View) -> Result<&'a mut Compiled, String> {
    let keep = slot.take().filter(|c| BodySpec::of(&c.source) == BodySpec::of(design));
    let compiled = match keep {
        Some(compiled) => compiled,
        None => {
            let plushie = compile(design, view).map_err(|e| e.to_string())?;
            Compiled { source: body_of(design), plushie, last: None, tracker: None }
        }
    };
    Ok(slot.insert(compiled))
}

/// The design without what no model depends on.
fn body_of(design: &Design) -> Design {
    Design { poses: Vec::new(), keyframes: Vec::new(), ..design.clone() }
}

/// Activations for display and export: a winch whose cables are all slack is wound just to the point where they are not
/// yet taut, within its bounds.
fn tidy(plushie: &Plushie, posture: &Posture) -> Vec<f64> {
    let elements = &plushie.model.contractile.elements;
    plushie
        .winches
        .iter()
        .zip(&posture.beta)
        .map(|(winch, beta)| {
            let slack = |&(e, ratio): &(usize, f64)| {
                (elements[e].alpha0 - elements[e].length(&posture.x) - elements[e].epsilon) / ratio
            };
            let just_slack = winch.members.iter().map(slack).fold(f64::INFINITY, f64::min);
            if just_slack > *beta { just_slack.min(winch.upper) } else { *beta }
        })
        .collect()
}

/// A posture as it is shown. The model's laws must be those of the posture.
pub fn report(design: &Design, plushie: &Plushie, targets: &[Target], posture: &Posture, clock: Instant) -> Shape {
    let tensions = plushie.model.contractile.tensions(&posture.x);
    let nodes: Vec<[f64; 2]> = posture.x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
    Shape {
        target_error: target_error(design, targets, &nodes),
        nodes,
        activations_mm: tidy(plushie, posture),
        fiber_contractions_mm: Vec::new(),
        fiber_tensions: Vec::new(),
        tendon_tensions: tensions[plushie.tendons.clone()].to_vec(),
        residual: posture.residual,
        force_scale: plushie.model.force_scale(&posture.x),
        converged: posture.in_equilibrium(),
        iterations: 0,
        factorizations: 0,
        milliseconds: clock.elapsed().as_secs_f64() * 1e3,
        wound: false,
        play: None,
        warning: Warning::of(plushie, posture),
    }
}

/// Rms distance of the targets in body lengths; zero without targets.
pub fn target_error(design: &Design, targets: &[Target], nodes: &[[f64; 2]]) -> f64 {
    if targets.is_empty() {
        return 0.0;
    }
    let sum: f64 = targets
        .iter()
        .map(|t| {
            let p = design.mesh.position(&t.at, nodes);
            (p[0] - t.to[0]).powi(2) + (p[1] - t.to[1]).powi(2)
        })
        .sum();
    (sum / targets.len() as f64).sqrt() / design.body_length_mm()
}

impl Shape {
    fn counted(self, answer: &Answer) -> Self {
        Self { iterations: answer.iterations, factorizations: answer.factorizations, ..self }
    }

    /// The rest shape, with what is to be said about it.
    pub fn at_rest(design: &Design, why: String) -> Self {
        Self {
            nodes: design.mesh.nodes.clone(),
            activations_mm: vec![0.0; design.networks.len()],
            warning: Some(Warning::Solver(why)),
            ..Self::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{EQUILIBRIUM, Quality};
    use super::*;
    use crate::design::testing;
    use std::sync::Arc;

    fn ask(solver: &mut Solver, design: &Design, question: Question, shown: [bool; 2]) -> Outcome {
        let design = Arc::new(design.clone());
        let [show_idealized, show_realizable] = shown;
        let request = Request { id: 0, design, question, quality: Quality::Balanced, show_idealized, show_realizable };
        solver.solve(&request, &AtomicBool::new(false))
    }

    /// Whether the idealized and the realizable plushie were worked on.
    fn worked(solver: &Solver) -> [bool; 2] {
        [solver.idealized.is_some(), solver.realizable.is_some()]
    }

    #[test]
    fn a_hidden_view_is_not_solved() {
        let rigged = testing::sample();
        let plain = Design { networks: Vec::new(), keyframes: Vec::new(), ..rigged.clone() };
        let pose = || Question::Targets(rigged.poses[0].targets.clone());
        for (design, question, shown) in [
            (&plain, pose(), [true, false]),
            (&plain, pose(), [false, true]),
            (&rigged, pose(), [false, true]),
            (&rigged, Question::Targets(Vec::new()), [true, false]),
            (&rigged, Question::Activations(vec![3.0, 1.0]), [true, false]),
        ] {
            let mut solver = Solver::default();
            let outcome = ask(&mut solver, design, question, shown);
            assert_eq!([outcome.idealized.is_some(), outcome.realizable.is_some()], shown);
            assert_eq!(worked(&solver), shown, "{} networks", design.networks.len());
        }
        // The fibres add to what the winches reach, so these are searched for, seen or not.
        let mut solver = Solver::default();
        let outcome = ask(&mut solver, &rigged, pose(), [true, false]);
        assert!(outcome.realizable.is_none());
        assert_eq!(worked(&solver), [true, true]);
    }

    #[test]
    fn a_view_looks_the_same_alone() {
        let design = testing::sample();
        for question in [Question::Targets(Vec::new()), Question::Activations(vec![3.0, 1.0])] {
            let together = ask(&mut Solver::default(), &design, question.clone(), [true, true]);
            let alone = ask(&mut Solver::default(), &design, question, [true, false]);
            let [together, alone] = [together, alone].map(|outcome| outcome.idealized.unwrap());
            for (p, q) in together.nodes.iter().flatten().zip(alone.nodes.iter().flatten()) {
                assert!((p - q).abs() < 1e-6, "{p} {q}");
            }
        }
    }

    #[test]
    fn all_effort_makes_neither_view_worse() {
        // Held by one pin the body turns freely: the winches alone leave it turned as the hand did.
        let mut design = testing::sample();
        design.pins.truncate(1);
        let home = design.poses[0].targets.clone();
        let design = Arc::new(design);
        let mut solver = Solver::default();
        let mut ask = |targets: &[Target], effort| {
            let question = Question::Targets(targets.to_vec());
            let quality = Quality::Balanced;
            let request = Request {
                id: 0,
                design: design.clone(),
                question,
                quality,
                show_idealized: true,
                show_realizable: true,
            };
            let outcome = solver.solve_with(&request, effort, &AtomicBool::new(false));
            [outcome.idealized.unwrap(), outcome.realizable.unwrap()].map(|shape| shape.target_error)
        };
        let size = design.body_length_mm();
        for turn in 0..8 {
            let (sin, cos) = (0.8 * f64::from(turn)).sin_cos();
            let mut away = home.clone();
            away[0].to = [3.0 * size * cos, 3.0 * size * sin];
            ask(&away, Effort::Interactive);
            let hand = ask(&home, Effort::Interactive);
            let all = ask(&home, Effort::Thorough);
            assert!(all[0] <= hand[0] + 1e-6 && all[1] <= hand[1] + 1e-6, "turn {turn}: {all:?} after {hand:?}");
        }
    }

    #[test]
    fn a_shape_says_how_far_from_equilibrium_it_is() {
        let design = testing::sample();
        let outcome = ask(&mut Solver::default(), &design, Question::Activations(vec![3.0, 1.0]), [true, true]);
        for shape in [outcome.idealized.unwrap(), outcome.realizable.unwrap()] {
            assert!(shape.converged && shape.factorizations > 0 && shape.force_scale > 0.0);
            assert!(shape.distance_from_equilibrium() < EQUILIBRIUM, "{}", shape.distance_from_equilibrium());
        }
        assert_eq!(Shape::default().distance_from_equilibrium(), 0.0);
    }
}
