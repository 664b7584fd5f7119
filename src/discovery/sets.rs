//! The best set of candidate tendons at one root, found exactly without enumerating the sets.
//!
//! A root has several branches, each with candidate tendons of net contraction x. Wanted are k branches and one
//! candidate on each, with the largest score `phi M - (1 - phi) S`, M the mean and S the variance (or the standard
//! deviation) of the k net contractions. Since
//!
//! ```text
//! -variance  = max over m     of  mean of -(x - m)^2
//! -deviation = max over m, s  of  mean of -((x - m)^2 / s + s) / 2
//! ```
//!
//! the score is the maximum over m (and s) of a mean of functions of one candidate each, `phi x - q (x - m)^2` plus a
//! constant. For given m (and s) that function falls with the distance of x from a centre `c = m + phi / (2 q)`. So the
//! best set belongs to some centre c: on each branch the candidate nearest to c, and of those the k nearest. (For
//! phi = 1 the centre is at infinity.) The nearest sets change only where c passes the midpoint of two candidates,
//! and only where fewer than k branches lie between them: few events, each cheap to evaluate. At an event, two
//! evaluations that decide the tie to the left and to the right give the sets of both neighbouring intervals; mixtures
//! of the two never win, because their mean would have to agree with both.

use super::Spread;
use super::graph::ROUNDING;

/// A candidate tendon from a root to a leaf of the winch tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TendonPath {
    pub net_contraction: f64,
    pub branch: usize,
    pub leaf: usize,
}

/// How a set of net contractions is scored: `phi mean - (1 - phi) spread`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measure {
    pub phi: f64,
    pub spread: Spread,
    /// Uncertainty of a net contraction by rounding, in its unit.
    rounding: f64,
}

/// A score and its uncertainty by rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Score {
    pub value: f64,
    pub rounding: f64,
}

impl Score {
    /// Whether this score equals the largest one up to rounding.
    pub fn ties(self, largest: Score) -> bool {
        self.value + self.rounding >= largest.value - largest.rounding
    }
}

impl Measure {
    /// `magnitude`: sum of |w| over the tree, which bounds every net contraction.
    pub fn new(phi: f64, spread: Spread, magnitude: f64) -> Self {
        Self { phi, spread, rounding: ROUNDING * magnitude }
    }

    /// Population statistics; one pass for the mean and one for the spread, so that equal values give exactly none.
    pub fn score(&self, net_contractions: &[f64]) -> Score {
        let count = net_contractions.len() as f64;
        let mean = net_contractions.iter().sum::<f64>() / count;
        let variance = net_contractions.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
        let deviation = variance.sqrt();
        let (spread, uncertainty) = match self.spread {
            Spread::Variance => (variance, self.rounding * (2.0 * deviation + self.rounding)),
            Spread::StandardDeviation => (deviation, self.rounding),
        };
        let rounding = self.phi * self.rounding + (1.0 - self.phi) * uncertainty;
        Score { value: self.phi * mean - (1.0 - self.phi) * spread, rounding }
    }
}

/// The largest score of the sets that hold the `forced` net contractions and `take` more, on different branches.
/// `candidates` ascend by net contraction. `None` where they have fewer than `take` branches.
///
/// Cost: about n k evaluations of O(k + log n) for n candidates on many branches.
pub(super) fn best_score(candidates: &[TendonPath], forced: &[f64], take: usize, measure: &Measure) -> Option<Score> {
    if take == 0 {
        return (!forced.is_empty()).then(|| measure.score(forced));
    }
    let branches = candidates.iter().map(|candidate| candidate.branch + 1).max()?;
    let mut sweep = Sweep { candidates, take, seen: vec![0; branches], round: 0, values: Vec::with_capacity(8) };
    let mut best: Option<Score> = None;
    let mut consider = |sweep: &mut Sweep, twice_center: f64, left_first: bool| {
        sweep.values.clear();
        sweep.values.extend_from_slice(forced);
        if sweep.nearest(twice_center, left_first) {
            let score = measure.score(&sweep.values);
            if best.is_none_or(|best| score.value > best.value) {
                best = Some(score);
            }
        }
    };
    consider(&mut sweep, f64::INFINITY, true);
    consider(&mut sweep, f64::NEG_INFINITY, false);
    let mut between = vec![usize::MAX; branches];
    for (i, left) in candidates.iter().enumerate() {
        let mut between_count = 0;
        for right in &candidates[i + 1..] {
            if between[right.branch] == i {
                continue;
            }
            let twice_center = left.net_contraction + right.net_contraction;
            consider(&mut sweep, twice_center, true);
            consider(&mut sweep, twice_center, false);
            // From here on something nearer to the centre stands for the left one's branch, or enough branches do.
            between[right.branch] = i;
            between_count += 1;
            if right.branch == left.branch || between_count == take {
                break;
            }
        }
    }
    best
}

