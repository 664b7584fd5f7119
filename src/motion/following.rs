//! How closely drives follow what they are told: simulated trapezoids against the trajectory.

use super::drive::{Drive, TICK_S};
use super::machine::Machine;
use super::plan::Plan;
use super::schedule::Beat;
use super::stream::Move;
use super::trajectory::Trajectory;

/// How far drives are from the trajectory, and how unevenly they run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Following {
    /// The largest distance of each winch, mm of cable.
    pub lag_mm: Vec<f64>,
    /// Root mean square of the difference of its speed from the trajectory's, as a part of the trajectory's largest speed.
    pub ripple: Vec<f64>,
}

/// An order as it arrives: from then on a drive goes there at this speed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Order {
    time_s: f64,
    target: i64,
    rpm: u32,
}

impl Order {
    /// A drive is told it.
    pub fn give(&self, drive: &mut Drive, machine: &Machine) {
        drive.target = self.target as f64;
        drive.speed = f64::from(self.rpm) / 60.0 * f64::from(machine.resolution());
    }
}

/// The orders of a winch: every step of a trajectory at its time, one step ahead.
pub(super) fn orders(machine: &Machine, trajectory: &Trajectory, winch: usize) -> Vec<Order> {
    let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
    let order = |k: usize| {
        let (from, to) = (machine.counts(lengths[k][winch]), machine.counts(lengths[k + 1][winch]));
        Order { time_s: times[k], target: to, rpm: machine.rpm(to - from, times[k + 1] - times[k]) }
    };
    (0..times.len().saturating_sub(1)).map(order).collect()
}

/// A drive that stands where it has wound so much, mm.
pub(super) fn drive(machine: &Machine, wound_mm: f64) -> Drive {
    let following = f64::from(machine.controller.drives.following_acceleration) * f64::from(machine.resolution());
    let position = (machine.counts_per_mm * wound_mm).round();
    Drive { position, target: position, ..Drive::new(0.0, following) }
}

/// Time of all winches together that is simulated at most, s: what bounds the work on motions of hours.
const MOST_S: f64 = 480.0;
/// Time after the end in which drives still run, s.
const AFTER_S: f64 = 0.5;

impl Following {
    /// How much of a motion is simulated, s.
    pub fn most_s(machine: &Machine) -> f64 {
        MOST_S / machine.winches.len().max(1) as f64
    }

    /// Drives that are told every step of a trajectory at its time, one step ahead, as in the file of a host stream.
    pub fn of_file(machine: &Machine, trajectory: &Trajectory) -> Self {
        let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
        let mut following = Self::default();
        for winch in 0..machine.winches.len() {
            let orders = orders(machine, trajectory, winch);
            let track = |time_s: f64| interpolated(times, lengths, winch, time_s);
            let span_s = [times[0], times[times.len() - 1].min(times[0] + Self::most_s(machine))];
            following.add(machine, &orders, track, span_s);
        }
        following
    }

    /// Drives that are told the beats of a plan, each `late_s` after its time.
    pub fn of_beats(machine: &Machine, plan: &Plan, beats: &[Beat], late_s: f64) -> Self {
        let [begin, end] = plan.span_s();
        let end = end.min(begin + Self::most_s(machine));
        let mut following = Self::default();
        for winch in 0..machine.winches.len() {
            let own = beats.iter().flat_map(|beat| beat.moves.iter().map(move |step| (beat.due_s, step)));
            let order = |(due_s, step): (f64, &Move)| {
                let [from, to] = [step.from_mm, step.to_mm].map(|length| machine.counts(length));
                Order { time_s: begin + due_s + late_s, target: to, rpm: machine.rpm(to - from, step.duration_s) }
            };
            let orders: Vec<Order> = own.filter(|(_, step)| step.winch == winch).map(order).collect();
            following.add(machine, &orders, |time_s| plan.length_at(winch, time_s), [begin, end]);
        }
        following
    }

    /// The largest lag, mm, and the largest ripple of all winches.
    pub fn worst(&self) -> [f64; 2] {
        [&self.lag_mm, &self.ripple].map(|values| values.iter().copied().fold(0.0, f64::max))
    }

    fn add(&mut self, machine: &Machine, orders: &[Order], track: impl Fn(f64) -> f64, [begin, end]: [f64; 2]) {
        let scale = machine.counts_per_mm;
        let mut drive = drive(machine, track(begin));
        let (mut lag, mut squares, mut fastest, mut samples) = (0.0_f64, 0.0_f64, 0.0_f64, 0_u64);
        let (mut time_s, mut next) = (begin, 0);
        let mut before = track(time_s);
        while time_s < end + AFTER_S {
            while orders.get(next).is_some_and(|order| order.time_s <= time_s + 1e-9) {
                orders[next].give(&mut drive, machine);
                next += 1;
            }
            let from = drive.position;
            drive.pass(TICK_S);
            time_s += TICK_S;
            let now = track(time_s);
            let speed = (now - before) / TICK_S;
            lag = lag.max((drive.position / scale - now).abs());
            squares += ((drive.position - from) / scale / TICK_S - speed).powi(2);
            fastest = fastest.max(speed.abs());
            samples += 1;
            before = now;
        }
        self.lag_mm.push(lag);
        self.ripple.push(if fastest > 0.0 { (squares / samples as f64).sqrt() / fastest } else { 0.0 });
    }
}

/// The length of a winch between two rows of a trajectory, mm.
fn interpolated(times: &[f64], lengths: &[Vec<f64>], winch: usize, time_s: f64) -> f64 {
    let next = times.partition_point(|&t| t <= time_s).clamp(1, times.len().saturating_sub(1).max(1));
    match (times.get(next), lengths.get(next)) {
        (Some(&to_s), Some(to)) => {
            let part = ((time_s - times[next - 1]) / (to_s - times[next - 1])).clamp(0.0, 1.0);
            lengths[next - 1][winch] + (to[winch] - lengths[next - 1][winch]) * part
        }
        _ => lengths.last().map_or(0.0, |row| row[winch]),
    }
}
