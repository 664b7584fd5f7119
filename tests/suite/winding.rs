//! The best pose that winding from rest reaches, on rigs made from a seed.

use plushwright::bench::winding::rigs::{Rig, rig};
use plushwright::design;
use plushwright::engine::compile::{Plushie, View, compile, objective};
use plushwright::engine::target_error;
use plushwright::engine::{self, Effort, Outcome, Quality, Request, Shape, Solver};
use plushwright::soft_ik::contraction::GaussNewton;
use plushwright::soft_ik::winding::{Care, Search, distance, wound};
use plushwright::soft_ik::{self, Actuation, Budget, Method, Objective, Posture, Question, Tracker};
use std::cell::Cell;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const NEVER: &dyn Fn() -> bool = &|| false;
const SEED: u64 = 1;

/// Rigs of one winch whose first valley is not the deepest: shape and number, with the part of the error at rest that Gauss-Newton
/// from rest leaves at least, and that which is left in the best valley at most.
const TWO_VALLEYS: [(&str, u64, f64, f64); 4] =
    [("e", 33, 0.99, 0.01), ("e", 27, 0.99, 0.6), ("robot", 21, 0.99, 0.8), ("pig", 4, 0.99, 0.9)];

struct Posed {
    rig: Rig,
    plushie: Plushie,
    actuation: Actuation,
    objective: Objective,
}

impl Posed {
    fn new(shape: &str, winches: usize, number: u64) -> Self {
        let rig = rig(shape, winches, SEED, number, NEVER).unwrap();
        let plushie = compile(&rig.design, View::Realizable).unwrap();
        let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
        let objective = objective(&rig.design, &plushie, &rig.targets);
        Self { rig, plushie, actuation, objective }
    }

    fn question(&mut self) -> Question<'_> {
        Question { model: &mut self.plushie.model, actuation: &self.actuation, objective: &self.objective }
    }

    /// Target error as a part of that at rest.
    fn error(&self, x: &[f64]) -> f64 {
        let nodes: Vec<[f64; 2]> = x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
        let Rig { design, targets } = &self.rig;
        target_error(design, targets, &nodes) / target_error(design, targets, &design.mesh.nodes)
    }
}

fn at_rest(question: &mut Question) -> Posture {
    let rest = question.model.rest.clone();
    let zero = vec![0.0; question.actuation.winches.len()];
    question.settle(&zero, &rest, NEVER).0
}

fn budget(iterations: usize) -> Budget<'static> {
    Budget { iterations, stop: NEVER }
}

fn ask(rig: &Rig, setpoint: engine::Setpoint, effort: Effort) -> Outcome {
    let request = Request {
        id: 0,
        design: Arc::new(rig.design.clone()),
        setpoint,
        quality: Quality::Accurate,
        show_idealized: false,
        show_realizable: true,
    };
    Solver::default().solve_with(&request, effort, &AtomicBool::new(false))
}

fn shown(rig: &Rig) -> Shape {
    ask(rig, engine::Setpoint::Targets(rig.targets.clone()), Effort::Thorough).realizable.unwrap()
}

#[test]
fn the_deepest_valley_is_shown_where_the_first_is_not_the_deepest() {
    for (shape, number, first, deepest) in TWO_VALLEYS {
        let mut posed = Posed::new(shape, 1, number);
        let mut question = posed.question();
        let start = at_rest(&mut question);
        let nearest = GaussNewton::default().solve(&mut question, &start, &budget(200)).posture;
        let by_default = soft_ik::solve(&mut question, &[0.0], &budget(300)).posture;
        let shown = shown(&posed.rig);
        // What is shown is where winding from rest ends, in few steps and in many.
        let mut question = posed.question();
        let ends = [12, 300].map(|steps| question.wind(&start, &shown.activations_mm, steps, NEVER).0.x);
        let x: Vec<f64> = shown.nodes.as_flattened().to_vec();
        assert!(posed.error(&nearest.x) >= first, "{shape} {number}: {}", posed.error(&nearest.x));
        for (what, x) in [("shown", &x), ("default", &by_default.x), ("12 steps", &ends[0]), ("300 steps", &ends[1])] {
            assert!(posed.error(x) <= deepest, "{shape} {number}, {what}: {}", posed.error(x));
        }
        assert!(shown.wound && shown.converged && shown.play.unwrap().error >= shown.target_error);
    }
}

/// A winch whose range ends just behind the place where its body snaps: the last step there is longer than the shortest one, and was asked for
/// again and again.
#[test]
fn a_snap_within_the_last_step_of_the_way_ends_it() {
    /// Where the body snaps, mm of cable, and the shortest step.
    const SNAP: f64 = 31.805706500496484;
    const STEP: f64 = SNAP / 1024.0;
    let design = design::file::read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/designs/snap.plush")));
    let design = design.unwrap();
    let mut plushie = compile(&design, View::Realizable).unwrap();
    let mut actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
    let objective = objective(&design, &plushie, &design.poses[0].targets);
    for sixteenths in 2..20 {
        actuation.winches[0].upper = SNAP + STEP * (0.5 + sixteenths as f64) / 16.0;
        let mut question = Question { model: &mut plushie.model, actuation: &actuation, objective: &objective };
        let start = at_rest(&mut question);
        let asked = Cell::new(0);
        let stop = || {
            asked.set(asked.get() + 1);
            asked.get() > 2_000
        };
        // Walking alone.
        let care = Care { polished: 0, proved: false, ..Care::THOROUGH };
        Search::new(&question, &start, care).run(&mut question, &stop);
        assert!(!stop(), "{sixteenths} sixteenths: no end");
    }
}

