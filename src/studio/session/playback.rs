//! The playhead.

pub struct Playback {
    pub time_s: f64,
    pub playing: bool,
    pub looping: bool,
}

impl Playback {
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
        Self { time_s: 0.0, playing: false, looping: true }
    }
}
