//! Friction of cables at their holes, against closed forms.

use crate::support::bodies::{Mesh, bar, dot, largest, largest_difference, neo_hookean, plus};
use crate::support::{Random, rectangle, rigged, scenes};
use plushwright::defaults;
use plushwright::design::{Design, Network, Pin, Tendon, file};
use plushwright::engine::compile::{View, compile, objective};
use plushwright::engine::{FrictionPoseError, pose_with_friction};
use plushwright::operations::{Context, FiberCount, check, new_design};
use plushwright::physics::friction::{self, Bordered, Fault, Friction};
use plushwright::physics::{
    Direction, Element, HessianForm, MaterialPoint, Model, NeoHookean, PinSpring, Pins, StaticsSettings, statics,
};
use plushwright::soft_ik::friction::position_jacobian;
use plushwright::soft_ik::{self, Actuation, Objective, Question, Winch};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::atomic::AtomicBool;

const GO: &dyn Fn() -> bool = &|| false;
const BOTH: [Direction; 2] = [Direction::Pulling, Direction::LettingOut];

/// A bar held at its left end, with a cable that zigzags through it, one through points inside triangles, and one that bends so
/// little that the rim of the holes matters.
fn bent_bar() -> (Mesh, Model) {
    let mesh = bar(4.0, 1.0, 12, 3);
    let inside = |t: usize, a: f64, b: f64| MaterialPoint::of_triangle(mesh.triangles[t], [a, b, 1.0 - a - b]);
    let routed = |routing: Vec<MaterialPoint>, alpha0: f64| {
        let mut element = Element { routing, stiffness: 3.0, epsilon: 0.01, alpha0: 1.0 };
        element.alpha0 = alpha0 * element.length(&mesh.flat());
        element
    };
    let zigzag = [mesh.at(0, 2), mesh.at(3, 3), mesh.at(6, 2), mesh.at(9, 3), mesh.at(12, 2)];
    let within = vec![inside(2, 0.2, 0.3), inside(15, 0.5, 0.2), inside(40, 0.3, 0.3), inside(60, 0.1, 0.6)];
    let elements = vec![
        routed(MaterialPoint::through(zigzag), 0.9),
        routed(within, 0.95),
        routed(MaterialPoint::through([mesh.at(1, 1), mesh.at(4, 1), mesh.at(8, 1)]), 0.97),
    ];
    let model = mesh.model(neo_hookean(), elements, mesh.left_pins(100.0), Vec::new());
    (mesh, model)
}

/// A cable over a half circle of pins so stiff that nothing moves: the tension that the last pin feels, to that at the winch, is
/// `exp(-mu pi (n-1)/n)`, with the turns of a polygon of `n` sides; and its inverse when it is let out.
#[test]
fn a_cable_over_a_known_wrap_has_the_ratio_of_eytelwein() {
    let sides = 8;
    let arc = |k: usize| {
        let (s, c) = (PI * k as f64 / sides as f64).sin_cos();
        [-c, s]
    };
    // A fan of triangles below the arc.
    let mut nodes: Vec<[f64; 2]> = (0..=sides).map(arc).collect();
    nodes.push([0.0, 0.0]);
    let centre = nodes.len() - 1;
    let triangles: Vec<[usize; 3]> = (0..sides).map(|k| [centre, k + 1, k]).collect();
    let mesh = Mesh { nodes, triangles, columns: 0, rows: 0 };
    let element = Element { alpha0: 2.5, ..mesh.element(&(0..=sides).collect::<Vec<_>>(), 1.0, 1e-3) };
    let pins = (0..mesh.nodes.len()).map(|n| PinSpring::node(n, mesh.nodes[n], 1e9));
    let soft = Box::new(NeoHookean { mu: 1e-3, kappa: 1e-3 });
    let mut model = mesh.model(soft, vec![element], Pins { pins: pins.collect() }, Vec::new());
    let turned = PI * (sides - 1) as f64 / sides as f64;
    for mu in [0.1, 0.25, 1.0] {
        let rubbing = Friction::new(&model, &[mu]);
        for (direction, sign) in BOTH.into_iter().zip([-1.0, 1.0]) {
            let state = friction::settle(&mut model, &rubbing, &mesh.flat(), direction, GO).unwrap();
            let felt = |n: usize| {
                let [fx, fy] = model.pins.pins[n].force(&state.x);
                fx.hypot(fy)
            };
            let expected = (sign * mu * turned).exp();
            assert!((felt(sides) / felt(0) / expected - 1.0).abs() < 1e-6, "{direction:?} at {mu}");
            let pieces = &rubbing.piece_tensions(&model, &state.x, direction)[0];
            assert!((pieces[sides - 1] / pieces[0] / expected - 1.0).abs() < 1e-6);
            // And what the winch takes in is true length.
            let gamma = model.contractile.elements[0].length(&state.x) - 2.5;
            assert!((pieces[0] - 2.0 * gamma).abs() < 1e-12);
        }
    }
}

