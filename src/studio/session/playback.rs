//! The playhead.

pub struct Playback {
    pub time_s: f64,
    pub playing: bool,
    pub looping: bool,
    /// Where the animation ended in the last frame, s.
    end_s: f64,
}

impl Playback {
    /// The animation ends here now: the playhead does not stay behind the end of one that became shorter.
    pub(crate) fn follow(&mut self, end_s: f64) {
        if self.time_s <= self.end_s {
            self.time_s = self.time_s.min(end_s);
        }
        self.end_s = end_s;
    }

    /// Moves the playhead on, to the end of the animation or round again.
    pub fn advance(&mut self, passed_s: f64, end_s: f64) {
        let time_s = self.time_s + passed_s.max(0.0);
        self.time_s = if time_s < end_s {
            time_s
        } else if self.looping && end_s > 0.0 {
            time_s % end_s
        } else {
            self.playing = false;
            end_s
        };
    }
}

impl Default for Playback {
    fn default() -> Self {
        Self { time_s: 0.0, playing: false, looping: true, end_s: 0.0 }
    }
}
