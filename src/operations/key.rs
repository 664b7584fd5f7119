//! A pose on the timeline, as the winch activations that reach it.

use super::posing::{self, solve};
use super::{Cancelled, Context, NoSuchPose, Progress, Unbalanced};
use crate::design::edit::{self, EditError};
use crate::design::{Design, Easing, Keyframe, Pose};
use crate::engine::{BodySpec, Setpoint};
use serde::{Deserialize, Serialize};

/// The pose that is put on the timeline, and when.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Name of the pose; none: at rest, with nothing wound.
    pub pose: Option<String>,
    pub time_s: f64,
    pub easing: Easing,
}

/// Why there is no keyframe.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error("the design has no winches to key")]
    NoNetworks,
    #[error(transparent)]
    NoSuchPose(#[from] NoSuchPose),
    #[error("the solver returned no activation for some winches")]
    Unsolved,
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A note for the keyframe's maker.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// The activations are the best that were found.
    Unbalanced(Unbalanced),
}

/// A keyframe that was worked out.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyed {
    pub keyframe: Keyframe,
    pub notes: Vec<Note>,
}

/// Works out the activations of a pose: those of the realizable plushie, looked for from rest with all effort.
///
/// # Errors
/// The design has no winches or no such pose; [`Error::Cancelled`].
pub fn prepare(design: &Design, options: &Options, context: &Context) -> Result<Keyed, Error> {
    if design.networks.is_empty() {
        return Err(Error::NoNetworks);
    }
    let &Options { ref pose, time_s, easing } = options;
    let (activations_mm, notes) = match pose {
        None => (vec![0.0; design.networks.len()], Vec::new()),
        Some(pose) => {
            let setpoint = Setpoint::Targets(posing::targets(design, pose)?);
            let shapes = solve(design, setpoint, [false, true], context)?;
            let activations_mm = shapes[1].activations_mm.clone();
            if activations_mm.len() != design.networks.len() {
                return Err(Error::Unsolved);
            }
            (activations_mm, Unbalanced::of(pose, &shapes).into_iter().map(Note::Unbalanced).collect())
        }
    };
    Ok(Keyed { keyframe: Keyframe { time_s, activations_mm, pose: pose.clone(), easing }, notes })
}

impl Keyed {
    /// Puts the keyframe on the timeline, in the place of one at the same time, and returns its number.
    ///
    /// # Errors
    /// The design has other winches or poses by now, or the time is none.
    pub fn apply(mut self, design: &mut Design) -> Result<usize, EditError> {
        // A winch that is switched off keeps what it has there.
        if let Some(before) = edit::keyframe_at(design, self.keyframe.time_s) {
            let (before, now) = (&design.keyframes[before].activations_mm, &mut self.keyframe.activations_mm);
            for ((network, before), now) in design.networks.iter().zip(before).zip(now) {
                if network.muted {
                    *now = *before;
                }
            }
        }
        edit::set_keyframe(design, self.keyframe)
    }

    /// [`Self::apply`]; the keyframe comes back as the timeline has it now.
    ///
    /// # Errors
    /// As there.
    pub fn put(self, design: &mut Design) -> Result<Self, EditError> {
        let notes = self.notes.clone();
        let number = self.apply(design)?;
        Ok(Self { keyframe: design.keyframes[number].clone(), notes })
    }
}

/// [`prepare`] and [`Keyed::put`] in one.
///
/// # Errors
/// As both; the design is as it was then.
pub fn run(design: &mut Design, options: &Options, context: &Context) -> Result<Keyed, Error> {
    Ok(prepare(design, options, context)?.put(design)?)
}

/// Names of the poses on the timeline that `before` had other winches, another body or other targets for: what their keyframes wind is old.
pub fn outdated(before: &Design, now: &Design) -> Vec<String> {
    let targets = |design: &Design, name: &str| {
        design.poses.iter().find(|pose| pose.name == name).map(|pose| pose.targets.clone()).unwrap_or_default()
    };
    let same_body = BodySpec::of(before) == BodySpec::of(now);
    // A pose that was not on the timeline yet was worked out when it came there.
    let had = |name: &String| before.keyframes.iter().any(|keyframe| keyframe.pose.as_ref() == Some(name));
    let old = |name: &String| had(name) && (!same_body || targets(before, name) != targets(now, name));
    on_timeline(now).into_iter().filter(old).collect()
}

/// Names of the poses that keyframes are made from, each once; without those that ask for nothing.
pub fn on_timeline(design: &Design) -> Vec<String> {
    if design.networks.is_empty() {
        return Vec::new();
    }
    let keyed =
        |pose: &&Pose| !pose.targets.is_empty() && design.keyframes.iter().any(|k| k.pose.as_ref() == Some(&pose.name));
    design.poses.iter().filter(keyed).map(|pose| pose.name.clone()).collect()
}

