//! How a live drive kept the time.

use serde::Serialize;

/// The outcome of a motion that was played.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Played {
    /// Step of each winch, s.
    pub step_s: f64,
    /// A command and its reply on this line, s.
    pub round_trip_s: f64,
    /// From the first start to the last, s.
    pub lasted_s: f64,
    /// How late each start was sent, s, in order.
    #[serde(skip)]
    pub late: Vec<f64>,
}

impl Played {
    /// The lateness that this part of all starts stays under, s; 1 for all of them.
    pub fn late_s(&self, part: f64) -> f64 {
        let mut late = self.late.clone();
        late.sort_by(f64::total_cmp);
        let at = (part * late.len() as f64).ceil() as usize;
        late.get(at.saturating_sub(1)).copied().unwrap_or(0.0)
    }
}
