//! Onion skins follow the playhead.

use crate::engine::{Setpoint, Shape, solve_once};
use crate::studio::jobs::{self, Outcome, Told};
use crate::studio::session::{Neighbours, ONION, Session};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Once a frame. While it plays they stay as they are: nobody looks at a neighbour then.
pub fn follow(session: &mut Session) {
    if !session.look.onion.on || session.design().keyframes.is_empty() {
        if session.look.onion.of.is_some() {
            session.look.onion.clear();
        }
        return;
    }
    if session.playback.playing {
        return;
    }
    let wanted = Neighbours::of(session.design(), session.playback.time_s);
    if session.look.onion.of.as_ref().is_some_and(|of| of.is(&wanted)) {
        return;
    }
    jobs::cancel(&mut session.look.onion.running);
    session.look.onion.of = Some(wanted.clone());
    let running = session.jobs.start(ONION, move |cancel| {
        let shapes = wanted.activations_mm.each_ref().map(|wound| solved(&wanted, wound.as_ref()?, cancel));
        Outcome::Told { owner: ONION, told: Arc::new(shapes) as Told }
    });
    session.look.onion.running = Some(running);
}

/// The realizable plushie with its winches wound.
fn solved(of: &Neighbours, wound: &[f64], cancel: &AtomicBool) -> Option<Arc<Shape>> {
    let outcome = solve_once(&of.design, Setpoint::Activations(wound.to_vec()), [false, true], cancel);
    outcome.realizable.filter(|_| !cancel.load(Ordering::Relaxed)).map(Arc::new)
}
