//! Forecasts: what simulated drives make of a motion, told from a file and live.

use super::following::Following;
use super::line;
use super::plan::Plan;
use super::schedule::{Beat, Schedule, step_s};
use super::stream::Stream;
use super::trajectory::Trajectory;

/// The largest lag, mm of cable, and the largest ripple of speed, a part of the largest speed, of all winches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Each step of the file at its time.
    pub file: [f64; 2],
    /// Live, on a line with replies after [`line::LATENCY_S`].
    pub live: [f64; 2],
    /// Step of a live drive, s.
    pub step_s: f64,
}

impl Forecast {
    /// The forecast of a motion on the line of its design.
    pub fn of(stream: &dyn Stream, plan: &Plan, trajectory: &Trajectory) -> Self {
        let machine = stream.machine();
        let least_s = 1.0 / machine.controller.track_rate_hz;
        let step_s = step_s(stream, line::round_trip_s(machine, stream), least_s);
        let beats: Vec<Beat> = Schedule::new(plan, stream, step_s).beats().collect();
        Self {
            file: Following::of_file(machine, trajectory).worst(),
            live: Following::of_beats(machine, plan, &beats, 0.0).worst(),
            step_s,
        }
    }
}
