//! Negative curvature: from an equilibrium that is not stable to a state below it.

use crate::physics::energy::HessianForm;
use crate::physics::model::Model;

/// Shift of the Hessian at first, in shear moduli, and from try to try.
const FIRST_SHIFT: f64 = 1e-3;
const SHIFT_GROWTH: f64 = 4.0;
const SHIFTS: usize = 24;
/// Rounds of inverse iteration: the direction need not be exact.
const ROUNDS: usize = 12;
/// A curvature above this many shear moduli, negative, is that of a free rigid motion, or rounding.
const FLAT: f64 = -1e-6;
/// Longest step aside, as a part of the body's size, and how often it is halved.
const LONGEST: f64 = 0.05;
const HALVINGS: usize = 20;

/// A state of lower energy beside the unstable equilibrium `x`; `None` where no direction leads down.
///
/// Inverse iteration with a shifted Hessian finds the direction of the most negative curvature.
/// `cancel` is asked between factorisations.
pub(super) fn step_aside(model: &mut Model, x: &[f64], cancel: &dyn Fn() -> bool) -> Option<Vec<f64>> {
    let mu = model.body.material().shear_modulus();
    let mut shift = FIRST_SHIFT * mu;
    let mut tries = 0;
    while model.factorize_shifted(x, HessianForm::Exact, shift).is_err() {
        shift *= SHIFT_GROWTH;
        tries += 1;
        if tries > SHIFTS || cancel() {
            return None;
        }
    }
    // Any start that is not symmetric will do; this one is the same on every machine.
    let mut v: Vec<f64> = (0..x.len()).map(|k| ((k * 7919 + 13) % 1009) as f64 / 1009.0 - 0.5).collect();
    let mut curvature = 0.0;
    for _ in 0..ROUNDS {
        let length = v.iter().map(|a| a * a).sum::<f64>().sqrt();
        if !(length.is_finite() && length > 0.0) {
            return None;
        }
        v.iter_mut().for_each(|a| *a /= length);
        let before = v.clone();
        model.solve(&mut v);
        // Rayleigh quotient of the inverse: 1 / (curvature + shift).
        let quotient: f64 = before.iter().zip(&v).map(|(a, b)| a * b).sum();
        curvature = 1.0 / quotient - shift;
    }
    if curvature > FLAT * mu {
        return None;
    }
    let longest = v.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    let size = model.body.area().sqrt();
    v.iter_mut().for_each(|a| *a *= LONGEST * size / longest);
    let energy = model.energy(x);
    let moved = |t: f64| x.iter().zip(&v).map(|(x, v)| x + t * v).collect::<Vec<f64>>();
    let mut t = 1.0;
    for _ in 0..HALVINGS {
        let [plus, minus] = [t, -t].map(&moved);
        let [up, down] = [&plus, &minus].map(|x| model.energy(x));
        if up < energy && up <= down {
            return Some(plus);
        }
        if down < energy {
            return Some(minus);
        }
        t *= 0.5;
    }
    None
}
