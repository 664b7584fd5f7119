//! The rim of a mesh, and drawn points tied to it.
//!
//! Along a stretch of rim from node a to node b (length h, from 0 to 1 by t) runs the cubic curve through both with tangents that are
//! the mean direction of the rim at its nodes (Hermite). A drawn point P at rest hangs on the curve C at its t by the offset P - C(t).
//! In a pose the tangents and the offset are turned and stretched as the rim around the nodes is: by the complex number
//! c = sum conj(E) e / sum |E|^2 over the two edges of a node (E at rest, e in the pose: the nearest similarity), eased between the two.
//! All of that is smooth from stretch to stretch, exact at rest and for every motion that leaves the shape as it is; corners of the
//! drawing stay corners.

use crate::mesh::Mesh;
use crate::outline::{Outline, Point, polygon};

/// An outline is that of a rim whose nodes are no farther from it than this part of the rim's mean edge.
const BESIDE: f64 = 0.25;
/// Drawn points are at most this part of the body's length apart, so that straight sides bend smoothly.
const LONGEST_STEP: f64 = 1.0 / 320.0;
/// And not nearer than this part of it: finer detail is not seen.
const SHORTEST_STEP: f64 = 1.0 / 3000.0;
/// Points on each stretch of a rim whose outline is not known, at least.
const LEAST_POINTS: usize = 4;
/// A node that turns such a rim by more than this is a corner, rad: round bodies of a coarse mesh turn by less.
const CORNER_RAD: f64 = 0.9;
/// Longest way along the outline between neighbouring nodes, times their distance: more is another part of the body.
const LONGEST_WAY: f64 = 4.0;

/// The rims of a mesh at rest and the points that are drawn along them.
#[derive(Clone, Debug, PartialEq)]
pub struct Rim {
    nodes: usize,
    /// Node, and the nodes before and after it on its rim.
    around: Vec<[usize; 3]>,
    /// Number in `around` of each node; none for those inside.
    number: Vec<Option<usize>>,
    /// Directions of the edge after each node at rest, mm, in the order of `around`.
    after: Vec<[f64; 2]>,
    pub rings: Vec<Vec<Stretch>>,
}

/// The rim from a node to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    pub from: usize,
    pub to: usize,
    /// Part of the way, 0 at first, always below 1, and the drawn place there, mm.
    pub points: Vec<(f64, Point)>,
}

/// A drawn point on a stretch of rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tie {
    ends: [usize; 2],
    /// In [`Rim::turns`].
    numbers: [usize; 2],
    /// Weights of the ends.
    weights: [f64; 2],
    /// Tangents at rest with their weights, mm.
    tangents: [[f64; 2]; 2],
    /// How much of the turn is that of the second end.
    eased: f64,
    /// From the curve to the point at rest, mm.
    offset: [f64; 2],
}

impl Rim {
    /// The rims of a mesh with the points of an outline along them.
    pub fn drawn(mesh: &Mesh, outline: &Outline) -> Self {
        let body_length = mesh.body_length();
        let loops = mesh.boundary();
        let mut rim = Self::bare(mesh, &loops);
        let rings = loops.iter().map(|ring| {
            let places: Vec<Point> = ring.iter().map(|&n| mesh.nodes[n]).collect();
            let known = outline.polygons().find_map(|drawn| along(&places, drawn, body_length));
            let stretches = known.unwrap_or_else(|| smooth(&places, LONGEST_STEP * body_length));
            let next = |i: usize| ring[(i + 1) % ring.len()];
            stretches
                .into_iter()
                .enumerate()
                .map(|(i, points)| Stretch { from: ring[i], to: next(i), points })
                .collect()
        });
        rim.rings = rings.collect();
        rim
    }

    fn bare(mesh: &Mesh, loops: &[Vec<usize>]) -> Self {
        let mut number = vec![None; mesh.nodes.len()];
        let (mut around, mut after) = (Vec::new(), Vec::new());
        for ring in loops {
            let count = ring.len();
            for (i, &node) in ring.iter().enumerate() {
                number[node] = Some(around.len());
                let [before, next] = [ring[(i + count - 1) % count], ring[(i + 1) % count]];
                around.push([node, before, next]);
                after.push(between(mesh.nodes[node], mesh.nodes[next]));
            }
        }
        Self { nodes: mesh.nodes.len(), around, number, after, rings: Vec::new() }
    }

