//! An equilibrium beyond the digits of its coordinates.
//!
//! The tension of a spring `K` times stiffer than the body follows from its stretch, and rounding of the coordinates leaves
//! only `16 - log10(K)` digits of it: of a pin of `1e12` shear moduli, four; of the balance of forces at its node, none that
//! counts. So the state is carried on as `x + y`, two words a coordinate, `y` below the rounding of `x`, and Newton's
//! method goes on with residuals of twice the digits and the factor of the ordinary Hessian (iterative refinement). What
//! comes out are forces in balance: the force of a stiff pin is what its node needs, as if its unknowns were eliminated.

use super::double_double::DoubleDouble;
use super::element::{Element, Law};
use super::energy::{Energy, Scales};
use super::material_point::MaterialPoint;
use super::model::Model;
use super::statics::norm;

/// Rounds at most; each gains several digits where the Hessian is definite.
const ROUNDS: usize = 8;
/// The residual, as a part of the forces at work, that is good enough.
const BALANCED: f64 = 1e-13;
/// A round that leaves more than this part of the residual was the last, and in vain.
const WORTHWHILE: f64 = 0.7;
/// One that leaves more than this part asks for a new factor.
const FAST: f64 = 0.01;

/// Forces of an equilibrium, in balance to `BALANCED` or as far as refinement went.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    pub tensions: Vec<f64>,
    /// Force of each pin on the body.
    pub pins: Vec<[f64; 2]>,
    /// `max |dE/dx|`, rounding of the coordinates taken out.
    pub residual: f64,
    /// The forces at work, without any allowance for rounding.
    pub scale: f64,
    pub factorizations: usize,
}

/// Refines the equilibrium `x` in place and returns its forces. Costs one factorisation and a few solves. A state that is not
/// near a stable equilibrium stays as it is. `stop` is asked in every round.
pub fn refine(model: &mut Model, x: &mut [f64], stop: &dyn Fn() -> bool) -> Forces {
    let mut state: Vec<DoubleDouble> = x.iter().map(|&v| v.into()).collect();
    let (mut gradient, mut scale) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    let mut forces = evaluate(model, &state, x, &mut gradient, &mut scale);
    if forces.residual <= BALANCED * forces.scale {
        return forces;
    }
    let mut fresh = false;
    for _ in 0..ROUNDS {
        if stop() {
            break;
        }
        if !fresh {
            // A free motion or an unstable equilibrium: still a direction in which forces of stiff springs balance.
            if model.factorize_for_descent(x).is_err() {
                break;
            }
            forces.factorizations += 1;
        }
        let mut step = gradient.clone();
        model.solve(&mut step);
        let trial: Vec<DoubleDouble> = state.iter().zip(&step).map(|(v, s)| *v - DoubleDouble::from(*s)).collect();
        let rounded: Vec<f64> = trial.iter().map(|v| v.value()).collect();
        let valid = rounded.iter().all(|v| v.is_finite()) && model.body.smallest_determinant(&rounded) > 0.0;
        if !valid {
            break;
        }
        let mut trial_gradient = vec![0.0; x.len()];
        let next = evaluate(model, &trial, &rounded, &mut trial_gradient, &mut scale);
        if next.residual.is_nan() || next.residual >= WORTHWHILE * forces.residual {
            break;
        }
        fresh = next.residual <= FAST * forces.residual;
        x.copy_from_slice(&rounded);
        (state, gradient) = (trial, trial_gradient);
        forces = Forces { factorizations: forces.factorizations, ..next };
        if forces.residual <= BALANCED * forces.scale {
            break;
        }
    }
    forces
}

/// The forces at `state`, whose leading words are `x`, and their sum in `gradient`.
fn evaluate(model: &Model, state: &[DoubleDouble], x: &[f64], gradient: &mut [f64], scale: &mut [f64]) -> Forces {
    gradient.fill(0.0);
    let mut rounding = vec![0.0; x.len()];
    let mut scales = Scales::apart(scale, &mut rounding);
    model.body.add_precise_gradient(state, gradient);
    model.body.add_scales(x, &mut scales);
    for term in &model.terms {
        term.add_gradient(x, gradient);
        term.add_scales(x, &mut scales);
    }
    let mut tensions = Vec::with_capacity(model.contractile.elements.len());
    for (element, law) in model.contractile.elements.iter().zip(&model.contractile.laws) {
        let tau = add_pull(element, law, state, gradient);
        for (n, w) in element.routing.iter().flat_map(MaterialPoint::parts) {
            scale[2 * n] += w * tau;
            scale[2 * n + 1] += w * tau;
        }
        tensions.push(tau);
    }
    let mut pins = Vec::with_capacity(model.pins.pins.len());
    for pin in &model.pins.pins {
        let force = [0, 1].map(|axis| {
            let at = pin
                .nodes
                .iter()
                .zip(&pin.weights)
                .fold(DoubleDouble::ZERO, |sum, (n, w)| sum + state[2 * n + axis] * DoubleDouble::from(*w));
            pin.stiffness * (DoubleDouble::from(pin.anchor[axis]) - at).value()
        });
        let force = pin.across(force);
        for (&n, w) in pin.nodes.iter().zip(&pin.weights) {
            for axis in 0..2 {
                gradient[2 * n + axis] -= w * force[axis];
                scale[2 * n + axis] += (w * force[axis]).abs();
            }
        }
        pins.push(force);
    }
    Forces { tensions, pins, residual: norm(gradient), scale: norm(scale), factorizations: 0 }
}

/// Adds the forces of an element and returns its tension; length and directions in two words.
fn add_pull(element: &Element, law: &Law, state: &[DoubleDouble], gradient: &mut [f64]) -> f64 {
    let point = DoubleDouble::from(element.point()).square();
    let segments = element.routing.windows(2).map(|s| {
        let (a, b) = (s[0].at_precisely(state), s[1].at_precisely(state));
        let [dx, dy] = [0, 1].map(|axis| b[axis] - a[axis]);
        ([dx, dy], (dx.square() + dy.square() + point).sqrt())
    });
    let length = segments.clone().fold(DoubleDouble::ZERO, |sum, (_, length)| sum + length);
    let tau = match *law {
        Law::Spring { alpha } => element.tension((length - DoubleDouble::from(alpha)).value()),
        _ => law.tension_and_tangent(element, length.value()).0,
    };
    if tau != 0.0 {
        for (s, (d, length)) in element.routing.windows(2).zip(segments) {
            let pull = d.map(|d| tau * (d / length).value());
            s[0].add(pull.map(|f| -f), gradient);
            s[1].add(pull, gradient);
        }
    }
    tau
}
