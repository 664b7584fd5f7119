//! Plans: the animation as motors can follow it.
//!
//! Keyframes are hit: each is a step of its own, at its value. Between two of them every winch keeps the easing that the maker chose where
//! speed and acceleration stay within limits; where they do not, it takes a trapezoid of speed that does (a straight line gets round
//! corners, a jump becomes the quickest move that arrives in time). Where not even that is quick enough, the section is stretched if
//! that was asked for, and refused by name if not. A winch cannot push: slack is never commanded.

use super::error::MotionError;
use super::limits::Limits;
use super::profile::{Profile, ROUNDING, Trapezoid};
use super::winches::{counts_per_mm, winch_labels};
use crate::design::animation::SAME_TIME_S;
use crate::design::{Design, Easing};
use serde::{Deserialize, Serialize};

/// A change that the animation took on its way to the motors.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// A keyframe lets out more than the just-slack rest length, where line may leave the spool: it stops there.
    Slack { winch: String, time_s: f64, length_mm: f64 },
    /// The first keyframe is not at rest: the winches are wound up to it first, and all else is `later_s` later where that takes longer
    /// than there is time before it.
    Lead { lead_s: f64, later_s: f64 },
    /// A section was too quick: it takes longer now, and what follows is later. Its ends are those of the design's keyframes.
    Stretched { from_s: f64, to_s: f64, now_s: f64 },
    /// The easing of a section is rounded off. Its ends are those of the design's keyframes.
    Rounded { winch: String, from_s: f64, to_s: f64 },
    /// A keyframe is held and the next one has another length: no motor jumps, so the winch leaves before, to be there in time. Between
    /// these times of the design it is on its way.
    Jump { winch: String, from_s: f64, to_s: f64 },
}

/// The treatment of a section that no motor can follow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TooFast {
    /// Refuse the animation, and say what it would need.
    #[default]
    Refuse,
    /// Give it the time it needs.
    Stretch,
}

/// Lengths of all winches over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Times of the keyframes, s, those of a lead from rest before them.
    times_s: Vec<f64>,
    /// For each section between two of them, a profile a winch.
    sections: Vec<Vec<Profile>>,
    /// What holds without sections, mm.
    still_mm: Vec<f64>,
    pub notes: Vec<Note>,
}

/// Part by which a section that is as long as a move from rest to rest needs, and does not fit, is made longer until it does. The speeds at
/// its ends only shorten the way; it is a guard against rounding.
const LONGER: f64 = 0.01;
/// The lead runs at this part of speed and acceleration: nobody waits for it, and everybody watches it.
const LEAD: f64 = 0.5;

/// Largest speed and acceleration of a design's motors, in mm of cable on a spool of ratio 1.
pub fn limits(design: &Design) -> Limits {
    let motor = &design.controller;
    let mm_per_revolution = 4.0 * f64::from(motor.encoder_lines) / counts_per_mm(design);
    Limits {
        speed: f64::from(motor.speed_rpm) / 60.0 * mm_per_revolution,
        acceleration: f64::from(motor.acceleration) * mm_per_revolution,
    }
}

/// Time that a smooth move between two keyframes' lengths takes at least, s.
pub fn smooth_s(design: &Design, from_mm: &[f64], to_mm: &[f64]) -> f64 {
    let limits = limits(design);
    let needs = from_mm.iter().zip(to_mm).map(|(from, to)| {
        let [speed, acceleration] = Profile::peaks(Easing::Smooth, to.max(0.0) - from.max(0.0), 1.0);
        (speed / limits.speed).max((acceleration / limits.acceleration).sqrt())
    });
    needs.fold(0.0, f64::max)
}

impl Plan {
    /// Plans the animation of a design.
    ///
    /// # Errors
    /// [`MotionError::TooFast`] with the first section that no motor can follow, unless it may be stretched.
    pub fn of(design: &Design, too_fast: TooFast) -> Result<Self, MotionError> {
        let (limits, winches) = (limits(design), winch_labels(design));
        let mut notes = Vec::new();
        let mut keys: Vec<Key> = design
            .keyframes
            .iter()
            .map(|k| Key { asked_s: k.time_s, time_s: k.time_s, easing: k.easing, lengths: k.activations_mm.clone() })
            .collect();
        for key in &mut keys {
            for (winch, length) in winches.iter().zip(&mut key.lengths) {
                if *length < 0.0 {
                    notes.push(Note::Slack { winch: winch.clone(), time_s: key.time_s, length_mm: *length });
                    *length = 0.0;
                }
            }
        }
        lead(&mut keys, limits, &mut notes);
        let still_mm = keys.first().map_or_else(|| vec![0.0; winches.len()], |key| key.lengths.clone());
        let sections = fit(&mut keys, &winches, limits, too_fast, &mut notes)?;
        Ok(Self { times_s: keys.iter().map(|key| key.time_s).collect(), sections, still_mm, notes })
    }