#[test]
fn without_a_coefficient_the_bits_are_those_of_statics() {
    let (mesh, mut model) = bent_bar();
    let plain = statics::solve(&mut model, &mesh.flat(), &StaticsSettings::default(), GO).unwrap();
    let rubbing = Friction::new(&model, &[0.0; 3]);
    assert!(rubbing.is_absent());
    for direction in BOTH {
        let state = friction::settle(&mut model, &rubbing, &mesh.flat(), direction, GO).unwrap();
        assert_eq!((&state.x, state.residual, state.factorizations), (&plain.x, plain.residual, plain.factorizations));
    }
}

/// The residual's derivative along random directions, by central differences, solved for with the bordered system gives the
/// direction back, with an error of second order.
#[test]
fn the_bordered_system_is_the_derivative_of_the_residual() {
    let (mesh, mut model) = bent_bar();
    let mut random = Random(7);
    let start = statics::solve(&mut model, &mesh.flat(), &StaticsSettings::default(), GO).unwrap().x;
    let rubbing = Friction::new(&model, &[0.4, 0.7, 0.9]);
    for part in [-1.0, 0.5, 1.0] {
        let x: Vec<f64> = start.iter().map(|x| x + 0.01 * random.between(-1.0, 1.0)).collect();
        let v: Vec<f64> = x.iter().map(|_| random.between(-1.0, 1.0)).collect();
        let jacobian = Bordered::new(&rubbing, &mut model, &x, part, HessianForm::Exact).unwrap();
        let mut error = |h: f64| {
            let [mut up, mut down] = [vec![0.0; x.len()], vec![0.0; x.len()]];
            rubbing.residual(&model, &plus(&x, h, &v), part, &mut up);
            rubbing.residual(&model, &plus(&x, -h, &v), part, &mut down);
            let mut rate: Vec<f64> = up.iter().zip(&down).map(|(u, d)| (u - d) / (2.0 * h)).collect();
            jacobian.solve(&mut model, &mut rate).unwrap();
            largest_difference(&rate, &v)
        };
        let (coarse, fine) = (error(2e-4), error(1e-4));
        assert!(fine < 1e-4 && coarse / fine > 3.5 && coarse / fine < 4.5, "{part}: {coarse} {fine}");
    }
}

