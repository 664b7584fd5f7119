//! The changes that the window makes to the document, as data.

use crate::design::edit::{self, EditError};
use crate::design::{
    ControllerSettings, Design, Easing, FabricationSettings, FiberSettings, Hold, Keyframe, Material, Network, Pin,
    Pose, Target, TendonSettings, Term,
};
use crate::mesh::{Axis, BodyPoint};
use crate::operations::arrange::{self, Handle, Motion};
use crate::operations::network::{self, Part};
use crate::operations::pose::{at_hand, begin, pin_middle, put_pin, put_target, rounded};
use crate::operations::{propose, retime, starch};
use crate::outline::{Drawing, Point};
use crate::physics::TermKind;
use crate::sewing::Rules;
use crate::studio::language::mark;
use crate::studio::session::Brush;

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
    /// Another anchor, mm; none: where its point is at rest.
    MovePin {
        index: usize,
        to: Option<Point>,
    },
    /// Another point of the body.
    SitePin {
        index: usize,
        at: BodyPoint,
    },
    HoldPin {
        index: usize,
        hold: Hold,
    },
    PinMiddle,
    /// Pins and a first pose.
    Begin,
    /// Targets and pins together.
    Arrange {
        pose: Option<usize>,
        handles: Vec<Handle>,
        motion: Motion,
    },
    WeighTargets {
        pose: usize,
        handles: Vec<Handle>,
        weight: f64,
    },
    /// Their mirror images are added.
    Mirror {
        pose: Option<usize>,
        handles: Vec<Handle>,
        axis: Axis,
    },
    MirrorPose {
        pose: usize,
        axis: Axis,
    },
    RemoveHandles {
        pose: Option<usize>,
        handles: Vec<Handle>,
    },
    /// A dab around a place at rest, mm.
    Starch {
        at: Point,
        brush: Brush,
    },
    ClearStarch,
    AcceptNetwork(Network),
    /// A change of winches and tendons.
    Network(network::Edit),
    SetKeyframe(Keyframe),
    /// What it winds stays, whatever becomes of its pose.
    DetachKeyframe(usize),
    RemoveKeyframe(usize),
    /// Keyframes together, by their numbers.
    MoveKeyframes {
        keys: Vec<usize>,
        by_s: f64,
    },
    StretchKeyframes {
        keys: Vec<usize>,
        factor: f64,
    },
    EaseKeyframes {
        keys: Vec<usize>,
        easing: Easing,
    },
    /// Copies, the first at a time.
    PasteKeyframes {
        copies: Vec<Keyframe>,
        time_s: f64,
    },
    RemoveKeyframes(Vec<usize>),
    /// Numbers and new times, s.
    RetimeKeyframes(Vec<(usize, f64)>),
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Made {
    Nothing,
    Pose(usize),
    Target {
        pose: usize,
        index: usize,
    },
    Keyframe(usize),
    /// By their numbers.
    Keyframes(Vec<usize>),
    Pin(usize),
    Part(Part),
}

