//! Drawing the outline: from parts, by hand, and a new body made of it.
//!
//! The drawing is part of the document, so that every stroke can be undone; the body stays as it is until a new one is made.

use super::{edit, mesh};
use crate::design::Design;
use crate::design::edit::set_drawing;
use crate::operations::reshape::{self, Error, Note, Options, Reshaped, Source};
use crate::operations::{Context, FiberCount};
use crate::outline::drawing::Item;
use crate::outline::{Drawing, Point};
use crate::studio::action::Sketch;
use crate::studio::change::Change;
use crate::studio::jobs::Outcome;
use crate::studio::language::{mark, tf};
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
    let is_point = thinner.is_some();
    let (what, drawing) = match (thinner, item) {
        (Some(drawing), _) => (mark("Delete point"), drawing),
        (None, Item::Part(_)) => (mark("Delete part"), session.drawing().without(item)),
        (None, Item::Track(_)) => (mark("Delete track"), session.drawing().without(item)),
    };
    if !is_point {
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
    session.meshing.drawn = drawing.clone();
    session.meshing.made = None;
    session.meshing.running = Some(session.jobs.start(mark("Meshing"), move |cancel| {
        let made = reshape::prepare(&design, Source::Drawing(&drawing), &options, &Context::new(cancel));
        Outcome::Reshaped(made.map(Box::new))
    }));
}

/// The body that was drawn is made.
pub fn take_body(session: &mut Session, serial: u64, made: Result<Box<Reshaped>, Error>) {
    if !session.meshing.take(serial) {
        return;
    }
    match made {
        Ok(made) => session.meshing.made = Some(made),
        Err(error) => refuse(session, &error),
    }
}

/// Gives the design as it is by now the body that was made, but not under a hand that draws. What was drawn since stays, and so does the
/// sheet then.
pub fn give_body(session: &mut Session, hands_off: bool) {
    if session.sketching.open && (session.sketching.waits || !hands_off) {
        return;
    }
    let Some(made) = session.meshing.made.take() else { return };
    let (changes, notes) = (made.changes.clone(), made.notes.clone());
    let drawn = std::mem::take(&mut session.meshing.drawn);
    let since = session.design().drawing.clone().filter(|drawing| *drawing != drawn);
    let goes_on = since.is_some();
    let mut by = [0.0; 2];
    let given = session.document.history.edit(mark("New body"), |design| {
        let report = made.apply(design)?;
        by = design.drawing.as_ref().map_or(by, |laid| moved(&drawn, laid));
        since.map_or(Ok(()), |drawing| set_drawing(design, Some(drawing.moved(by)))).map(|()| report)
    });
    let report = match given {
        Ok(report) => report,
        Err(error) => return refuse(session, &error.into()),
    };
    session.meshing.wanted = None;
    session.look.fit();
    session.sketching.fresh = false;
    if goes_on {
        session.sketching.camera = session.sketching.camera.map(|camera| camera.moved(by));
    } else {
        sketch(session, Sketch::Open(false));
    }
    mesh::tell_carried(session, &report);
    for line in words::changes(&changes) {
        session.messages.info(line);
    }
    for Note::MoreFibers(more) in notes {
        session.messages.info(words::more_fibers(more));
    }
}

fn refuse(session: &mut Session, error: &Error) {
    session.messages.error(tf!("New body: {why}", why = words::unshaped(error)));
}

/// How far a drawing was moved with its body, whose lower left corner is the origin.
fn moved(drawn: &Drawing, laid: &Drawing) -> Point {
    let place = |drawing: &Drawing| drawing.parts.first().and_then(|part| part.primitive.handles().first().copied());
    match (place(drawn), place(laid)) {
        (Some(from), Some(to)) => [to[0] - from[0], to[1] - from[1]],
        _ => [0.0; 2],
    }
}

/// A plushie that is still to be drawn: an empty sheet over a cushion.
pub fn blank() -> Design {
    Design { name: "Plushie".to_owned(), drawing: Some(Drawing::default()), ..cushion::design() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::drawing::{Part, Primitive};
    use crate::studio::acts::tick::tick;
    use crate::studio::canvas::Camera;
    use std::sync::Arc;

    /// A sheet whose body is being made, the hand on something that is not in the drawing yet.
    fn at_work() -> Session {
        let mut session = Session::new(cushion::design(), None, Arc::new(|| ()), crate::studio::services());
        sketch(&mut session, Sketch::Open(true));
        // It reaches out of the old body to the left, so that the new one has another origin.
        draw(&mut session, [10.0, 75.0], 40.0);
        sketch(&mut session, Sketch::Camera(Some(Camera { center: [100.0, 50.0], scale: 2.0 })));
        sketch(&mut session, Sketch::MakeBody);
        session.sketching.waits = true;
        while session.meshing.running.is_some() {
            tick(&mut session, 0.0, 0.0, true);
        }
        assert_eq!(session.history().undo_label(), Some("Draw a circle"), "not under the hand");
        session
    }

    fn draw(session: &mut Session, center: Point, radius: f64) {
        let mut drawing = session.drawing().clone();
        drawing.parts.push(Part::joined(Primitive::Circle { center, radius }));
        edit::change(session, Change::Draw { what: "Draw a circle", drawing });
    }

    #[test]
    fn a_body_waits_for_the_hand_and_closes_the_sheet() {
        let mut session = at_work();
        tick(&mut session, 0.0, 0.0, true);
        assert!(session.sketching.open && session.history().undo_label() == Some("Draw a circle"));
        // It was dropped with Escape.
        session.sketching.waits = false;
        tick(&mut session, 0.0, 0.0, false);
        assert!(session.sketching.open, "something is held still");
        tick(&mut session, 0.0, 0.0, true);
        assert!(!session.sketching.open && session.history().undo_label() == Some("New body"));
    }

    #[test]
    fn what_is_drawn_while_a_body_is_made_stays_and_the_sheet_too() {
        let mut session = at_work();
        draw(&mut session, [240.0, 75.0], 25.0);
        session.sketching.waits = false;
        tick(&mut session, 0.0, 0.0, true);
        assert!(session.sketching.open && session.history().undo_label() == Some("New body"));
        // It lies over the new body as it lay over the old one, and on the same place of the screen.
        let Primitive::Circle { center, radius } = session.drawing().parts[2].primitive else { panic!() };
        assert!((center[0] - 270.0).abs() < 0.1 && (center[1] - 75.0).abs() < 0.5 && radius == 25.0, "{center:?}");
        let camera = session.sketching.camera.unwrap();
        assert!((camera.center[0] - (center[0] - 140.0)).abs() < 1e-9, "{camera:?}");
        edit::undo(&mut session);
        assert!(matches!(session.drawing().parts[2].primitive, Primitive::Circle { center: [240.0, 75.0], .. }));
    }
}