    /// Lengths of all winches at a time, mm; before the beginning and after the end they stand still.
    pub fn at(&self, time_s: f64) -> Vec<f64> {
        (0..self.still_mm.len()).map(|winch| self.length_at(winch, time_s)).collect()
    }

    /// Its beginning and its end, s.
    pub fn span_s(&self) -> [f64; 2] {
        [self.times_s.first(), self.times_s.last()].map(|time| time.copied().unwrap_or(0.0))
    }

    /// Length of one winch at a time, mm, as [`Plan::at`] has it.
    pub fn length_at(&self, winch: usize, time_s: f64) -> f64 {
        let next = self.times_s.partition_point(|&t| t <= time_s);
        let section = next.saturating_sub(1).min(self.sections.len().saturating_sub(1));
        match self.sections.get(section) {
            None => self.still_mm[winch],
            Some(profiles) => {
                let (from, to) = (self.times_s[section], self.times_s[section + 1]);
                profiles[winch].at((time_s - from).clamp(0.0, to - from))
            }
        }
    }

    /// The steps of a track of this rate: each section in equal steps of at most `1 / rate_hz`, so that every keyframe is one, s.
    pub fn steps(&self, rate_hz: f64) -> Vec<f64> {
        let mut steps = vec![self.times_s.first().copied().unwrap_or(0.0)];
        for pair in self.times_s.windows(2) {
            let (duration, count) = (pair[1] - pair[0], steps_of(pair, rate_hz));
            let inner = (1..count as u64).map(|k| pair[0] + duration * k as f64 / count);
            steps.extend(inner);
            steps.push(pair[1]);
        }
        steps
    }

    /// Times of the design's keyframes in the plan, s; `count`: how many it has. A lead before them does not count.
    pub fn keyframes_s(&self, count: usize) -> &[f64] {
        &self.times_s[self.times_s.len().saturating_sub(count)..]
    }

    /// How many steps [`Plan::steps`] has.
    pub fn count(&self, rate_hz: f64) -> f64 {
        self.times_s.windows(2).map(|pair| steps_of(pair, rate_hz)).sum::<f64>() + 1.0
    }
}

/// Steps between two keyframes.
fn steps_of(times_s: &[f64], rate_hz: f64) -> f64 {
    ((times_s[1] - times_s[0] - SAME_TIME_S) * rate_hz).ceil().max(1.0)
}

/// A keyframe on its way into the plan.
#[derive(Clone, Debug)]
struct Key {
    /// When the design has it, s.
    asked_s: f64,
    /// When the plan has it, s.
    time_s: f64,
    easing: Easing,
    lengths: Vec<f64>,
}

/// Begins at rest: winds up to the first keyframe, in the time before it if there is enough, else all else is later.
fn lead(keys: &mut Vec<Key>, limits: Limits, notes: &mut Vec<Note>) {
    let Some(first) = keys.first().cloned() else { return };
    let gently = Limits { speed: LEAD * limits.speed, acceleration: LEAD * limits.acceleration };
    let needs = first.lengths.iter().map(|&by| Trapezoid::shortest(by, gently)).fold(0.0, f64::max);
    if needs == 0.0 {
        return;
    }
    let late = (needs - first.time_s).max(0.0);
    keys.iter_mut().for_each(|key| key.time_s += late);
    let rest = Key {
        asked_s: first.time_s - needs,
        time_s: first.time_s + late - needs,
        easing: Easing::Linear,
        lengths: vec![0.0; first.lengths.len()],
    };
    keys.insert(0, rest);
    notes.push(Note::Lead { lead_s: needs, later_s: late });
}

