//! The animation: playing, scrubbing, setting keyframes.

use super::change::{Change, Made};
use super::jobs::{Outcome, Running};
use super::session::{Mode, Session};
use super::words;
use crate::defaults;
use crate::design::{Easing, Keyframe, animation, edit};
use crate::operations::Context;
use crate::operations::key::{self, Error, Keyed, Note, Options};

impl Session {
    pub(super) fn play(&mut self) {
        let end = animation::duration_s(self.design());
        if end <= 0.0 {
            self.messages.info("Put at least two keyframes on the timeline to play an animation.");
            return;
        }
        if self.playback.time_s >= end {
            self.playback.time_s = 0.0;
        }
        self.mode = Mode::Animation;
        self.discovery.shown = None;
        self.playback.playing = true;
    }

    pub(super) fn advance(&mut self, passed_s: f64) {
        let end = animation::duration_s(self.design());
        let time = self.playback.time_s + passed_s.max(0.0);
        self.playback.time_s = if time < end {
            time
        } else if self.playback.looping && end > 0.0 {
            time % end
        } else {
            self.playback.playing = false;
            end
        };
    }

    pub(super) fn scrub(&mut self, time_s: f64) {
        self.playback.playing = false;
        self.playback.time_s = time_s.max(0.0);
        self.discovery.shown = None;
        self.mode = if self.design().keyframes.is_empty() { Mode::Pose } else { Mode::Animation };
    }

    /// What is seen becomes a keyframe: the animation at the playhead at once, a pose as soon as its activations are worked out.
    pub(super) fn add_keyframe(&mut self) {
        if self.design().networks.is_empty() {
            return self.messages.warning(words::unkeyed(&Error::NoNetworks));
        }
        let time_s = self.free_time();
        match self.mode {
            Mode::Pose => self.start_keying(time_s),
            Mode::Animation => {
                self.playback.playing = false;
                let activations_mm = animation::activations_at(self.design(), self.playback.time_s);
                let keyframe = Keyframe { time_s, activations_mm, pose: None, easing: Easing::default() };
                self.change(Change::SetKeyframe(keyframe));
                self.playback.time_s = time_s;
            }
        }
    }

    /// The playhead, or a step after the last keyframe where the playhead has one already.
    fn free_time(&self) -> f64 {
        match edit::keyframe_at(self.design(), self.playback.time_s) {
            Some(_) => animation::duration_s(self.design()) + defaults::KEYFRAME_SPACING_S,
            None => self.playback.time_s,
        }
    }

    fn start_keying(&mut self, time_s: f64) {
        if self.keying.is_some() {
            return;
        }
        let design = self.design().clone();
        let pose = self.pose.and_then(|pose| design.poses.get(pose)).map(|pose| pose.name.clone());
        let options = Options { pose, time_s, ..Options::default() };
        self.keying = Some(self.jobs.start("The keyframe", move |cancel| {
            Outcome::Keyed(key::prepare(&design, &options, &Context::new(cancel)))
        }));
    }

    pub(super) fn cancel_keying(&mut self) {
        if let Some(running) = self.keying.take() {
            running.cancel();
        }
    }

    pub(super) fn take_key(&mut self, serial: u64, keyed: Result<Keyed, Error>) {
        if !Running::is(self.keying.as_ref(), serial) {
            return;
        }
        self.keying = None;
        let keyed = match keyed {
            Ok(keyed) => keyed,
            Err(error) => return self.messages.error(words::unkeyed(&error)),
        };
        let time_s = keyed.keyframe.time_s;
        for Note::Unbalanced(unbalanced) in &keyed.notes {
            self.messages.warning(format!("The keyframe at {time_s:.2} s: {unbalanced}"));
        }
        match self.history.edit("Set keyframe", |design| keyed.apply(design)) {
            Ok(index) => {
                self.pick_out(Made::Keyframe(index));
                self.playback.time_s = time_s;
            }
            Err(error) => self.messages.error(words::unkeyed(&error.into())),
        }
    }
}
