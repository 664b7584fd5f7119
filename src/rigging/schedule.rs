//! When a search for a rig leaves its islands, gathers the best of all, or drops the rules.
//!
//! One start decides most of where a search ends: of six searches for the robot's three poses (meshes of 177 and 414 fibres, three seeds,
//! 80 rounds, first layouts that were not annealed yet) from one start each, the worst pose keeps 0.12 to 0.23 of its error at rest; with eight
//! starts 0.04 to 0.14, and each of the six is better than before. So the first half of the rounds is spent in heats, each on new islands; then the best of all heats are gathered, and go on
//! together. Where the rules are lifted in the end, all this is the first half, and the second is free. A search that gains nothing any more begins
//! again with the rounds that are left.

use super::options::RigOptions;
use std::cmp::Ordering;

/// Rounds of a heat: what is a bad start has shown it by then.
const HEAT: usize = 5;
/// Fewer heats than this are none.
const FEWEST_HEATS: usize = 2;
/// Rounds after which islands are left for new ones, if none has left less than this part of the worst pose's error.
const PATIENCE: usize = 25;
const GAIN: f64 = 0.99;

/// What is done before a round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    /// Nothing: the islands go on.
    Go,
    /// One more heat.
    Heat,
    /// The best of the heats go on.
    Gather,
    /// The islands are left for good, for new ones by the rules.
    Anew,
    /// The rules are lifted.
    Free,
}

/// Where a search is in its rounds.
pub(super) struct Schedule {
    rounds: usize,
    /// Most heats.
    starts: usize,
    /// Whether the rules hold to the end.
    rules: bool,
    begun: usize,
    is_free: bool,
    best: f64,
    since: usize,
}

impl Schedule {
    pub fn new(options: &RigOptions) -> Self {
        let &RigOptions { rounds, starts, rules, .. } = options;
        Self {
            rounds,
            starts: starts.unwrap_or(rounds),
            rules,
            begun: 0,
            is_free: false,
            best: f64::INFINITY,
            since: 0,
        }
    }

    /// What is done before a round.
    pub fn turn(&mut self, round: usize) -> Turn {
        let turn = self.next(round);
        if turn != Turn::Go {
            (self.best, self.since) = (f64::INFINITY, 0);
        }
        match turn {
            Turn::Free => self.is_free = true,
            Turn::Anew => (self.begun, self.is_free) = (round, false),
            _ => (),
        }
        turn
    }

    /// The best of the present islands before a round: the worst pose's error as a part of that at rest.
    pub fn note(&mut self, worst: f64) {
        self.since = if worst < GAIN * self.best { 0 } else { self.since + 1 };
        self.best = self.best.min(worst);
    }

    fn next(&self, round: usize) -> Turn {
        let gone = round - self.begun;
        if !self.is_free {
            if gone > 0 && gone.is_multiple_of(HEAT) {
                match (gone / HEAT).cmp(&self.heats()) {
                    Ordering::Less => return Turn::Heat,
                    Ordering::Equal => return Turn::Gather,
                    Ordering::Greater => (),
                }
            }
            if !self.rules && (gone >= self.by_rules() || self.since > PATIENCE) {
                return Turn::Free;
            }
        }
        if self.since > PATIENCE { Turn::Anew } else { Turn::Go }
    }

    /// Rounds of this beginning that keep the rules.
    fn by_rules(&self) -> usize {
        let left = self.rounds - self.begun;
        if self.rules { left } else { left / 2 }
    }

    fn heats(&self) -> usize {
        let heats = (self.by_rules() / 2 / HEAT).min(self.starts);
        if heats < FEWEST_HEATS { 0 } else { heats }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The turns of a search that always gains, or never does, but for those that do nothing.
    fn turns(rounds: usize, rules: bool, gains: bool) -> Vec<(usize, Turn)> {
        of(&RigOptions { rounds, rules, ..Default::default() }, gains)
    }

    fn of(options: &RigOptions, gains: bool) -> Vec<(usize, Turn)> {
        let mut schedule = Schedule::new(options);
        let mut out = Vec::new();
        for round in 0..options.rounds {
            out.push((round, schedule.turn(round)));
            schedule.note(if gains { 0.5_f64.powi(round as i32) } else { 1.0 });
        }
        out.retain(|(_, turn)| *turn != Turn::Go);
        out
    }

    #[test]
    fn heats_come_first_and_their_best_go_on_together() {
        use Turn::{Free, Gather, Heat};
        let heats = |rounds: usize| (1..rounds / 5).map(|k| (5 * k, Heat)).collect::<Vec<_>>();
        assert_eq!(turns(80, true, true), [heats(40), vec![(40, Gather)]].concat());
        assert_eq!(turns(80, false, true), [heats(20), vec![(20, Gather), (40, Free)]].concat());
        // Too few rounds for two.
        assert!(turns(19, true, true).is_empty() && turns(0, true, true).is_empty());
        assert_eq!(turns(30, false, true), [(15, Free)]);
        let starts = |starts| of(&RigOptions { rounds: 80, starts: Some(starts), ..Default::default() }, true);
        assert!(starts(1).is_empty() && starts(2) == [(5, Heat), (10, Gather)] && starts(99).len() == 8);
    }

    #[test]
    fn a_search_that_gains_nothing_begins_again() {
        use Turn::{Anew, Free, Gather, Heat};
        let by_rules = turns(120, true, false);
        // The first round after each turn is a gain.
        assert_eq!(by_rules[11..], [(60, Gather), (87, Anew), (92, Heat), (97, Heat), (102, Gather)]);
        let free = turns(100, false, false);
        assert_eq!(free[..4], [(5, Heat), (10, Heat), (15, Heat), (20, Heat)]);
        assert_eq!(free[4..], [(25, Gather), (50, Free), (77, Anew), (88, Free)]);
    }
}
