//! Friction of cables at their holes, against closed forms.

use crate::support::Random;
use crate::support::bodies::{Mesh, bar, dot, largest, largest_difference, neo_hookean, plus};
use plushwright::physics::friction::{self, Bordered, Friction};
use plushwright::physics::{
    Direction, Element, HessianForm, MaterialPoint, Model, NeoHookean, PinSpring, Pins, StaticsSettings, statics,
};
use std::f64::consts::PI;

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

/// Pulled, the far end of the cable does less than without friction; let out, it does more, and the tip is to either side of where it
/// is without. Forces balance at both ends of the band.
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
        let tip = 2 * mesh.at(12, 1) + 1;
        let band = [ends[0].x[tip] - plain.x[tip], plain.x[tip] - ends[1].x[tip]];
        assert!(band[0] * band[1] > 0.0, "{mu}: {band:?}");
        let band = band.map(f64::abs);
        assert!(band[0] > before[0] && band[1] > before[1], "wider with more friction: {band:?} after {before:?}");
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
