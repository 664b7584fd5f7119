//! Variants of a discovered network that are easier to sew or pull better.
//!
//! Algorithm 2 knows contractions but no geometry, so its tendons can zigzag between parallel fibres (section 8.2 of the
//! paper). The functions here propose other routings for the simulation to judge; none is better by itself. A routing is
//! a list of mesh nodes from the winch outward, and stays one: its ends are kept unless said otherwise, and no node
//! stands twice in a row.

use crate::outline::Point;
use std::collections::BTreeSet;

/// Cosine of the sharpest turn, 60 degrees, that still continues a tendon. Beyond it the new piece pulls across.
const CONTINUING_TURN_COS: f64 = 0.5;
/// How many fibres an extended variant adds at most at each tip.
const MAX_EXTENSION: usize = 2;

/// The mesh as far as routings care.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// Rest positions of the nodes, mm.
    pub positions: &'a [Point],
    pub edges: &'a [[usize; 2]],
    /// Contraction of each edge, mm.
    pub weights: &'a [f64],
}

/// Other versions of a network's tendons: shortened, straightened, both, and extended at the tips (one by one and all
/// together). Distinct from each other and from the given ones, in a fixed order.
pub fn variants(tendons: &[Vec<usize>], around: &Surroundings, tolerance_mm: f64) -> Vec<Vec<Vec<usize>>> {
    let smooth_all = |tendons: &[Vec<usize>]| -> Vec<Vec<usize>> {
        tendons.iter().map(|path| smooth(path, around, tolerance_mm)).collect()
    };
    let mut proposals: Vec<Vec<Vec<usize>>> = vec![
        tendons.iter().map(|path| shorten(path, around)).collect(),
        tendons.iter().map(|path| straighten(path, around.positions, tolerance_mm)).collect(),
        smooth_all(tendons),
    ];
    for index in 0..tendons.len() {
        let mut one = tendons.to_vec();
        if extend_one(&mut one, index, around) {
            proposals.push(smooth_all(&one));
        }
    }
    let mut all = tendons.to_vec();
    for _ in 0..MAX_EXTENSION {
        for index in 0..all.len() {
            extend_one(&mut all, index, around);
        }
        proposals.push(smooth_all(&all));
    }
    let mut seen = BTreeSet::from([tendons.to_vec()]);
    proposals.retain(|proposal| seen.insert(proposal.clone()));
    proposals
}

/// [`shorten`], then [`straighten`].
pub fn smooth(path: &[usize], around: &Surroundings, tolerance_mm: f64) -> Vec<usize> {
    straighten(&shorten(path, around), around.positions, tolerance_mm)
}

/// The fewest via points, each a hole in the felt, for which no dropped point lies further than `tolerance_mm` from the
/// straight piece that replaces it. Of several ways with equally few points the one that deviates least (sum of
/// distances). Cost: cube of the number of points.
pub fn straighten(path: &[usize], positions: &[Point], tolerance_mm: f64) -> Vec<usize> {
    // The best way to each point: number of pieces, sum of deviations, point before.
    let mut best: Vec<(usize, f64, usize)> = vec![(0, 0.0, 0)];
    for end in 1..path.len() {
        let mut way = (usize::MAX, f64::INFINITY, end - 1);
        for start in (0..end).rev() {
            if let Some(deviation) = deviation(&path[start..=end], positions, tolerance_mm) {
                let (pieces, sum) = (best[start].0 + 1, best[start].1 + deviation);
                if (pieces, sum) < (way.0, way.1) {
                    way = (pieces, sum, start);
                }
            }
        }
        best.push(way);
    }
    let mut kept = Vec::new();
    let mut at = path.len();
    while at > 0 {
        kept.push(path[at - 1]);
        at = if at == 1 { 0 } else { best[at - 1].2 + 1 };
    }
    kept.reverse();
    kept
}

/// Sum of the distances of the inner points from the piece between the outer ones; `None` where one is too far, or where
/// the path turns back along it. A piece without inner points deviates by nothing.
fn deviation(path: &[usize], positions: &[Point], tolerance: f64) -> Option<f64> {
    let &[first, .., last] = path else { return None };
    if path.len() == 2 {
        return Some(0.0);
    }
    let piece = difference(positions[last], positions[first]);
    let length = norm(piece);
    if length == 0.0 {
        return None;
    }
    let (mut sum, mut reached) = (0.0, 0.0);
    for &node in &path[1..path.len() - 1] {
        let from_first = difference(positions[node], positions[first]);
        let along = dot(from_first, piece) / length;
        let across = (from_first[0] * piece[1] - from_first[1] * piece[0]).abs() / length;
        if across > tolerance || along < reached || along > length {
            return None;
        }
        reached = along;
        sum += across;
    }
    Some(sum)
}

/// Replaces detours over two edges by the direct edge where the mesh has one, the one that saves most first, until none
/// is left. Back-and-forth pieces disappear as well.
pub fn shorten(path: &[usize], around: &Surroundings) -> Vec<usize> {
    let edges: BTreeSet<[usize; 2]> = around.edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    let distance = |a: usize, b: usize| norm(difference(around.positions[b], around.positions[a]));
    let mut path = path.to_vec();
    path.dedup();
    loop {
        let mut largest: Option<(f64, usize)> = None;
        for (index, detour) in path.windows(3).enumerate() {
            let &[a, b, c] = detour else { continue };
            if a == c || edges.contains(&[a.min(c), a.max(c)]) {
                let saved = distance(a, b) + distance(b, c) - distance(a, c);
                if largest.is_none_or(|(most, _)| saved > most) {
                    largest = Some((saved, index + 1));
                }
            }
        }
        let Some((_, index)) = largest else { return path };
        // A path a-b-a alone cannot lose its only piece.
        if path.len() == 3 && path[0] == path[2] {
            return path;
        }
        path.remove(index);
        path.dedup();
    }
}

