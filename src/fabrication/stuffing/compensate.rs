//! A pattern that has the drawn silhouette when it is stuffed.

use super::shape::{Shape, over, refined};
use crate::design::Design;
use crate::mesh::Mesh;
use crate::outline::polygon::{distance_to_segment, length, nearest_parameter};
use crate::outline::{Outline, Point};

/// Most triangles of a body whose pattern is compensated.
const MOST_TRIANGLES: usize = 4000;
/// How near to the drawn silhouette the stuffed one comes, as a part of the body's length, and how near is aimed at.
const WITHIN: f64 = 0.01;
const AIM: f64 = 0.004;
/// Most rounds of moving the rim by what is missing.
const ROUNDS: usize = 30;
/// Rounds without a nearer one, by this part, after which one that is near enough is as good as it gets.
const PATIENCE: usize = 3;
const NEARER: f64 = 0.98;
/// The part of what is missing that the rim is moved by, how often the moves of neighbours are averaged, and the longest move over the body's length:
/// all of it at once makes curved tubes swing from one side to the other.
const PART: f64 = 0.7;
const MEANS: usize = 1;
const STEP: f64 = 0.05;
/// Sweeps that spread a change of the rim over the inside.
const SWEEPS: usize = 200;

/// Why there is no such pattern.
#[derive(Clone, Debug, PartialEq)]
pub enum Impossible {
    /// Parts of the pattern would lie over each other.
    Overlap(Point),
    /// The stuffed silhouette stays this far from the drawn one, mm.
    Off(f64),
    /// The body has too many triangles to be solved again and again.
    TooFine,
}

/// A design of the same plushie whose outline is what has to be cut, so that the body is as drawn when it is stuffed: its rim is moved by what
/// is missing, round by round. Everything that is fixed to the body moves along.
///
/// # Errors
/// Parts of the pattern would overlap, or it cannot be done to a hundredth of the body's length.
pub fn compensated(design: &Design) -> Result<Design, Impossible> {
    if design.mesh.triangles.len() > MOST_TRIANGLES {
        return Err(Impossible::TooFine);
    }
    let rim = design.mesh.boundary();
    let drawn = design.outline.near();
    let mut mesh = design.mesh.clone();
    let mut before: Option<Vec<[f64; 3]>> = None;
    let mut best: Option<(f64, Vec<Point>)> = None;
    let mut since = 0;
    let size = design.mesh.body_length();
    for _ in 0..ROUNDS {
        let fine = refined(&mesh);
        let shape = Shape::of(&fine, before.as_deref());
        // The nodes of a mesh keep their numbers in a finer one.
        let seen = over(&rim, &design.mesh.nodes, &shape.seen);
        let on_rim = fine.boundary().into_iter().flatten();
        let off = on_rim.map(|i| drawn.distance(seen[i])).fold(0.0, f64::max);
        let reached = best.as_ref().map_or(f64::INFINITY, |best| best.0);
        since = if off < NEARER * reached { 0 } else { since + 1 };
        if off < reached && shape.is_settled {
            best = Some((off, mesh.nodes.clone()));
        }
        if off <= AIM * size || (since > PATIENCE && reached <= WITHIN * size) {
            break;
        }
        spread(&mut mesh, &moves(&rim, &design.mesh.nodes, &seen, STEP * size));
        if let Some(at) = overlap(&mesh, &rim) {
            // What was reached before may do.
            match &best {
                Some((off, _)) if *off <= WITHIN * size => break,
                _ => return Err(Impossible::Overlap(at)),
            }
        }
        before = Some(shape.nodes);
    }
    let (off, nodes) = best.unwrap_or((f64::INFINITY, mesh.nodes.clone()));
    if off > WITHIN * size {
        return Err(Impossible::Off(off));
    }
    Ok(with_nodes(design, &rim, nodes))
}

/// The moves of the rim's nodes: a part of what is missing to the drawn places, the mean of neighbours, no longer than `longest`.
fn moves(rim: &[Vec<usize>], drawn: &[Point], seen: &[Point], longest: f64) -> Vec<(usize, Point)> {
    let mut moves = Vec::new();
    for ring in rim {
        let mut missing: Vec<Point> = ring.iter().map(|&i| [0, 1].map(|k| PART * (drawn[i][k] - seen[i][k]))).collect();
        let n = missing.len();
        for _ in 0..MEANS {
            let own = missing.clone();
            for k in 0..n {
                let (a, b) = (own[(k + n - 1) % n], own[(k + 1) % n]);
                missing[k] = [0, 1].map(|c| 0.25 * a[c] + 0.5 * own[k][c] + 0.25 * b[c]);
            }
        }
        moves.extend(ring.iter().zip(missing).map(|(&i, d)| {
            let whole = length(d, [0.0; 2]);
            (i, if whole > longest { d.map(|v| v * longest / whole) } else { d })
        }));
    }
    moves
}

