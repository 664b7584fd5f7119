//! Winding by hand.

use crate::design::animation;
use crate::engine::winch_reach_mm;
use crate::studio::session::{Mode, Session};

/// Winds a winch to so many mm of cable, as far as its tendons allow. What the views show is wound by hand from now on, beginning with
/// what they showed before.
pub fn wind(session: &mut Session, winch: usize, wound_mm: f64) {
    take_over(session);
    let design = session.document.design();
    let Some(network) = design.networks.get(winch) else { return };
    let reach = winch_reach_mm(design, network);
    if wound_mm.is_finite() {
        session.winding.wind(winch, wound_mm.clamp(-reach, reach));
    }
}

/// Winds nothing.
pub fn slacken(session: &mut Session) {
    take_over(session);
    for winch in 0..session.design().networks.len() {
        session.winding.wind(winch, 0.0);
    }
}

/// The winches as they are shown are the hand's now.
fn take_over(session: &mut Session) {
    let design = session.design().clone();
    if session.picked.mode == Mode::Winding && session.winding.fits(&design) {
        return;
    }
    let wound = match (session.picked.mode, &session.solver.shapes.realizable, &session.solver.shapes.idealized) {
        (Mode::Animation, ..) => animation::activations_at(&design, session.playback.time_s),
        (_, Some(shape), _) | (_, None, Some(shape)) => shape.activations_mm.clone(),
        _ => Vec::new(),
    };
    session.winding.begin(&design, &wound);
    session.playback.playing = false;
    session.picked.mode = Mode::Winding;
    session.discovery.shown = None;
}
