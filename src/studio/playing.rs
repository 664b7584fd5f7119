//! The animation: playing, scrubbing, setting keyframes.

use super::change::Change;
use super::session::{Mode, Session};
use crate::defaults;
use crate::design::{Keyframe, animation, edit};

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
        self.key_wanted = false;
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
        self.key_wanted = false;
        self.discovery.shown = None;
        self.mode = if self.design().keyframes.is_empty() { Mode::Pose } else { Mode::Animation };
    }

    /// What is seen becomes a keyframe: the animation at the playhead at once, a pose as soon as it has settled.
    pub(super) fn add_keyframe(&mut self) {
        match self.mode {
            Mode::Pose => self.key_wanted = true,
            Mode::Animation => {
                self.playback.playing = false;
                let activations_mm = animation::activations_at(self.design(), self.playback.time_s);
                self.set_keyframe(activations_mm, None);
            }
        }
    }

    /// The settled pose as a keyframe.
    pub(super) fn key_pose(&mut self) {
        let Some(shape) = &self.shapes.realizable else { return };
        let activations_mm = shape.activations_mm.clone();
        let pose = self.pose.and_then(|p| self.design().poses.get(p)).map(|p| p.name.clone());
        self.set_keyframe(activations_mm, pose);
    }

    /// At the playhead, or a step after the last keyframe where the playhead has one already.
    fn set_keyframe(&mut self, mut activations_mm: Vec<f64>, pose: Option<String>) {
        let design = self.design().clone();
        if design.networks.is_empty() {
            self.messages.warning("Without networks there is nothing to animate: propose and accept one first.");
            return;
        }
        let mut time_s = self.playback.time_s;
        if edit::keyframe_at(&design, time_s).is_some() {
            time_s = animation::duration_s(&design) + defaults::KEYFRAME_SPACING_S;
        }
        activations_mm.resize(design.networks.len(), 0.0);
        let easing = Default::default();
        self.change(Change::SetKeyframe(Keyframe { time_s, activations_mm, pose, easing }));
        self.playback.time_s = time_s;
    }
}
