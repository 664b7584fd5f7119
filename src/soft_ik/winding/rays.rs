//! The lines along which wound states are looked at: from where winding begins to the edge of the winches' range.
//!
//! A winch goes from its start to the end of its range in `levels` equal parts, or the other way to its lower bound (`-1`): a
//! winch that pays out goes slack, and how far beyond that makes no difference. The lines end in all combinations in which one
//! winch at least is wound to its end, and in the one in which all pay out; coarse ones come first.

use crate::soft_ik::Question;

/// A line's end.
#[derive(Clone, Debug, PartialEq)]
pub struct Ray {
    pub end: Vec<f64>,
}

/// How far each winch may be wound from `start`, and paid out: the ends of its range, or a take-in of half the shortest of its
/// elements where there is no bound.
pub fn ranges(question: &Question, start: &[f64]) -> Vec<[f64; 2]> {
    let winches = question.actuation.winches.iter().zip(start);
    winches
        .enumerate()
        .map(|(j, (winch, &start))| {
            let reach = reach(question, j);
            let upper = if winch.upper.is_finite() { winch.upper } else { start.max(0.0) + reach };
            let lower = if winch.lower.is_finite() { winch.lower } else { start.min(0.0) - reach };
            [lower.min(start), upper.max(start)]
        })
        .collect()
}

/// A take-in for a winch without bound: half the shortest of its elements.
pub fn reach(question: &Question, winch: usize) -> f64 {
    let elements = &question.model.contractile.elements;
    let members = &question.actuation.winches[winch].members;
    let shortest = members.iter().map(|&(e, r)| (elements[e].alpha0 / r).abs()).fold(f64::INFINITY, f64::min);
    if shortest.is_finite() { 0.5 * shortest } else { 0.0 }
}

/// The lines for `levels` parts of each winch's range; `levels` is a power of two.
pub fn rays(start: &[f64], ranges: &[[f64; 2]], levels: usize) -> Vec<Ray> {
    let mut out: Vec<Ray> = Vec::new();
    let mut add = |parts: &[f64]| {
        let end: Vec<f64> = (0..start.len())
            .map(|j| {
                let [lower, upper] = ranges[j];
                match parts[j] {
                    part if part < 0.0 => start[j] + part * (start[j] - lower),
                    1.0 => upper,
                    part => start[j] + part * (upper - start[j]),
                }
            })
            .collect();
        if end != start && !out.iter().any(|ray| ray.end == end) {
            out.push(Ray { end });
        }
    };
    let mut fine = 1;
    while fine <= levels {
        // Winding comes before paying out.
        let values: Vec<f64> = (0..=fine).rev().map(|k| k as f64 / fine as f64).chain([-1.0]).collect();
        for code in 0..values.len().pow(start.len() as u32) {
            let parts: Vec<f64> =
                (0..start.len()).map(|j| values[code / values.len().pow(j as u32) % values.len()]).collect();
            if parts.contains(&1.0) {
                add(&parts);
            }
        }
        fine *= 2;
    }
    add(&vec![-1.0; start.len()]);
    out
}

/// Many winches: each alone, all together, all but each, and `count` lines spread over the edge of the range (Halton's sequence,
/// the same for everybody).
pub fn spread(start: &[f64], ranges: &[[f64; 2]], count: usize) -> Vec<Ray> {
    let n = start.len();
    let mut parts: Vec<Vec<f64>> = vec![vec![1.0; n]];
    for alone in 0..n {
        parts.push((0..n).map(|j| if j == alone { 1.0 } else { -1.0 }).collect());
        parts.push((0..n).map(|j| if j == alone { -1.0 } else { 1.0 }).collect());
    }
    for k in 1..=count {
        // From -1 (paid out) to 1; the winch that is wound furthest is wound to its end.
        let drawn: Vec<f64> = (0..n).map(|j| 2.0 * halton(k, PRIMES[j % PRIMES.len()]) - 1.0).collect();
        let most = drawn.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        parts.push(drawn.iter().map(|part| if *part > 0.0 { part / most } else { *part }).collect());
    }
    let end = |parts: Vec<f64>| {
        let along = |j: usize| {
            let [lower, upper] = ranges[j];
            let room = if parts[j] < 0.0 { start[j] - lower } else { upper - start[j] };
            (start[j] + parts[j] * room).clamp(lower, upper)
        };
        Ray { end: (0..n).map(along).collect() }
    };
    parts.into_iter().map(end).filter(|ray| ray.end != start).collect()
}

/// Bases of Halton's sequence.
const PRIMES: [usize; 16] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];

/// The `k`-th number of the van der Corput sequence in this base, in `[0, 1)`.
fn halton(mut k: usize, base: usize) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0);
    while k > 0 {
        digit /= base as f64;
        value += digit * (k % base) as f64;
        k /= base;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_on_the_edge_of_the_range_and_coarse_ones_come_first() {
        let ends = |start: &[f64], ranges: &[[f64; 2]], levels| -> Vec<Vec<f64>> {
            rays(start, ranges, levels).into_iter().map(|ray| ray.end).collect()
        };
        assert_eq!(ends(&[0.0], &[[-2.0, 4.0]], 8), [[4.0], [-2.0]]);
        assert_eq!(ends(&[0.0], &[[0.0, 4.0]], 8), [[4.0]]);
        assert_eq!(ends(&[4.0], &[[4.0, 4.0]], 8), Vec::<Vec<f64>>::new());
        let two = ends(&[0.0, 0.0], &[[-1.0, 1.0], [0.0, 2.0]], 2);
        assert_eq!(two[..4], [[1.0, 2.0], [0.0, 2.0], [-1.0, 2.0], [1.0, 0.0]]);
        assert!(two.contains(&vec![0.5, 2.0]) && two.contains(&vec![1.0, 1.0]) && two.contains(&vec![-1.0, 0.0]));
        assert_eq!(two.len(), 7);
        // All combinations with one winch at its end, and the one in which all pay out.
        assert_eq!(ends(&[0.0; 3], &[[-1.0, 1.0]; 3], 4).len(), 6_usize.pow(3) - 5_usize.pow(3) + 1);
    }
}
