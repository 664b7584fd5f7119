//! Ghosts: what simulated drives make of an animation, beside what it asks of them.

use super::following::Following;
use super::machine::Machine;
use super::plan::{Note, Plan, TooFast};
use super::trajectory::Trajectory;
use super::{MotionError, following};
use crate::design::Design;
use crate::engine::winch_reach_mm;

/// The way of every drive, and the stretches of the animation that they cannot follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Ghost {
    /// s; those of the plan, in which nothing is too fast.
    pub times_s: Vec<f64>,
    /// Cable that each drive has wound at each of these times, mm.
    pub wound_mm: Vec<Vec<f64>>,
    pub doubts: Vec<Doubt>,
}

/// A stretch of the animation that the motors do not play as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// Between these times of the design, s.
    pub from_s: f64,
    pub to_s: f64,
    pub why: Why,
}

/// The reason of a [`Doubt`].
#[derive(Clone, Debug, PartialEq)]
pub enum Why {
    /// It takes so long, s.
    TooFast { needs_s: f64 },
    /// A winch comes to a tendon that cannot be wound any shorter, mm.
    TooFar { winch: String, reach_mm: f64 },
    /// It is rounded off to keep the limits.
    Rounded { winch: String },
    /// It is the way to the next length, which a keyframe that is held would have as a jump.
    Jump { winch: String },
}

impl Ghost {
    /// Simulates the drives of a design, each told every step of the trajectory at its time. Those of winches that are switched off stand still.
    ///
    /// # Errors
    /// Too many steps, or a position beyond the controllers'.
    pub fn of(design: &Design) -> Result<Self, MotionError> {
        let acting = design.acting();
        let trajectory = Trajectory::of(&acting, TooFast::Stretch)?;
        let machine = Machine::new(&acting, &trajectory);
        let winches = machine.winches.len();
        let end_s = trajectory.times_s[0] + Following::most_s(&machine);
        let steps = trajectory.times_s.iter().take_while(|time_s| **time_s <= end_s).count();
        let mut wound_mm = vec![Vec::with_capacity(winches); steps];
        for winch in 0..winches {
            let orders = following::orders(&machine, &trajectory, winch);
            let mut drive = following::drive(&machine, trajectory.lengths_mm[0][winch]);
            wound_mm[0].push(drive.position / machine.counts_per_mm);
            for k in 1..steps {
                orders[k - 1].give(&mut drive, &machine);
                drive.pass(trajectory.times_s[k] - trajectory.times_s[k - 1]);
                wound_mm[k].push(drive.position / machine.counts_per_mm);
            }
        }
        let doubts = doubts(&acting, &trajectory.notes);
        let wound_mm = wound_mm.iter().map(|row| design.of_all(row)).collect();
        Ok(Self { times_s: trajectory.times_s[..steps].to_vec(), wound_mm, doubts })
    }
}

/// What the plan had to change, and where winches come to their ends.
fn doubts(design: &Design, notes: &[Note]) -> Vec<Doubt> {
    let mut doubts: Vec<Doubt> = notes.iter().filter_map(doubt).collect();
    for pair in design.keyframes.windows(2) {
        for (winch, network) in design.networks.iter().enumerate() {
            let reach_mm = winch_reach_mm(design, network);
            if pair.iter().any(|key| key.activations_mm.get(winch).is_some_and(|&wound| wound > reach_mm)) {
                let why = Why::TooFar { winch: network.name.clone(), reach_mm };
                doubts.push(Doubt { from_s: pair[0].time_s, to_s: pair[1].time_s, why });
            }
        }
    }
    doubts
}

fn doubt(note: &Note) -> Option<Doubt> {
    match note {
        Note::Stretched { from_s, to_s, now_s } => {
            Some(Doubt { from_s: *from_s, to_s: *to_s, why: Why::TooFast { needs_s: *now_s } })
        }
        Note::Rounded { winch, from_s, to_s } => {
            Some(Doubt { from_s: *from_s, to_s: *to_s, why: Why::Rounded { winch: winch.clone() } })
        }
        Note::Jump { winch, from_s, to_s } => {
            Some(Doubt { from_s: *from_s, to_s: *to_s, why: Why::Jump { winch: winch.clone() } })
        }
        Note::Slack { .. } | Note::Lead { .. } => None,
    }
}

/// Whether the animation of a design can be played as it is, by the winches that act, without simulating anything.
///
/// # Errors
/// A position or a length that no controller takes.
pub fn doubted(design: &Design) -> Result<Vec<Doubt>, MotionError> {
    let acting = design.acting();
    Ok(doubts(&acting, &Plan::of(&acting, TooFast::Stretch)?.notes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Keyframe, testing};

    #[test]
    fn drives_follow_a_slow_animation_and_doubt_a_quick_one() {
        let mut design = testing::sample();
        design.keyframes[1].time_s = 4.0;
        let slow = Ghost::of(&design).unwrap();
        assert_eq!((slow.doubts.as_slice(), slow.wound_mm[0].len()), (&[][..], 2));
        let last = slow.wound_mm.last().unwrap();
        assert!((last[0] - 6.0).abs() < 0.1, "{last:?}");
        let quick = Keyframe { time_s: 4.001, activations_mm: vec![0.0, 0.0], ..design.keyframes[1].clone() };
        design.keyframes.push(quick);
        let doubts = Ghost::of(&design).unwrap().doubts;
        assert!(matches!(doubts[0], Doubt { from_s: 4.0, why: Why::TooFast { needs_s }, .. } if needs_s > 0.001));
        assert_eq!(doubted(&design).unwrap(), doubts);
        design.keyframes[1].activations_mm[1] = 1e3;
        assert!(doubted(&design).unwrap().iter().any(|doubt| matches!(doubt.why, Why::TooFar { .. })));
        // A winch that is switched off is no motor's trouble.
        design.keyframes.pop();
        design.networks[1].muted = true;
        let ghost = Ghost::of(&design).unwrap();
        assert_eq!((doubted(&design).unwrap().as_slice(), ghost.doubts.as_slice()), (&[][..], &[][..]));
        assert!(ghost.wound_mm.iter().all(|row| row.len() == 2 && row[1] == 0.0));
        assert_eq!(ghost.wound_mm.last().unwrap()[0], slow.wound_mm.last().unwrap()[0]);
    }
}