/// Pulled, the far end of the cable does less than without friction; let out, it does more, and with little friction
/// the tip is to either side of where it is without. Forces balance at both ends of the band.
#[test]
fn the_band_lies_about_the_state_without_friction() {
    let (mesh, mut model) = bent_bar();
    let plain = statics::solve(&mut model, &mesh.flat(), &StaticsSettings::default(), GO).unwrap();
    let rest = mesh.flat();
    let mut before = [0.0; 2];
    for mu in [0.05, 0.2, 0.6] {
        let rubbing = Friction::new(&model, &[mu; 3]);
        let ends = BOTH.map(|direction| friction::settle(&mut model, &rubbing, &rest, direction, GO).unwrap());
        let last = Element {
            routing: model.contractile.elements[0].routing[3..].to_vec(),
            ..model.contractile.elements[0].clone()
        };
        let [pulled, frictionless, let_out] = [&ends[0].x, &plain.x, &ends[1].x].map(|x| last.length(x));
        assert!(pulled > frictionless && frictionless > let_out, "{mu}: {pulled} {frictionless} {let_out}");
        let band = [pulled - frictionless, frictionless - let_out];
        assert!(band[0] > before[0] && band[1] > before[1], "wider with more friction: {band:?} after {before:?}");
        // Where the tip goes is not monotone in the friction; while that is small, it changes in proportion.
        let tip = 2 * mesh.at(12, 1) + 1;
        let moved = ends.each_ref().map(|end| end.x[tip] - plain.x[tip]);
        assert!(mu > 0.2 || moved[0] * moved[1] < 0.0, "{mu}: {moved:?}");
        before = band;
        for (end, part) in ends.iter().zip([1.0, -1.0]) {
            let mut force = vec![0.0; rest.len()];
            rubbing.residual(&model, &end.x, part, &mut force);
            assert!(largest(&force) <= 1e-10 * model.force_scale(&end.x));
            // Cables push and pull at the body alone.
            let held: f64 = model.pins.pins.iter().map(|pin| pin.force(&end.x)[0]).sum();
            assert!(held.abs() < 1e-9 * dot(&end.x, &end.x).sqrt());
        }
        let back = ends[0].reversed(&mut model, &rubbing, Direction::Pulling, GO).unwrap();
        assert!(largest_difference(&back.x, &ends[1].x) < 1e-8);
    }
}

/// Columns of `dx/dbeta` under friction against equilibria solved anew, with an error of second order.
#[test]
fn sensitivities_under_friction_are_those_of_equilibria_solved_anew() {
    let (mesh, mut model) = bent_bar();
    let rubbing = Friction::new(&model, &[0.3; 3]);
    let winch = |members: Vec<(usize, f64)>| Winch { members, lower: -1.0, upper: 1.0 };
    let actuation =
        Actuation { winches: vec![winch(vec![(0, 1.0), (2, 0.7)]), winch(vec![(1, 1.5)])], fixed: vec![0.0; 3] };
    let objective = Objective::default();
    let at = [0.1, 0.2];
    let mut settled = |beta: [f64; 2], from: &[f64]| {
        model.contractile.set_contractions(&actuation.contractions(&beta));
        friction::follow(&mut model, &rubbing, from, Direction::Pulling, GO).unwrap().x
    };
    let x = settled(at, &mesh.flat());
    let [coarse, fine] = [2e-3, 1e-3].map(|h| -> Vec<f64> {
        let rate = |j: usize| {
            let off = |by: f64| [0, 1].map(|k| at[k] + if j == k { by } else { 0.0 });
            let [up, down] = [h, -h].map(|by| settled(off(by), &x));
            up.iter().zip(&down).map(|(u, d)| (u - d) / (2.0 * h)).collect::<Vec<_>>()
        };
        [0, 1].map(rate).concat()
    });
    model.contractile.set_contractions(&actuation.contractions(&at));
    let mut question = Question { model: &mut model, actuation: &actuation, objective: &objective };
    let exact = position_jacobian(&mut question, &rubbing, &x, GO).unwrap();
    let [coarse, fine] = [coarse, fine].map(|rates| largest_difference(&rates, &exact));
    assert!(fine < 1e-4 * largest(&exact) && (3.5..4.5).contains(&(coarse / fine)), "{coarse} {fine}");
}

