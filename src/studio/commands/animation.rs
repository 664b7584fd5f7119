//! Commands of the timeline.

use super::command::{Command, Keys, Scope};
use crate::studio::action::FileAction;
use crate::studio::acts;
use crate::studio::icons::Icon;
use crate::studio::jobs;
use crate::studio::language::{mark, t};
use crate::studio::session::Session;
use eframe::egui::Key;

pub static ALL: [&Command; 18] = [
    &PLAY,
    &LOOP,
    &BEGIN,
    &ADD_KEYFRAME,
    &NEXT,
    &PREVIOUS,
    &EARLIER,
    &LATER,
    &ALL_KEYFRAMES,
    &COPY,
    &CUT,
    &PASTE,
    &FIT,
    &FOLLOW,
    &DRIVES,
    &FILM,
    &CANCEL_FILM,
    &REMOVE,
];

/// A step of keyframes by the keys, s.
const STEP_S: f64 = 0.05;
const NO_KEYFRAME: &str = mark("Select a keyframe first");

pub static PLAY: Command = Command {
    icon: Some(Icon::Play),
    keys: &[Keys::plain(Key::Space)],
    scope: Scope::Views,
    on: Some(&|session| session.playback().playing),
    face_on: Some((Icon::Pause, "Pause", "Pause")),
    run: &|session, _| {
        if session.playback.playing {
            session.playback.playing = false;
        } else {
            acts::animate::play(session);
        }
    },
    ..Command::new("animation.play", "Play", "Play the animation")
};

pub static LOOP: Command = Command {
    icon: Some(Icon::Loop),
    keys: &[Keys::plain(Key::L)],
    scope: Scope::Views,
    on: Some(&|session| session.playback().looping),
    run: &|session, _| session.playback.looping = !session.playback.looping,
    ..Command::new("animation.loop", "Loop", "Begin again at the end")
};

pub static BEGIN: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| {
        let design = session.design();
        if design.networks.is_empty() {
            Some(t("Without networks there is nothing to animate: propose and accept one first."))
        } else if design.keyframes.len() > 1 {
            Some(t("There is an animation already"))
        } else if design.poses.iter().all(|pose| pose.targets.is_empty()) {
            Some(t("Pose the plushie first: drag a point of the body"))
        } else {
            None
        }
    },
    run: &|session, _| acts::animate::begin(session),
    ..Command::new("animation.begin", "Make it move", "Put rest, the pose and rest again on the timeline")
};

pub static ADD_KEYFRAME: Command = Command {
    icon: Some(Icon::Key),
    keys: &[Keys::plain(Key::K)],
    scope: Scope::Views,
    run: &|session, _| acts::animate::add_keyframe(session),
    ..Command::new(
        "animation.key",
        "Add keyframe",
        "Put what the realizable plushie shows on the timeline, in the place of a keyframe that the playhead is on; another pose comes \
         after the end",
    )
};

pub static NEXT: Command = Command {
    keys: &[Keys::plain(Key::PageDown)],
    scope: Scope::Views,
    run: &|session, _| acts::timing::step(session, true),
    ..Command::new("animation.next", "Next keyframe", "Go to the keyframe after the playhead")
};

pub static PREVIOUS: Command = Command {
    keys: &[Keys::plain(Key::PageUp)],
    scope: Scope::Views,
    run: &|session, _| acts::timing::step(session, false),
    ..Command::new("animation.previous", "Previous keyframe", "Go to the keyframe before the playhead")
};

pub static EARLIER: Command = Command {
    keys: &[Keys::plain(Key::Comma)],
    scope: Scope::Views,
    why_not: &|session, _| none_picked(session),
    run: &|session, _| acts::timing::nudge(session, -STEP_S),
    ..Command::new("animation.earlier", "Earlier", "Move the keyframes that are selected 0.05 s to the front")
};

