//! The timeline at other times: copies, steps, and the time that the motors need.

use super::edit;
use crate::design::Keyframe;
use crate::operations::retime::{copied, fitted};
use crate::studio::change::Change;
use crate::studio::language::{t, tf, tn};
use crate::studio::session::{Mode, Session};

/// Copies what is picked out, for this window and as text for others.
pub fn copy(session: &mut Session) {
    let Ok(copies) = copied(session.design(), &session.keys()) else { return };
    session.clipboard = ron::ser::to_string(&copies).ok();
    let count = copies.len();
    session.timing.copies = copies;
    session.messages.info(tn!(count, "{count} keyframe copied", "{count} keyframes copied"));
}

/// Text from the clipboard: keyframes that were copied in another window.
pub fn paste_text(session: &mut Session, text: &str) {
    if let Ok(copies) = ron::from_str::<Vec<Keyframe>>(text) {
        session.timing.copies = copies;
    }
    paste(session);
}

/// Puts the copies on the timeline, the first at the playhead.
pub fn paste(session: &mut Session) {
    if session.timing.copies.is_empty() {
        return session.messages.info(t("Nothing was copied: select keyframes and copy them first."));
    }
    let (copies, time_s) = (session.timing.copies.clone(), session.playback.time_s);
    edit::change(session, Change::PasteKeyframes { copies, time_s });
}

/// Moves what is picked out.
pub fn nudge(session: &mut Session, by_s: f64) {
    let keys = session.keys();
    edit::change(session, Change::MoveKeyframes { keys, by_s });
}

/// Gives the animation the time that its motors need.
pub fn fit(session: &mut Session) {
    match fitted(session.design()) {
        Ok(times) => edit::change(session, Change::RetimeKeyframes(times)),
        Err(error) => session.messages.error(tf!("The animation cannot be fitted: {error}", error)),
    }
}

/// Goes to the keyframe after the playhead, or before it.
pub fn step(session: &mut Session, forth: bool) {
    let now = session.playback.time_s;
    let frames = session.design().keyframes.iter().enumerate();
    let found = if forth {
        frames.clone().find(|(_, k)| k.time_s > now + NEXT_S)
    } else {
        frames.clone().rfind(|(_, k)| k.time_s < now - NEXT_S)
    };
    if let Some((key, time_s)) = found.map(|(key, frame)| (key, frame.time_s)) {
        session.playback.playing = false;
        session.playback.time_s = time_s;
        session.picked.mode = Mode::Animation;
        edit::gather_keys(session, vec![key]);
    }
}

/// A keyframe nearer than this to the playhead is the one that it is on, s.
const NEXT_S: f64 = 1e-6;
