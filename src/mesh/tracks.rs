//! Tracks: lines inside the body along which edges run, so that a thread can follow them.

use super::grid::Grid;
use super::search::WorkBudget;
use crate::outline::{Outline, Point, polygon};
use std::collections::{BTreeMap, BTreeSet};

/// Nearest that a track comes to the boundary, in spacings: what is nearer is cut off, for it would force flat triangles.
const CLEARANCE: f64 = 0.45;
/// Nodes of tracks nearer to each other than this, in spacings, become one.
const MERGE: f64 = 0.3;

/// Nodes of the tracks and the edges between them.
#[derive(Clone, Debug, Default)]
pub(super) struct Sampled {
    pub nodes: Vec<Point>,
    pub segments: Vec<[usize; 2]>,
}

/// Longest segment, in spacings: one and a half steps, and what joining adds at either end, with room for rounding.
const LONGEST: f64 = 1.5 + 2.0 * MERGE + 0.1;
/// Most nodes of the tracks on an area of one spacing squared: twice those of an even mesh.
const MOST: f64 = 2.3;
/// Units of work for a stop, of which the distance from the rim takes most; and how many tries for a crossing weigh one.
const STOP_WORK: usize = 10;
const TRIES: usize = 20;

/// The tracks with a node about every `h`, where they cross each other, and at their own corners; only where they run well
/// inside the body. Nodes closer than a fraction of `h` are joined, so that lines drawn nearly alike become one. `None` where
/// they fill the body with more nodes than a mesh has room for; what it took to find that out is spent as well.
pub(super) fn sample(tracks: &[Vec<Point>], outline: &Outline, h: f64, budget: &WorkBudget) -> Option<Sampled> {
    let mut sampled = Sampled::default();
    if tracks.is_empty() {
        return Some(sampled);
    }
    let most = (MOST * outline.area() / (h * h)) as usize + 2 * tracks.len();
    let bounds = outline.bounding_box();
    let rim = Grid::new(outline.polygons().flat_map(polygon::sides).collect());
    let pieces: Vec<(Point, Point)> = tracks.iter().flat_map(|t| t.windows(2).map(|w| (w[0], w[1]))).collect();
    let mut places = Places::new(MERGE * h);
    let mut known = BTreeSet::new();
    budget.spend(pieces.len() * pieces.len() / TRIES);
    // Corners first, so that what falls together with them goes there.
    for &p in tracks.iter().flatten().filter(|&&p| outline.contains(p) && rim.distance(p) > CLEARANCE * h) {
        places.put(p);
    }
    for track in tracks {
        let mut before: Option<usize> = None;
        for (k, w) in track.windows(2).enumerate() {
            for t in stops((w[0], w[1]), &pieces, bounds, h, k == 0) {
                let p = polygon::lerp(w[0], w[1], t);
                let inside = outline.contains(p) && rim.distance(p) > CLEARANCE * h;
                let node = inside.then(|| places.put(p));
                budget.spend(STOP_WORK);
                if let (Some(a), Some(b)) = (before, node)
                    && a != b
                {
                    let segment = [a.min(b), a.max(b)];
                    if known.insert(segment) && clear(&rim, places.nodes[a], places.nodes[b], h) {
                        sampled.segments.push(segment);
                    }
                }
                before = node;
            }
            if places.nodes.len() > most {
                return None;
            }
        }
    }
    sampled.nodes = places.nodes;
    without_crossings(&mut sampled, LONGEST * h);
    Some(sampled)
}

/// Parameters of the nodes along a piece: its ends, its crossings with all pieces, and even steps between them. What is
/// outside of the body's box, however long, takes no steps.
fn stops((a, b): (Point, Point), pieces: &[(Point, Point)], bounds: (Point, Point), h: f64, first: bool) -> Vec<f64> {
    let mut fixed = vec![0.0, 1.0];
    let (enters, leaves) = within(a, b, bounds);
    fixed.extend([enters, leaves].into_iter().filter(|&t| enters < leaves && t > 0.0 && t < 1.0));
    fixed.extend(pieces.iter().filter_map(|&(c, d)| meet(a, b, c, d)));
    fixed.sort_by(f64::total_cmp);
    fixed.dedup();
    let length = polygon::length(a, b);
    let mut all = if first { vec![0.0] } else { Vec::new() };
    for w in fixed.windows(2) {
        let inside = (enters..leaves).contains(&(0.5 * (w[0] + w[1])));
        let steps = if inside { ((w[1] - w[0]) * length / h).round().max(1.0) as usize } else { 1 };
        all.extend((1..=steps).map(|k| w[0] + (w[1] - w[0]) * k as f64 / steps as f64));
    }
    all
}