pub static LATER: Command = Command {
    keys: &[Keys::plain(Key::Period)],
    scope: Scope::Views,
    why_not: &|session, _| none_picked(session),
    run: &|session, _| acts::timing::nudge(session, STEP_S),
    ..Command::new("animation.later", "Later", "Move the keyframes that are selected 0.05 s to the back")
};

pub static ALL_KEYFRAMES: Command = Command {
    keys: &[Keys::ctrl_shift(Key::A)],
    scope: Scope::Views,
    why_not: &|session, _| session.design().keyframes.is_empty().then_some(t("There are no keyframes")),
    run: &|session, _| {
        let keys = (0..session.design().keyframes.len()).collect();
        acts::edit::gather_keys(session, keys);
    },
    ..Command::new("animation.all", "Select all keyframes", "Pick out all keyframes of the timeline")
};

pub static COPY: Command = Command {
    keys: &[Keys::ctrl(Key::C)],
    scope: Scope::Views,
    why_not: &|session, _| none_picked(session),
    run: &|session, _| acts::timing::copy(session),
    ..Command::new("animation.copy", "Copy keyframes", "Copy the keyframes that are selected")
};

pub static CUT: Command = Command {
    keys: &[Keys::ctrl(Key::X)],
    scope: Scope::Views,
    why_not: &|session, _| none_picked(session),
    run: &|session, _| {
        acts::timing::copy(session);
        acts::edit::delete_selected(session);
    },
    ..Command::new("animation.cut", "Cut keyframes", "Copy the keyframes that are selected and take them away")
};

pub static PASTE: Command = Command {
    keys: &[Keys::ctrl(Key::V)],
    scope: Scope::Views,
    run: &|session, _| acts::timing::paste(session),
    ..Command::new(
        "animation.paste",
        "Paste keyframes",
        "Put what was copied on the timeline, the first at the playhead",
    )
};

pub static FIT: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| {
        session.timing().doubts().is_empty().then_some(t("The motors follow the animation as it is"))
    },
    run: &|session, _| acts::timing::fit(session),
    ..Command::new("animation.fit", "Make it fit", "Give the animation the time that its motors need")
};

pub static FOLLOW: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| {
        let stopped = session.following().is_stopped_at(session.design());
        (!stopped).then_some(t("Keyframes follow their poses as they are"))
    },
    run: &|session, _| session.following.go_on(),
    ..Command::new(
        "animation.follow",
        "Work out keyframes",
        "Go on with working out keyframes whose poses, winches or body have changed, after that was stopped",
    )
};

pub static DRIVES: Command = Command {
    keys: &[Keys::plain(Key::D)],
    scope: Scope::Views,
    on: Some(&|session| session.timing().drives),
    run: &|session, _| session.timing.drives = !session.timing.drives,
    ..Command::new(
        "animation.drives",
        "Drives",
        "Show beside the curves what simulated drives make of them, and their loads",
    )
};

pub static FILM: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| {
        (session.design().keyframes.len() < 2).then_some(t("Put two keyframes on the timeline first"))
    },
    run: &|session, _| acts::filing::ask(session, FileAction::Film),
    ..Command::new(
        "animation.film",
        "Export film…",
        "Write the animation as GIF, as pictures, or as a page that plays it",
    )
};

pub static CANCEL_FILM: Command = Command {
    why_not: &|session, _| session.filming().running.is_none().then_some(t("No film is being made")),
    run: &|session, _| jobs::cancel(&mut session.filming.running),
    ..Command::new("animation.film.cancel", "Cancel film", "Stop drawing the animation; nothing is written")
};

pub static REMOVE: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| none_picked(session),
    run: &|session, _| acts::edit::delete_selected(session),
    ..Command::new("animation.remove", "Delete keyframes", "Take the keyframes that are selected away")
};

fn none_picked(session: &Session) -> Option<&'static str> {
    session.keys().is_empty().then_some(t(NO_KEYFRAME))
}