impl Change {
    /// Its name in the undo history.
    pub fn label(&self) -> &'static str {
        match self {
            Self::AddPose => mark("Add pose"),
            Self::DuplicatePose(_) => mark("Duplicate pose"),
            Self::RenamePose(..) => mark("Rename pose"),
            Self::RemovePose(_) => mark("Delete pose"),
            Self::AddTarget { .. } => mark("Add target"),
            Self::MoveTarget { .. } => mark("Move target"),
            Self::WeighTarget { .. } => mark("Target weight"),
            Self::RemoveTarget { .. } => mark("Remove target"),
            Self::ClearTargets(_) => mark("Remove all targets"),
            Self::AddPin(_) => mark("Add pin"),
            Self::RemovePin(_) => mark("Remove pin"),
            Self::MovePin { .. } => mark("Move pin"),
            Self::SitePin { .. } => mark("Move pin on the body"),
            Self::HoldPin { .. } => mark("Kind of pin"),
            Self::PinMiddle => mark("Pin the middle"),
            Self::Begin => mark("Pins and a first pose"),
            Self::Arrange { .. } => mark("Arrange"),
            Self::WeighTargets { .. } => mark("Weights of targets"),
            Self::Mirror { .. } => mark("Mirror"),
            Self::MirrorPose { .. } => mark("Mirrored pose"),
            Self::RemoveHandles { .. } => mark("Delete selected"),
            Self::Starch { .. } => mark("Starch"),
            Self::ClearStarch => mark("Take starch away"),
            Self::AcceptNetwork(_) => mark("Accept network"),
            Self::Network(edit) => edit.label(),
            Self::SetKeyframe(_) => mark("Set keyframe"),
            Self::DetachKeyframe(_) => mark("Detach keyframe"),
            Self::RemoveKeyframe(_) => mark("Delete keyframe"),
            Self::MoveKeyframes { keys, .. } if keys.len() == 1 => mark("Move keyframe"),
            Self::MoveKeyframes { .. } => mark("Move keyframes"),
            Self::StretchKeyframes { .. } => mark("Stretch keyframes"),
            Self::EaseKeyframes { keys, .. } if keys.len() == 1 => mark("Keyframe easing"),
            Self::EaseKeyframes { .. } => mark("Easing of keyframes"),
            Self::PasteKeyframes { .. } => mark("Paste keyframes"),
            Self::RemoveKeyframes(_) => mark("Delete keyframes"),
            Self::RetimeKeyframes(_) => mark("Make it fit"),
            Self::Rename(_) => mark("Rename plushie"),
            Self::Material(_) => mark("Body settings"),
            Self::Term(kind, _) => kind.label,
            Self::Fibers(_) => mark("Fibre settings"),
            Self::Tendons(_) => mark("Tendon settings"),
            Self::Fabrication(_) => mark("Fabrication settings"),
            Self::Controller(_) => mark("Controller settings"),
            Self::Sewing(_) => mark("Sewing settings"),
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
            Self::AddPin(at) => nothing(put_pin(design, at_hand(&design.mesh, &at), Hold::Point)?),
            Self::RemovePin(index) => nothing(edit::remove_pin(design, index)?),
            Self::MovePin { .. }
            | Self::SitePin { .. }
            | Self::HoldPin { .. }
            | Self::PinMiddle
            | Self::Begin
            | Self::Arrange { .. }
            | Self::WeighTargets { .. }
            | Self::Mirror { .. }
            | Self::MirrorPose { .. }
            | Self::RemoveHandles { .. }
            | Self::Starch { .. }
            | Self::ClearStarch => return self.pose(design),
            Self::AcceptNetwork(network) => Made::Part(Part::Winch(propose::accept(design, network)?)),
            Self::Network(edit) => network::apply(design, &edit)?.map_or(Made::Nothing, Made::Part),
            Self::SetKeyframe(keyframe) => Made::Keyframe(edit::set_keyframe(design, keyframe)?),
            Self::DetachKeyframe(index) => match design.keyframes.get(index).cloned() {
                Some(keyframe) => Made::Keyframe(edit::set_keyframe(design, Keyframe { pose: None, ..keyframe })?),
                None => Made::Nothing,
            },
            Self::RemoveKeyframe(index) => nothing(edit::remove_keyframe(design, index)?),
            Self::MoveKeyframes { keys, by_s } => Made::Keyframes(retime::shift(design, &keys, by_s)?),
            Self::StretchKeyframes { keys, factor } => Made::Keyframes(stretched(design, &keys, factor)?),
            Self::EaseKeyframes { keys, easing } => nothing(retime::ease(design, &keys, easing)?),
            Self::PasteKeyframes { copies, time_s } => Made::Keyframes(retime::paste(design, &copies, time_s)?),
            Self::RemoveKeyframes(keys) => nothing(edit::remove_keyframes(design, &keys)?),
            Self::RetimeKeyframes(times) => nothing(edit::retime_keyframes(design, &times)?),
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

impl Change {
    /// Pins, several at once, starch.
    fn pose(self, design: &mut Design) -> Result<Made, EditError> {
        Ok(match self {
            Self::MovePin { index, to } => nothing(with_pin(design, index, |pin| pin.position = to.map(rounded))?),
            Self::SitePin { index, at } => {
                let at = at_hand(&design.mesh, &at);
                nothing(with_pin(design, index, |pin| (pin.at, pin.position) = (at, None))?)
            }
            Self::HoldPin { index, hold } => nothing(with_pin(design, index, |pin| pin.hold = hold)?),
            Self::PinMiddle => Made::Pin(pin_middle(design)?),
            Self::Begin => Made::Pose(begin(design)?),
            Self::Arrange { pose, handles, motion } => nothing(arrange::shift(design, pose, &handles, &motion)?),
            Self::WeighTargets { pose, handles, weight } => nothing(arrange::weigh(design, pose, &handles, weight)?),
            Self::Mirror { pose, handles, axis } => nothing(arrange::mirror(design, pose, &handles, axis)?),
            Self::MirrorPose { pose, axis } => Made::Pose(arrange::mirrored_pose(design, pose, axis)?),
            Self::RemoveHandles { pose, handles } => nothing(arrange::remove(design, pose, handles)?),
            Self::Starch { at, brush } => nothing(starch::dab(design, at, brush.radius_mm, brush.factor)?),
            Self::ClearStarch => nothing(starch::clear(design)?),
            _ => Made::Nothing,
        })
    }
}

fn with_pin(design: &mut Design, index: usize, change: impl FnOnce(&mut Pin)) -> Result<(), EditError> {
    let Some(mut pin) = design.pins.get(index).copied() else { return Ok(()) };
    change(&mut pin);
    edit::set_pin(design, index, pin)
}

/// A factor that is none leaves everything where it is.
fn stretched(design: &mut Design, keys: &[usize], factor: f64) -> Result<Vec<usize>, EditError> {
    match retime::stretch(design, keys, factor) {
        Ok(keys) => Ok(keys),
        Err(retime::Error::Edit(error)) => Err(error),
        Err(_) => Ok(keys.to_vec()),
    }
}

fn add_pose(design: &mut Design) -> Result<usize, EditError> {
    let name = edit::unused_pose_name(design, &format!("Pose {}", design.poses.len() + 1));
    edit::add_pose(design, Pose { name, targets: Vec::new() })
}

fn nothing<T>(_: T) -> Made {
    Made::Nothing
}
