//! Which networks are the same in kind: of a list one is shown, of those that a search ends with one is enough.

use super::layout::{Layout, Placed};
use crate::outline::{Point, polygon};

/// Networks nearer than this part of the body are of one kind: an eye that compares two pictures takes them for the same.
pub const APART: f64 = 0.07;
/// Places along a cable that are compared.
const PLACES: usize = 12;

/// How far two layouts are apart, mm: the largest distance of a winch from its partner, where partners are chosen so that this is least.
/// Infinite for different numbers of winches or tendons.
pub fn distance(a: &Layout, b: &Layout) -> f64 {
    if a.winches.len() != b.winches.len() {
        return f64::INFINITY;
    }
    let apart: Vec<Vec<f64>> = a.winches.iter().map(|p| b.winches.iter().map(|q| apart(p, q)).collect()).collect();
    let mut steps: Vec<f64> = apart.iter().flatten().copied().filter(|mm| mm.is_finite()).collect();
    steps.sort_by(f64::total_cmp);
    let least = steps.partition_point(|&within| !are_partners(&apart, within));
    steps.get(least).copied().unwrap_or(if a.winches.is_empty() { 0.0 } else { f64::INFINITY })
}

/// Whether each winch of the one layout has a partner of its own in the other, none farther off than `within` (augmenting paths).
fn are_partners(apart: &[Vec<f64>], within: f64) -> bool {
    fn find(winch: usize, apart: &[Vec<f64>], within: f64, seen: &mut [bool], of: &mut [Option<usize>]) -> bool {
        (0..of.len()).any(|other| {
            let is_new = apart[winch][other] <= within && !std::mem::replace(&mut seen[other], true);
            let found = is_new && of[other].is_none_or(|before| find(before, apart, within, seen, of));
            if found {
                of[other] = Some(winch);
            }
            found
        })
    }
    let mut of = vec![None; apart.len()];
    (0..apart.len()).all(|winch| find(winch, apart, within, &mut vec![false; apart.len()], &mut of))
}

/// The distance of two winches, or the mean distance of their cables where that is more, each with the nearest of the other.
fn apart(a: &Placed, b: &Placed) -> f64 {
    if a.cables.len() != b.cables.len() {
        return f64::INFINITY;
    }
    let [mine, theirs] = [a, b].map(|winch| -> Vec<Vec<Point>> {
        winch.cables.iter().map(|cable| resampled(&[&[winch.at], &cable[..]].concat())).collect()
    });
    let nearest = |cable: &Vec<Point>, others: &[Vec<Point>]| {
        others.iter().map(|other| mean(cable, other)).fold(f64::INFINITY, f64::min)
    };
    let one_way = |cables: &[Vec<Point>], others: &[Vec<Point>]| {
        cables.iter().map(|cable| nearest(cable, others)).sum::<f64>() / cables.len().max(1) as f64
    };
    let cables = one_way(&mine, &theirs).max(one_way(&theirs, &mine));
    polygon::length(a.at, b.at).max(cables)
}

fn mean(a: &[Point], b: &[Point]) -> f64 {
    a.iter().zip(b).map(|(p, q)| polygon::length(*p, *q)).sum::<f64>() / a.len().max(1) as f64
}

/// Places at equal steps along a cable, its ends included.
fn resampled(cable: &[Point]) -> Vec<Point> {
    let steps: Vec<f64> = cable.windows(2).map(|s| polygon::length(s[0], s[1])).collect();
    let whole: f64 = steps.iter().sum();
    let at = |k: usize| {
        let mut left = whole * k as f64 / (PLACES - 1) as f64;
        for (piece, step) in cable.windows(2).zip(&steps) {
            if left <= *step {
                return polygon::lerp(piece[0], piece[1], left / step.max(f64::MIN_POSITIVE));
            }
            left -= step;
        }
        cable[cable.len() - 1]
    };
    (0..PLACES).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(cables: Vec<Vec<Point>>) -> Layout {
        let cables = cables.into_iter().map(Into::into).collect();
        Layout { winches: vec![Placed { at: [0.0, 0.0], cables }] }
    }

    #[test]
    fn the_distance_is_that_of_the_ways_and_not_of_their_points() {
        let straight = one(vec![vec![[10.0, 0.0]]]);
        assert_eq!(distance(&straight, &straight), 0.0);
        // A hole on the way changes nothing.
        assert!(distance(&straight, &one(vec![vec![[3.0, 0.0], [10.0, 0.0]]])) < 1e-12);
        // From the winch to an end 6 mm off: 3 mm in the mean.
        let off = one(vec![vec![[10.0, 6.0]]]);
        assert!(
            (distance(&straight, &off) - 3.0).abs() < 1e-12 && distance(&straight, &off) == distance(&off, &straight)
        );
        // The order of tendons is no difference, their number is.
        let both = one(vec![vec![[10.0, 0.0]], vec![[10.0, 6.0]]]);
        let turned = one(vec![vec![[10.0, 6.0]], vec![[10.0, 0.0]]]);
        assert_eq!(distance(&both, &turned), 0.0);
        assert_eq!(distance(&both, &straight), f64::INFINITY);
        // Nor is the order of winches one.
        let winch = |at: Point, layout: &Layout| Placed { at, ..layout.winches[0].clone() };
        let pair = Layout { winches: vec![winch([0.0, 0.0], &straight), winch([50.0, 0.0], &both)] };
        let swapped = Layout { winches: vec![winch([50.0, 0.0], &both), winch([0.0, 4.0], &straight)] };
        assert_eq!((distance(&pair, &swapped), distance(&swapped, &pair)), (4.0, 4.0));
        let others = Layout { winches: vec![winch([50.0, 0.0], &both), winch([0.0, 4.0], &both)] };
        assert_eq!((distance(&pair, &others), distance(&pair, &straight)), (f64::INFINITY, f64::INFINITY));
        let mut elsewhere = straight.clone();
        elsewhere.winches[0].at = [0.0, 5.0];
        assert_eq!(distance(&straight, &elsewhere), 5.0);
    }
}
