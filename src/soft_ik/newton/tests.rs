//! The reduced Hessian against differences of the gradient, and the ways to solve with it against each other.

use super::damped::{Model as Quadratic, Point};
use super::form::Form;
use super::interior;
use super::saddle::Step;
use super::*;
use crate::physics::{Body, Contractile, Element, MaterialPoint, Model, NeoHookean, PinSpring, Pins};
use crate::soft_ik::{Actuation, Objective, PointTarget, Winch, sensitivity};

const NEVER: &dyn Fn() -> bool = &|| false;

/// A cantilever of `nx` by 2 squares with a fibre on every edge and two tendons; fibres are winches of one element each, the
/// tendons one winch of two elements, with ratios.
fn cantilever(nx: usize) -> (Model, Actuation, Objective) {
    let at = |i: usize, j: usize| 3 * i + j;
    let mut nodes = Vec::new();
    for i in 0..=nx {
        for j in 0..3 {
            let bend = 0.03 * ((1 + i * 7 + j * 5) as f64).sin();
            nodes.push([0.2 * i as f64 + bend, 0.2 * j as f64 - 0.5 * bend]);
        }
    }
    let (mut triangles, mut edges) = (Vec::new(), Vec::new());
    for i in 0..nx {
        for j in 0..2 {
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            edges.extend([[at(i, j), at(i + 1, j)], [at(i, j), at(i + 1, j + 1)], [at(i + 1, j), at(i + 1, j + 1)]]);
        }
        edges.push([at(i, 2), at(i + 1, 2)]);
    }
    let element = |routing: Vec<usize>, stiffness: f64| {
        let length = |s: &[usize]| (nodes[s[0]][0] - nodes[s[1]][0]).hypot(nodes[s[0]][1] - nodes[s[1]][1]);
        let alpha0 = routing.windows(2).map(length).sum();
        // A wide transition, so that few elements change zone within a difference quotient.
        Element { routing: MaterialPoint::through(routing), stiffness, epsilon: 0.15 * alpha0, alpha0 }
    };
    let mut elements: Vec<Element> = edges.iter().map(|e| element(e.to_vec(), 1.5)).collect();
    let fibers = elements.len();
    elements.push(element((0..=nx).map(|i| at(i, 2)).collect(), 2.0));
    elements.push(element((0..nx).map(|i| at(i, i % 2)).collect(), 2.0));
    let mut winches: Vec<Winch> = (0..fibers)
        .map(|e| Winch { members: vec![(e, if e % 3 == 0 { 0.7 } else { 1.0 })], lower: -0.03, upper: 0.06 })
        .collect();
    winches.push(Winch { members: vec![(fibers, 1.0), (fibers + 1, 0.6)], lower: f64::NEG_INFINITY, upper: 0.3 });
    let target = |node: usize, goal: [f64; 2]| PointTarget { nodes: vec![node], weights: vec![1.0], goal, weight: 1.0 };
    let patch = PointTarget {
        nodes: vec![at(nx - 1, 0), at(nx, 0), at(nx, 1)],
        weights: vec![0.2, 0.5, 0.3],
        goal: [0.15 * nx as f64, 0.25],
        weight: 1.7,
    };
    let objective = Objective {
        targets: vec![target(at(nx, 2), [0.17 * nx as f64, 0.75]), patch],
        rest_weights: (0..nodes.len()).map(|i| 0.01 * (1 + i % 3) as f64).collect(),
        rest: nodes.iter().flatten().copied().collect(),
        contraction_weight: 3e-3,
        tension_weight: 0.0,
    };
    let body = Body::new(&nodes, &triangles, Box::new(NeoHookean { mu: 1.0, kappa: 1.5 }), None).unwrap();
    let pins = Pins { pins: (0..3).map(|j| PinSpring::node(at(0, j), nodes[at(0, j)], 50.0)).collect() };
    let fixed = vec![0.0; elements.len()];
    let model = Model::new(&nodes, body, Contractile::new(elements), pins, Vec::new()).unwrap();
    (model, Actuation { winches, fixed }, objective)
}