/// A winch with a spool of two radii, one cable with slack, on a body that cannot move: tensions are `2 K (ratio beta - slack - epsilon)`,
/// nothing before the slack is wound, and what is left of them behind a known turn.
#[test]
fn two_radii_and_slack_have_their_closed_forms() {
    let mut design = rectangle(120.0, 80.0, 6, 4);
    design.tendons.stiffness = 1e-3;
    design.tendons.epsilon_mm = 0.05;
    let all = 0..design.mesh.nodes.len();
    let pin = |n: usize| Pin::at_rest(design.mesh.node_point(n).unwrap(), 1e6);
    design.pins = all.map(pin).collect();
    // Nodes 8 to 12 are 20 mm apart on a line; 19 lies above 12: a right angle.
    let tendon = |ratio, slack_mm| Tendon { routing: MaterialPoint::through([8, 10, 12, 19]), ratio, slack_mm };
    design.networks = vec![Network::new("w", vec![tendon(1.0, 0.0), tendon(2.5, 0.0), tendon(2.0, 7.0)])];
    let mut plushie = compile(&design, View::Realizable).unwrap();
    let (stiffness, epsilon, mu) = (design.tendons.stiffness, design.tendons.epsilon_mm, 0.3);
    let rubbing = plushie.friction(mu);
    let rest = plushie.model.rest.clone();
    for beta in [2.0, 3.4, 3.6, 9.0] {
        let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; 3] };
        plushie.model.contractile.set_contractions(&actuation.contractions(&[beta]));
        let state = friction::settle(&mut plushie.model, &rubbing, &rest, Direction::Pulling, GO).unwrap();
        let tensions = rubbing.piece_tensions(&plushie.model, &state.x, Direction::Pulling);
        for (pieces, (ratio, slack)) in tensions.iter().zip([(1.0, 0.0), (2.5, 0.0), (2.0, 7.0)]) {
            let wound = ratio * beta - slack;
            let expected = if wound > 0.0 { 2.0 * stiffness * (wound - epsilon) } else { 0.0 };
            assert!((pieces[0] - expected).abs() <= 1e-6 * expected, "{beta}: {} {expected}", pieces[0]);
            // Straight through the hole at 10, a right angle at 12.
            let turned = (-mu * FRAC_PI_2).exp();
            assert!((pieces[1] - expected).abs() <= 1e-6 * expected);
            assert!(
                (pieces[2] - expected * turned).abs() <= 1e-6 * expected,
                "{beta}: {} {}",
                pieces[2],
                expected * turned
            );
        }
    }
}

/// Activations may be chosen for friction: no worse by `O` than the frictionless ones, which the wound state at no friction repeats.
#[test]
fn a_pose_under_friction_is_looked_for_again() {
    let mut design = rigged();
    design.pins.push(Pin::at_rest(design.mesh.node_point(28).unwrap(), 20.0));
    let targets = design.poses[0].targets.clone();
    let of = |mu: f64, from: &[f64]| pose_with_friction(&design, &targets, from, mu, GO).unwrap();
    let start = of(0.0, &[5.0, 5.0]);
    let frictionless = of(0.0, &start.activations_mm);
    assert!(start.converged && (start.error - frictionless.error).abs() < 1e-4);
    assert_eq!(frictionless.error, frictionless.error_letting_out.unwrap());
    let rubbed = of(0.3, &start.activations_mm);
    assert!(rubbed.converged && rubbed.error.is_finite() && rubbed.error > 0.0);
    let let_out = rubbed.error_letting_out.unwrap();
    assert!((let_out - rubbed.error).abs() > 1e-6, "friction leaves a band");
    assert!(matches!(pose_with_friction(&design, &targets, &start.activations_mm, 0.3, &|| true),
        Err(FrictionPoseError::Friction(error)) if matches!(error.fault, Fault::Cancelled | Fault::Frictionless(_))));
}