    /// How the rim is turned and stretched at each of its nodes, as complex numbers; `None` for nodes of another mesh.
    pub fn turns(&self, nodes: &[Point]) -> Option<Vec<[f64; 2]>> {
        if nodes.len() != self.nodes {
            return None;
        }
        let turn = |(&[node, before, next], rest): (&[usize; 3], &[f64; 2])| {
            let behind = self.number[before].map_or([0.0; 2], |k| self.after[k]);
            let (first, second) = (between(nodes[before], nodes[node]), between(nodes[node], nodes[next]));
            let whole = dot(behind, behind) + dot(*rest, *rest);
            let [p, q] = [times(conjugate(behind), first), times(conjugate(*rest), second)];
            if whole > 0.0 { [(p[0] + q[0]) / whole, (p[1] + q[1]) / whole] } else { [1.0, 0.0] }
        };
        Some(self.around.iter().zip(&self.after).map(turn).collect())
    }

    /// Ties a point of a stretch.
    pub fn tie(&self, mesh: &Mesh, stretch: &Stretch, (t, place): (f64, Point)) -> Tie {
        let ends = [stretch.from, stretch.to];
        let numbers = ends.map(|n| self.number[n].unwrap_or_default());
        let length = polygon::length(mesh.nodes[ends[0]], mesh.nodes[ends[1]]);
        let [h00, h10, h01, h11] = hermite(t);
        let tangents = [(0, h10), (1, h11)].map(|(k, h)| self.direction(numbers[k]).map(|d| h * length * d));
        let mut tie = Tie { ends, numbers, weights: [h00, h01], tangents, eased: h01, offset: [0.0; 2] };
        let ones = vec![[1.0, 0.0]; self.around.len()];
        tie.offset = between(tie.place(&mesh.nodes, &ones), place);
        tie
    }

    /// The direction of the rim at a node at rest, of about unit length: of the edge beside it that is shorter the more.
    fn direction(&self, number: usize) -> [f64; 2] {
        let before = self.number[self.around[number][1]].map_or([0.0; 2], |k| self.after[k]);
        let after = self.after[number];
        let [p, q] = [dot(before, before).sqrt(), dot(after, after).sqrt()].map(|l| l.max(f64::MIN_POSITIVE));
        [0, 1].map(|k| (q * before[k] / p + p * after[k] / q) / (p + q))
    }
}

impl Tie {
    /// Where the point is, mm.
    pub fn place(&self, nodes: &[Point], turns: &[[f64; 2]]) -> Point {
        let [a, b] = self.numbers.map(|k| turns[k]);
        let turn = [0, 1].map(|k| a[k] + self.eased * (b[k] - a[k]));
        let parts = [times(a, self.tangents[0]), times(b, self.tangents[1]), times(turn, self.offset)];
        [0, 1].map(|k| {
            let ends = self.weights[0] * nodes[self.ends[0]][k] + self.weights[1] * nodes[self.ends[1]][k];
            ends + parts.iter().map(|p| p[k]).sum::<f64>()
        })
    }
}

/// The points of a drawn polygon on each stretch between places of a rim; `None` where it is the outline of another rim, or that of the
/// mesh itself: a file's own mesh has no other.
fn along(places: &[Point], drawn: &[Point], body_length: f64) -> Option<Vec<Vec<(f64, Point)>>> {
    if drawn.len() == places.len() && places.iter().all(|p| drawn.contains(p)) {
        return None;
    }
    let mut arcs = vec![0.0];
    arcs.extend(polygon::sides(drawn).scan(0.0, |sum, (a, b)| {
        *sum += polygon::length(a, b);
        Some(*sum)
    }));
    let whole = *arcs.last()?;
    let mean = polygon::perimeter(places) / places.len().max(1) as f64;
    let stops: Option<Vec<f64>> = places
        .iter()
        .map(|&p| {
            let (distance, arc) = nearest(drawn, &arcs, p)?;
            (distance <= BESIDE * mean).then_some(arc)
        })
        .collect();
    let stops = stops?;
    let way = |i: usize| (stops[(i + 1) % stops.len()] - stops[i]).rem_euclid(whole);
    let once: f64 = (0..stops.len()).map(way).sum();
    let is_beside = |i: usize| {
        let straight = polygon::length(places[i], places[(i + 1) % places.len()]);
        way(i) > 0.0 && way(i) <= LONGEST_WAY * straight + mean
    };
    if (once - whole).abs() > 1e-6 * whole || !(0..stops.len()).all(is_beside) {
        return None;
    }
    let corners = Corners { drawn, arcs: &arcs, whole };
    let steps = [SHORTEST_STEP, LONGEST_STEP].map(|step| step * body_length);
    Some((0..stops.len()).map(|i| corners.between(stops[i], way(i), steps)).collect())
}

