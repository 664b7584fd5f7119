//! Letting go.

use super::{edit, sheet};
use crate::studio::action::Sketch;
use crate::studio::session::{Mode, Selection, Session};

/// Ends a drag, a search or the animation as if it had not been; otherwise clears the selection.
pub fn escape(session: &mut Session) {
    if session.discovery.running.is_some() && !session.document.history.in_gesture() && !session.sketching.open {
        return session.discovery.cancel();
    }
    if session.document.history.in_gesture() {
        session.document.history.cancel();
    } else if session.sketching.open {
        sheet::sketch(session, Sketch::Select(None, None));
    } else if session.picked.mode != Mode::Pose {
        session.playback.playing = false;
        session.picked.mode = Mode::Pose;
    } else {
        session.picked.selection = Selection::Nothing;
        session.look.marked = None;
        session.group.set(Vec::new());
        session.timing.keys.clear();
        session.discovery.shown = None;
    }
    edit::clamp(session);
}