/// Works out the keyframes of these poses again, each pose once; times and easings stay.
///
/// # Errors
/// As [`prepare`].
pub fn again(design: &Design, poses: &[String], context: &mut Context) -> Result<Vec<Keyed>, Error> {
    let mut out = Vec::new();
    for (done, pose) in poses.iter().enumerate() {
        context.tell(&Progress::Keyed { done, of: poses.len() });
        let keyed = prepare(design, &Options { pose: Some(pose.clone()), ..Options::default() }, context)?;
        context.check()?;
        let of_pose = design.keyframes.iter().filter(|keyframe| keyframe.pose.as_ref() == Some(pose));
        for (k, keyframe) in of_pose.enumerate() {
            let activations_mm = keyed.keyframe.activations_mm.clone();
            // A pose that does not balance is told once.
            let notes = if k == 0 { keyed.notes.clone() } else { Vec::new() };
            out.push(Keyed { keyframe: Keyframe { activations_mm, ..keyframe.clone() }, notes });
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    fn at(pose: Option<&str>, time_s: f64) -> Options {
        Options { pose: pose.map(str::to_owned), time_s, ..Options::default() }
    }

    #[test]
    fn a_pose_becomes_the_activations_that_reach_it() {
        let mut design = testing::sample();
        design.keyframes.clear();
        let pose = design.poses[0].name.clone();
        let go = AtomicBool::new(false);
        let context = Context::new(&go);
        let keyed = run(&mut design, &at(Some(&pose), 1.0), &context).unwrap();
        assert_eq!(keyed.keyframe.activations_mm.len(), design.networks.len());
        assert_eq!(run(&mut design, &at(Some(&pose), 1.0), &context).unwrap(), keyed);
        run(&mut design, &at(None, 2.0), &context).unwrap();
        assert_eq!(design.keyframes.len(), 2);
        assert!(design.keyframes[1].activations_mm.iter().all(|mm| *mm == 0.0));
    }

    #[test]
    fn keyframes_of_poses_are_worked_out_again_for_other_winches() {
        let mut design = testing::sample();
        design.keyframes.clear();
        // To where cables pull it.
        design.poses[0].targets[0].to = [27.0, 43.0];
        let pose = design.poses[0].name.clone();
        let go = AtomicBool::new(false);
        let context = Context::new(&go);
        run(&mut design, &at(None, 0.0), &context).unwrap();
        run(&mut design, &at(Some(&pose), 1.0), &context).unwrap();
        run(&mut design, &at(Some(&pose), 3.0), &context).unwrap();
        assert_eq!(outdated(&design, &design), [""; 0]);
        let mut strung = design.clone();
        strung.networks[0].tendons[0].ratio = 0.5;
        strung.networks[0].name.push('x');
        assert_eq!(outdated(&design, &strung), std::slice::from_ref(&pose));
        let mut free = strung.clone();
        free.keyframes.iter_mut().for_each(|keyframe| keyframe.pose = None);
        assert_eq!(outdated(&design, &free), [""; 0]);
        let mut steps = Vec::new();
        let mut telling = |step: &Progress| steps.push(format!("{step:?}"));
        let keyed = again(&strung, &on_timeline(&strung), &mut Context::telling(&go, &mut telling)).unwrap();
        assert_eq!(steps, ["Keyed { done: 0, of: 1 }"]);
        assert_eq!(keyed.iter().map(|keyed| keyed.keyframe.time_s).collect::<Vec<_>>(), [1.0, 3.0]);
        let fresh = run(&mut strung.clone(), &at(Some(&pose), 1.0), &context).unwrap();
        for keyed in keyed {
            assert_eq!(keyed.keyframe.activations_mm, fresh.keyframe.activations_mm);
            keyed.apply(&mut strung).unwrap();
        }
        let [now, before] = [&strung, &design].map(|design| design.keyframes[1].activations_mm[0]);
        assert!(before > 1.0 && (now - before).abs() > 0.1, "{before} mm before, {now} mm now");
        assert_eq!((strung.keyframes.len(), &strung.keyframes[0]), (3, &design.keyframes[0]));
    }

    #[test]
    fn a_winch_that_is_switched_off_keeps_what_it_winds_and_that_is_told() {
        let mut design = testing::sample();
        let pose = design.poses[0].name.clone();
        let time_s = design.keyframes[1].time_s;
        design.keyframes[1].activations_mm = vec![1.0, 12.5];
        design.networks[1].muted = true;
        let go = AtomicBool::new(false);
        let keyed = run(&mut design, &at(Some(&pose), time_s), &Context::new(&go)).unwrap();
        assert_eq!((&keyed.keyframe, keyed.keyframe.activations_mm[1]), (&design.keyframes[1], 12.5));
    }

    #[test]
    fn what_cannot_be_keyed_is_told_and_changes_nothing() {
        let mut design = testing::sample();
        let before = design.clone();
        let (go, stop) = (AtomicBool::new(false), AtomicBool::new(true));
        let pose = design.poses[0].name.clone();
        assert!(matches!(run(&mut design, &at(Some("none"), 0.0), &Context::new(&go)), Err(Error::NoSuchPose(_))));
        assert!(matches!(run(&mut design, &at(None, -1.0), &Context::new(&go)), Err(Error::Edit(_))));
        assert!(matches!(run(&mut design, &at(Some(&pose), 0.0), &Context::new(&stop)), Err(Error::Cancelled(_))));
        assert_eq!(design, before);
        design.networks.clear();
        design.keyframes.clear();
        assert_eq!(run(&mut design, &at(None, 0.0), &Context::new(&go)), Err(Error::NoNetworks));
    }
}
