//! Work ends when it is told to: at most one factorisation (two where the first one fails) follows a question whether to stop,
//! and what is left is a body all the same.

use plushwright::bench::extremes::scenes::{aim, bar, bent_arm, fibers_on_all_edges, pin};
use plushwright::physics::Model;
use plushwright::problem::file::{DragData, SoftIkData};
use plushwright::problem::{Failure, Options, Problem, model, solve};
use plushwright::soft_ik::{Actuation, Budget, Objective, PointTarget, Quality, Question, Tracker, Winch, method};
use std::cell::Cell;
use std::time::{Duration, Instant};

/// The arm whose fibres shall lift its end.
struct Scene {
    model: Model,
    actuation: Actuation,
    objective: Objective,
}

fn scene() -> Scene {
    let problem = bent_arm(0.0);
    let model = model(&problem).unwrap();
    let winch = |e: usize| Winch { members: vec![(e, 1.0)], lower: 0.0, upper: 0.5 * problem.elements[e].alpha0 };
    let count = problem.elements.len();
    let actuation = Actuation { winches: (0..count).map(winch).collect(), fixed: vec![0.0; count] };
    let tip = PointTarget { nodes: vec![20], weights: vec![1.0], goal: [0.8, 0.7], weight: 1.0 };
    let objective = Objective {
        targets: vec![tip],
        rest_weights: vec![1e-4; problem.mesh.nodes.len()],
        rest: model.rest.clone(),
        contraction_weight: 0.0,
        tension_weight: 1e-4,
    };
    Scene { model, actuation, objective }
}

#[test]
fn every_method_asks_between_factorisations() {
    for name in ["default", "gradient", "contraction", "tension", "tracker"] {
        for most in [0, 1, 2, 3, 5, 9, 20] {
            let Scene { mut model, actuation, objective } = scene();
            let asked = Cell::new(0);
            let stop = || {
                asked.set(asked.get() + 1);
                asked.get() > most
            };
            let rest = model.rest.clone();
            let mut question = Question { model: &mut model, actuation: &actuation, objective: &objective };
            let (start, _) = question.settle(&vec![0.0; actuation.winches.len()], &rest, &|| false);
            let (posture, factorizations) = if name == "tracker" {
                let mut tracker = Tracker::within(&mut question, &start, &stop);
                let frame = tracker.frame(&mut question, Quality::Accurate, &stop);
                (tracker.posture().clone(), frame.factorizations)
            } else {
                let budget = Budget { iterations: 100, stop: &stop };
                let answer = method(name).unwrap().solve(&mut question, &start, &budget);
                (answer.posture, answer.factorizations)
            };
            assert!(factorizations <= 2 * most, "{name}: {factorizations} factorisations after {most} questions");
            assert!(model.body.smallest_determinant(&posture.x) > 0.0, "{name}, {most}");
            let within = |(b, w): (&f64, &Winch)| (w.lower..=w.upper).contains(b);
            assert!(posture.beta.iter().zip(&actuation.winches).all(within), "{name}, {most}: {:?}", posture.beta);
        }
    }
}

/// A bar of 6 600 cells with a fibre on every edge, its end to be lifted.
fn large() -> Problem {
    let (columns, rows) = (120, 55);
    let mut problem = bar(2.0, 1.0, columns, rows);
    fibers_on_all_edges(&mut problem, 0.1);
    (0..=rows).for_each(|j| pin(&mut problem, j * (columns + 1), 1e3));
    aim(&mut problem, &[columns, rows * (columns + 1) + columns]);
    if let Some(objective) = &mut problem.objective {
        objective.targets.iter_mut().for_each(|t| t.xy[1] += 0.4);
    }
    problem
}

#[test]
fn a_budget_holds_for_20_000_fibers() {
    let plain = large();
    assert!(plain.elements.len() > 19_000);
    let upper = plain.elements.iter().map(|e| Some(0.3 * e.alpha0)).collect();
    let soft_ik = SoftIkData { beta_upper: Some(upper), ..SoftIkData::default() };
    let goals =
        |lift: f64| plain.objective.iter().flat_map(|o| &o.targets).map(|t| [t.xy[0], t.xy[1] + lift]).collect();
    let drag = DragData { frames: vec![goals(0.0), goals(0.2)], report: vec![0], tension_regulariser: 1e-4 };
    for (name, problem) in [
        ("statics", plain.clone()),
        ("soft_ik", Problem { soft_ik: Some(soft_ik), contractions: None, ..plain.clone() }),
        ("drag", Problem { drag: Some(drag), ..plain.clone() }),
    ] {
        let options = Options { budget: Duration::from_millis(50), ..Options::default() };
        let clock = Instant::now();
        let answered = solve(&problem, &options).unwrap();
        println!("{name}: {:?}", clock.elapsed());
        let out_of_time = |f: &Failure| matches!(f, Failure::TimeBudget { .. });
        assert!(!answered.converged && answered.failures.iter().all(out_of_time), "{name}: {:?}", answered.failures);
    }
}