/// The path with the heaviest contracted fibre that continues it at the tip, turning by at most 60 degrees, onto a node
/// that is neither on the path nor `occupied`. Equal fibres: the smaller node.
pub fn extend(path: &[usize], around: &Surroundings, occupied: &BTreeSet<usize>) -> Option<Vec<usize>> {
    let &[.., before, tip] = path else { return None };
    let direction = difference(around.positions[tip], around.positions[before]);
    let mut heaviest: Option<(f64, usize)> = None;
    for (&[a, b], &weight) in around.edges.iter().zip(around.weights) {
        let next = match tip {
            _ if a == tip => b,
            _ if b == tip => a,
            _ => continue,
        };
        let onward = difference(around.positions[next], around.positions[tip]);
        let continues = dot(direction, onward) >= CONTINUING_TURN_COS * norm(direction) * norm(onward);
        if weight <= 0.0 || !continues || path.contains(&next) || occupied.contains(&next) {
            continue;
        }
        if heaviest.is_none_or(|(most, node)| weight > most || (weight == most && next < node)) {
            heaviest = Some((weight, next));
        }
    }
    heaviest.map(|(_, next)| path.iter().copied().chain([next]).collect())
}

/// Extends one of several tendons without touching the others; false where nothing continues it.
fn extend_one(tendons: &mut [Vec<usize>], index: usize, around: &Surroundings) -> bool {
    let occupied = tendons.iter().flatten().copied().collect();
    let extended = extend(&tendons[index], around, &occupied);
    extended.map(|path| tendons[index] = path).is_some()
}

fn difference(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn norm(a: Point) -> f64 {
    a[0].hypot(a[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of two rows, the upper shifted by half: nodes 0..5 below, 5..10 above.
    fn strip() -> (Vec<Point>, Vec<[usize; 2]>) {
        let below = (0..5).map(|i| [10.0 * i as f64, 0.0]);
        let above = (0..5).map(|i| [10.0 * i as f64 + 5.0, 8.0]);
        let mut edges = Vec::new();
        for i in 0..5 {
            edges.push([i, i + 5]);
            if i < 4 {
                edges.extend([[i, i + 1], [i + 5, i + 6], [i + 1, i + 5]]);
            }
        }
        (below.chain(above).collect(), edges)
    }

    #[test]
    fn zigzags_take_the_direct_edge() {
        let (positions, edges) = strip();
        let weights = vec![0.0; edges.len()];
        let around = Surroundings { positions: &positions, edges: &edges, weights: &weights };
        assert_eq!(shorten(&[0, 5, 1, 6, 2, 7, 3], &around), [0, 1, 2, 3]);
        assert_eq!(smooth(&[0, 5, 1, 6, 2, 7, 3], &around, 0.1), [0, 3]);
        assert_eq!(shorten(&[0, 1, 1, 2, 1, 2], &around), [0, 1, 2]);
        assert_eq!(shorten(&[0, 1, 0], &around), [0, 1, 0]);
        assert_eq!(shorten(&[0, 9], &around), [0, 9]);
    }

    #[test]
    fn straightening_stays_within_the_tolerance_with_the_fewest_points() {
        let positions: Vec<Point> = (0..=40).map(|i| [i as f64, (i as f64 / 10.0).sin() * 5.0]).collect();
        let path: Vec<usize> = (0..=40).collect();
        let mut before = usize::MAX;
        for tolerance in [0.0, 0.01, 0.1, 0.5, 2.0, 20.0] {
            let kept = straighten(&path, &positions, tolerance);
            assert!(kept.len() <= before && kept[0] == 0 && kept[kept.len() - 1] == 40);
            before = kept.len();
            for pair in kept.windows(2) {
                assert!(deviation(&path[pair[0]..=pair[1]], &positions, tolerance).is_some());
            }
        }
        assert_eq!(before, 2);
        // Turning back is never straight.
        assert_eq!(straighten(&[0, 9, 4], &positions, 20.0), [0, 9, 4]);
        assert_eq!(straighten(&[7], &positions, 1.0), [7]);
        assert!(straighten(&[], &positions, 1.0).is_empty());
    }

    #[test]
    fn the_heaviest_continuing_fibre_extends_the_tip() {
        let (positions, edges) = strip();
        let weight = |edge: &[usize; 2]| if *edge == [2, 6] { 9.0 } else { (edge[0] + edge[1]) as f64 };
        let weights: Vec<f64> = edges.iter().map(weight).collect();
        let around = Surroundings { positions: &positions, edges: &edges, weights: &weights };
        // Backwards to 6 would be the heaviest; ahead lie 3 and, within 60 degrees, 7.
        assert_eq!(extend(&[1, 2], &around, &BTreeSet::new()), Some(vec![1, 2, 7]));
        assert_eq!(extend(&[1, 2], &around, &BTreeSet::from([7])), Some(vec![1, 2, 3]));
        assert_eq!(extend(&[1, 2], &around, &BTreeSet::from([3, 7])), None);
    }

    #[test]
    fn variants_are_distinct_routings() {
        let (positions, edges) = strip();
        let weights = vec![1.0; edges.len()];
        let around = Surroundings { positions: &positions, edges: &edges, weights: &weights };
        let tendons = vec![vec![1, 6, 2, 3], vec![1, 0]];
        let found = variants(&tendons, &around, 0.5);
        assert!(found.len() >= 3, "{found:?}");
        for (index, variant) in found.iter().enumerate() {
            assert!(*variant != tendons && !found[..index].contains(variant));
            assert!(variant.iter().all(|path| path[0] == 1 && path.windows(2).all(|pair| pair[0] != pair[1])));
        }
    }
}
