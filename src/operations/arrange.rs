//! Several targets of a pose and pins of a body at once: moved, turned, scaled, weighed, mirrored, taken away.

use super::pose::{is_same, place_pin, put_target, rounded};
use super::{Cancelled, Context, NoSuchPose};
use crate::design::edit::{self, EditError};
use crate::design::{Design, Hold, Pin, Pose, Target};
use crate::mesh::{Axis, Mesh, axis};
use crate::outline::Point;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A target of a pose, or a pin, by its number from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Handle {
    Target(usize),
    Pin(usize),
}

/// A motion of the plane: `p -> about + scale R(turn) (p - about) + by`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Motion {
    /// mm.
    pub by: Point,
    /// Counter-clockwise.
    pub turn_degrees: f64,
    pub scale: f64,
    /// The place that turning and scaling leave where it is, mm; the middle of what is arranged if absent.
    pub about: Option<Point>,
}

/// What is arranged, and how.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Name of the pose whose targets are meant.
    pub pose: Option<String>,
    /// None: all targets of the pose.
    pub handles: Vec<Handle>,
    pub motion: Motion,
    /// A weight for the targets.
    pub weight: Option<f64>,
    /// Their mirror images about the axis of the body are added.
    pub mirror: bool,
    /// They are taken away.
    pub remove: bool,
}