/// Moves the rim, and the inside as a membrane that is fixed to it (every node by the mean of its neighbours).
fn spread(mesh: &mut Mesh, moves: &[(usize, Point)]) {
    let mut by = vec![[0.0; 2]; mesh.nodes.len()];
    let mut is_fixed = vec![false; mesh.nodes.len()];
    for &(node, d) in moves {
        (by[node], is_fixed[node]) = (d, true);
    }
    let mut beside = vec![Vec::new(); mesh.nodes.len()];
    for [a, b] in mesh.edges() {
        beside[a].push(b);
        beside[b].push(a);
    }
    for _ in 0..SWEEPS {
        for node in (0..mesh.nodes.len()).filter(|&n| !is_fixed[n] && !beside[n].is_empty()) {
            let count = beside[node].len() as f64;
            by[node] = [0, 1].map(|k| beside[node].iter().map(|&n| by[n][k]).sum::<f64>() / count);
        }
    }
    for (p, d) in mesh.nodes.iter_mut().zip(by) {
        *p = [p[0] + d[0], p[1] + d[1]];
    }
}

/// A place where a mesh folds over or its rim crosses itself.
fn overlap(mesh: &Mesh, rim: &[Vec<usize>]) -> Option<Point> {
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|n| mesh.nodes[n]);
        if (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0.0 {
            return Some(a);
        }
    }
    let sides: Vec<[usize; 2]> =
        rim.iter().flat_map(|ring| (0..ring.len()).map(move |i| [ring[i], ring[(i + 1) % ring.len()]])).collect();
    for (i, s) in sides.iter().enumerate() {
        for t in sides[i + 1..].iter().filter(|t| !s.iter().any(|n| t.contains(n))) {
            let [a, b, c, d] = [s[0], s[1], t[0], t[1]].map(|n| mesh.nodes[n]);
            let side = |p: Point, q: Point, r: Point| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            if side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0 {
                return Some(a);
            }
        }
    }
    None
}

/// The design on moved nodes: points of its outline move as the rim of the mesh beside them does.
fn with_nodes(design: &Design, rim: &[Vec<usize>], nodes: Vec<Point>) -> Design {
    let sides: Vec<[usize; 2]> =
        rim.iter().flat_map(|ring| (0..ring.len()).map(move |i| [ring[i], ring[(i + 1) % ring.len()]])).collect();
    let old = &design.mesh.nodes;
    let moved = |p: &Point| {
        let side = sides.iter().min_by(|s, t| {
            let away = |s: &[usize; 2]| distance_to_segment(old[s[0]], old[s[1]], *p);
            away(s).total_cmp(&away(t))
        });
        let Some(&[a, b]) = side else { return *p };
        let t = nearest_parameter(old[a], old[b], *p);
        [0, 1].map(|k| p[k] + (1.0 - t) * (nodes[a][k] - old[a][k]) + t * (nodes[b][k] - old[b][k]))
    };
    let ring = |ring: &Vec<Point>| ring.iter().map(moved).collect();
    let outline =
        Outline { outer: ring(&design.outline.outer), holes: design.outline.holes.iter().map(ring).collect() };
    let mut mesh = design.mesh.clone();
    mesh.nodes = nodes;
    Design { outline, mesh, ..design.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::stuffing::stuffed;

    #[test]
    fn a_compensated_pattern_has_the_drawn_silhouette() {
        let ring: Vec<Point> = (0..60)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 60.0)
            .map(|a| [90.0 * a.cos(), 60.0 * a.sin()])
            .collect();
        let outline = Outline { outer: ring, holes: vec![] };
        let mesh = crate::mesh::generate(&outline, 200).unwrap();
        let design = Design::new("egg", outline, mesh);
        let cut = compensated(&design).expect("an egg");
        assert!(cut.outline.area() > 1.4 * design.outline.area());
        // From the flat pattern, as a hand stuffs it, and not from what the search for it knew.
        let found = stuffed(&cut, &design);
        assert!(found.is_settled && found.off_mm <= WITHIN * design.mesh.body_length(), "{}", found.off_mm);
    }

    /// Curved tubes curl, arms that the felt pulls swing: what `off_mm` says is what the printed silhouette shows.
    #[test]
    fn arms_that_swing_are_cut_so_that_they_come_to_lie_as_drawn() {
        let outer = [
            [0.0, 0.0],
            [150.0, 0.0],
            [150.0, 35.0],
            [40.0, 35.0],
            [40.0, 105.0],
            [150.0, 105.0],
            [150.0, 140.0],
            [0.0, 140.0],
        ];
        let outline = Outline { outer: outer.to_vec(), holes: vec![] };
        let mesh = crate::mesh::generate(&outline, 200).unwrap();
        let design = Design::new("c", outline, mesh);
        let size = design.mesh.body_length();
        let uncut = stuffed(&design, &design);
        assert!(uncut.is_settled && uncut.off_mm > 0.05 * size, "{}", uncut.off_mm);
        let cut = compensated(&design).expect("arms that are far apart");
        let found = stuffed(&cut, &design);
        let drawn = design.outline.near();
        let farthest = found.rings[0].iter().map(|&p| drawn.distance(p)).fold(0.0, f64::max);
        assert!(found.is_settled && found.off_mm == farthest, "{} {farthest}", found.off_mm);
        assert!(farthest <= WITHIN * size, "{farthest} of {size}");
    }
}