/// A profile for each winch in each section; sections that are too quick are stretched or refused.
fn fit(
    keys: &mut [Key],
    winches: &[String],
    limits: Limits,
    too_fast: TooFast,
    notes: &mut Vec<Note>,
) -> Result<Vec<Vec<Profile>>, MotionError> {
    let mut k = 0;
    let mut sections: Vec<Vec<Profile>> = Vec::new();
    while k + 1 < keys.len() {
        let found: Option<Vec<Profile>> = (0..winches.len()).map(|winch| profile(keys, k, winch, limits)).collect();
        if let Some(found) = found {
            sections.push(found);
            k += 1;
            continue;
        }
        let duration = keys[k + 1].time_s - keys[k].time_s;
        let by = |winch: usize| keys[k + 1].lengths[winch] - keys[k].lengths[winch];
        if too_fast == TooFast::Refuse {
            let slow = (0..winches.len()).find(|&winch| profile(keys, k, winch, limits).is_none()).unwrap_or(0);
            return Err(MotionError::TooFast {
                winch: winches[slow].clone(),
                from_s: keys[k].asked_s,
                to_s: keys[k + 1].asked_s,
                by_mm: by(slow),
                needs_s: Trapezoid::shortest(by(slow), limits),
            });
        }
        let needs = (0..winches.len()).map(|winch| Trapezoid::shortest(by(winch), limits)).fold(0.0, f64::max);
        let more = if needs > duration { needs * (1.0 + ROUNDING) - duration } else { LONGER * duration };
        keys[k + 1..].iter_mut().for_each(|key| key.time_s += more);
        // The speed at which the section begins has changed with it: the one before is fitted again.
        k = k.saturating_sub(1);
        sections.truncate(k);
    }
    for (section, profiles) in sections.iter().enumerate() {
        let [from_s, to_s] = [keys[section].asked_s, keys[section + 1].asked_s];
        let now_s = keys[section + 1].time_s - keys[section].time_s;
        if now_s > (to_s - from_s) * (1.0 + ROUNDING) {
            notes.push(Note::Stretched { from_s, to_s, now_s });
        }
        for (profile, winch) in profiles.iter().zip(winches) {
            let Profile::Trapezoid { wait, .. } = profile else { continue };
            match keys[section].easing {
                // A straight line's corners are rounded off as a matter of course.
                Easing::Linear => {}
                Easing::Hold => {
                    let leaves_s = from_s + (to_s - from_s) * wait / now_s;
                    notes.push(Note::Jump { winch: winch.clone(), from_s: leaves_s, to_s });
                }
                _ => notes.push(Note::Rounded { winch: winch.clone(), from_s, to_s }),
            }
        }
    }
    Ok(sections)
}

/// The motion of a winch in section `k`: the easing itself if it keeps the limits, else a trapezoid, if there is one.
fn profile(keys: &[Key], k: usize, winch: usize, limits: Limits) -> Option<Profile> {
    let (from, by) = (keys[k].lengths[winch], keys[k + 1].lengths[winch] - keys[k].lengths[winch]);
    let duration = keys[k + 1].time_s - keys[k].time_s;
    let easing = keys[k].easing;
    let [speed, acceleration] = Profile::peaks(easing, by, duration);
    let ends = [speed_at(keys, k, winch), speed_at(keys, k + 1, winch)];
    if ends == [0.0; 2] && speed <= limits.speed && acceleration <= limits.acceleration {
        return Some(Profile::Eased { from, by, duration, easing });
    }
    // A held value stays as long as it can.
    let moving = if easing == Easing::Hold { Trapezoid::shortest(by, limits).min(duration) } else { duration };
    let trapezoid = Trapezoid::find(by, moving, ends, limits)?;
    Some(Profile::Trapezoid { from, wait: duration - moving, trapezoid })
}

/// Speed with which a winch passes keyframe `k`, mm/s: none but between two straight stretches in one direction, where it is the
/// harmonic mean of theirs (as monotone cubic interpolation has it, Fritsch and Butland 1984: never more than twice the slower one).
fn speed_at(keys: &[Key], k: usize, winch: usize) -> f64 {
    if k == 0 || k + 1 == keys.len() || keys[k - 1].easing != Easing::Linear || keys[k].easing != Easing::Linear {
        return 0.0;
    }
    let slope = |a: &Key, b: &Key| (b.lengths[winch] - a.lengths[winch]) / (b.time_s - a.time_s);
    let (before, after) = (slope(&keys[k - 1], &keys[k]), slope(&keys[k], &keys[k + 1]));
    if before * after > 0.0 { 2.0 * before * after / (before + after) } else { 0.0 }
}

#[cfg(test)]
mod tests;
