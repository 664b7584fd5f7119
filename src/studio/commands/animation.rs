//! Commands of the timeline.

use super::command::{Command, Keys, Scope};
use crate::studio::acts;
use crate::studio::icons::Icon;
use eframe::egui::Key;

pub static ALL: [&Command; 3] = [&PLAY, &LOOP, &ADD_KEYFRAME];

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
