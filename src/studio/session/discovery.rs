//! Network discovery: what was asked, and what came of it.

use crate::discovery::Parameters;
use crate::picture::Stage;
use crate::rigging::Proposal;
use crate::studio::jobs::{Running, cancel};
use std::sync::Arc;

/// Network discovery: what was asked, and what came of it.
pub struct Discovery {
    pub parameters: Parameters,
    pub running: Option<Running>,
    pub proposals: Vec<Arc<Proposal>>,
    /// Which proposal the views show.
    pub shown: Option<usize>,
    pub stage: Stage,
}

impl Discovery {
    /// The proposal that the views show.
    pub fn shown(&self) -> Option<&Arc<Proposal>> {
        self.shown.and_then(|index| self.proposals.get(index))
    }

    pub fn cancel(&mut self) {
        cancel(&mut self.running);
    }

    /// Drops what was proposed.
    pub fn clear(&mut self) {
        self.proposals.clear();
        self.shown = None;
    }
}

impl Default for Discovery {
    fn default() -> Self {
        let parameters = Parameters::default();
        Self { parameters, running: None, proposals: Vec::new(), shown: None, stage: Stage::Result }
    }
}