/// Activations in general position.
fn activations(actuation: &Actuation) -> Vec<f64> {
    (0..actuation.winches.len()).map(|j| 0.025 + 0.02 * (1.3 * j as f64).sin()).collect()
}

/// A search linearised at these activations, and the posture there.
fn linearised(question: &mut Question, beta: &[f64]) -> (Search, Posture) {
    let rest = question.model.rest.clone();
    let (posture, _) = question.settle(beta, &rest, NEVER);
    assert!(posture.in_equilibrium());
    let mut search = Search::new(question).unwrap();
    assert!(search.linearise(question, &posture, &mut 0));
    (search, posture)
}

fn largest(v: impl IntoIterator<Item = f64>) -> f64 {
    v.into_iter().fold(0.0, |m, a| m.max(a.abs()))
}

#[test]
fn gradient_and_reduced_hessian_are_the_derivatives() {
    // Both with all winches on the border and with most of them eliminated.
    for nx in [2, 6] {
        let (mut model, actuation, objective) = cantilever(nx);
        let mut question = Question { model: &mut model, actuation: &actuation, objective: &objective };
        let beta = activations(&actuation);
        let (mut search, posture) = linearised(&mut question, &beta);
        let gradient_at = |question: &mut Question, beta: &[f64]| {
            let (at, _) = question.settle(beta, &posture.x, NEVER);
            let contractions = question.actuation.contractions(beta);
            sensitivity::gradient(question, &at.x, &contractions).unwrap().by_activation
        };
        let expected = gradient_at(&mut question, &beta);
        let apart = search.local.gradient.iter().zip(&expected).map(|(a, b)| a - b);
        assert!(largest(apart) < 1e-9 * largest(expected.iter().copied()), "{nx}: gradient");
        let none = vec![0.0; beta.len()];
        for seed in 0..3 {
            let d: Vec<f64> = (0..beta.len()).map(|j| ((j * 7 + seed * 3) as f64).cos()).collect();
            let quotient: Vec<f64> = {
                let h = 2e-5;
                let [up, down] = [h, -h].map(|t| {
                    let moved: Vec<f64> = beta.iter().zip(&d).map(|(b, d)| b + t * d).collect();
                    gradient_at(&mut question, &moved)
                });
                up.iter().zip(&down).map(|(u, v)| (u - v) / (2.0 * h)).collect()
            };
            assert!(search.linearise(&mut question, &posture, &mut 0));
            search.saddle.assemble(&question, &search.local, Form::Exact);
            let (step, slopes) = search.saddle.evaluate(&mut question, &search.local, Form::Exact, &none, d.clone());
            let product: Vec<f64> = slopes.iter().zip(&search.local.gradient).map(|(s, g)| s - g).collect();
            let apart = largest(product.iter().zip(&quotient).map(|(a, b)| a - b));
            assert!(apart < 2e-5 * largest(quotient.iter().copied()), "{nx}: {apart:e}");
            let along: f64 = product.iter().zip(&d).map(|(p, d)| 0.5 * p * d).sum();
            assert!((along - step.curvature).abs() < 1e-9 * along.abs().max(largest(product)));
        }
    }
}

#[test]
fn the_newton_step_leaves_no_slope() {
    for (nx, form) in [(2, Form::GaussNewton), (6, Form::GaussNewton), (2, Form::Convexified), (6, Form::Convexified)] {
        let (mut model, actuation, objective) = cantilever(nx);
        let mut question = Question { model: &mut model, actuation: &actuation, objective: &objective };
        let beta = activations(&actuation);
        let (mut search, _) = linearised(&mut question, &beta);
        assert_eq!(search.saddle.cost(), (beta.len() > 16) as usize);
        let local = &search.local;
        search.saddle.assemble(&question, local, form);
        let damping = vec![2.0; beta.len()];
        let held: Vec<bool> = (0..beta.len()).map(|j| j % 5 == 1).collect();
        search.saddle.factorize(&mut question, local, form, &damping, &held).unwrap();
        let step = search.saddle.solve(&local.rows, &local.gradient).unwrap();
        let change = search.saddle.change_of_slopes(&local.rows, &step);
        let (_, slopes) = search.saddle.evaluate(&mut question, local, form, &damping, step.clone());
        for j in 0..beta.len() {
            let expected = if held[j] { local.gradient[j] + change[j] } else { 0.0 };
            assert!((slopes[j] - expected).abs() < 1e-9 * largest(local.gradient.iter().copied()), "{form:?} {j}");
            assert!(!held[j] || step[j] == 0.0);
        }
    }
}