struct Sweep<'a> {
    candidates: &'a [TendonPath],
    take: usize,
    /// Per branch the last round in which it was taken.
    seen: Vec<u32>,
    round: u32,
    values: Vec<f64>,
}

impl Sweep<'_> {
    /// Appends the nearest candidates to a centre, one a branch; false where there are too few branches. Works with
    /// twice the centre, so that the two candidates whose midpoint it is tie exactly.
    fn nearest(&mut self, twice_center: f64, left_first: bool) -> bool {
        self.round += 1;
        let mut right = self.candidates.partition_point(|c| 2.0 * c.net_contraction < twice_center);
        let mut left = right;
        let mut missing = self.take;
        while missing > 0 {
            let use_left = match (left > 0, right < self.candidates.len()) {
                (false, false) => return false,
                (true, false) => true,
                (false, true) => false,
                (true, true) => {
                    let sum = self.candidates[left - 1].net_contraction + self.candidates[right].net_contraction;
                    if left_first { twice_center <= sum } else { twice_center < sum }
                }
            };
            let candidate = if use_left {
                left -= 1;
                self.candidates[left]
            } else {
                right += 1;
                self.candidates[right - 1]
            };
            if self.seen[candidate.branch] != self.round {
                self.seen[candidate.branch] = self.round;
                self.values.push(candidate.net_contraction);
                missing -= 1;
            }
        }
        true
    }
}

/// The smallest sorted list of leaves among the sets of `count` candidates whose score ties with `largest`. It is found
/// leaf by leaf: the smallest leaf from which such a set can still be completed with larger leaves.
pub(super) fn smallest_set(
    candidates: &[TendonPath],
    count: usize,
    measure: &Measure,
    largest: Score,
) -> Option<Vec<TendonPath>> {
    let mut by_leaf = candidates.to_vec();
    by_leaf.sort_unstable_by_key(|candidate| candidate.leaf);
    let mut allowed = candidates.to_vec();
    let (mut chosen, mut forced) = (Vec::new(), Vec::new());
    for candidate in by_leaf {
        if chosen.len() == count {
            break;
        }
        if !allowed.contains(&candidate) {
            continue;
        }
        allowed.retain(|other| other.leaf > candidate.leaf);
        let rest: Vec<TendonPath> = allowed.iter().copied().filter(|other| other.branch != candidate.branch).collect();
        forced.push(candidate.net_contraction);
        let score = best_score(&rest, &forced, count - forced.len(), measure);
        if score.is_some_and(|score| score.ties(largest)) {
            chosen.push(candidate);
            allowed = rest;
        } else {
            forced.pop();
        }
    }
    (chosen.len() == count).then_some(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidates(list: &[(f64, usize)]) -> Vec<TendonPath> {
        let with_leaf = list.iter().enumerate();
        let mut list: Vec<TendonPath> =
            with_leaf.map(|(leaf, &(net_contraction, branch))| TendonPath { net_contraction, branch, leaf }).collect();
        list.sort_by(|a, b| a.net_contraction.total_cmp(&b.net_contraction));
        list
    }

    #[test]
    fn phi_trades_the_mean_against_the_spread() {
        let list = candidates(&[(1.0, 0), (1.1, 1), (5.0, 1), (8.0, 2)]);
        let best = |phi, spread| best_score(&list, &[], 2, &Measure::new(phi, spread, 20.0)).unwrap().value;
        assert!((best(0.0, Spread::Variance) + 0.0025).abs() < 1e-12);
        assert!((best(1.0, Spread::Variance) - 6.5).abs() < 1e-12);
        assert!((best(0.5, Spread::StandardDeviation) - (3.25 - 0.75)).abs() < 1e-12);
        assert!(best_score(&list, &[], 4, &Measure::new(0.5, Spread::Variance, 20.0)).is_none());
    }

    #[test]
    fn ties_go_to_the_smallest_leaves() {
        let list = candidates(&[(2.0, 0), (3.0, 1), (2.0, 2), (2.0, 1), (3.0, 0)]);
        let measure = Measure::new(0.0, Spread::Variance, 12.0);
        let largest = best_score(&list, &[], 2, &measure).unwrap();
        let leaves = smallest_set(&list, 2, &measure, largest).unwrap();
        assert_eq!(leaves.iter().map(|candidate| candidate.leaf).collect::<Vec<_>>(), [0, 2]);
    }
}
