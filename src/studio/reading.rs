//! What panels, viewports and tests may read of the session.

use super::canvas::Hit;
use super::messages::Messages;
use super::session::{Discovery, Look, Mode, Overlay, Playback, Renamed, Selection, Session, Shapes};
use crate::design::history::History;
use crate::design::{Design, Target};
use crate::engine::{Quality, Request};
use crate::rigging::Proposal;
use std::sync::Arc;

impl Session {
    /// The document as it is now.
    pub fn design(&self) -> &Arc<Design> {
        self.history.current()
    }

    pub fn history(&self) -> &History {
        &self.history
    }

    /// The current pose; `None` is the rest shape.
    pub fn pose(&self) -> Option<usize> {
        self.pose
    }

    /// Whether a dialog, the palette or a page stands over the window.
    pub fn is_covered(&self) -> bool {
        self.files.dialog.is_some() || self.overlay.is_some()
    }

    /// Whether a tool is the one for its canvas.
    pub fn has_taken(&self, id: &str) -> bool {
        self.tools.contains(&id)
    }

    /// What stands over the window.
    pub fn overlay(&self) -> Option<Overlay> {
        self.overlay
    }

    /// A name that is being typed.
    pub fn renaming(&self) -> Option<&(Renamed, String)> {
        self.renaming.as_ref()
    }

    /// What commands are about when nothing is pointed at.
    pub fn selected(&self) -> Hit {
        match self.selection {
            Selection::Target(index) => Hit::Target(index),
            Selection::Pin(index) => Hit::Pin(index),
            _ => Hit::Nothing,
        }
    }

    pub fn selection(&self) -> Selection {
        self.selection
    }

    pub fn playback(&self) -> &Playback {
        &self.playback
    }

    pub fn discovery(&self) -> &Discovery {
        &self.discovery
    }

    pub fn shapes(&self) -> &Shapes {
        &self.shapes
    }

    pub fn messages(&self) -> &Messages {
        &self.messages
    }

    pub fn look(&self) -> &Look {
        &self.look
    }

    /// Whether a thread is busy with a file, a keyframe or a rig.
    pub fn is_working(&self) -> bool {
        self.working().is_some()
    }

    /// What threads are busy with, ready to be shown.
    pub fn working(&self) -> Option<&'static str> {
        let keying = self.keying.is_some().then_some("Working out the keyframe");
        let rigging = self.rigging.running.is_some().then_some("Looking for winches and tendons");
        self.files.working.or(rigging).or(keying)
    }

    /// Whether the window is about to close.
    pub fn is_closing(&self) -> bool {
        self.files.quit
    }

    /// Targets of the current pose; none at rest and while the animation is shown.
    pub fn targets(&self) -> &[Target] {
        match (self.mode, self.pose.and_then(|pose| self.design().poses.get(pose))) {
            (Mode::Pose, Some(pose)) => &pose.targets,
            _ => &[],
        }
    }

    /// Whether a hand is in the middle of a change.
    pub fn is_dragging(&self) -> bool {
        self.history.in_gesture()
    }

    /// Whether the shapes answer the newest question; while the outline is drawn none is asked.
    pub fn is_settled(&self) -> bool {
        if self.sketching.open {
            return true;
        }
        let resting = !self.worker.is_busy();
        resting && self.asked.as_ref().is_some_and(|asked| self.answered_id == Some(asked.id))
    }

    /// Whether the hand rests and the shapes are being refined with all effort.
    pub fn is_refining(&self) -> bool {
        self.worker.is_refining()
    }

    /// How much work a frame may take.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// What the solver was asked last.
    pub fn request(&self) -> Option<&Request> {
        self.asked.as_ref()
    }

    /// The proposal that the views show.
    pub fn shown_proposal(&self) -> Option<&Arc<Proposal>> {
        self.discovery.shown.and_then(|index| self.discovery.proposals.get(index))
    }

    /// What the solver has to say about the newest shapes.
    pub fn solver_warning(&self) -> Option<&str> {
        self.warning.as_deref()
    }

    /// Why networks cannot be proposed now, if so.
    pub fn cannot_propose(&self) -> Option<&'static str> {
        if self.discovery.running.is_some() {
            Some("Discovery is running")
        } else if self.mode == Mode::Animation || self.targets().is_empty() {
            Some("Choose a pose with at least one target first: drag a point of the body")
        } else {
            None
        }
    }
}
