//! Schedules: when a live drive tells which winch what, so that a line with slow replies keeps the time.
//!
//! A line carries one command after the other, and waits for each reply. Winches that are all told at the ends of common steps would start one reply
//! after the other; so every winch has steps of its own, shifted by a part of a step against the others, and each start falls on its own time. A
//! target is where the plan is at that time, not later: shifted winches do not trail. Families that move all winches by one command need no shift.

use super::plan::Plan;
use super::stream::{Move, Stream};

/// Moves that start together, at their time.
#[derive(Clone, Debug, PartialEq)]
pub struct Beat {
    /// From the beginning of the plan, s.
    pub due_s: f64,
    pub moves: Vec<Move>,
}

/// The beats of a plan in the order of their times.
#[derive(Clone, Copy, Debug)]
pub struct Schedule<'a> {
    plan: &'a Plan,
    winches: usize,
    together: bool,
    step_s: f64,
}

/// The line is busy for no more than this part of a step: the rest is for replies that come late.
const BUSY: f64 = 0.85;

/// Shortest step in which a line with such a round trip of a command and its reply, s, tells all winches of a stream; at least `least_s`.
pub fn step_s(stream: &dyn Stream, round_trip_s: f64, least_s: f64) -> f64 {
    (commands_a_step(stream) as f64 * round_trip_s / BUSY).max(least_s)
}

/// Commands of a step of all winches.
pub fn commands_a_step(stream: &dyn Stream) -> usize {
    let step = |winch| Move { winch, from_mm: 0.0, to_mm: 0.0, duration_s: 1.0 };
    let steps: Vec<Move> = (0..stream.machine().winches.len()).map(step).collect();
    let loads: usize = steps.iter().map(|step| stream.load(step).len()).sum();
    loads + if stream.moves_together() { 1 } else { stream.go(&steps).len() }
}

impl<'a> Schedule<'a> {
    /// The schedule of a plan in steps of `step_s`.
    pub fn new(plan: &'a Plan, stream: &dyn Stream, step_s: f64) -> Self {
        Self { plan, winches: stream.machine().winches.len(), together: stream.moves_together(), step_s }
    }

    /// Beats, first to last; the last ones end where the plan does.
    pub fn beats(&self) -> impl Iterator<Item = Beat> + use<'a> {
        let Self { plan, winches, together, step_s } = *self;
        let [begin, end] = plan.span_s();
        let steps = ((end - begin) / step_s).ceil() as u64;
        let parts = if together { 1 } else { winches as u64 };
        let shift = step_s / parts.max(1) as f64;
        // A winch that is shifted needs one step more to get to the end.
        (0..(steps + u64::from(!together)) * parts).filter_map(move |number| {
            let (k, part) = (number / parts, number % parts);
            let due_s = k as f64 * step_s + part as f64 * shift;
            // The first step of a shifted winch is longer by the shift, so that none jumps.
            let from_s = (begin + if k == 0 { 0.0 } else { due_s }).min(end);
            let to_s = (begin + due_s + step_s).min(end);
            let (from, to) = (plan.at(from_s), plan.at(to_s));
            let duration_s = (to_s - begin - due_s).max(0.0);
            let one = |winch: usize| Move { winch, from_mm: from[winch], to_mm: to[winch], duration_s };
            let moves = if together { (0..winches).map(one).collect() } else { vec![one(part as usize)] };
            (duration_s > 0.0).then_some(Beat { due_s, moves })
        })
    }
}
