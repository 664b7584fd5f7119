//! Commands of the drawing of the outline.

use super::command::{Command, Group, Keys, Place, Scope};
use crate::outline::Drawing;
use crate::outline::drawing::{Item, Primitive};
use crate::studio::action::Sketch;
use crate::studio::acts;
use crate::studio::change::Change;
use crate::studio::icons::Icon;
use crate::studio::language::{mark, t};
use crate::studio::session::Session;
use eframe::egui::Key;

pub static ALL: [&Command; 7] = [&EDIT, &CUT, &CORNER, &DELETE, &TRACE, &MAKE_BODY, &CLOSE];

pub static EDIT: Command = Command {
    icon: Some(Icon::Pen),
    keys: &[Keys::plain(Key::O)],
    places: &[Place::Toolbar(Group::Tools)],
    ends_drawing: true,
    on: Some(&|session| session.sketching().open),
    run: &|session, _| acts::sheet::sketch(session, Sketch::Open(!session.sketching().open)),
    ..Command::new("outline.edit", "Edit outline", "Draw the outline, change its points, build it from parts")
};

pub static CUT: Command = Command {
    keys: &[Keys::plain(Key::X)],
    scope: Scope::Outline,
    on: Some(&|session| session.sketching().cut),
    run: &|session, _| acts::sheet::sketch(session, Sketch::Cut(!session.sketching().cut)),
    ..Command::new(
        "outline.cut",
        "Cut out what is drawn",
        "New parts are cut out of what was drawn before, not joined to it",
    )
};

pub static CORNER: Command = Command {
    keys: &[Keys::plain(Key::K)],
    scope: Scope::Outline,
    why_not: &|session, _| sharpened(session).is_none().then_some(t("Pick out a point of a path first")),
    run: &|session, _| {
        if let Some(change) = sharpened(session) {
            acts::edit::change(session, change);
        }
    },
    ..Command::new("outline.corner", "Corner or curve", "Make the point a corner, or round again")
};

pub static DELETE: Command = Command {
    icon: Some(Icon::Trash),
    keys: &[Keys::plain(Key::Delete), Keys::plain(Key::Backspace)],
    scope: Scope::Outline,
    why_not: &|session, _| session.sketching().item.is_none().then_some(t("Pick out a part, a track or a point first")),
    run: &|session, _| acts::sheet::delete_drawn(session),
    ..Command::new(
        "outline.delete",
        "Delete part or point",
        "Delete the point that is picked out, or else its part or track",
    )
};

pub static TRACE: Command = Command {
    scope: Scope::Outline,
    why_not: &|session, _| session.design().drawing.is_none().then_some(t("The present body is what is drawn")),
    run: &|session, _| {
        let tracks = session.drawing().tracks.clone();
        let drawing = Drawing { tracks, ..Drawing::of(&session.design().outline) };
        acts::edit::change(session, Change::Draw { what: mark("Trace the body"), drawing });
    },
    ..Command::new(
        "outline.trace",
        "Trace the present body",
        "Draw the present body anew, with few points, in place of these parts; the tracks stay",
    )
};

pub static MAKE_BODY: Command = Command {
    scope: Scope::Outline,
    ends_drawing: true,
    why_not: &|session, _| session.meshing().running.is_some().then_some(t("A body is being made")),
    run: &|session, _| acts::sheet::sketch(session, Sketch::MakeBody),
    ..Command::new(
        "outline.body",
        "Make the body",
        "Put this body in place of the old one; pins, poses, networks and keyframes stay",
    )
};

pub static CLOSE: Command = Command {
    scope: Scope::Outline,
    ends_drawing: true,
    run: &|session, _| acts::sheet::sketch(session, Sketch::Open(false)),
    ..Command::new("outline.close", "Close the drawing", "Back to the plushies; the drawing stays in the document")
};

/// The point of a path that is picked out made a corner, or round again.
fn sharpened(session: &Session) -> Option<Change> {
    let (Some(Item::Part(part)), Some(point)) = (session.sketching().item, session.sketching().point) else {
        return None;
    };
    let mut drawing = session.drawing().clone();
    let primitive = &mut drawing.parts.get_mut(part)?.primitive;
    let Primitive::Path { points } = &*primitive else { return None };
    let corner = !points.get(point)?.corner;
    *primitive = primitive.with_corner(point, corner);
    let what = if corner { mark("Sharpen point") } else { mark("Round point") };
    Some(Change::Draw { what, drawing })
}