/// The parameters between which `ab` runs in a box; the first is not the smaller one where it does not.
fn within(a: Point, b: Point, (low, high): (Point, Point)) -> (f64, f64) {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let along = b[axis] - a[axis];
        if along == 0.0 {
            if a[axis] < low[axis] || a[axis] > high[axis] {
                return (1.0, 0.0);
            }
            continue;
        }
        let (s, t) = ((low[axis] - a[axis]) / along, (high[axis] - a[axis]) / along);
        enters = enters.max(s.min(t));
        leaves = leaves.min(s.max(t));
    }
    (enters, leaves)
}

/// Where on `ab`, between its ends, `cd` crosses it.
fn meet(a: Point, b: Point, c: Point, d: Point) -> Option<f64> {
    let (r, s, q) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]], [c[0] - a[0], c[1] - a[1]]);
    let cross = |u: Point, v: Point| u[0] * v[1] - u[1] * v[0];
    let (t, u) = (cross(q, s) / cross(r, s), cross(q, r) / cross(r, s));
    (t > 0.0 && t < 1.0 && (0.0..=1.0).contains(&u)).then_some(t)
}

/// Nodes, no two of them nearer than a distance; looked up by cells of that size.
struct Places {
    nodes: Vec<Point>,
    near: f64,
    cells: BTreeMap<[i64; 2], Vec<usize>>,
}

impl Places {
    fn new(near: f64) -> Self {
        Self { nodes: Vec::new(), near, cells: BTreeMap::new() }
    }

    /// The first node near `p`, or a new one there.
    fn put(&mut self, p: Point) -> usize {
        let cell = p.map(|v| (v / self.near).floor() as i64);
        let found = around(cell).filter_map(|cell| self.cells.get(&cell)).flatten().copied();
        let found = found.filter(|&n| polygon::length(self.nodes[n], p) < self.near).min();
        found.unwrap_or_else(|| {
            self.nodes.push(p);
            self.cells.entry(cell).or_default().push(self.nodes.len() - 1);
            self.nodes.len() - 1
        })
    }
}

/// A cell and its eight neighbours.
fn around([x, y]: [i64; 2]) -> impl Iterator<Item = [i64; 2]> {
    (-1..=1).flat_map(move |i| (-1..=1).map(move |j| [x.saturating_add(i), y.saturating_add(j)]))
}

fn clear(rim: &Grid, a: Point, b: Point, h: f64) -> bool {
    (1..4).all(|k| rim.distance(polygon::lerp(a, b, f64::from(k) / 4.0)) > 0.5 * CLEARANCE * h)
}

/// Joining nodes may have made segments cross; the later ones go. Nodes without a segment go too. No segment is longer than
/// `longest`.
fn without_crossings(sampled: &mut Sampled, longest: f64) {
    let nodes = &sampled.nodes;
    let mut kept: Vec<[usize; 2]> = Vec::new();
    // Segments by where their middles are: those of two that cross are no farther apart than either is long.
    let mut cells: BTreeMap<[i64; 2], Vec<[usize; 2]>> = BTreeMap::new();
    for &[a, b] in &sampled.segments {
        let cell = polygon::lerp(nodes[a], nodes[b], 0.5).map(|v| (v / longest).floor() as i64);
        let mut near = around(cell).filter_map(|cell| cells.get(&cell)).flatten();
        let crosses = near.any(|&[c, d]| {
            ![c, d].contains(&a) && ![c, d].contains(&b) && meet(nodes[a], nodes[b], nodes[c], nodes[d]).is_some()
        });
        if !crosses {
            cells.entry(cell).or_default().push([a, b]);
            kept.push([a, b]);
        }
    }
    let mut number = vec![None; nodes.len()];
    let mut used = Vec::new();
    for n in kept.iter_mut().flatten() {
        let p = sampled.nodes[*n];
        *n = *number[*n].get_or_insert_with(|| {
            used.push(p);
            used.len() - 1
        });
    }
    *sampled = Sampled { nodes: used, segments: kept };
}
