//! Trajectories with fewer steps, for what is stored in controllers, where there is little room.
//!
//! Between two steps a drive runs evenly. So of a trajectory those steps are kept between which straight lines pass all others within a tolerance: of a
//! still or straight run its ends, of a curve as many as it takes. From each step that is kept the farthest is sought that sees all between them
//! (intersected cones of slopes: Imai and Iri, *An optimal algorithm for approximating a piecewise linear function*, 1986, at the points of the function).

use crate::motion::error::MotionError;

/// Distances from the trajectory that are tried, mm of cable: the first is below what a drive tells apart, each is twice the one before.
const FINEST_MM: f64 = 1e-3;
/// A stored motion that would be farther off is no longer the one that was drawn.
const MOST_OFF_MM: f64 = 1.0;
/// Doublings after which no motion has more steps than there is room for: [`FINEST_MM`] is many kilometres by then.
const DOUBLINGS: i32 = 40;

/// A trajectory, or some of its columns.
pub(super) struct Steps<'a> {
    pub times_s: &'a [f64],
    pub lengths_mm: &'a [Vec<f64>],
    /// The winches that are told together.
    pub winches: std::ops::Range<usize>,
    /// How far the drives are off a straight line between two steps, mm: none of them runs at every speed.
    pub uneven_mm: &'a dyn Fn(usize, usize) -> f64,
}

/// The steps that are kept, both ends among them; `room`: whether so many fit.
///
/// # Errors
/// [`MotionError::NoRoom`] where they fit only so that the motion is another one; `what` has no room.
pub(super) fn shortened(
    steps: &Steps,
    room: impl Fn(&[usize]) -> bool,
    what: &'static str,
) -> Result<Vec<usize>, MotionError> {
    let mut off_mm = FINEST_MM;
    for _ in 0..DOUBLINGS {
        let kept = within(steps, off_mm);
        if room(&kept) {
            return if off_mm <= MOST_OFF_MM { Ok(kept) } else { Err(MotionError::NoRoom { what, off_mm }) };
        }
        // The most that is allowed is tried as well.
        off_mm = if off_mm < MOST_OFF_MM { (2.0 * off_mm).min(MOST_OFF_MM) } else { 2.0 * off_mm };
    }
    Err(MotionError::NoRoom { what, off_mm })
}

/// Steps between which the trajectory stays within a tolerance of straight lines: from each the farthest that will do. Not always the fewest that there
/// are, in one pass.
fn within(steps: &Steps, tolerance_mm: f64) -> Vec<usize> {
    let last = steps.times_s.len().saturating_sub(1);
    let mut kept = vec![0];
    let mut slopes = vec![[f64::NEG_INFINITY, f64::INFINITY]; steps.winches.len()];
    let mut from = 0;
    while from < last {
        slopes.fill([f64::NEG_INFINITY, f64::INFINITY]);
        let mut to = from + 1;
        for k in from + 1..=last {
            let lasts_s = steps.times_s[k] - steps.times_s[from];
            let mut sees = true;
            for (winch, [low, high]) in steps.winches.clone().zip(&mut slopes) {
                let by = steps.lengths_mm[k][winch] - steps.lengths_mm[from][winch];
                let slope = by / lasts_s;
                sees &= (*low..=*high).contains(&slope);
                *low = low.max((by - tolerance_mm) / lasts_s);
                *high = high.min((by + tolerance_mm) / lasts_s);
            }
            let uneven_mm = (steps.uneven_mm)(from, k);
            if sees && uneven_mm <= tolerance_mm {
                to = k;
            }
            // No later step is seen from here; and what runs unevenly seldom gets better, while looking on along a slow run would take its square.
            if slopes.iter().any(|[low, high]| low > high) || uneven_mm > 2.0 * tolerance_mm {
                break;
            }
        }
        kept.push(to);
        from = to;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pull and a still stretch in turn, smooth and every 20 ms.
    fn waves(seconds: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
        let times: Vec<f64> = (0..=50 * seconds).map(|k| 0.02 * k as f64).collect();
        let length = |t: &f64| if t % 4.0 < 2.0 { 20.0 * (1.0 - (std::f64::consts::PI * t).cos()) } else { 0.0 };
        let rows = times.iter().map(|t| vec![length(t), 3.0]).collect();
        (times, rows)
    }

    fn off(times: &[f64], rows: &[Vec<f64>], kept: &[usize]) -> f64 {
        let mut worst = 0.0_f64;
        for pair in kept.windows(2) {
            for k in pair[0]..=pair[1] {
                let part = (times[k] - times[pair[0]]) / (times[pair[1]] - times[pair[0]]);
                let straight = rows[pair[0]][0] + part * (rows[pair[1]][0] - rows[pair[0]][0]);
                worst = worst.max((straight - rows[k][0]).abs());
            }
        }
        worst
    }

    #[test]
    fn still_and_straight_runs_are_their_ends_and_curves_stay_where_they_are() {
        let (times, rows) = waves(8);
        let even = |_: usize, _: usize| 0.0;
        let steps = Steps { times_s: &times, lengths_mm: &rows, winches: 0..2, uneven_mm: &even };
        for most in [400, 60, 30] {
            let kept = shortened(&steps, |kept| kept.len() <= most, "it").unwrap();
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, 400));
            assert!(kept.len() <= most && off(&times, &rows, &kept) <= MOST_OFF_MM, "{most}: {}", kept.len());
            // The still stretch, from 2 s to 4 s, has no step between its ends but what rounding asks for.
            assert!(kept.iter().filter(|k| (105..195).contains(*k)).count() <= 1, "{kept:?}");
        }
        let refused = shortened(&steps, |kept| kept.len() <= 4, "it").unwrap_err();
        assert!(matches!(refused, MotionError::NoRoom { off_mm, .. } if off_mm > 1.0), "{refused}");
        // Drives that run at no slow speed get more steps.
        let uneven = |from: usize, to: usize| 0.001 * (to - from) as f64;
        let slow = Steps { uneven_mm: &uneven, ..steps };
        assert!(within(&slow, 0.02).len() >= 20);
        let one = Steps { times_s: &times[..1], lengths_mm: &rows[..1], ..slow };
        assert_eq!(within(&one, 0.1), [0]);
    }
}
