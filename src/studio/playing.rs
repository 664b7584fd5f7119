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

    /// At the playhead, or a step after the last keyframe where the playhead has one already.
    pub(super) fn set_keyframe(&mut self) {
        let design = self.design().clone();
        let Some(shape) = &self.shapes.realizable else { return };
        if design.networks.is_empty() {
            self.messages.warning("Without networks there is nothing to animate: propose and accept one first.");
            return;
        }
        let mut time_s = self.playback.time_s;
        if edit::keyframe_at(&design, time_s).is_some() {
            time_s = animation::duration_s(&design) + defaults::KEYFRAME_SPACING_S;
        }
        let mut activations_mm = shape.activations_mm.clone();
        activations_mm.resize(design.networks.len(), 0.0);
        let pose = self.pose.and_then(|p| design.poses.get(p)).map(|p| p.name.clone());
        let easing = Default::default();
        self.change(Change::SetKeyframe(Keyframe { time_s, activations_mm, pose, easing }));
        self.playback.time_s = time_s;
    }
}