#[test]
fn friction_is_a_setting_that_old_files_lack_and_new_designs_guess() {
    let mut design = rigged();
    assert_eq!(design.tendons.friction, 0.0);
    assert!(!file::to_text(&design).unwrap().contains("friction"));
    let asks = |design: &Design, friction| {
        let cancel = AtomicBool::new(false);
        check::run(design, &check::Options { friction, ..Default::default() }, &Context::new(&cancel))
    };
    let plain = asks(&design, None).unwrap().poses.remove(0);
    assert!(plain.error_realizable_friction.is_none() && plain.error_realizable_letting_out.is_none());
    let asked = asks(&design, Some(0.25)).unwrap().poses.remove(0);
    assert_eq!(asked.error_realizable, plain.error_realizable, "the frictionless figures stay as they are");
    design.tendons.friction = 0.25;
    let own = asks(&design, None).unwrap().poses.remove(0);
    assert!(asked.error_realizable_friction.is_some() && asked.error_realizable_letting_out.is_some());
    assert_eq!(own.error_realizable_friction, asked.error_realizable_friction);
    assert_eq!(own.error_realizable_letting_out, asked.error_realizable_letting_out);
    assert!(asks(&design, Some(0.0)).unwrap().poses[0].error_realizable_friction.is_none());
    for bad in [-0.1, 1.1, f64::NAN] {
        assert!(matches!(asks(&design, Some(bad)), Err(check::Error::Friction(_))), "{bad}");
    }
    let text = file::to_text(&design).unwrap();
    assert!(text.contains("friction: 0.25") && file::parse(&text).unwrap() == design);
    let svg =
        br#"<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="80mm"><rect width="120" height="80"/></svg>"#;
    let options = new_design::Options { fibers: FiberCount::Exactly(60), ..Default::default() };
    let begun = new_design::run(svg, &options, &Context::new(&AtomicBool::new(false))).unwrap().design;
    assert_eq!(begun.tendons.friction, defaults::NEW_FRICTION);
    assert!(begun.is_bare());
}

/// One winch: what is found is as good as the best of many states on the way of its whole range.
#[test]
fn a_winch_is_wound_as_well_as_in_a_dense_scan() {
    for (name, design) in [("Pig", scenes::design("Pig")), ("E", scenes::steady_e())] {
        let mut plushie = compile(&design, View::Realizable).unwrap();
        let rubbing = plushie.friction(0.2);
        let objective = objective(&design, &plushie, &design.poses[0].targets);
        let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
        let mut question = Question { model: &mut plushie.model, actuation: &actuation, objective: &objective };
        let (mut best, mut x) = ((f64::INFINITY, 0.0), question.model.rest.clone());
        for k in 0..=60 {
            let beta = actuation.winches[0].upper * f64::from(k) / 60.0;
            let contractions = actuation.contractions(&[beta]);
            question.model.contractile.set_contractions(&contractions);
            x = friction::follow(question.model, &rubbing, &x, Direction::Pulling, GO).unwrap().x;
            let there = question.objective_at(&x, &contractions);
            if there < best.0 {
                best = (there, beta);
            }
        }
        // From a little beside it, as the frictionless answer is.
        let found = soft_ik::friction::pose(&mut question, &rubbing, &[0.9 * best.1], GO).unwrap();
        assert!(found.converged && found.pulled.objective <= best.0, "{name}: {} {best:?}", found.pulled.objective);
    }
}

/// Let out, a cable that goes back and forth 400 times would carry more at its end than a number can hold: that is told, not shown.
#[test]
fn what_has_no_equilibrium_is_refused_with_the_best_state() {
    let mesh = bar(4.0, 1.0, 12, 3);
    let ends = [mesh.at(2, 1), mesh.at(8, 2)];
    let routing: Vec<usize> = (0..400).map(|k| ends[k % 2]).collect();
    let mut cable = mesh.element(&routing, 3.0, 0.01);
    cable.alpha0 *= 0.999;
    let mut model = mesh.model(neo_hookean(), vec![cable], mesh.left_pins(100.0), Vec::new());
    let rubbing = Friction::new(&model, &[1.0]);
    let error = friction::settle(&mut model, &rubbing, &mesh.flat(), Direction::LettingOut, GO).unwrap_err();
    assert!(error.reached > -1.0 && error.reached <= 0.0, "{error}");
    assert!(error.to_string().contains("when let out") || error.reached == 0.0, "{error}");
    assert!(error.best.x.iter().all(|v| v.is_finite()));
    let mut force = vec![0.0; error.best.x.len()];
    rubbing.residual(&model, &error.best.x, error.reached, &mut force);
    assert!(largest(&force) <= 1e-7 * model.force_scale(&error.best.x), "what was reached is in balance");
    let pulled = friction::settle(&mut model, &rubbing, &mesh.flat(), Direction::Pulling, GO).unwrap();
    assert!(model.energy(&pulled.x).is_finite());
}