#[test]
fn both_methods_end_where_no_bound_and_no_slope_can_be_left() {
    for nx in [2, 6] {
        let (mut model, actuation, objective) = cantilever(nx);
        let mut question = Question { model: &mut model, actuation: &actuation, objective: &objective };
        let beta = activations(&actuation);
        let (mut search, posture) = linearised(&mut question, &beta);
        let damping = vec![1e-3; beta.len()];
        search.saddle.assemble(&question, &search.local, Form::GaussNewton);
        let room: Vec<[f64; 2]> =
            actuation.winches.iter().zip(&beta).map(|(w, b)| [w.lower - b, w.upper - b]).collect();
        let still = Step { beta: vec![0.0; beta.len()], x: vec![0.0; posture.x.len()], slope: 0.0, curvature: 0.0 };
        let from = Point { step: still, slopes: search.local.gradient.clone(), value: 0.0 };
        let mut quadratic = Quadratic {
            saddle: &mut search.saddle,
            question: &mut question,
            local: &search.local,
            form: Form::GaussNewton,
            damping: &damping,
            room: room.clone(),
            lengths: &search.lengths,
            objective: posture.objective,
        };
        let mut factorizations = 0;
        let (least, exact) = active::minimise(&mut quadratic, &mut factorizations).unwrap();
        assert!(exact && least.value < 0.0);
        // At the minimiser the slopes of the free winches vanish, and the others push against their bounds.
        let largest = largest(search.local.gradient.iter().copied());
        for (j, [low, high]) in room.iter().enumerate() {
            let (d, slope) = (least.step.beta[j], least.slopes[j]);
            assert!((*low..=*high).contains(&d));
            let push = if d == *low {
                slope.min(0.0)
            } else if d == *high {
                slope.max(0.0)
            } else {
                slope
            };
            assert!(push.abs() <= 1e-9 * largest, "{j} at {d} of {low} to {high} has the slope {slope:e}");
        }
        let found = interior::minimise(&mut quadratic, &from, &mut factorizations).unwrap();
        assert!(found.value < 0.98 * least.value && found.value >= (1.0 + 1e-9) * least.value);
        // What any single winch could still gain, by its slope, is small against what was gained.
        let mut on_bounds = 0;
        for (j, [low, high]) in room.iter().enumerate() {
            let d = found.step.beta[j];
            assert!((*low..=*high).contains(&d));
            on_bounds += (d == *low || d == *high) as usize;
            let way = if found.slopes[j] > 0.0 { d - low } else { high - d };
            let gain = found.slopes[j].abs() * way.min(search.lengths[j]);
            assert!(gain <= 0.05 * -found.value, "{j} can still gain {gain:e} of {:e}", -found.value);
        }
        assert!(on_bounds > 3, "only {on_bounds} at their bounds");
    }
}

#[test]
fn the_answer_has_no_projected_gradient_left() {
    for nx in [2, 6] {
        let (mut model, actuation, objective) = cantilever(nx);
        let mut question = Question { model: &mut model, actuation: &actuation, objective: &objective };
        let (mut zero, rest) = (vec![0.0; actuation.winches.len()], question.model.rest.clone());
        actuation.clamp(&mut zero);
        let (start, _) = question.settle(&zero, &rest, NEVER);
        let answer = Newton::default().solve(&mut question, &start, &Budget { iterations: 100, stop: NEVER });
        assert!(answer.converged && answer.posture.objective < start.objective);
        let posture = &answer.posture;
        let contractions = actuation.contractions(&posture.beta);
        let gradient = sensitivity::gradient(&mut question, &posture.x, &contractions).unwrap().by_activation;
        let projected = projected_gradient(&question, &posture.beta, &gradient);
        assert!(projected <= 1.01 * TOLERANCE * posture.objective, "{projected:e} at {:e}", posture.objective);
    }
}
