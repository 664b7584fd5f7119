//! The changes a user can make to a document.
//!
//! Each function leaves a valid design valid, or returns an error and leaves it as it was. They know nothing of undo:
//! [`super::History`] calls them.

mod keyframes;
mod networks;

pub use keyframes::{keyframe_at, move_keyframe, remove_keyframe, remove_keyframes, retime_keyframes, set_keyframe};
pub use networks::{
    accept_network, color_network, move_network, mute_network, remove_network, rename_network, set_network,
};

use super::{
    ControllerSettings, Design, DesignError, FabricationSettings, FiberSettings, Gravity, Material, Pin, Pose, Target,
    TendonSettings, Term, validate,
};
use crate::mesh::MeshError;
use crate::outline::drawing::Track;
use crate::outline::{Drawing, Point};
use crate::physics::terms::GRAVITY;
use crate::physics::{Kind, TermKind};
use crate::sewing::Rules;
use thiserror::Error;

/// Why a change was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum EditError {
    #[error(transparent)]
    Invalid(#[from] DesignError),
    /// Told as people count, from 1.
    #[error("there is no {what} {}, there are {len}", index + 1)]
    Missing { what: &'static str, index: usize, len: usize },
    #[error("a {0} needs a name")]
    NoName(&'static str),
    #[error("there is already a {what} named {name:?}")]
    NameTaken { what: &'static str, name: String },
    #[error("there is already a keyframe at {0} s")]
    TimeTaken(f64),
    #[error(
        "{},{} mm is not on the body at rest; the nearest point of the body is {:.1},{:.1}",
        place[0], place[1], nearest[0], nearest[1]
    )]
    OffBody { place: Point, nearest: Point },
    #[error("{},{} mm is not on the body: the design has no mesh", place[0], place[1])]
    NoBody { place: Point },
    #[error("a tendon starts at its winch and needs one more place at least")]
    NoEnd,
    #[error("only some of the tendons of a winch can be split off, one at least")]
    NotSome,
    #[error("no gesture is running")]
    NoGesture,
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// Adds a pin; its index.
///
/// # Errors
/// A point or figure out of range; the design stays as it was.
pub fn add_pin(design: &mut Design, pin: Pin) -> Result<usize, EditError> {
    validate::pin(&format!("pins[{}]", design.pins.len()), &design.mesh, &pin)?;
    design.pins.push(pin);
    Ok(design.pins.len() - 1)
}

/// Replaces a pin: another anchor or stiffness.
///
/// # Errors
/// No such pin, or a figure out of range; the design stays as it was.
pub fn set_pin(design: &mut Design, index: usize, pin: Pin) -> Result<(), EditError> {
    validate::pin(&format!("pins[{index}]"), &design.mesh, &pin)?;
    *item(&mut design.pins, "pin", index)? = pin;
    Ok(())
}

/// Takes a pin away and returns it.
///
/// # Errors
/// No such pin.
pub fn remove_pin(design: &mut Design, index: usize) -> Result<Pin, EditError> {
    item(&mut design.pins, "pin", index)?;
    Ok(design.pins.remove(index))
}

/// Adds a pose; its index.
///
/// # Errors
/// A pose without a name, or a target out of range; the design stays as it was.
pub fn add_pose(design: &mut Design, pose: Pose) -> Result<usize, EditError> {
    let name = free_pose_name(design, &pose.name, None)?;
    let pose = Pose { name, ..pose };
    validate::pose(&format!("poses[{}]", design.poses.len()), &design.mesh, &pose)?;
    design.poses.push(pose);
    Ok(design.poses.len() - 1)
}

/// Renames a pose, in the keyframes made from it as well.
///
/// # Errors
/// No such pose; a name that is empty or taken.
pub fn rename_pose(design: &mut Design, index: usize, name: &str) -> Result<(), EditError> {
    item(&mut design.poses, "pose", index)?;
    let name = free_pose_name(design, name, Some(index))?;
    let old = std::mem::replace(&mut design.poses[index].name, name.clone());
    for keyframe in design.keyframes.iter_mut().filter(|k| k.pose.as_ref() == Some(&old)) {
        keyframe.pose = Some(name.clone());
    }
    Ok(())
}

/// Copies a pose behind itself, under its name with a number; the copy's index.
///
/// # Errors
/// No such pose.
pub fn duplicate_pose(design: &mut Design, index: usize) -> Result<usize, EditError> {
    let mut copy = item(&mut design.poses, "pose", index)?.clone();
    copy.name = unused_pose_name(design, &copy.name);
    design.poses.insert(index + 1, copy);
    Ok(index + 1)
}

/// Removes a pose. Keyframes made from it keep their activations.
///
/// # Errors
/// No such pose.
pub fn remove_pose(design: &mut Design, index: usize) -> Result<Pose, EditError> {
    item(&mut design.poses, "pose", index)?;
    let pose = design.poses.remove(index);
    for keyframe in design.keyframes.iter_mut().filter(|k| k.pose.as_ref() == Some(&pose.name)) {
        keyframe.pose = None;
    }
    Ok(pose)
}

/// Adds a target to a pose; its index there.
///
/// # Errors
/// No such pose, or a target out of range.
pub fn add_target(design: &mut Design, pose: usize, target: Target) -> Result<usize, EditError> {
    let targets = &mut item(&mut design.poses, "pose", pose)?.targets;
    validate::target(&format!("poses[{pose}].targets[{}]", targets.len()), &design.mesh, &target)?;
    targets.push(target);
    Ok(targets.len() - 1)
}

/// Moves the goal of a target.
///
/// # Errors
/// No such pose or target, or a goal out of range.
pub fn move_target(design: &mut Design, pose: usize, index: usize, to: Point) -> Result<(), EditError> {
    let target = *item(&mut item(&mut design.poses, "pose", pose)?.targets, "target", index)?;
    set_target(design, pose, index, Target { to, ..target })
}

/// Replaces a target: another goal, weight or point of the body.
///
/// # Errors
/// No such pose or target, or a figure out of range.
pub fn set_target(design: &mut Design, pose: usize, index: usize, target: Target) -> Result<(), EditError> {
    let place = item(&mut item(&mut design.poses, "pose", pose)?.targets, "target", index)?;
    validate::target(&format!("poses[{pose}].targets[{index}]"), &design.mesh, &target)?;
    *place = target;
    Ok(())
}

/// Takes a target of a pose away and returns it.
///
/// # Errors
/// No such pose or target.
pub fn remove_target(design: &mut Design, pose: usize, index: usize) -> Result<Target, EditError> {
    let targets = &mut item(&mut design.poses, "pose", pose)?.targets;
    item(targets, "target", index)?;
    Ok(targets.remove(index))
}

/// Gives the design another name.
///
/// # Errors
/// An empty name, or one that cannot be shown.
pub fn rename(design: &mut Design, name: &str) -> Result<(), EditError> {
    design.name = trimmed("design", name)?;
    Ok(())
}

/// Replaces the material.
///
/// # Errors
/// What makes the design unsound; the design stays as it was.
pub fn set_material(design: &mut Design, material: Material) -> Result<(), EditError> {
    set(design, |d| std::mem::replace(&mut d.material, material), |d, old| d.material = old)
}

/// Replaces the settings of the fibres.
///
/// # Errors
/// What makes the design unsound; the design stays as it was.
pub fn set_fibers(design: &mut Design, fibers: FiberSettings) -> Result<(), EditError> {
    set(design, |d| std::mem::replace(&mut d.fibers, fibers), |d, old| d.fibers = old)
}

/// Replaces the settings of the tendons.
///
/// # Errors
/// What makes the design unsound; the design stays as it was.
pub fn set_tendons(design: &mut Design, tendons: TendonSettings) -> Result<(), EditError> {
    set(design, |d| std::mem::replace(&mut d.tendons, tendons), |d, old| d.tendons = old)
}

/// Replaces the settings of fabrication.
///
/// # Errors
/// What makes the design unsound; the design stays as it was.
pub fn set_fabrication(design: &mut Design, fabrication: FabricationSettings) -> Result<(), EditError> {
    set(design, |d| std::mem::replace(&mut d.fabrication, fabrication), |d, old| d.fabrication = old)
}

/// Replaces the settings of the motors.
///
/// # Errors
/// What makes the design unsound; the design stays as it was.
pub fn set_controller(design: &mut Design, controller: ControllerSettings) -> Result<(), EditError> {
    set(design, |d| std::mem::replace(&mut d.controller, controller), |d, old| d.controller = old)
}

/// Replaces the rules of sewing.
///
/// # Errors
/// What makes the design unsound; the design stays as it was.
pub fn set_sewing(design: &mut Design, rules: Rules) -> Result<(), EditError> {
    set(design, |d| std::mem::replace(&mut d.sewing, rules), |d, old| d.sewing = old)
}

/// Puts an energy term in the place of the one of its kind, or takes that away.
///
/// # Errors
/// A parameter out of its range; the design is as it was then.
pub fn set_term(design: &mut Design, kind: &'static TermKind, term: Option<Term>) -> Result<(), EditError> {
    set(
        design,
        |d| put_term(d, kind, term),
        |d, old| {
            put_term(d, kind, old);
        },
    )
}

/// Gravity goes where files have always had it, other terms into the list of them. Returns what was there.
fn put_term(design: &mut Design, kind: &TermKind, term: Option<Term>) -> Option<Term> {
    let is_kind = |t: &Term| t.kind().name == kind.name;
    let old = design.all_terms().into_iter().find(is_kind);
    design.terms.retain(|t| !is_kind(t));
    if kind.name == GRAVITY.name {
        design.gravity = term.map(Gravity::from);
    } else {
        design.terms.extend(term);
    }
    let place = |t: &Term| TermKind::names().iter().position(|name| *name == t.kind().name);
    design.terms.sort_by_key(place);
    old
}

/// Replaces the drawing of the outline, or takes it away.
///
/// # Errors
/// What makes the design unsound; the design stays as it was.
pub fn set_drawing(design: &mut Design, drawing: Option<Drawing>) -> Result<(), EditError> {
    set(design, |d| std::mem::replace(&mut d.drawing, drawing), |d, old| d.drawing = old)
}

/// Replaces the factors on the stiffness of the triangles, or takes them away.
///
/// # Errors
/// Another number of factors than triangles, or one out of range; the design stays as it was.
pub fn set_stiffness_map(design: &mut Design, map: Option<Vec<f64>>) -> Result<(), EditError> {
    set(design, |d| std::mem::replace(&mut d.stiffness_map, map), |d, old| d.stiffness_map = old)
}

/// Replaces the tracks of the drawing. An outline that was not drawn is traced, so that there is one.
///
/// # Errors
/// What makes the design unsound; the design stays as it was.
pub fn set_tracks(design: &mut Design, tracks: Vec<Track>) -> Result<(), EditError> {
    if design.tracks() == tracks {
        return Ok(());
    }
    let drawing = design.drawing.clone().unwrap_or_else(|| Drawing::of(&design.outline));
    set_drawing(design, Some(Drawing { tracks, ..drawing }))
}

/// A pose name that is free: `wanted` itself, or with a number behind it.
pub fn unused_pose_name(design: &Design, wanted: &str) -> String {
    unused_name(wanted, |name| design.poses.iter().any(|p| p.name == name))
}

/// Replaces a setting and puts the old one back if the outcome is unsound.
fn set<T>(
    design: &mut Design,
    replace: impl FnOnce(&mut Design) -> T,
    restore: impl FnOnce(&mut Design, T),
) -> Result<(), EditError> {
    let old = replace(design);
    validate::settings(design).map_err(|error| {
        restore(design, old);
        error.into()
    })
}

/// Counts a name's trailing number up until it is free: "wave", "wave 2", "wave 3".
fn unused_name(wanted: &str, taken: impl Fn(&str) -> bool) -> String {
    if !taken(wanted) {
        return wanted.to_string();
    }
    let (stem, number) = match wanted.rsplit_once(' ') {
        Some((stem, number)) => (stem, number.parse::<u32>().ok()),
        None => (wanted, None),
    };
    let (stem, first) = number.map_or((wanted, 2), |n| (stem, u64::from(n) + 1));
    (first..).map(|n| format!("{stem} {n}")).find(|name| !taken(name)).unwrap_or_default()
}

fn free_pose_name(design: &Design, name: &str, except: Option<usize>) -> Result<String, EditError> {
    let name = trimmed("pose", name)?;
    if design.poses.iter().enumerate().any(|(i, p)| Some(i) != except && p.name == name) {
        return Err(EditError::NameTaken { what: "pose", name });
    }
    Ok(name)
}

fn trimmed(what: &'static str, name: &str) -> Result<String, EditError> {
    let name = name.trim();
    if name.is_empty() { Err(EditError::NoName(what)) } else { Ok(name.to_string()) }
}

fn item<'a, T>(items: &'a mut [T], what: &'static str, index: usize) -> Result<&'a mut T, EditError> {
    let len = items.len();
    items.get_mut(index).ok_or(EditError::Missing { what, index, len })
}
