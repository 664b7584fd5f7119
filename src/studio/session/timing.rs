//! The timeline as it is worked on: keyframes picked out together, copies, and what the motors make of it.

use crate::design::{Design, Keyframe};
use crate::motion::{Doubt, doubted};
use std::sync::Arc;

/// Keyframes picked out and copied, doubts about the motors, and how the timeline is shown.
#[derive(Default)]
pub struct Timing {
    /// Numbers of keyframes that are picked out together: none or several.
    pub keys: Vec<usize>,
    /// Times from the first of them, s.
    pub copies: Vec<Keyframe>,
    /// Whether simulated drives and their loads are shown.
    pub drives: bool,
    doubts: Option<(Arc<Design>, Vec<Doubt>)>,
}

impl Timing {
    /// Stretches of the animation that the motors do not play as it is.
    pub fn doubts(&self) -> &[Doubt] {
        self.doubts.as_ref().map_or(&[], |(_, doubts)| doubts)
    }

    /// After any change of the document.
    pub(crate) fn follow(&mut self, design: &Arc<Design>) {
        if self.doubts.as_ref().is_some_and(|(of, _)| Arc::ptr_eq(of, design)) {
            return;
        }
        // What no controller takes is told at the export.
        let doubts = if design.keyframes.len() < 2 { Vec::new() } else { doubted(design).unwrap_or_default() };
        self.doubts = Some((design.clone(), doubts));
    }
}
