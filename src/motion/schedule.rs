//! Schedules: when a live drive tells which winch what, so that a line with slow replies keeps the time.
//!
//! A line carries one command after the other, and waits for each reply: it has room for one move in so many tens of milliseconds, a *slot*. Families that
//! move all winches by one command get one in every slot. Others have a slot for a single winch. A winch runs straight from its slot to its next one,
//! both where the plan is at that time; so each slot goes to the winch whose straight line would be the farthest from the plan by the next slot. Those that
//! stand still, or run evenly, need none.

use super::plan::Plan;
use super::stream::{Move, Stream};

/// Moves that start together, at their time.
#[derive(Clone, Debug, PartialEq)]
pub struct Beat {
    /// From the beginning of the plan, s.
    pub due_s: f64,
    pub moves: Vec<Move>,
}

/// The line is busy for no more than this part of a slot: the rest is for replies that come late.
const BUSY: f64 = 0.85;
/// A straight line that is nearer to the plan needs no slot, mm: below what any drive does.
const NEAR_MM: f64 = 1e-3;
/// At most so many places of a straight line are compared with the plan: what bounds the work on winches that stand still for long.
const PLACES: usize = 12;
/// A winch that moves by less need not be told, mm: nobody sees it.
const LEFT_OUT_MM: f64 = 0.5;
/// Places at which a plan is looked at for that, at least.
const LEFT_OUT_PLACES: usize = 1000;

/// Shortest slot on a line with such a round trip of a command and its reply, s; at least `least_s`.
pub fn slot_s(stream: &dyn Stream, round_trip_s: f64, least_s: f64) -> f64 {
    (commands_a_slot(stream) as f64 * round_trip_s / BUSY).max(least_s)
}

/// Commands of a move of all winches.
pub fn commands_a_step(stream: &dyn Stream) -> usize {
    commands(stream, stream.machine().winches.len())
}

/// Commands in a slot: of all winches where they move together, of one where not.
fn commands_a_slot(stream: &dyn Stream) -> usize {
    commands(stream, if stream.moves_together() { stream.machine().winches.len() } else { 1 })
}

fn commands(stream: &dyn Stream, winches: usize) -> usize {
    let step = |winch| Move { winch, from_mm: 0.0, to_mm: 0.0, duration_s: 1.0 };
    let steps: Vec<Move> = (0..winches).map(step).collect();
    let loads: usize = steps.iter().map(|step| stream.load(step).len()).sum();
    loads + if stream.moves_together() { 1 } else { stream.go(&steps).len() }
}

/// The beats of a plan in slots of `slot_s`, in the order of their times; the last moves end where the plan does, or `most_s` after its beginning.
pub fn beats(plan: &Plan, stream: &dyn Stream, slot_s: f64, most_s: f64) -> Vec<Beat> {
    let [begin, end] = plan.span_s();
    let end = end.min(begin + most_s);
    let slots = ((end - begin) / slot_s).ceil() as usize;
    let times: Vec<f64> = (0..=slots).map(|k| (k as f64 * slot_s).min(end - begin)).collect();
    let lengths: Vec<Vec<f64>> = times.iter().map(|time| plan.at(begin + time)).collect();
    let winches = stream.machine().winches.len();
    let one = |winch: usize, from: usize, at: usize, to: usize| Move {
        winch,
        from_mm: lengths[from][winch],
        to_mm: lengths[to][winch],
        duration_s: times[to] - times[at],
    };
    if stream.moves_together() {
        let all = |k: usize| (0..winches).map(|winch| one(winch, k, k, k + 1)).collect();
        return (0..slots).map(|k| Beat { due_s: times[k], moves: all(k) }).collect();
    }
    let owners = owners(&lengths, winches);
    let firsts: Vec<Option<usize>> =
        (0..winches).map(|winch| owners.iter().position(|owner| *owner == Some(winch))).collect();
    let mut next = vec![slots; winches];
    let mut beats = Vec::new();
    for (k, owner) in owners.iter().enumerate().rev() {
        let Some(winch) = *owner else { continue };
        // Until its first slot a winch stands where the plan begins.
        let from = if firsts[winch] == Some(k) { 0 } else { k };
        let step = one(winch, from, k, next[winch]);
        next[winch] = k;
        beats.push(Beat { due_s: times[k], moves: vec![step] });
    }
    beats.reverse();
    beats
}

/// A winch that the plan moves and no beat does: slots that are as long as a motion miss it.
pub fn left_out(plan: &Plan, beats: &[Beat]) -> Option<usize> {
    let [begin, end] = plan.span_s();
    let first = plan.at(begin);
    let places = beats.len().max(LEFT_OUT_PLACES);
    let at = |place: usize| plan.at(begin + (end - begin) * place as f64 / places as f64);
    let mut still: Vec<bool> = vec![true; first.len()];
    for place in 1..=places {
        let off = at(place).into_iter().zip(&first).map(|(there, first)| (there - first).abs());
        still.iter_mut().zip(off).for_each(|(still, off)| *still &= off < LEFT_OUT_MM);
    }
    let is_told = |winch: usize| beats.iter().any(|beat| beat.moves.iter().any(|step| step.winch == winch));
    (0..first.len()).find(|&winch| !still[winch] && !is_told(winch))
}

