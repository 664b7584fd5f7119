//! Changes of the document, and what follows of them.

use crate::design::edit::EditError;
use crate::design::history::History;
use crate::operations::arrange::Handle;
use crate::operations::network::{self, Part};
use crate::outline::Point;
use crate::studio::change::{Change, Made};
use crate::studio::language::t;
use crate::studio::session::{Mode, Renamed, Selection, Session};

/// One step of undo.
pub fn change(session: &mut Session, change: Change) {
    let label = change.label();
    match session.document.history.edit(label, |design| change.apply(design)) {
        Ok(made) => pick_out(session, made),
        Err(error) => session.messages.error(format!("{}: {error}", t(label))),
    }
}

/// Part of a gesture, which is one step of undo.
pub fn live(session: &mut Session, change: Change) {
    let label = change.label();
    let of_networks = matches!(change, Change::Network(_));
    if session.document.history.undo_label() != Some(label) || !session.document.history.in_gesture() {
        session.document.history.begin(label);
    }
    match session.document.history.preview(|design| change.apply(design)) {
        Ok(made) => pick_out(session, made),
        // On the way through a refused value: the last good one stays, and the control shows it.
        Err(EditError::TimeTaken(_)) => {}
        // A hole on top of the one before it.
        Err(EditError::Invalid(_)) if of_networks => {}
        Err(error) => session.messages.error(format!("{}: {error}", t(label))),
    }
}

/// Part of a gesture that is worked out anew from its beginning every time.
pub fn again(session: &mut Session, change: Change) {
    let label = change.label();
    if session.document.history.undo_label() != Some(label) || !session.document.history.in_gesture() {
        session.document.history.begin(label);
    }
    match session.document.history.preview_anew(|design| change.apply(design)) {
        Ok(made) => pick_out(session, made),
        // On the way over another keyframe: the last place stays.
        Err(EditError::TimeTaken(_) | EditError::Invalid(_)) => {}
        Err(error) => session.messages.error(format!("{}: {error}", t(label))),
    }
}

/// Picks targets and pins out together; one alone is selected.
pub fn gather(session: &mut Session, handles: Vec<Handle>) {
    session.picked.selection = match handles[..] {
        [Handle::Target(index)] => Selection::Target(index),
        [Handle::Pin(index)] => Selection::Pin(index),
        _ => Selection::Nothing,
    };
    session.timing.keys.clear();
    session.group.set(handles);
}

/// Picks keyframes out together; one alone is selected.
pub fn gather_keys(session: &mut Session, mut keys: Vec<usize>) {
    keys.sort_unstable();
    keys.dedup();
    session.group.set(Vec::new());
    session.picked.selection = match keys[..] {
        [key] => Selection::Keyframe(key),
        _ => Selection::Nothing,
    };
    session.timing.keys = if keys.len() > 1 { keys } else { Vec::new() };
}

/// Moves the anchor of a pin.
pub fn drag_pin(session: &mut Session, index: usize, to: Point) {
    live(session, Change::MovePin { index, to: Some(to) });
}

/// What is done to a target is done to its mirror image, where that is wanted.
fn mirror_along(session: &mut Session, pose: usize, index: usize) {
    let Some(axis) = session.posing.axis().filter(|_| session.posing.symmetric) else { return };
    let change = Change::Mirror { pose: Some(pose), handles: vec![Handle::Target(index)], axis };
    // The image may lie beside the body by more than a drawing is off: then there is none.
    let _ = session.document.history.preview(|design| change.apply(design));
}

/// Goes on with the gesture that made the target, or begins one that moves it.
pub fn drag_target(session: &mut Session, to: Point) {
    let (Selection::Target(index), Some(pose)) = (session.picked.selection, session.picked.pose) else { return };
    let change = Change::MoveTarget { pose, index, to };
    if !session.document.history.in_gesture() {
        live(session, change);
    } else if let Err(error) = session.document.history.preview(|design| change.apply(design)) {
        session.messages.error(error.to_string());
    }
    mirror_along(session, pose, index);
}

