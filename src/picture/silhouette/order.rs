//! What of a body lies on top where it is folded over itself: limbs lie over the trunk, whole limbs over others, slender ones over stout ones.
//!
//! Distances are those of triangles through the body from where it is thickest. From the farthest triangle inward the pieces of the body
//! that are farther than a distance grow together; where two of them meet that both reach far out, they are limbs, and what they meet in
//! is the trunk, or a larger limb that they sprout from.

use crate::outline::{Point, polygon};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// How far a limb reaches out of what it sprouts from, in parts of the greatest distance. Smaller: bumps are limbs.
const LEAST_REACH: f64 = 0.15;

/// A piece of the body that grows.
#[derive(Clone, Default)]
struct Piece {
    farthest: f64,
    /// Those that are of no limb yet.
    triangles: Vec<usize>,
    /// Limbs that sprout from it.
    limbs: Vec<usize>,
}

/// A limb, or the trunk.
struct Limb {
    triangles: Vec<usize>,
    /// Those that sprout from it.
    limbs: Vec<usize>,
    /// With those.
    stoutness: f64,
}

/// The triangles in an order in which they can be painted: the trunk first, limbs after what they sprout from, each without a break. Of limbs that
/// could be next it is the stoutest: a leg that crosses a head crosses the neck as well, and neither is to end in the middle of it.
pub fn ordered(rest: &[Point], triangles: Vec<[usize; 3]>, heights: &[f64]) -> Vec<[usize; 3]> {
    let beside = neighbours(&triangles);
    let distances = distances(rest, &triangles, heights, &beside);
    let most = distances.iter().copied().fold(0.0, f64::max);
    let mut inward: Vec<usize> = (0..triangles.len()).collect();
    inward.sort_by(|&a, &b| distances[b].total_cmp(&distances[a]).then(a.cmp(&b)));
    // Disjoint sets by their roots, and limbs from the tips inward.
    let mut parents: Vec<usize> = (0..triangles.len()).collect();
    let mut pieces: Vec<Option<Piece>> = vec![None; triangles.len()];
    let mut limbs: Vec<Limb> = Vec::new();
    let limb = |piece: &mut Piece, all: &[Limb]| {
        let (own, limbs) = (std::mem::take(&mut piece.triangles), std::mem::take(&mut piece.limbs));
        let own_stoutness = own.iter().map(|&t| stoutness(rest, triangles[t], heights));
        let stoutness = own_stoutness.chain(limbs.iter().map(|&limb| all[limb].stoutness)).fold(0.0, |a, b| a + b);
        Limb { triangles: own, limbs, stoutness }
    };
    for &here in &inward {
        let at = distances[here];
        pieces[here] = Some(Piece { farthest: at, triangles: vec![here], limbs: Vec::new() });
        for &other in &beside[here] {
            let (own, other) = (root(&mut parents, here), root(&mut parents, other));
            if own == other || pieces[other].is_none() {
                continue;
            }
            let (Some(mut a), Some(mut b)) = (pieces[own].take(), pieces[other].take()) else { continue };
            if a.farthest.min(b.farthest) - at > LEAST_REACH * most {
                for piece in [&mut a, &mut b] {
                    let grown = limb(piece, &limbs);
                    limbs.push(grown);
                    piece.limbs.push(limbs.len() - 1);
                }
            }
            a.triangles.append(&mut b.triangles);
            a.limbs.append(&mut b.limbs);
            parents[other] = own;
            pieces[own] = Some(Piece { farthest: a.farthest.max(b.farthest), ..a });
        }
    }
    let mut painted = Vec::with_capacity(triangles.len());
    for mut trunk in pieces.into_iter().flatten() {
        let trunk = limb(&mut trunk, &limbs);
        limbs.push(trunk);
        // Stoutness is not negative, nor is its zero: its bits are in its order.
        let mut next = BinaryHeap::from([(0, limbs.len() - 1)]);
        while let Some((_, limb)) = next.pop() {
            let Limb { triangles: group, limbs: sprouting, .. } = &mut limbs[limb];
            group.sort_unstable();
            painted.extend(group.iter().map(|&t| triangles[t]));
            let sprouting = std::mem::take(sprouting);
            next.extend(sprouting.into_iter().map(|limb| (limbs[limb].stoutness.to_bits(), limb)));
        }
    }
    painted
}

/// Its area by the mean of what tells how thick the body is there: a sum over a limb's triangles tells limbs apart.
fn stoutness(rest: &[Point], triangle: [usize; 3], heights: &[f64]) -> f64 {
    let area = polygon::signed_area(&triangle.map(|n| rest[n])).abs();
    area * triangle.iter().map(|&n| heights[n]).sum::<f64>() / 3.0
}

/// The root of a set; the way there is halved.
fn root(parents: &mut [usize], mut of: usize) -> usize {
    while parents[of] != of {
        parents[of] = parents[parents[of]];
        of = parents[of];
    }
    of
}

/// The triangles beside each triangle.
fn neighbours(triangles: &[[usize; 3]]) -> Vec<Vec<usize>> {
    let mut sides: HashMap<[usize; 2], usize> = HashMap::new();
    let mut beside = vec![Vec::new(); triangles.len()];
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        for side in [[a, b], [b, c], [c, a]] {
            let key = [side[0].min(side[1]), side[0].max(side[1])];
            if let Some(other) = sides.insert(key, t) {
                beside[t].push(other);
                beside[other].push(t);
            }
        }
    }
    beside
}

