//! Motors that are driven live.

use crate::design::Design;
use crate::live::{Remote, Status};
use crate::operations::play::{Options, SIMULATED};
use std::sync::Arc;

/// The line to the motors: how it is wanted, and what goes on.
pub struct Motors {
    /// Port, family and speed of the line, whether an animation that is too quick is stretched.
    pub choice: Options,
    pub(crate) remote: Option<Remote>,
    /// The design as it was when the line was opened.
    of: Option<Arc<Design>>,
    /// Travel of the winches then, mm.
    travel_mm: Vec<f64>,
    /// Where sliders have the winches, mm; empty until a hand moves one.
    pub(crate) asked_mm: Vec<f64>,
}

impl Default for Motors {
    fn default() -> Self {
        let choice = Options { port: SIMULATED.into(), ..Options::default() };
        Self { choice, remote: None, of: None, travel_mm: Vec::new(), asked_mm: Vec::new() }
    }
}

impl Motors {
    /// What the motors do; none without a line.
    pub fn status(&self) -> Option<Status> {
        self.remote.as_ref().map(Remote::status)
    }

    /// Whether they wait for an order.
    pub fn is_ready(&self) -> bool {
        matches!(self.status(), Some(Status::Ready(_)))
    }

    /// Travel of the winches that the line was opened for, mm.
    pub fn travel_mm(&self) -> &[f64] {
        &self.travel_mm
    }

    /// Where sliders have them, mm: where they were told to be until a hand moves one.
    pub fn asked_mm(&self) -> Vec<f64> {
        match self.status() {
            Some(Status::Ready(told_mm)) if self.asked_mm.is_empty() => told_mm,
            _ => self.asked_mm.clone(),
        }
    }

    /// Whether the motion has changed since the line was opened.
    pub fn is_stale(&self, design: &Design) -> bool {
        let same = |of: &Arc<Design>| {
            (&of.networks, &of.keyframes, &of.controller, &of.fabrication)
                == (&design.networks, &design.keyframes, &design.controller, &design.fabrication)
        };
        self.remote.is_some() && !self.of.as_ref().is_some_and(same)
    }

    /// Whether the line was opened for the networks of this design.
    pub(crate) fn winds(&self, design: &Design) -> bool {
        self.of.as_ref().is_some_and(|of| of.networks == design.networks)
    }

    pub(crate) fn begin(&mut self, of: Arc<Design>, travel_mm: Vec<f64>, remote: Remote) {
        self.asked_mm.clear();
        (self.of, self.travel_mm, self.remote) = (Some(of), travel_mm, Some(remote));
    }
}
