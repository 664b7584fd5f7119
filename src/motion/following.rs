//! How closely drives follow what they are told: simulated trapezoids against the trajectory.

use super::drive::{Drive, TICK_S};
use super::families::classic::FOLLOWING;
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
struct Order {
    time_s: f64,
    target: i64,
    rpm: u32,
}

/// Time after the last order in which drives still run, s.
const AFTER_S: f64 = 0.5;

impl Following {
    /// Drives that are told every step of a trajectory at its time, one step ahead, as in the file of a host stream.
    pub fn of_file(machine: &Machine, trajectory: &Trajectory) -> Self {
        let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
        let mut following = Self::default();
        for winch in 0..machine.winches.len() {
            let order = |k: usize| {
                let (from, to) = (machine.counts(lengths[k][winch]), machine.counts(lengths[k + 1][winch]));
                Order { time_s: times[k], target: to, rpm: machine.rpm(to - from, times[k + 1] - times[k]) }
            };
            let orders: Vec<Order> = (0..times.len().saturating_sub(1)).map(order).collect();
            let track = |time_s: f64| interpolated(times, lengths, winch, time_s);
            following.add(machine, &orders, track);
        }
        following
    }

    /// Drives that are told the beats of a plan, each `late_s` after its time.
    pub fn of_beats(machine: &Machine, plan: &Plan, beats: &[Beat], late_s: f64) -> Self {
        let begin = plan.span_s()[0];
        let mut following = Self::default();
        for winch in 0..machine.winches.len() {
            let own = beats.iter().flat_map(|beat| beat.moves.iter().map(move |step| (beat.due_s, step)));
            let order = |(due_s, step): (f64, &Move)| {
                let [from, to] = [step.from_mm, step.to_mm].map(|length| machine.counts(length));
                Order { time_s: begin + due_s + late_s, target: to, rpm: machine.rpm(to - from, step.duration_s) }
            };
            let orders: Vec<Order> = own.filter(|(_, step)| step.winch == winch).map(order).collect();
            following.add(machine, &orders, |time_s| plan.at(time_s)[winch]);
        }
        following
    }

    /// The largest lag, mm, and the largest ripple of all winches.
    pub fn worst(&self) -> [f64; 2] {
        [&self.lag_mm, &self.ripple].map(|values| values.iter().copied().fold(0.0, f64::max))
    }

    fn add(&mut self, machine: &Machine, orders: &[Order], track: impl Fn(f64) -> f64) {
        let resolution = f64::from(machine.resolution());
        let following = f64::from(FOLLOWING) * resolution;
        let mut drive = Drive::new(0.0, following);
        let (Some(first), Some(last)) = (orders.first(), orders.last()) else {
            self.lag_mm.push(0.0);
            return self.ripple.push(0.0);
        };
        let scale = machine.counts_per_mm;
        drive.position = (scale * track(first.time_s)).round();
        drive.target = drive.position;
        let (mut lag, mut squares, mut fastest, mut samples) = (0.0_f64, 0.0_f64, 0.0_f64, 0_u64);
        let (mut time_s, mut next) = (first.time_s, 0);
        let mut before = track(time_s);
        while time_s < last.time_s + AFTER_S {
            while orders.get(next).is_some_and(|order| order.time_s <= time_s + 1e-9) {
                (drive.target, drive.speed) =
                    (orders[next].target as f64, f64::from(orders[next].rpm) / 60.0 * resolution);
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
