//! The timeline at other times: keyframes moved, stretched, copied, eased, taken away, or given the time that their motors need.

use super::{Cancelled, Context};
use crate::design::animation::SAME_TIME_S;
use crate::design::edit::{self, EditError};
use crate::design::{Design, Easing, Keyframe};
use crate::motion::{MotionError, Plan, TooFast};
use serde::{Deserialize, Serialize};

/// Which keyframes, and what becomes of them, in this order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Numbers from 0; none: all.
    pub keys: Vec<usize>,
    /// How the animation moves on from them.
    pub easing: Option<Easing>,
    /// A copy of them begins at this time, s.
    pub copy_to_s: Option<f64>,
    /// Time between them is multiplied by this; the first one stays where it is.
    pub stretch: Option<f64>,
    /// They are moved by so much, s.
    pub by_s: f64,
    pub remove: bool,
    /// The whole animation gets the time that its motors need.
    pub fit: bool,
}

/// Why the timeline stays as it is.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error("the timeline has no keyframes")]
    NoKeyframes,
    #[error("the factor of stretching must be a positive number")]
    NoFactor,
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Changes the timeline.
///
/// # Errors
/// There is no such keyframe, or a time is taken or out of range; the design is as it was then.
pub fn run(design: &mut Design, options: &Options, context: &Context) -> Result<(), Error> {
    context.check()?;
    if design.keyframes.is_empty() {
        return Err(Error::NoKeyframes);
    }
    let mut changed = design.clone();
    let all = || (0..design.keyframes.len()).collect();
    let mut keys: Vec<usize> = if options.keys.is_empty() { all() } else { options.keys.clone() };
    if let Some(easing) = options.easing {
        ease(&mut changed, &keys, easing)?;
    }
    if let Some(time_s) = options.copy_to_s {
        let copies = copied(&changed, &keys)?;
        keys = paste(&mut changed, &copies, time_s)?;
    }
    if let Some(factor) = options.stretch {
        keys = stretch(&mut changed, &keys, factor)?;
    }
    if options.by_s != 0.0 {
        keys = shift(&mut changed, &keys, options.by_s)?;
    }
    if options.remove {
        edit::remove_keyframes(&mut changed, &keys)?;
    }
    if options.fit {
        fit(&mut changed)?;
    }
    *design = changed;
    Ok(())
}

/// Moves keyframes together; their new numbers.
///
/// # Errors
/// As [`edit::retime_keyframes`].
pub fn shift(design: &mut Design, keys: &[usize], by_s: f64) -> Result<Vec<usize>, EditError> {
    let times: Vec<(usize, f64)> =
        keys.iter().map(|&key| Ok((key, time(design, key)? + by_s))).collect::<Result<_, EditError>>()?;
    edit::retime_keyframes(design, &times)
}

/// Multiplies the time from the first of several keyframes to the others; their new numbers.
///
/// # Errors
/// A factor that is none; otherwise as [`edit::retime_keyframes`].
pub fn stretch(design: &mut Design, keys: &[usize], factor: f64) -> Result<Vec<usize>, Error> {
    if !(factor.is_finite() && factor > 0.0) {
        return Err(Error::NoFactor);
    }
    let times: Vec<(usize, f64)> =
        keys.iter().map(|&key| Ok((key, time(design, key)?))).collect::<Result<_, EditError>>()?;
    let first = times.iter().map(|(_, time_s)| *time_s).fold(f64::INFINITY, f64::min);
    let times: Vec<(usize, f64)> =
        times.into_iter().map(|(key, time_s)| (key, first + factor * (time_s - first))).collect();
    Ok(edit::retime_keyframes(design, &times)?)
}

/// Keyframes with times from the first of them.
///
/// # Errors
/// No such keyframe.
pub fn copied(design: &Design, keys: &[usize]) -> Result<Vec<Keyframe>, EditError> {
    let mut copies: Vec<Keyframe> = Vec::new();
    for &key in keys {
        time(design, key)?;
        copies.push(design.keyframes[key].clone());
    }
    copies.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    let first = copies.first().map_or(0.0, |frame| frame.time_s);
    copies.iter_mut().for_each(|frame| frame.time_s -= first);
    Ok(copies)
}

/// Puts copies on the timeline, the first at a time, in the place of those that are there; their numbers. Ones of a pose that there is not any
/// more are fixed.
///
/// # Errors
/// They are of other winches, or a time is out of range; the design is as it was then.
pub fn paste(design: &mut Design, copies: &[Keyframe], time_s: f64) -> Result<Vec<usize>, EditError> {
    let mut changed = design.clone();
    for copy in copies {
        let pose = copy.pose.clone().filter(|name| design.poses.iter().any(|pose| pose.name == *name));
        edit::set_keyframe(&mut changed, Keyframe { time_s: time_s + copy.time_s, pose, ..copy.clone() })?;
    }
    *design = changed;
    Ok(copies.iter().filter_map(|copy| edit::keyframe_at(design, time_s + copy.time_s)).collect())
}

