//! Drawing the outline: from parts, by hand, and a new body made of it.
//!
//! The drawing is part of the document, so that every stroke can be undone; the body stays as it is until a new one is made.

use super::{edit, mesh};
use crate::design::Design;
use crate::operations::reshape::{self, Error, Note, Options, Reshaped, Source};
use crate::operations::{Context, FiberCount};
use crate::outline::Drawing;
use crate::outline::drawing::Item;
use crate::studio::action::Sketch;
use crate::studio::change::Change;
use crate::studio::jobs::Outcome;
use crate::studio::session::{Mode, Session};
use crate::studio::{blank as cushion, words};

/// Does what is asked for on the sheet.
pub fn sketch(session: &mut Session, sketch: Sketch) {
    match sketch {
        Sketch::Open(open) => {
            session.sketching.open = open;
            session.sketching.camera = None;
            session.playback.playing = false;
            session.picked.mode = Mode::Pose;
            edit::clamp(session);
        }
        Sketch::Cut(cut) => session.sketching.cut = cut,
        Sketch::Select(item, point) => {
            session.sketching.item = item;
            session.sketching.point = point;
            session.sketching.clamp(session.document.design());
        }
        Sketch::Camera(camera) => {
            session.sketching.camera = camera;
            session.look.zoom = None;
        }
        Sketch::MakeBody => start_body(session),
    }
}

/// Removes the point, or else the part or track, that is picked out.
pub fn delete_drawn(session: &mut Session) {
    let Some(item) = session.sketching.item.filter(|&item| session.drawing().has(item)) else { return };
    let thinner = session.sketching.point.and_then(|point| session.drawing().without_point(item, point));
    let (what, drawing) = match (thinner, item) {
        (Some(drawing), _) => ("Delete point", drawing),
        (None, Item::Part(_)) => ("Delete part", session.drawing().without(item)),
        (None, Item::Track(_)) => ("Delete track", session.drawing().without(item)),
    };
    if what != "Delete point" {
        session.sketching.item = None;
    }
    session.sketching.point = None;
    edit::change(session, Change::Draw { what, drawing });
}

fn start_body(session: &mut Session) {
    if session.meshing.running.is_some() {
        return;
    }
    let fibers = match session.meshing.wanted {
        None => FiberCount::Usual,
        // What an empty sheet begins with was nobody's wish.
        Some(resolution) if session.sketching.fresh => FiberCount::AtLeast(resolution.fibers),
        Some(resolution) => FiberCount::Exactly(resolution.fibers),
    };
    let options = Options { fibers, finer: session.resolution().finer, ..Options::default() };
    let (design, drawing) = (session.design().clone(), session.drawing().clone());
    session.meshing.running = Some(session.jobs.start("Meshing", move |cancel| {
        let made = reshape::prepare(&design, Source::Drawing(&drawing), &options, &Context::new(cancel));
        Outcome::Reshaped(made.map(Box::new))
    }));
}

/// Gives the design as it is by now the body that was drawn.
pub fn take_body(session: &mut Session, serial: u64, made: Result<Box<Reshaped>, Error>) {
    if !session.meshing.take(serial) {
        return;
    }
    let told = made.as_ref().map(|made| (words::changes(&made.changes).collect::<Vec<_>>(), made.notes.clone()));
    let (lines, notes) = told.unwrap_or_default();
    let made = made.and_then(|made| Ok(session.document.history.edit("New body", |design| made.apply(design))?));
    let report = match made {
        Ok(report) => report,
        Err(error) => return session.messages.error(format!("New body: {}", words::unshaped(&error))),
    };
    session.meshing.wanted = None;
    session.look.camera = None;
    session.sketching.fresh = false;
    sketch(session, Sketch::Open(false));
    mesh::tell_carried(session, &report);
    for line in lines {
        session.messages.info(line);
    }
    for Note::MoreFibers { asked, count } in notes {
        session.messages.info(words::more_fibers(asked, count));
    }
}

/// A plushie that is still to be drawn: an empty sheet over a cushion.
pub fn blank() -> Design {
    Design { name: "Plushie".to_owned(), drawing: Some(Drawing::default()), ..cushion::design() }
}
