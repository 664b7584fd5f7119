//! Commands that change the document: history, poses, targets and pins, the mesh.

use super::command::{Command, Group, Keys, Place, Scope};
use crate::mesh::BodyPoint;
use crate::studio::acts;
use crate::studio::canvas::Hit;
use crate::studio::change::Change;
use crate::studio::icons::Icon;
use crate::studio::language::{mark, t, tf};
use crate::studio::session::{Selection, Session};
use eframe::egui::Key;

pub static ALL: [&Command; 14] = [
    &UNDO,
    &REDO,
    &DELETE,
    &ESCAPE,
    &ADD_POSE,
    &DUPLICATE_POSE,
    &RENAME_POSE,
    &DELETE_POSE,
    &REMOVE_TARGET,
    &PIN_POINT,
    &UNPIN,
    &CLEAR_TARGETS,
    &REMESH,
    &CANCEL_MESHING,
];

const NO_POSE: &str = mark("Choose a pose first");

pub static UNDO: Command = Command {
    icon: Some(Icon::Undo),
    keys: &[Keys::ctrl(Key::Z)],
    places: &[Place::Toolbar(Group::History)],
    detail: &|session| session.history().undo_label().map(|label| tf!("Undo “{label}”", label = t(label))),
    why_not: &|session, _| session.history().undo_label().is_none().then_some(t("Nothing to undo")),
    run: &|session, _| acts::edit::undo(session),
    ..Command::new("edit.undo", "Undo", "Take back the last change")
};

pub static REDO: Command = Command {
    icon: Some(Icon::Redo),
    keys: &[Keys::ctrl_shift(Key::Z), Keys::ctrl(Key::Y)],
    places: &[Place::Toolbar(Group::History)],
    detail: &|session| session.history().redo_label().map(|label| tf!("Redo “{label}”", label = t(label))),
    why_not: &|session, _| session.history().redo_label().is_none().then_some(t("Nothing to redo")),
    run: &|session, _| acts::edit::redo(session),
    ..Command::new("edit.redo", "Redo", "Do again what was undone")
};

pub static DELETE: Command = Command {
    icon: Some(Icon::Trash),
    keys: &[Keys::plain(Key::Delete)],
    scope: Scope::Views,
    why_not: &|session, _| {
        let several = !session.group().handles().is_empty() || !session.timing().keys.is_empty();
        (session.selection() == Selection::Nothing && !several)
            .then_some(t("Select a target, pin, keyframe, network, tendon or hole first"))
    },
    run: &|session, _| acts::edit::delete_selected(session),
    ..Command::new(
        "edit.delete",
        "Delete selected",
        "Delete the target, pin, keyframe, network, tendon or hole that is selected",
    )
};

pub static ESCAPE: Command = Command {
    keys: &[Keys::plain(Key::Escape)],
    run: &|session, _| acts::escape::escape(session),
    ..Command::new(
        "edit.cancel",
        "Let go",
        "End a drag, a search or the animation as if it had not been; otherwise clear the selection",
    )
};

pub static ADD_POSE: Command = Command {
    icon: Some(Icon::Plus),
    keys: &[Keys::ctrl_shift(Key::N)],
    run: &|session, _| acts::edit::change(session, Change::AddPose),
    ..Command::new("pose.add", "Add pose", "Add a pose")
};

pub static DUPLICATE_POSE: Command = Command {
    icon: Some(Icon::Copy),
    keys: &[Keys::ctrl(Key::D)],
    why_not: &|session, _| session.pose().is_none().then_some(t(NO_POSE)),
    run: &|session, _| with_pose(session, Change::DuplicatePose),
    ..Command::new("pose.duplicate", "Duplicate pose", "Duplicate this pose")
};

pub static RENAME_POSE: Command = Command {
    icon: Some(Icon::Pen),
    keys: &[Keys::plain(Key::F2)],
    scope: Scope::Views,
    why_not: &|session, _| session.pose().is_none().then_some(t(NO_POSE)),
    run: &|session, _| acts::edit::rename_pose(session),
    ..Command::new("pose.rename", "Rename pose", "Rename this pose")
};

pub static DELETE_POSE: Command = Command {
    icon: Some(Icon::Trash),
    why_not: &|session, _| session.pose().is_none().then_some(t(NO_POSE)),
    run: &|session, _| with_pose(session, Change::RemovePose),
    ..Command::new("pose.delete", "Delete pose", "Delete this pose")
};

pub static REMOVE_TARGET: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|_, at| (!matches!(at, Hit::Target(_))).then_some(t("Select a target first")),
    run: &|session, at| {
        if let (Hit::Target(index), Some(pose)) = (at, session.pose()) {
            acts::edit::change(session, Change::RemoveTarget { pose, index });
        }
    },
    ..Command::new("target.remove", "Remove target", "Remove the target that is selected or pointed at")
};

pub static PIN_POINT: Command = Command {
    icon: Some(Icon::Pin),
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, at| point(session, at).is_none().then_some(t("Select a target first, or point at the body")),
    run: &|session, at| {
        if let Some(at) = point(session, at) {
            acts::edit::change(session, Change::AddPin(at));
        }
    },
    ..Command::new("pin.add", "Pin this point", "Pin the body where the target or the pointer is")
};

pub static UNPIN: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|_, at| (!matches!(at, Hit::Pin(_))).then_some(t("Select a pin first")),
    run: &|session, at| {
        if let Hit::Pin(index) = at {
            acts::edit::change(session, Change::RemovePin(index));
        }
    },
    ..Command::new("pin.remove", "Unpin", "Remove the pin that is selected or pointed at")
};

pub static CLEAR_TARGETS: Command = Command {
    icon: Some(Icon::Trash),
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, _| session.targets().is_empty().then_some(t("There are no targets")),
    run: &|session, _| with_pose(session, Change::ClearTargets),
    ..Command::new("target.clear", "Remove all targets", "Remove all targets of this pose")
};

pub static REMESH: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| session.meshing().running.is_some().then_some(t("A mesh is being made")),
    run: &|session, _| acts::mesh::start_remesh(session),
    ..Command::new("mesh.remesh", "Remesh", "Make a new mesh of the outline; pins, poses, networks and keyframes stay")
};

pub static CANCEL_MESHING: Command = Command {
    why_not: &|session, _| session.meshing().running.is_none().then_some(t("No mesh is being made")),
    run: &|session, _| session.meshing.cancel(),
    ..Command::new("mesh.cancel", "Cancel meshing", "Keep the body as it is")
};

fn with_pose(session: &mut Session, change: fn(usize) -> Change) {
    if let Some(pose) = session.pose() {
        acts::edit::change(session, change(pose));
    }
}

/// The point of the body at a target, or under the pointer.
fn point(session: &Session, at: Hit) -> Option<BodyPoint> {
    match at {
        Hit::Target(index) => session.targets().get(index).map(|target| target.at),
        Hit::Body(at) => Some(at),
        Hit::Pin(_) | Hit::Part(_) | Hit::Nothing => None,
    }
}