/// Why nothing was arranged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error(transparent)]
    NoSuchPose(#[from] NoSuchPose),
    #[error("targets belong to a pose: name one")]
    NoPose,
    #[error("there is nothing to arrange: the pose has no targets and no pin is named")]
    Nothing,
    #[error("the outline is not its own mirror image about any axis")]
    NoAxis,
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Default for Motion {
    fn default() -> Self {
        Self { by: [0.0; 2], turn_degrees: 0.0, scale: 1.0, about: None }
    }
}

impl Motion {
    /// The place of a point after it.
    pub fn of(&self, about: Point, p: Point) -> Point {
        let (sin, cos) = self.turn_degrees.to_radians().sin_cos();
        let [dx, dy] = [p[0] - about[0], p[1] - about[1]].map(|v| self.scale * v);
        [about[0] + cos * dx - sin * dy + self.by[0], about[1] + sin * dx + cos * dy + self.by[1]]
    }
}

/// Arranges targets and pins; how many there were.
///
/// # Errors
/// There is no such pose, target or pin, or what comes of it is out of range; the design is as it was then.
pub fn run(design: &mut Design, options: &Options, context: &Context) -> Result<usize, Error> {
    context.check()?;
    let named = |name: &String| design.poses.iter().position(|p| p.name == *name);
    let pose = match &options.pose {
        None => None,
        Some(name) => Some(named(name).ok_or_else(|| NoSuchPose::of(design, name))?),
    };
    // What is named twice is moved once.
    let mut handles = options.handles.clone();
    let mut seen = BTreeSet::new();
    handles.retain(|handle| seen.insert(*handle));
    if handles.is_empty() {
        let count = pose.map_or(0, |pose| design.poses[pose].targets.len());
        handles.extend((0..count).map(Handle::Target));
    }
    if handles.is_empty() {
        return Err(Error::Nothing);
    }
    if pose.is_none() && handles.iter().any(|handle| matches!(handle, Handle::Target(_))) {
        return Err(Error::NoPose);
    }
    let count = handles.len();
    let found = options.mirror.then(|| axis(&design.outline).ok_or(Error::NoAxis)).transpose()?;
    let mut changed = design.clone();
    shift(&mut changed, pose, &handles, &options.motion)?;
    if let (Some(weight), Some(pose)) = (options.weight, pose) {
        weigh(&mut changed, pose, &handles, weight)?;
    }
    if let Some((axis, _)) = found {
        mirror(&mut changed, pose, &handles, axis)?;
    }
    if options.remove {
        remove(&mut changed, pose, handles)?;
    }
    *design = changed;
    Ok(count)
}

/// Moves, turns and scales the goals of targets and the anchors of pins; lines and regions of pins turn with them.
///
/// # Errors
/// There is no such target or pin, or a place is out of range.
pub fn shift(design: &mut Design, pose: Option<usize>, handles: &[Handle], motion: &Motion) -> Result<(), EditError> {
    if *motion == Motion::default() {
        return Ok(());
    }
    let about = motion.about.unwrap_or_else(|| middle(design, pose, handles));
    for &handle in handles {
        match (handle, pose) {
            (Handle::Target(index), Some(pose)) => {
                let to = target(design, pose, index)?.to;
                edit::move_target(design, pose, index, rounded(motion.of(about, to)))?;
            }
            (Handle::Target(index), None) => return Err(missing("target", index, 0)),
            (Handle::Pin(index), _) => {
                let pin = pin(design, index)?;
                let position = Some(rounded(motion.of(about, pin.anchor(&design.mesh))));
                edit::set_pin(design, index, Pin { position, hold: turned(pin.hold, motion.turn_degrees), ..pin })?;
            }
        }
    }
    Ok(())
}

/// Gives targets a weight.
///
/// # Errors
/// There is no such target, or the weight is out of range.
pub fn weigh(design: &mut Design, pose: usize, handles: &[Handle], weight: f64) -> Result<(), EditError> {
    for &handle in handles {
        if let Handle::Target(index) = handle {
            let target = target(design, pose, index)?;
            edit::set_target(design, pose, index, Target { weight, ..target })?;
        }
    }
    Ok(())
}

/// Adds the mirror images of targets and pins about an axis, in the place of what is on those points of the body.
///
/// # Errors
/// There is no such target or pin, or a place is out of range.
pub fn mirror(design: &mut Design, pose: Option<usize>, handles: &[Handle], axis: Axis) -> Result<(), EditError> {
    for &handle in handles {
        match (handle, pose) {
            (Handle::Target(index), Some(pose)) => {
                let old = target(design, pose, index)?;
                let image = mirrored(&design.mesh, axis, &old)?;
                // A point on the axis is its own image: what it is asked for stays.
                if !is_same(&design.mesh, &old.at, &image.at) {
                    put_target(design, pose, image)?;
                }
            }
            (Handle::Target(index), None) => return Err(missing("target", index, 0)),
            (Handle::Pin(index), _) => {
                let old = pin(design, index)?;
                let place = axis.mirror(design.mesh.position(&old.at, &design.mesh.nodes));
                let at = super::pose::body_point(&design.mesh, rounded(place))?;
                let doubled = 2.0 * axis.along[1].atan2(axis.along[0]).to_degrees();
                let hold = match old.hold {
                    Hold::Point => Hold::Point,
                    Hold::Line { degrees } => Hold::Line { degrees: half_turn(doubled - degrees) },
                    Hold::Region { radius_mm, degrees } => Hold::Region { radius_mm, degrees: -degrees },
                };
                place_pin(design, Pin { at, position: old.position.map(|p| rounded(axis.mirror(p))), hold, ..old })?;
            }
        }
    }
    Ok(())
}

/// Adds the mirror image of a whole pose behind it; its number.
///
/// # Errors
/// There is no such pose, or a place is out of range.
pub fn mirrored_pose(design: &mut Design, pose: usize, axis: Axis) -> Result<usize, EditError> {
    let len = design.poses.len();
    let old = design.poses.get(pose).cloned().ok_or_else(|| missing("pose", pose, len))?;
    let targets = old.targets.iter().map(|target| mirrored(&design.mesh, axis, target)).collect::<Result<_, _>>()?;
    let name = edit::unused_pose_name(design, &format!("{} mirrored", old.name));
    edit::add_pose(design, Pose { name, targets })
}

/// Takes targets and pins away.
///
/// # Errors
/// There is no such target or pin.
pub fn remove(design: &mut Design, pose: Option<usize>, mut handles: Vec<Handle>) -> Result<(), EditError> {
    handles.sort_unstable();
    handles.dedup();
    // The last first, so that the numbers of the others hold.
    for handle in handles.into_iter().rev() {
        match (handle, pose) {
            (Handle::Target(index), Some(pose)) => drop(edit::remove_target(design, pose, index)?),
            (Handle::Target(index), None) => return Err(missing("target", index, 0)),
            (Handle::Pin(index), _) => drop(edit::remove_pin(design, index)?),
        }
    }
    Ok(())
}

/// The middle of the box around goals and anchors, mm.
pub fn middle(design: &Design, pose: Option<usize>, handles: &[Handle]) -> Point {
    let places = places(design, pose, handles);
    let ends = |axis: usize| {
        let values = || places.iter().map(|p| p[axis]);
        0.5 * (values().fold(f64::INFINITY, f64::min) + values().fold(f64::NEG_INFINITY, f64::max))
    };
    if places.is_empty() { [0.0; 2] } else { [ends(0), ends(1)] }
}

/// Goals of targets and anchors of pins, mm, of those that are there.
pub fn places(design: &Design, pose: Option<usize>, handles: &[Handle]) -> Vec<Point> {
    let targets = pose.and_then(|pose| design.poses.get(pose)).map_or(&[][..], |pose| &pose.targets);
    let place = |handle: &Handle| match *handle {
        Handle::Target(index) => targets.get(index).map(|target| target.to),
        Handle::Pin(index) => design.pins.get(index).map(|pin| pin.anchor(&design.mesh)),
    };
    handles.iter().filter_map(place).collect()
}

/// The mirror image of a target: of its point on the body at rest, and of its goal.
fn mirrored(mesh: &Mesh, axis: Axis, target: &Target) -> Result<Target, EditError> {
    let place = rounded(axis.mirror(mesh.position(&target.at, &mesh.nodes)));
    Ok(Target { at: super::pose::body_point(mesh, place)?, to: rounded(axis.mirror(target.to)), ..*target })
}

fn turned(hold: Hold, by: f64) -> Hold {
    match hold {
        Hold::Point => Hold::Point,
        Hold::Line { degrees } => Hold::Line { degrees: half_turn(degrees + by) },
        Hold::Region { radius_mm, degrees } => Hold::Region { radius_mm, degrees: whole_turn(degrees + by) },
    }
}

/// A line is the same after half a turn.
fn half_turn(degrees: f64) -> f64 {
    degrees.rem_euclid(180.0)
}

/// From -180 to 180 degrees.
fn whole_turn(degrees: f64) -> f64 {
    (degrees + 180.0).rem_euclid(360.0) - 180.0
}

fn target(design: &Design, pose: usize, index: usize) -> Result<Target, EditError> {
    let targets = design.poses.get(pose).map_or(&[][..], |pose| &pose.targets);
    targets.get(index).copied().ok_or_else(|| missing("target", index, targets.len()))
}

fn pin(design: &Design, index: usize) -> Result<Pin, EditError> {
    design.pins.get(index).copied().ok_or_else(|| missing("pin", index, design.pins.len()))
}

fn missing(what: &'static str, index: usize, len: usize) -> EditError {
    EditError::Missing { what, index, len }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    fn arranged(design: &mut Design, options: Options) -> Result<usize, Error> {
        run(design, &options, &Context::new(&AtomicBool::new(false)))
    }

    #[test]
    fn targets_and_pins_move_turn_and_scale_together() {
        let mut design = testing::sample();
        design.pins[0].hold = Hold::Line { degrees: 30.0 };
        let motion = Motion { by: [1.0, 2.0], turn_degrees: 90.0, scale: 2.0, about: Some([20.0, 60.0]) };
        let handles = vec![Handle::Target(0), Handle::Pin(0)];
        let options = Options { pose: Some("lean".into()), handles, motion, weight: Some(3.0), ..Options::default() };
        assert_eq!(arranged(&mut design, options), Ok(2));
        // The goal is 10 above the centre: 20 to its left. The pin is 20 to the left and 60 below: 40 below and 120 to the right.
        assert_eq!(design.poses[0].targets[0].to, [1.0, 62.0]);
        assert_eq!(design.poses[0].targets[0].weight, 3.0);
        assert_eq!(design.pins[0].position, Some([141.0, 22.0]));
        assert_eq!(design.pins[0].hold, Hold::Line { degrees: 120.0 });
    }

    #[test]
    fn a_mirror_image_of_a_mirror_image_is_what_was_there() {
        let mut design = testing::sample();
        // Beside the axis: a point on it is its own image.
        design.poses[0].targets[0].at.weights = [0.5, 0.25, 0.25];
        let pose = Some("lean".to_owned());
        let mirror = Options { pose: pose.clone(), mirror: true, ..Options::default() };
        arranged(&mut design, mirror.clone()).unwrap();
        let targets = design.poses[0].targets.clone();
        assert_eq!((targets.len(), targets[1].to), (2, [40.0, 70.0]));
        arranged(&mut design, mirror).unwrap();
        assert_eq!(design.poses[0].targets.len(), 2);
        let axis = axis(&design.outline).unwrap().0;
        assert_eq!(mirrored_pose(&mut design, 0, axis), Ok(2));
        assert_eq!(design.poses[2].name, "lean mirrored");
        let both = Options { pose, remove: true, ..Options::default() };
        assert_eq!(arranged(&mut design, both), Ok(2));
        assert!(design.poses[0].targets.is_empty());
    }

    #[test]
    fn what_is_named_twice_is_moved_once() {
        let pin = |handles: &[Handle]| {
            let mut design = testing::sample();
            let options = Options {
                handles: handles.to_vec(),
                motion: Motion { by: [2.0, 0.0], ..Motion::default() },
                ..Options::default()
            };
            let count = run(&mut design, &options, &Context::new(&AtomicBool::new(false))).unwrap();
            (count, design.pins[0])
        };
        assert_eq!(pin(&[Handle::Pin(0), Handle::Pin(0)]), pin(&[Handle::Pin(0)]));
    }

    #[test]
    fn what_is_not_there_is_refused_and_nothing_changes() {
        let mut design = testing::sample();
        let before = design.clone();
        let of = |pose: &str, handles: Vec<Handle>| Options {
            pose: Some(pose.into()),
            handles,
            motion: Motion { by: [1.0, 0.0], ..Motion::default() },
            ..Options::default()
        };
        assert!(matches!(arranged(&mut design, of("none", Vec::new())), Err(Error::NoSuchPose(_))));
        assert_eq!(arranged(&mut design, of("rest", Vec::new())), Err(Error::Nothing));
        let wrong = vec![Handle::Target(0), Handle::Pin(9)];
        assert!(matches!(arranged(&mut design, of("lean", wrong)), Err(Error::Edit(EditError::Missing { .. }))));
        let nobody = Options { handles: vec![Handle::Target(0)], ..Options::default() };
        assert_eq!(arranged(&mut design, nobody), Err(Error::NoPose));
        assert_eq!(design, before);
    }
}
