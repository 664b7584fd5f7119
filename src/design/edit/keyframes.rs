//! Changes of the timeline: keyframes set, moved alone or together, taken away.

use super::{EditError, item};
use crate::design::animation::SAME_TIME_S;
use crate::design::{Design, Keyframe, validate};

/// Puts a keyframe on the timeline in place of one at the same time (within [`SAME_TIME_S`]), if any; its index.
///
/// # Errors
/// A figure out of range, or another number of activations than networks.
pub fn set_keyframe(design: &mut Design, keyframe: Keyframe) -> Result<usize, EditError> {
    validate::keyframe("keyframe", design, &keyframe)?;
    if let Some(index) = keyframe_at(design, keyframe.time_s) {
        design.keyframes[index] = keyframe;
        return Ok(index);
    }
    Ok(insert_keyframe(design, keyframe))
}

/// Moves a keyframe in time, past others if need be; its new index. Two keyframes at one time are refused.
///
/// # Errors
/// No such keyframe; a time out of range, or one that another keyframe has.
pub fn move_keyframe(design: &mut Design, index: usize, time_s: f64) -> Result<usize, EditError> {
    let moved = Keyframe { time_s, ..item(&mut design.keyframes, "keyframe", index)?.clone() };
    validate::keyframe(&format!("keyframes[{index}]"), design, &moved)?;
    if design.keyframes.iter().enumerate().any(|(i, k)| i != index && same_time(k.time_s, time_s)) {
        return Err(EditError::TimeTaken(time_s));
    }
    design.keyframes.remove(index);
    Ok(insert_keyframe(design, moved))
}

/// Takes a keyframe away and returns it.
///
/// # Errors
/// No such keyframe.
pub fn remove_keyframe(design: &mut Design, index: usize) -> Result<Keyframe, EditError> {
    item(&mut design.keyframes, "keyframe", index)?;
    Ok(design.keyframes.remove(index))
}

/// The keyframe at a time, within [`SAME_TIME_S`].
pub fn keyframe_at(design: &Design, time_s: f64) -> Option<usize> {
    design.keyframes.iter().position(|k| same_time(k.time_s, time_s))
}

/// Gives several keyframes other times, past others if need be; their new indices in the same order. Two keyframes at one time are refused.
///
/// # Errors
/// No such keyframe; a time out of range, or one that another keyframe has; the design stays as it was.
pub fn retime_keyframes(design: &mut Design, times_s: &[(usize, f64)]) -> Result<Vec<usize>, EditError> {
    let mut frames: Vec<(Option<usize>, Keyframe)> = design.keyframes.iter().map(|k| (None, k.clone())).collect();
    for (place, &(index, time_s)) in times_s.iter().enumerate() {
        let (mark, frame) = item(&mut frames, "keyframe", index)?;
        (*mark, frame.time_s) = (Some(place), time_s);
        validate::keyframe(&format!("keyframes[{index}]"), design, frame)?;
    }
    frames.sort_by(|a, b| a.1.time_s.total_cmp(&b.1.time_s));
    if let Some(pair) = frames.windows(2).find(|pair| same_time(pair[0].1.time_s, pair[1].1.time_s)) {
        return Err(EditError::TimeTaken(pair[1].1.time_s));
    }
    let mut places = vec![0; times_s.len()];
    for (index, (mark, _)) in frames.iter().enumerate() {
        if let Some(place) = mark {
            places[*place] = index;
        }
    }
    design.keyframes = frames.into_iter().map(|(_, frame)| frame).collect();
    Ok(places)
}

/// Takes several keyframes away.
///
/// # Errors
/// No such keyframe; the design stays as it was.
pub fn remove_keyframes(design: &mut Design, indices: &[usize]) -> Result<(), EditError> {
    let len = design.keyframes.len();
    if let Some(&index) = indices.iter().find(|&&index| index >= len) {
        return Err(EditError::Missing { what: "keyframe", index, len });
    }
    let mut index = 0;
    design.keyframes.retain(|_| {
        index += 1;
        !indices.contains(&(index - 1))
    });
    Ok(())
}

fn insert_keyframe(design: &mut Design, keyframe: Keyframe) -> usize {
    let index = design.keyframes.partition_point(|k| k.time_s < keyframe.time_s);
    design.keyframes.insert(index, keyframe);
    index
}

fn same_time(a: f64, b: f64) -> bool {
    (a - b).abs() < SAME_TIME_S
}