/// Lengths of the shortest ways from where the body is thickest, from middle to middle, mm.
fn distances(rest: &[Point], triangles: &[[usize; 3]], heights: &[f64], beside: &[Vec<usize>]) -> Vec<f64> {
    let middle = |t: usize| [0, 1].map(|k| triangles[t].iter().map(|&p| rest[p][k]).sum::<f64>() / 3.0);
    let thickness = |t: usize| triangles[t].iter().map(|&p| heights[p]).sum::<f64>();
    let mut lengths = vec![f64::INFINITY; triangles.len()];
    // Pieces that hang together in a point alone have a thickest place each.
    let mut by_thickness: Vec<usize> = (0..triangles.len()).collect();
    by_thickness.sort_by(|&a, &b| thickness(b).total_cmp(&thickness(a)).then(a.cmp(&b)));
    let mut heap = BinaryHeap::new();
    for start in by_thickness {
        if lengths[start].is_finite() {
            continue;
        }
        lengths[start] = 0.0;
        // Lengths are not negative: their bits are in their order.
        heap.push(Reverse((0_u64, start)));
        while let Some(Reverse((bits, t))) = heap.pop() {
            if f64::from_bits(bits) > lengths[t] {
                continue;
            }
            let from = middle(t);
            for &next in &beside[t] {
                let to = middle(next);
                let length = lengths[t] + (to[0] - from[0]).hypot(to[1] - from[1]);
                if length < lengths[next] {
                    lengths[next] = length;
                    heap.push(Reverse((length.to_bits(), next)));
                }
            }
        }
    }
    lengths
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points, triangles, and the letter of each triangle.
    type Body = (Vec<Point>, Vec<[usize; 3]>, Vec<(char, usize)>);

    /// Squares of 10 mm in two triangles each, where there are letters.
    fn body(rows: &[&str]) -> Body {
        let width = rows[0].len() + 1;
        let rest =
            (0..width * (rows.len() + 1)).map(|n| [10.0 * (n % width) as f64, -10.0 * (n / width) as f64]).collect();
        let (mut triangles, mut letters) = (Vec::new(), Vec::new());
        for (y, row) in rows.iter().enumerate() {
            for (x, letter) in row.chars().enumerate().filter(|(_, letter)| *letter != ' ') {
                let [a, b, c, d] = [y * width + x, y * width + x + 1, (y + 1) * width + x, (y + 1) * width + x + 1];
                letters.extend([(letter, triangles.len()), (letter, triangles.len() + 1)]);
                triangles.extend([[a, c, b], [b, c, d]]);
            }
        }
        (rest, triangles, letters)
    }

    #[test]
    fn limbs_are_painted_after_the_trunk_and_one_by_one() {
        let rows = [
            "a      b", "a      b", "a      b", "attttttb", " tttttt ", " tttttt ", " c    d ", " c    d ", " c    d ",
        ];
        let (rest, triangles, letters) = body(&rows);
        // Thickest in the middle.
        let heights: Vec<f64> = rest.iter().map(|p| 1e4 - (p[0] - 40.0).powi(2) - (p[1] + 45.0).powi(2)).collect();
        let painted = ordered(&rest, triangles.clone(), &heights);
        assert_eq!(painted.len(), triangles.len());
        let place = |t: usize| painted.iter().position(|of| *of == triangles[t]).unwrap();
        let places = |letter: char| -> Vec<usize> {
            // The tips: where a limb begins is the body's to say.
            letters
                .iter()
                .filter(|(of, t)| {
                    *of == letter && (rest[triangles[*t][0]][1] > -25.0 || rest[triangles[*t][0]][1] < -65.0)
                })
                .map(|&(_, t)| place(t))
                .collect()
        };
        let middle = letters.iter().filter(|(of, _)| *of == 't').map(|&(_, t)| place(t));
        let trunk: Vec<usize> = middle.filter(|&p| rest[painted[p][0]] == [40.0, -40.0]).collect();
        for limb in ['a', 'b', 'c', 'd'].map(places) {
            assert!(trunk.iter().all(|t| limb.iter().all(|l| l > t)), "{trunk:?} {limb:?}");
            let (first, last) = (limb.iter().min().unwrap(), limb.iter().max().unwrap());
            assert!(last - first < limb.len() + 4, "without a break: {limb:?}");
        }
    }

    #[test]
    fn slender_limbs_are_painted_after_stout_ones() {
        // Two arms, one thrice as wide, whichever side it is on.
        let rows = ["aaa  b", "aaa  b", "aaa  b", "aaa  b", "tttttt", "tttttt", "tttttt"];
        let turned: Vec<String> = rows.iter().map(|row| row.chars().rev().collect()).collect();
        let turned: Vec<&str> = turned.iter().map(String::as_str).collect();
        for rows in [&rows[..], &turned] {
            let (rest, triangles, letters) = body(rows);
            let heights: Vec<f64> = rest.iter().map(|p| 1e4 - (p[0] - 30.0).powi(2) - (p[1] + 70.0).powi(2)).collect();
            let painted = ordered(&rest, triangles.clone(), &heights);
            let tips = |letter: char| -> Vec<usize> {
                let at_tip = letters.iter().filter(|(of, t)| *of == letter && rest[triangles[*t][0]][1] > -15.0);
                at_tip.map(|(_, t)| painted.iter().position(|of| *of == triangles[*t]).unwrap()).collect()
            };
            assert!(tips('a').iter().max() < tips('b').iter().min(), "{:?} {:?}", tips('a'), tips('b'));
        }
    }

    #[test]
    fn a_body_without_limbs_stays_as_it_is() {
        let (rest, triangles, _) = body(&["ttt", "ttt", "ttt"]);
        let heights = vec![1.0; rest.len()];
        assert_eq!(ordered(&rest, triangles.clone(), &heights), triangles);
    }
}
