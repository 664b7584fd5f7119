//! Keyframes that follow their poses: for which design they were worked out.

use super::done::Done;
use crate::design::Design;
use crate::studio::jobs::{self, Running};
use std::sync::Arc;

/// What the keyframes of poses were worked out for.
#[derive(Default)]
pub struct Following {
    of: Option<Arc<Design>>,
    /// The job that works them out again, and for which design.
    pub(crate) running: Option<(Running, Arc<Design>)>,
    /// How many poses it has worked out.
    pub(crate) done: Done,
    /// The design for which it was told to stop: keyframes wind what they did before.
    stopped_at: Option<Arc<Design>>,
}

impl Following {
    /// The keyframes are those of this design.
    pub(crate) fn settle(&mut self, design: &Arc<Design>) {
        self.cancel();
        self.of = Some(design.clone());
        self.stopped_at = None;
    }

    /// The design that they were worked out for, where it is another one.
    pub(crate) fn before(&self, design: &Arc<Design>) -> Option<&Arc<Design>> {
        self.of.as_ref().filter(|of| !Arc::ptr_eq(of, design))
    }

    /// Whether nothing is known yet: the document is as it was opened.
    pub(crate) fn is_new(&self) -> bool {
        self.of.is_none()
    }

    /// Whether keyframes are worked out again for this very design.
    pub(crate) fn is_at(&self, design: &Arc<Design>) -> bool {
        self.running.as_ref().is_some_and(|(_, of)| Arc::ptr_eq(of, design))
    }

    /// Lets keyframes be as they were, until the design changes again or somebody asks.
    pub(crate) fn stop(&mut self) {
        self.stopped_at = self.running.as_ref().map(|(_, of)| of.clone());
        self.cancel();
    }

    /// Works them out after all.
    pub(crate) fn go_on(&mut self) {
        self.stopped_at = None;
    }

    /// Whether nothing is worked out for this very design, because somebody has stopped it.
    pub fn is_stopped_at(&self, design: &Arc<Design>) -> bool {
        self.stopped_at.as_ref().is_some_and(|at| Arc::ptr_eq(at, design))
    }

    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    pub fn cancel(&mut self) {
        let mut running = self.running.take().map(|(running, _)| running);
        jobs::cancel(&mut running);
    }
}