/// Goes on with the gesture that made a hole or a winch, or begins one that moves it.
pub fn move_part(session: &mut Session, part: Part, to: Point) {
    let change = Change::Network(network::Edit::Move { part, to });
    if !session.document.history.in_gesture() {
        return live(session, change);
    }
    match session.document.history.preview(|design| change.apply(design)) {
        Ok(made) => pick_out(session, made),
        // On the way over another hole: the last place stays.
        Err(EditError::Invalid(_)) => {}
        Err(error) => session.messages.error(error.to_string()),
    }
}

/// Selects what a change brought about.
pub fn pick_out(session: &mut Session, made: Made) {
    match made {
        Made::Nothing => {}
        Made::Pose(pose) => select_pose(session, Some(pose)),
        Made::Target { pose, index } => {
            session.picked.pose = Some(pose);
            session.picked.selection = Selection::Target(index);
        }
        Made::Pin(index) => session.picked.selection = Selection::Pin(index),
        Made::Keyframe(index) => {
            session.picked.selection = Selection::Keyframe(index);
            session.timing.keys.clear();
        }
        Made::Keyframes(keys) => gather_keys(session, keys),
        Made::Part(part) => session.picked.selection = Selection::Part(part),
    }
    clamp(session);
}

pub fn undo(session: &mut Session) {
    travel(session, t("Undone"), History::undo);
}

pub fn redo(session: &mut Session) {
    travel(session, t("Redone"), History::redo);
}

fn travel(session: &mut Session, done: &str, step: impl FnOnce(&mut History) -> Option<String>) {
    if let Some(label) = step(&mut session.document.history) {
        session.messages.info(format!("{done}: {}", t(&label)));
    }
    session.discovery.shown = None;
    super::follow::travelled(session);
    clamp(session);
}

/// After any change of the document: nothing may point beyond it.
pub fn clamp(session: &mut Session) {
    follow_mesh(session);
    let design = session.document.design();
    session.sketching.clamp(design);
    session.group.clamp(design, session.picked.pose);
    session.timing.keys.retain(|&key| key < design.keyframes.len());
    session.picked.clamp(design);
    if session.picked.mode == Mode::Winding && !session.winding.fits(design) {
        session.picked.mode = Mode::Pose;
    }
}

/// Shows a pose, or the rest shape.
pub fn select_pose(session: &mut Session, pose: Option<usize>) {
    session.picked.pose = pose;
    session.picked.mode = Mode::Pose;
    session.playback.playing = false;
    session.picked.selection = Selection::Nothing;
    session.group.set(Vec::new());
    session.discovery.shown = None;
    clamp(session);
}

/// Deletes whatever is selected.
pub fn delete_selected(session: &mut Session) {
    if !session.timing.keys.is_empty() {
        let keys = std::mem::take(&mut session.timing.keys);
        return change(session, Change::RemoveKeyframes(keys));
    }
    if session.group.handles().len() > 1 {
        let (pose, handles) = (session.picked.pose, session.group.handles().to_vec());
        change(session, Change::RemoveHandles { pose, handles });
        return session.group.set(Vec::new());
    }
    match (session.picked.selection, session.picked.pose) {
        (Selection::Target(index), Some(pose)) => change(session, Change::RemoveTarget { pose, index }),
        (Selection::Pin(index), _) => change(session, Change::RemovePin(index)),
        (Selection::Keyframe(index), _) => change(session, Change::RemoveKeyframe(index)),
        (Selection::Part(part), _) => return change(session, Change::Network(network::Edit::Remove(part))),
        _ => return,
    }
    session.picked.selection = Selection::Nothing;
}

/// Starts to edit the name of the current pose.
pub fn rename_pose(session: &mut Session) {
    if let Some((index, pose)) = session.picked.pose.and_then(|index| Some((index, session.design().poses.get(index)?)))
    {
        session.renaming = Some((Renamed::Pose(index), pose.name.clone()));
    }
}

/// Shapes and proposals belong to one mesh. Where the document has another one, by whatever way, they are let go.
fn follow_mesh(session: &mut Session) {
    session.document.follow();
    if session.solver.is_remeshed(session.document.design()) {
        session.solver.forget();
        session.discovery.clear();
        session.discovery.cancel();
    }
}