/// Gives keyframes an easing.
///
/// # Errors
/// No such keyframe, or handles out of range.
pub fn ease(design: &mut Design, keys: &[usize], easing: Easing) -> Result<(), EditError> {
    for &key in keys {
        time(design, key)?;
        edit::set_keyframe(design, Keyframe { easing, ..design.keyframes[key].clone() })?;
    }
    Ok(())
}

/// Gives every section the time that the motors need, and no less than it has.
///
/// # Errors
/// A position or a length that no controller takes.
pub fn fit(design: &mut Design) -> Result<(), Error> {
    let times = fitted(design)?;
    edit::retime_keyframes(design, &times)?;
    Ok(())
}

/// The keyframes with the times that [`fit`] gives them, s.
///
/// # Errors
/// As [`fit`].
pub fn fitted(design: &Design) -> Result<Vec<(usize, f64)>, Error> {
    // Winches that are switched off ask for no time.
    let plan = Plan::of(&design.acting(), TooFast::Stretch)?;
    let planned = plan.keyframes_s(design.keyframes.len());
    let (mut before, mut later) = ([0.0; 2], 0.0);
    let mut times = Vec::new();
    for (key, (&planned_s, own)) in planned.iter().zip(&design.keyframes).enumerate() {
        let [since_plan, since_own] = [planned_s - before[0], own.time_s - before[1]];
        // What is quick enough stays to the bit, what is not gets time that can be read off and typed.
        if since_plan > since_own + SAME_TIME_S {
            later += up_to_a_millisecond(since_plan) - since_own;
        }
        times.push((key, own.time_s + later));
        before = [planned_s, own.time_s];
    }
    Ok(times)
}

/// A time on the next whole millisecond.
fn up_to_a_millisecond(time_s: f64) -> f64 {
    (time_s * 1e3 - 1e-6).ceil() / 1e3
}

fn time(design: &Design, key: usize) -> Result<f64, EditError> {
    let len = design.keyframes.len();
    design.keyframes.get(key).map(|k| k.time_s).ok_or(EditError::Missing { what: "keyframe", index: key, len })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    fn times(design: &Design) -> Vec<f64> {
        design.keyframes.iter().map(|k| k.time_s).collect()
    }

    fn with(times_s: &[f64]) -> Design {
        let mut design = testing::sample();
        let frame = design.keyframes[1].clone();
        let wound = |k: usize| vec![6.0 * (k % 2) as f64, 0.0];
        let frames = times_s.iter().enumerate();
        design.keyframes =
            frames.map(|(k, &time_s)| Keyframe { time_s, activations_mm: wound(k), ..frame.clone() }).collect();
        design.validate().unwrap();
        design
    }

    #[test]
    fn keyframes_move_stretch_and_are_copied_together() {
        let mut design = with(&[0.0, 1.0, 2.0, 5.0]);
        assert_eq!(shift(&mut design, &[1, 2], 4.5), Ok(vec![2, 3]));
        assert_eq!(times(&design), [0.0, 5.0, 5.5, 6.5]);
        assert_eq!(shift(&mut design, &[2], -0.5), Err(EditError::TimeTaken(5.0)));
        assert_eq!(stretch(&mut design, &[1, 2, 3], 2.0), Ok(vec![1, 2, 3]));
        assert_eq!(times(&design), [0.0, 5.0, 6.0, 8.0]);
        let copies = copied(&design, &[2, 1]).unwrap();
        assert_eq!(paste(&mut design, &copies, 1.0), Ok(vec![1, 2]));
        assert_eq!(times(&design), [0.0, 1.0, 2.0, 5.0, 6.0, 8.0]);
        assert_eq!(stretch(&mut design, &[0], 0.0), Err(Error::NoFactor));
        let before = design.clone();
        let wrong = Options { keys: vec![9], by_s: 1.0, ..Options::default() };
        assert!(run(&mut design, &wrong, &Context::new(&AtomicBool::new(false))).is_err());
        assert_eq!(design, before);
    }

    #[test]
    fn what_fits_is_not_too_fast_any_more_and_nothing_is_quicker_than_before() {
        let mut design = with(&[0.0, 0.05, 1.0, 1.01]);
        assert!(Plan::of(&design, TooFast::Refuse).is_err());
        let before = times(&design);
        run(&mut design, &Options { fit: true, ..Options::default() }, &Context::new(&AtomicBool::new(false))).unwrap();
        Plan::of(&design, TooFast::Refuse).unwrap();
        let after = times(&design);
        for (a, b) in before.windows(2).zip(after.windows(2)) {
            assert!(b[1] - b[0] >= a[1] - a[0] - 1e-9, "{before:?} {after:?}");
        }
        // What fits already stays.
        let fitted = design.clone();
        fit(&mut design).unwrap();
        assert_eq!(design, fitted);
    }
}
