//! Keyframes that follow their poses: for which design they were worked out.

use crate::design::Design;
use crate::studio::jobs::{self, Running};
use std::sync::Arc;

/// What the keyframes of poses were worked out for.
#[derive(Default)]
pub struct Following {
    of: Option<Arc<Design>>,
    /// The job that works them out again, and for which design.
    pub(crate) running: Option<(Running, Arc<Design>)>,
}

impl Following {
    /// The keyframes are those of this design.
    pub(crate) fn settle(&mut self, design: &Arc<Design>) {
        self.cancel();
        self.of = Some(design.clone());
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

    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    pub fn cancel(&mut self) {
        let mut running = self.running.take().map(|(running, _)| running);
        jobs::cancel(&mut running);
    }
}
