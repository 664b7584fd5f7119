//! Another document in the place of the one before.

use crate::design::Design;
use crate::studio::jobs;
use crate::studio::session::{Curve, Document, Following, Picked, Session, Sketching, Texturing};
use std::path::PathBuf;

/// Replaces the document; undo starts anew.
pub fn open(session: &mut Session, design: Design, path: Option<PathBuf>) {
    session.discovery.cancel();
    session.meshing.cancel();
    session.rigging.cancel();
    session.rigging.curve = Curve::default();
    session.tasks.cancel();
    jobs::cancel(&mut session.keying);
    session.following = Following::default();
    session.meshing.wanted = None;
    session.renaming = None;
    session.sketching = Sketching::default();
    session.picked = Picked::first(&design);
    session.document = Document::new(design, path);
    session.texturing = Texturing::default();
    session.files.forget_document();
    session.safety.unclaim();
    session.playback.time_s = 0.0;
    session.playback.playing = false;
    session.look.fit();
    session.look.onion.clear();
    session.discovery.clear();
    session.solver.forget();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::blank;
    use crate::studio::session::Renamed;
    use std::sync::Arc;

    #[test]
    fn a_name_that_is_being_typed_does_not_go_over_to_the_next_document() {
        let mut session = Session::new(blank::design(), None, Arc::new(|| ()), crate::studio::services());
        session.renaming = Some((Renamed::Plushie, "pig".into()));
        open(&mut session, blank::design(), None);
        assert_eq!(session.renaming, None);
    }
}