/// The distance of a place from a polygon, and how far along the nearest point of it is, mm.
fn nearest(drawn: &[Point], arcs: &[f64], p: Point) -> Option<(f64, f64)> {
    let sides = polygon::sides(drawn).enumerate().map(|(k, (a, b))| {
        let t = polygon::nearest_parameter(a, b, p);
        (polygon::length(p, polygon::lerp(a, b, t)), arcs[k] + t * (arcs[k + 1] - arcs[k]))
    });
    sides.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// A drawn polygon with the ways to its corners, mm.
struct Corners<'a> {
    drawn: &'a [Point],
    arcs: &'a [f64],
    whole: f64,
}

impl Corners<'_> {
    /// Points from `start` on for a `way`: all corners but those nearer than a step to the one before, and more where they are far apart.
    fn between(&self, start: f64, way: f64, [shortest, longest]: [f64; 2]) -> Vec<(f64, Point)> {
        let count = self.drawn.len();
        let first = self.arcs[..count].partition_point(|&arc| arc <= start);
        let ahead = (0..count).map(|k| (first + k) % count).map(|k| (self.arcs[k] - start).rem_euclid(self.whole));
        let mut stops: Vec<f64> = vec![0.0];
        for at in ahead.take_while(|&at| at < way) {
            if at - stops[stops.len() - 1] > shortest && way - at > shortest {
                stops.push(at);
            }
        }
        stops.push(way);
        let mut points = Vec::new();
        for pair in stops.windows(2) {
            let parts = ((pair[1] - pair[0]) / longest).ceil().max(1.0);
            for k in 0..parts as usize {
                let at = pair[0] + (pair[1] - pair[0]) * k as f64 / parts;
                points.push((at / way, self.at(start + at)));
            }
        }
        points
    }

    fn at(&self, arc: f64) -> Point {
        let arc = arc.rem_euclid(self.whole);
        let count = self.drawn.len();
        let k = self.arcs.partition_point(|&a| a <= arc).clamp(1, count) - 1;
        let length = self.arcs[k + 1] - self.arcs[k];
        let t = if length > 0.0 { ((arc - self.arcs[k]) / length).clamp(0.0, 1.0) } else { 0.0 };
        polygon::lerp(self.drawn[k], self.drawn[(k + 1) % count], t)
    }
}

/// A smooth curve through the places of a rim that keeps its corners, and straight sides straight, by points that are no farther apart than
/// `longest`.
fn smooth(places: &[Point], longest: f64) -> Vec<Vec<(f64, Point)>> {
    let count = places.len();
    let edge = |i: usize| between(places[i % count], places[(i + 1) % count]);
    let unit = |v: [f64; 2]| {
        let length = dot(v, v).sqrt().max(f64::MIN_POSITIVE);
        v.map(|x| x / length)
    };
    let turn = |i: usize| {
        let (a, b) = (edge(i + count - 1), edge(i));
        (a[0] * b[1] - a[1] * b[0]).atan2(dot(a, b)).abs()
    };
    let mean = |i: usize| {
        let (a, b) = (unit(edge(i + count - 1)), unit(edge(i)));
        unit([a[0] + b[0], a[1] + b[1]])
    };
    // At a corner each side goes its own way.
    let tangent =
        |node: usize, side: usize| if turn(node % count) > CORNER_RAD { unit(edge(side)) } else { mean(node % count) };
    let stretch = |i: usize| {
        let (a, b) = (places[i], places[(i + 1) % count]);
        let length = polygon::length(a, b);
        let (m, n) = (tangent(i, i), tangent(i + 1, i));
        let count = ((length / longest).ceil() as usize).max(LEAST_POINTS);
        let points = (0..count).map(|k| {
            let t = k as f64 / count as f64;
            let [h00, h10, h01, h11] = hermite(t);
            (t, [0, 1].map(|k| h00 * a[k] + h01 * b[k] + length * (h10 * m[k] + h11 * n[k])))
        });
        points.collect()
    };
    (0..count).map(stretch).collect()
}

/// Weights of the first end, its tangent, the second end and its tangent.
fn hermite(t: f64) -> [f64; 4] {
    let (s, t2) = (1.0 - t, t * t);
    [(1.0 + 2.0 * t) * s * s, t * s * s, t2 * (3.0 - 2.0 * t), -t2 * s]
}

fn between(a: Point, b: Point) -> [f64; 2] {
    [b[0] - a[0], b[1] - a[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn times(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn conjugate(a: [f64; 2]) -> [f64; 2] {
    [a[0], -a[1]]
}