#[test]
fn what_is_found_is_wound_from_rest_and_no_worse_than_what_lies_around() {
    for (shape, winches, number) in [("e", 2, 3), ("robot", 2, 5), ("e", 3, 1)] {
        let mut posed = Posed::new(shape, winches, number);
        let size = posed.rig.design.body_length_mm();
        let mut question = posed.question();
        let start = at_rest(&mut question);
        let nearest = GaussNewton::default().solve(&mut question, &start, &budget(200)).posture;
        let answer = Search::new(&question, &start, Care::THOROUGH).run(&mut question, NEVER);
        assert!(answer.converged, "{shape} {winches} {number}");
        let found = answer.posture;
        let (again, _) = question.wind(&start, &found.beta, 100, NEVER);
        assert!(distance(&again.x, &found.x) < 1e-3 * size, "{shape} {winches} {number}");
        // Gauss-Newton from rest counts where winding from rest leads to its end.
        if let (Some(end), _) = wound(&mut question, &start, &nearest.beta, NEVER) {
            assert!(found.objective <= end.objective * (1.0 + 1e-6), "{shape} {winches} {number}");
        }
        for (b, w) in found.beta.iter().zip(&question.actuation.winches) {
            assert!(*b >= w.lower && *b <= w.upper);
        }
    }
}

#[test]
fn a_search_spread_over_frames_ends_where_one_at_a_stretch_does() {
    let mut posed = Posed::new("e", 1, 27);
    let mut question = posed.question();
    let start = at_rest(&mut question);
    let whole = Search::new(&question, &start, Care::THOROUGH).run(&mut question, NEVER);
    let mut search = Search::new(&question, &start, Care::THOROUGH);
    let (mut parts, mut spent) = (0, 0);
    while !search.is_done() {
        let now = search.advance(&mut question, 6, NEVER);
        assert!(now < 60, "{now} factorisations in one part");
        spent += now;
        parts += 1;
    }
    assert_eq!((search.best(), spent), (&whole.posture, whole.factorizations));
    assert!(parts > 10);
    // The tracker does the same in the frames in which the targets rest.
    let mut tracker = Tracker::new(&mut question, &start);
    let mut frames = 0;
    while !tracker.frame(&mut question, Quality::Balanced, NEVER).converged {
        frames += 1;
        assert!(frames < 200, "no end");
    }
    let posture = tracker.posture();
    assert!((posture.objective - whole.posture.objective).abs() <= 1e-6 * whole.posture.objective, "{frames} frames");
}

#[test]
fn problem_files_with_few_winches_cost_little_more_than_one_run() {
    let (mut spent, mut alone) = (0, 0);
    for (shape, winches, number) in
        [("e", 1, 0), ("s", 1, 1), ("e", 2, 0), ("robot", 2, 1), ("e", 3, 0), ("puppy", 3, 2)]
    {
        let mut posed = Posed::new(shape, winches, number);
        let mut question = posed.question();
        let start = at_rest(&mut question);
        let nearest = GaussNewton::default().solve(&mut question, &start, &budget(300));
        let answer = soft_ik::solve(&mut question, &vec![0.0; winches], &budget(300));
        let (o, g) = (answer.posture.objective, nearest.posture.objective);
        println!("{shape} {winches} {number}: {} of {}", answer.factorizations, nearest.factorizations);
        assert!(o <= g + 1e-6 * (start.objective - g).abs(), "{shape} {winches} {number}: {o} above {g}");
        // A run that is over at once leaves a look around all the same.
        assert!(answer.factorizations <= 5 * nearest.factorizations.max(24), "{shape} {winches} {number}");
        spent += answer.factorizations;
        alone += nearest.factorizations;
    }
    assert!(spent <= 5 * alone, "{spent} factorisations where one run takes {alone}");
}

#[test]
fn a_winch_without_bounds_and_one_that_is_held_are_wound_as_well() {
    let mut posed = Posed::new("e", 2, 3);
    posed.actuation.winches[0].lower = f64::NEG_INFINITY;
    posed.actuation.winches[0].upper = f64::INFINITY;
    let held = posed.actuation.winches[1].upper * 0.2;
    (posed.actuation.winches[1].lower, posed.actuation.winches[1].upper) = (held, held);
    let mut question = posed.question();
    let rest = question.model.rest.clone();
    let (start, _) = question.settle(&[0.0, held], &rest, NEVER);
    let answer = Search::new(&question, &start, Care::THOROUGH).run(&mut question, NEVER);
    assert!(answer.posture.in_equilibrium() && answer.posture.beta[1] == held);
    let by_default = soft_ik::solve(&mut question, &[0.0, 0.0], &budget(300));
    assert!(by_default.posture.in_equilibrium() && by_default.posture.beta[1] == held);
    let nothing = Actuation { winches: Vec::new(), fixed: vec![0.0; posed.actuation.fixed.len()] };
    let mut question = Question { model: &mut posed.plushie.model, actuation: &nothing, objective: &posed.objective };
    let start = at_rest(&mut question);
    let answer = Search::new(&question, &start, Care::THOROUGH).run(&mut question, NEVER);
    assert!(answer.converged && answer.posture == start);
}

#[test]
fn play_is_what_a_millimetre_of_cable_does() {
    let posed = Posed::new("e", 1, 27);
    let shown = shown(&posed.rig);
    let play = shown.play.unwrap();
    let off = |by: f64| {
        let activations = engine::Setpoint::Activations(vec![shown.activations_mm[0] + by]);
        let shape = ask(&posed.rig, activations, Effort::Interactive).realizable.unwrap();
        target_error(&posed.rig.design, &posed.rig.targets, &shape.nodes)
    };
    let expected = off(-1.0).max(off(1.0)).max(shown.target_error);
    assert!((play.error - expected).abs() < 1e-6, "{} is not {expected}", play.error);
}
