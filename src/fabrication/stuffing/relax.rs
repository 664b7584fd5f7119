//! Least energy by Newton's method.
//!
//! A limb swings freely in the plane until the wrinkles at its root are tight: the energy has long curved valleys. A quasi-Newton method of limited memory
//! takes thousands of iterations along them and looks settled long before. Newton's method takes some twenty, each step with a correction to second
//! order that takes out the stretch of a step along a tangent.

use super::membrane::Membrane;
use super::stiffness::Stiffness;

/// Most iterations: several times what the slowest body takes that was tried.
const MOST_ITERATIONS: usize = 150;
/// Largest force that is left, over the pressure on the area around a node, dimensionless: the last steps converge quadratically, so that it costs one.
const FORCE: f64 = 1e-4;
/// Sufficient decrease, what of the energy is rounding, and the most halvings of a step (Armijo).
const DECREASE: f64 = 1e-4;
const ROUNDING: f64 = 1e-13;
const MOST_HALVINGS: usize = 30;
/// Longest step, as a part of the sheet's length: a limb swings by no more than the step's second order can mend.
const LONGEST: f64 = 0.1;
/// Corrections of a step at most.
const CORRECTIONS: usize = 2;

type Nodes = Vec<[f64; 3]>;

/// Where the sheet rests, from `start`, and whether it does: forces are in balance.
pub fn relaxed(membrane: &Membrane, start: Nodes) -> (Nodes, bool) {
    let mut x = start;
    let Some(mut stiffness) = Stiffness::new(membrane) else { return (x, false) };
    let mut gradient = vec![[0.0; 3]; x.len()];
    let mut energy = membrane.energy(&x, &mut gradient);
    let enough = FORCE * membrane.force_scale();
    let longest = LONGEST * length(&x);
    for _ in 0..MOST_ITERATIONS {
        if largest(&gradient) <= enough {
            return (x, true);
        }
        if !stiffness.factorize(membrane, &x) {
            break;
        }
        let mut direction: Nodes = gradient.iter().map(|g| g.map(|v| -v)).collect();
        stiffness.solve(&mut direction);
        let slope = product(&direction, &gradient);
        let mut step = (longest / largest(&direction)).min(1.0);
        let mut found = None;
        for _ in 0..MOST_HALVINGS {
            let there = Trial::at(membrane, added(&x, step, &direction));
            let there = corrected(there, membrane, &mut stiffness, &gradient, step);
            if there.energy <= energy + DECREASE * step * slope + ROUNDING * energy.abs() {
                found = Some(there);
                break;
            }
            step *= 0.5;
        }
        // Rounding allows no more.
        let Some(there) = found else { break };
        (x, energy, gradient) = (there.x, there.energy, there.gradient);
    }
    let settled = largest(&gradient) <= enough;
    (x, settled)
}

/// A place that a step leads to.
struct Trial {
    x: Nodes,
    energy: f64,
    gradient: Nodes,
}

impl Trial {
    fn at(membrane: &Membrane, x: Nodes) -> Self {
        let mut gradient = vec![[0.0; 3]; x.len()];
        let energy = membrane.energy(&x, &mut gradient);
        Self { x, energy, gradient }
    }
}

/// With what is wrong with a step of length `t` to second order taken out, `-H^-1 [g(x + t s) - (1 - t) g(x)]`, as far as that lowers the energy: what
/// the statics of bodies do in curved valleys.
fn corrected(mut there: Trial, membrane: &Membrane, stiffness: &mut Stiffness, before: &Nodes, t: f64) -> Trial {
    for _ in 0..CORRECTIONS {
        if !there.energy.is_finite() {
            break;
        }
        let wanted = before.iter().zip(&there.gradient);
        let mut correction: Nodes = wanted.map(|(g, now)| [0, 1, 2].map(|k| (1.0 - t) * g[k] - now[k])).collect();
        stiffness.solve(&mut correction);
        let other = Trial::at(membrane, added(&there.x, 1.0, &correction));
        if other.energy < there.energy {
            there = other;
        } else {
            break;
        }
    }
    there
}

fn largest(v: &Nodes) -> f64 {
    v.as_flattened().iter().fold(0.0, |most, v| most.max(v.abs()))
}

/// Of the sheet along x or y, whichever is longer.
fn length(x: &Nodes) -> f64 {
    let along = |k: usize| {
        let (low, high) = x.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[k]), h.max(p[k])));
        high - low
    };
    along(0).max(along(1))
}

fn product(a: &Nodes, b: &Nodes) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(p, q)| p * q).sum()
}

fn added(x: &Nodes, factor: f64, direction: &Nodes) -> Nodes {
    x.iter().zip(direction).map(|(p, d)| [0, 1, 2].map(|k| p[k] + factor * d[k])).collect()
}
