//! The changes that the window makes to the document, as data.

use crate::design::edit::{self, EditError};
use crate::design::{
    ControllerSettings, Design, Easing, FabricationSettings, FiberSettings, Keyframe, Material, Network, Pose, Target,
    TendonSettings, Term,
};
use crate::mesh::BodyPoint;
use crate::operations::network::{self, Part};
use crate::operations::pose::{at_hand, put_pin, put_target, rounded};
use crate::outline::{Drawing, Point};
use crate::physics::TermKind;
use crate::sewing::Rules;

#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    AddPose,
    DuplicatePose(usize),
    RenamePose(usize, String),
    RemovePose(usize),
    /// A target of a pose; without one, of a new pose.
    AddTarget {
        pose: Option<usize>,
        target: Target,
    },
    MoveTarget {
        pose: usize,
        index: usize,
        to: Point,
    },
    WeighTarget {
        pose: usize,
        index: usize,
        weight: f64,
    },
    RemoveTarget {
        pose: usize,
        index: usize,
    },
    ClearTargets(usize),
    AddPin(BodyPoint),
    RemovePin(usize),
    AcceptNetwork(Network),
    /// A change of winches and tendons.
    Network(network::Edit),
    SetKeyframe(Keyframe),
    MoveKeyframe {
        index: usize,
        time_s: f64,
    },
    EaseKeyframe(usize, Easing),
    /// What it winds stays, whatever becomes of its pose.
    FixKeyframe(usize),
    RemoveKeyframe(usize),
    Rename(String),
    Material(Material),
    /// An energy term in the place of the one of its kind, or none.
    Term(&'static TermKind, Option<Term>),
    Fibers(FiberSettings),
    Tendons(TendonSettings),
    Fabrication(FabricationSettings),
    Controller(ControllerSettings),
    Sewing(Rules),
    /// Another drawing of the outline, and what was done to it.
    Draw {
        what: &'static str,
        drawing: Drawing,
    },
}

/// The part that a change made and that should be picked out now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    Nothing,
    Pose(usize),
    Target { pose: usize, index: usize },
    Keyframe(usize),
    Part(Part),
}

impl Change {
    /// Its name in the undo history.
    pub fn label(&self) -> &'static str {
        match self {
            Self::AddPose => "Add pose",
            Self::DuplicatePose(_) => "Duplicate pose",
            Self::RenamePose(..) => "Rename pose",
            Self::RemovePose(_) => "Delete pose",
            Self::AddTarget { .. } => "Add target",
            Self::MoveTarget { .. } => "Move target",
            Self::WeighTarget { .. } => "Target weight",
            Self::RemoveTarget { .. } => "Remove target",
            Self::ClearTargets(_) => "Remove all targets",
            Self::AddPin(_) => "Add pin",
            Self::RemovePin(_) => "Remove pin",
            Self::AcceptNetwork(_) => "Accept network",
            Self::Network(edit) => edit.label(),
            Self::SetKeyframe(_) => "Set keyframe",
            Self::MoveKeyframe { .. } => "Move keyframe",
            Self::EaseKeyframe(..) => "Keyframe easing",
            Self::FixKeyframe(_) => "Fix keyframe",
            Self::RemoveKeyframe(_) => "Delete keyframe",
            Self::Rename(_) => "Rename plushie",
            Self::Material(_) => "Body settings",
            Self::Term(kind, _) => kind.label,
            Self::Fibers(_) => "Fibre settings",
            Self::Tendons(_) => "Tendon settings",
            Self::Fabrication(_) => "Fabrication settings",
            Self::Controller(_) => "Controller settings",
            Self::Sewing(_) => "Sewing settings",
            Self::Draw { what, .. } => what,
        }
    }

    /// Makes the change.
    ///
    /// # Errors
    /// What the document refuses; it is unchanged then.
    pub fn apply(self, design: &mut Design) -> Result<Made, EditError> {
        Ok(match self {
            Self::AddPose => Made::Pose(add_pose(design)?),
            Self::DuplicatePose(index) => Made::Pose(edit::duplicate_pose(design, index)?),
            Self::RenamePose(index, name) => nothing(edit::rename_pose(design, index, &name)?),
            Self::RemovePose(index) => nothing(edit::remove_pose(design, index)?),
            Self::AddTarget { pose, target } => {
                let pose = match pose {
                    Some(pose) => pose,
                    None => add_pose(design)?,
                };
                let target = Target { at: at_hand(&design.mesh, &target.at), to: rounded(target.to), ..target };
                Made::Target { pose, index: put_target(design, pose, target)? }
            }
            Self::MoveTarget { pose, index, to } => nothing(edit::move_target(design, pose, index, rounded(to))?),
            Self::WeighTarget { pose, index, weight } => {
                if let Some(target) = design.poses.get(pose).and_then(|p| p.targets.get(index)).copied() {
                    edit::set_target(design, pose, index, Target { weight, ..target })?;
                }
                Made::Nothing
            }
            Self::RemoveTarget { pose, index } => nothing(edit::remove_target(design, pose, index)?),
            Self::ClearTargets(pose) => {
                while design.poses.get(pose).is_some_and(|p| !p.targets.is_empty()) {
                    edit::remove_target(design, pose, 0)?;
                }
                Made::Nothing
            }
            Self::AddPin(at) => nothing(put_pin(design, at_hand(&design.mesh, &at))?),
            Self::RemovePin(index) => nothing(edit::remove_pin(design, index)?),
            Self::AcceptNetwork(network) => Made::Part(Part::Winch(edit::accept_network(design, network)?)),
            Self::Network(edit) => network::apply(design, &edit)?.map_or(Made::Nothing, Made::Part),
            Self::SetKeyframe(keyframe) => Made::Keyframe(edit::set_keyframe(design, keyframe)?),
            Self::MoveKeyframe { index, time_s } => Made::Keyframe(edit::move_keyframe(design, index, time_s)?),
            Self::EaseKeyframe(index, easing) => match design.keyframes.get(index).cloned() {
                Some(keyframe) => Made::Keyframe(edit::set_keyframe(design, Keyframe { easing, ..keyframe })?),
                None => Made::Nothing,
            },
            Self::FixKeyframe(index) => match design.keyframes.get(index).cloned() {
                Some(keyframe) => Made::Keyframe(edit::set_keyframe(design, Keyframe { pose: None, ..keyframe })?),
                None => Made::Nothing,
            },
            Self::RemoveKeyframe(index) => nothing(edit::remove_keyframe(design, index)?),
            Self::Rename(name) => nothing(edit::rename(design, &name)?),
            Self::Material(material) => nothing(edit::set_material(design, material)?),
            Self::Term(kind, term) => nothing(edit::set_term(design, kind, term)?),
            Self::Fibers(fibers) => nothing(edit::set_fibers(design, fibers)?),
            Self::Tendons(tendons) => nothing(edit::set_tendons(design, tendons)?),
            Self::Fabrication(fabrication) => nothing(edit::set_fabrication(design, fabrication)?),
            Self::Controller(controller) => nothing(edit::set_controller(design, controller)?),
            Self::Sewing(rules) => nothing(edit::set_sewing(design, rules)?),
            Self::Draw { drawing, .. } => nothing(edit::set_drawing(design, Some(drawing))?),
        })
    }
}

fn add_pose(design: &mut Design) -> Result<usize, EditError> {
    let name = edit::unused_pose_name(design, &format!("Pose {}", design.poses.len() + 1));
    edit::add_pose(design, Pose { name, targets: Vec::new() })
}

fn nothing<T>(_: T) -> Made {
    Made::Nothing
}
