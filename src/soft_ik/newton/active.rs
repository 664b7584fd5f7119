//! The quadratic model within the bounds by primal-dual active sets (Hintermueller, Ito, Kunisch,
//! SIAM J. Optim. 13, 2002).
//!
//! Winches are held at a bound or free. The model's minimiser over the free ones, with the others where they are held, says which of
//! the free ones would pass a bound, which are held there from now on, and which held ones are pulled away from theirs, which are
//! freed. Where nothing changes any more it is the minimiser within the bounds, exactly. There are bodies on which the sets go
//! round in circles; from sets that are nearly right, as those of the last linearisation are, a few rounds do.

use super::damped::{Model, Point};
use super::form::NotConvex;

/// Rounds before other methods take over: those that settle take 2 to 6 as a rule, and up to ten.
const MOST_ROUNDS: usize = 16;
/// The sets go round in circles where more winches change than so many times the fewest that did, and this part of all: a few that come
/// and go near the end are not yet a circle.
const RISE: usize = 2;
const MANY: f64 = 0.02;

/// A point within the bounds, and whether it is the minimiser there. Counts its factorisations.
///
/// # Errors
/// [`NotConvex`] where that shows on the first sets, or a system could not be solved.
pub(super) fn minimise(model: &mut Model, factorizations: &mut usize) -> Result<(Point, bool), NotConvex> {
    let count = model.room.len();
    let mut step = vec![0.0; count];
    let mut slopes = model.local.gradient.clone();
    // Which bound each winch is held at: -1 the lower, 1 the upper.
    let mut side: Vec<i8> = (0..count).map(|j| at_bound(model.room[j], slopes[j])).collect();
    let mut least = usize::MAX;
    for round in 0..MOST_ROUNDS {
        *factorizations += model.saddle.cost();
        let held: Vec<bool> = side.iter().map(|s| *s != 0).collect();
        let factorized = model.saddle.factorize(model.question, model.local, model.form, model.damping, &held);
        if round == 0 {
            factorized?;
        } else if factorized.is_err() {
            break;
        }
        let astray = |j: &usize| held[*j] && step[*j] != bound(model.room[*j], side[*j]);
        let moved: Vec<usize> = (0..count).filter(astray).collect();
        if !moved.is_empty() {
            moved.into_iter().for_each(|j| step[j] = bound(model.room[j], side[j]));
            slopes = model.evaluate(step.clone()).slopes;
        }
        let change = model.saddle.solve(&model.local.rows, &slopes)?;
        let by_model = model.saddle.change_of_slopes(&model.local.rows, &change);
        let mut changed = 0;
        for j in 0..count {
            step[j] += change[j];
            slopes[j] += by_model[j] + model.damping[j] * change[j];
            let [low, high] = model.room[j];
            let now = match side[j] {
                0 if step[j] < low => -1,
                0 if step[j] > high => 1,
                -1 if slopes[j] < 0.0 && high > low => 0,
                1 if slopes[j] > 0.0 && high > low => 0,
                other => other,
            };
            changed += (now != side[j]) as usize;
            side[j] = now;
        }
        if changed == 0 {
            return Ok((model.evaluate(step), true));
        }
        if changed > RISE.saturating_mul(least).saturating_add((MANY * count as f64) as usize) {
            break;
        }
        least = least.min(changed);
    }
    let inside = step.iter().zip(&model.room).map(|(d, [low, high])| d.max(*low).min(*high)).collect();
    Ok((model.evaluate(inside), false))
}

/// The bound that a winch is at and pushed against.
fn at_bound([low, high]: [f64; 2], slope: f64) -> i8 {
    match () {
        _ if low >= 0.0 && slope > 0.0 || high <= low => -1,
        _ if high <= 0.0 && slope < 0.0 => 1,
        _ => 0,
    }
}

fn bound([low, high]: [f64; 2], side: i8) -> f64 {
    if side < 0 { low } else { high }
}
