//! Another resolution under the plushie, worked out on a thread of its own; and what a new mesh makes stale.

use super::jobs::{Outcome, Running};
use super::session::{Session, Shapes};
use super::words;
use crate::mesh::Size;
use crate::operations::Context;
use crate::operations::remesh::{self, Error, Options, Remeshed, Report};

/// Largest `finer`.
pub const FINEST: usize = 16;

/// The resolution that is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Muscle fibres.
    pub fibers: usize,
    /// The simulation mesh is this many times finer than that of the fibres.
    pub finer: usize,
}

#[derive(Default)]
pub struct Meshing {
    /// What the controls say; `None`: that of the design.
    pub(super) wanted: Option<Resolution>,
    pub running: Option<Running>,
}

impl Session {
    pub fn meshing(&self) -> &Meshing {
        &self.meshing
    }

    pub fn resolution(&self) -> Resolution {
        let present = || {
            let design = self.design();
            let (fibers, edges) = (design.fiber_routings().len(), design.mesh.edges().len());
            let finer = (edges as f64 / fibers.max(1) as f64).sqrt().round() as usize;
            Resolution { fibers, finer: finer.clamp(1, FINEST) }
        };
        self.meshing.wanted.unwrap_or_else(present)
    }

    pub(super) fn start_remesh(&mut self) {
        if self.meshing.running.is_some() {
            return;
        }
        let Resolution { fibers, finer } = self.resolution();
        let options = Options { size: Size::Fibers(fibers), finer, ..Options::default() };
        let design = self.design().clone();
        self.meshing.running = Some(self.jobs.start("Meshing", move |cancel| {
            Outcome::Remeshed(remesh::prepare(&design, &options, &Context::new(cancel)).map(Box::new))
        }));
    }

    pub(super) fn cancel_remesh(&mut self) {
        if let Some(running) = self.meshing.running.take() {
            running.cancel();
        }
    }

    /// Whether the mesh that is waited for is there; it is not waited for any more then.
    pub(super) fn is_meshed(&mut self, serial: u64) -> bool {
        let wanted = Running::is(self.meshing.running.as_ref(), serial);
        if wanted {
            self.meshing.running = None;
        }
        wanted
    }

    /// Puts the mesh under the design as it is by now: what was changed meanwhile stays.
    pub(super) fn take_mesh(&mut self, serial: u64, made: Result<Box<Remeshed>, Error>) {
        if !self.is_meshed(serial) {
            return;
        }
        let made = made.and_then(|made| Ok(self.history.edit("Remesh", |design| made.apply(design))?));
        match made {
            Ok(report) => {
                self.meshing.wanted = None;
                self.tell_carried(&report);
            }
            Err(error) => self.messages.error(format!("Meshing: {}", words::unmeshed(&error))),
        }
    }

    pub(super) fn tell_carried(&mut self, report: &Report) {
        let [before, after] = report.fibers;
        let farthest = report.farthest_mm();
        let text = if report.moved.is_empty() {
            format!("The body has {after} fibres.")
        } else {
            format!("{before} fibres became {after}; pins, targets and tendons moved by up to {farthest:.1} mm.")
        };
        match report.lost_tendons.len() {
            0 => self.messages.info(text),
            lost => {
                self.messages.warning(format!("{text} Too short for this mesh, and one edge long now: {lost} tendons."))
            }
        }
    }

    /// Shapes and proposals belong to one mesh. Where the document has another one, by whatever way, they are let go.
    pub(super) fn follow_mesh(&mut self) {
        let design = self.history.current();
        if std::sync::Arc::ptr_eq(design, &self.meshed) {
            return;
        }
        if design.mesh != self.meshed.mesh {
            self.shapes = Shapes::default();
            self.discovery.proposals.clear();
            self.discovery.shown = None;
            self.first_id = self.asked.as_ref().map_or(0, |asked| asked.id + 1);
            self.answered_id = None;
            self.meshed = design.clone();
            self.cancel_propose();
        } else {
            self.meshed = design.clone();
        }
    }
}
