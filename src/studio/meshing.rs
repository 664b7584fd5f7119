//! Another resolution under the plushie, worked out on a thread of its own; and what a new mesh makes stale.

use super::jobs::{Made, Report};
use super::session::{Session, Shapes};
use crate::design::edit::EditError;
use crate::design::remesh;
use crate::mesh::Request;
use std::time::Instant;

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
    pub running: Option<Instant>,
    /// Counts the runs; what an abandoned one reports is not wanted.
    serial: u64,
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
        let (serial, outline) = (self.begin_meshing(), self.design().outline.clone());
        let request = Request { tracks: self.design().tracks().to_vec(), ..Request::fibers(fibers) };
        self.jobs.start("Meshing", move || {
            let body = remesh::body(&outline, &request, finer);
            let made = body.map(|(mesh, set)| Box::new(Made::Mesh(mesh, set))).map_err(|e| e.to_string());
            Report::Meshed { serial, made }
        });
    }

    /// The number under which the run reports.
    pub(super) fn begin_meshing(&mut self) -> u64 {
        self.meshing.running = Some(Instant::now());
        self.meshing.serial += 1;
        self.meshing.serial
    }

    pub(super) fn cancel_remesh(&mut self) {
        if self.meshing.running.take().is_some() {
            self.meshing.serial += 1;
        }
    }

    /// Puts the mesh under the design as it is by now: what was changed meanwhile stays.
    pub(super) fn take_mesh(&mut self, serial: u64, made: Result<Box<Made>, String>) {
        if serial != self.meshing.serial || self.meshing.running.take().is_none() {
            return;
        }
        let (mesh, set) = match made.map(|made| *made) {
            Ok(Made::Mesh(mesh, set)) => (mesh, set),
            Ok(Made::Body(body, changes)) => return self.take_body(body, &changes),
            Err(why) => return self.messages.error(format!("Meshing: {why}")),
        };
        let carried = self.history.edit("Remesh", |design| Ok::<_, EditError>(remesh::carry(design, mesh, set)));
        let report = match carried {
            Ok(report) => report,
            Err(error) => return self.messages.error(format!("Remesh: {error}")),
        };
        self.meshing.wanted = None;
        self.tell_carried(&report);
    }

    pub(super) fn tell_carried(&mut self, report: &remesh::Report) {
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
