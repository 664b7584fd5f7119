//! Another resolution under the plushie, worked out on a thread of its own.

use crate::mesh::Size;
use crate::operations::Context;
use crate::operations::remesh::{self, Error, Options, Remeshed, Report};
use crate::studio::jobs::Outcome;
use crate::studio::language::{mark, tf};
use crate::studio::session::{Resolution, Session};
use crate::studio::words;

/// Begins to mesh.
pub fn start_remesh(session: &mut Session) {
    if session.meshing.running.is_some() {
        return;
    }
    let Resolution { fibers, finer } = session.resolution();
    let options = Options { size: Size::Fibers(fibers), finer, ..Options::default() };
    let design = session.design().clone();
    session.meshing.running = Some(session.jobs.start(mark("Meshing"), move |cancel| {
        Outcome::Remeshed(remesh::prepare(&design, &options, &Context::new(cancel)).map(Box::new))
    }));
}

/// Puts the mesh under the design as it is by now: what was changed meanwhile stays.
pub fn take_mesh(session: &mut Session, serial: u64, made: Result<Box<Remeshed>, Error>) {
    if !session.meshing.take(serial) {
        return;
    }
    let made = made.and_then(|made| Ok(session.document.history.edit(mark("Remesh"), |design| made.apply(design))?));
    match made {
        Ok(report) => {
            session.meshing.wanted = None;
            tell_carried(session, &report);
        }
        Err(error) => session.messages.error(tf!("Meshing: {why}", why = words::unmeshed(&error))),
    }
}

/// Says what became of pins, targets and tendons.
pub fn tell_carried(session: &mut Session, report: &Report) {
    let [before, after] = report.fibers;
    let farthest = report.farthest_mm();
    let text = if report.moved.is_empty() {
        tf!("The body has {after} fibres.", after)
    } else {
        tf!(
            "{before} fibres became {after}; pins, targets and tendons moved by up to {farthest:.1} mm.",
            before,
            after,
            farthest
        )
    };
    match report.lost_tendons.len() {
        0 => session.messages.info(text),
        lost => session.messages.warning(tf!(
            "{text} Too short for this mesh, and one edge long now: {lost} tendons.",
            text,
            lost
        )),
    }
}