/// The winch that each slot goes to, if any.
fn owners(lengths: &[Vec<f64>], winches: usize) -> Vec<Option<usize>> {
    let mut last: Vec<Option<usize>> = vec![None; winches];
    let slots = lengths.len().saturating_sub(1);
    (0..slots)
        .map(|k| {
            let mut most = (NEAR_MM, None);
            for (winch, last) in last.iter().enumerate() {
                let off = off_mm(lengths, winch, *last, k + 1);
                if off > most.0 {
                    most = (off, Some(winch));
                }
            }
            if let Some(winch) = most.1 {
                last[winch] = Some(k);
            }
            most.1
        })
        .collect()
}

/// The largest distance, mm, of a winch's plan from the straight line between its last slot and a slot to come; from standing still where it had none.
fn off_mm(lengths: &[Vec<f64>], winch: usize, last: Option<usize>, to: usize) -> f64 {
    let from = last.unwrap_or(0);
    let (a, b) = (lengths[from][winch], lengths[to][winch]);
    let Some(_) = last else { return (b - a).abs() };
    let count = to - from;
    let places = count.min(PLACES);
    let off = |place: usize| {
        let at = from + count * place / places;
        let part = (at - from) as f64 / count as f64;
        (lengths[at][winch] - a - (b - a) * part).abs()
    };
    (1..places).map(off).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Design, Easing, Keyframe, testing};
    use crate::motion::families::classic::Classic;
    use crate::motion::{Machine, TooFast, Trajectory};

    /// The sample with as many winches as there are rows of keyframe values, a second apart.
    fn moving(rows: &[&[f64]]) -> (Classic, Plan) {
        let mut design: Design = testing::sample();
        let network = design.networks[0].clone();
        design.networks =
            (0..rows[0].len()).map(|k| crate::design::Network { name: format!("{k}"), ..network.clone() }).collect();
        let key = |(k, row): (usize, &&[f64])| Keyframe {
            time_s: k as f64,
            activations_mm: row.to_vec(),
            pose: None,
            easing: Easing::Smooth,
        };
        design.keyframes = rows.iter().enumerate().map(key).collect();
        let trajectory = Trajectory::of(&design, TooFast::Refuse).expect("slow enough");
        let machine = Machine::new(&design, &trajectory);
        (Classic::new(&machine).expect("it fits"), Plan::of(&design, TooFast::Refuse).expect("slow enough"))
    }

    #[test]
    fn every_winch_runs_from_slot_to_slot_along_the_plan_and_those_that_rest_need_none() {
        let (stream, plan) = moving(&[&[0.0, 0.0, 0.0], &[8.0, 0.0, 5.0], &[8.0, 0.0, 0.0], &[0.0, 0.0, 0.0]]);
        let slot_s = 0.07;
        let all = beats(&plan, &stream, slot_s, f64::INFINITY);
        let pairs = || all.windows(2);
        assert!(pairs().all(|pair| pair[1].due_s > pair[0].due_s + 0.99 * slot_s && pair[0].moves.len() == 1));
        for winch in 0..3 {
            let own: Vec<(f64, Move)> =
                all.iter().filter(|b| b.moves[0].winch == winch).map(|b| (b.due_s, b.moves[0])).collect();
            if winch == 1 {
                assert_eq!(own, []);
                continue;
            }
            assert_eq!(own[0].1.from_mm, 0.0);
            for pair in own.windows(2) {
                let ((due_s, step), (next_s, next)) = (pair[0], pair[1]);
                assert!((due_s + step.duration_s - next_s).abs() < 1e-9 && step.to_mm == next.from_mm);
                assert_eq!(step.to_mm, plan.at(next_s)[winch]);
            }
            let (due_s, last) = own[own.len() - 1];
            assert!((due_s + last.duration_s - 3.0).abs() < 1e-9 && last.to_mm == 0.0);
        }
        // The third rests from the second second on, the first in the middle one: then the other has the line for itself, but for one slot in
        // which the one that rests goes the last hundredths of its way.
        let within = |from_s: f64, to_s: f64| all.iter().filter(move |b| b.due_s > from_s && b.due_s < to_s);
        for (from_s, to_s, runs) in [(1.2, 1.8, 2), (2.2, 2.9, 0)] {
            let others: Vec<Move> =
                within(from_s, to_s).map(|beat| beat.moves[0]).filter(|step| step.winch != runs).collect();
            assert!(
                others.len() <= 1 && others.iter().all(|step| (step.to_mm - step.from_mm).abs() < 0.1),
                "{others:?}"
            );
        }
    }

    #[test]
    fn slots_are_as_long_as_the_line_needs() {
        let (stream, _) = moving(&[&[0.0; 3], &[5.0; 3]]);
        assert_eq!(commands_a_step(&stream), 9);
        assert!((slot_s(&stream, 0.0255, 0.02) - 0.09).abs() < 1e-12);
        assert_eq!(slot_s(&stream, 0.001, 0.02), 0.02);
    }
}
