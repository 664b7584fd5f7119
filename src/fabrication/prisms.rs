//! Solids as stacks of slabs: what a printer makes, layer by layer.
//!
//! All slabs share one triangulation of the plane in which the contours of each are edges, so that walls and lids meet at the same nodes and
//! the surface is closed by construction.

use super::solid::Solid;
use crate::outline::{Point, polygon};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// Corners of a circle. Its radius is such that the polygon is as long around as the circle, which is what counts for a thread.
const CORNERS: usize = 48;
/// Slices that a round hole across the layers is made of.
const SLICES: usize = 6;
/// Places are kept to this, mm: corners that are meant to be the same are.
const GRAIN_MM: f64 = 1e-3;
/// Rounds of cutting edges where they cross: rounding can make new crossings, a grain long.
const CUTTING_ROUNDS: usize = 4;

/// What is solid between two heights: all of `solid` that is in none of `hollow`.
#[derive(Clone, Debug, PartialEq)]
pub struct Slab {
    pub from: f64,
    pub to: f64,
    pub solid: Vec<Vec<Point>>,
    pub hollow: Vec<Vec<Point>>,
}

/// A circle as a polygon, counter-clockwise.
pub fn circle([x, y]: Point, radius: f64) -> Vec<Point> {
    let half = 0.5 * TAU / CORNERS as f64;
    let r = radius * half / half.sin();
    let angle = |i: usize| TAU * (i as f64 + 0.5) / CORNERS as f64;
    (0..CORNERS).map(|i| [x + r * angle(i).cos(), y + r * angle(i).sin()]).collect()
}

/// A rectangle by its lower left and upper right corner.
pub fn bar(low: Point, high: Point) -> Vec<Point> {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// A round hole across the layers at a height: (from, to, half its width) from below.
pub fn slices(middle: f64, radius: f64) -> Vec<(f64, f64, f64)> {
    let at = |k: usize| radius * (2.0 * k as f64 / SLICES as f64 - 1.0);
    (0..SLICES)
        .map(|k| {
            let (from, to) = (at(k), at(k + 1));
            let z = 0.5 * (from + to);
            (middle + from, middle + to, (radius * radius - z * z).sqrt())
        })
        .collect()
}

/// The solid of slabs from below, each beginning where the one before ends.
pub fn stacked(slabs: &[Slab]) -> Solid {
    let mut plane: ConstrainedDelaunayTriangulation<Point2<f64>> = ConstrainedDelaunayTriangulation::new();
    let place = |[x, y]: Grain| Point2::new(x as f64 * GRAIN_MM, y as f64 * GRAIN_MM);
    for [a, b] in apart(edges(slabs)) {
        let (Ok(a), Ok(b)) = (plane.insert(place(a)), plane.insert(place(b))) else { continue };
        // Where rounding has left a crossing, an edge less changes the shape by a grain; the surface stays closed.
        if a != b && plane.can_add_constraint(a, b) {
            plane.add_constraint(a, b);
        }
    }
    let faces: Vec<[usize; 3]> = plane.inner_faces().map(|f| f.vertices().map(|v| v.fix().index())).collect();
    let places: Vec<Point> = plane.vertices().map(|v| [v.position().x, v.position().y]).collect();
    let middle = |f: &[usize; 3]| [0, 1].map(|k| f.iter().map(|&v| places[v][k]).sum::<f64>() / 3.0);
    let inside: Vec<Vec<bool>> = slabs
        .iter()
        .map(|slab| {
            let holds = |rings: &[Vec<Point>], p: Point| rings.iter().any(|ring| polygon::contains(ring, p));
            faces.iter().map(middle).map(|p| holds(&slab.solid, p) && !holds(&slab.hollow, p)).collect()
        })
        .collect();
    let mut edges: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (i, f) in faces.iter().enumerate() {
        edges.extend((0..3).map(|k| ((f[k], f[(k + 1) % 3]), i)));
    }
    let mut surface = Surface { places: &places, nodes: BTreeMap::new(), solid: Solid::default() };
    for (k, slab) in slabs.iter().enumerate() {
        let beside = |other: Option<usize>, i: usize| other.and_then(|o| inside.get(o)).is_some_and(|s| s[i]);
        for (i, f) in faces.iter().enumerate().filter(|(i, _)| inside[k][*i]) {
            if !beside(k.checked_sub(1), i) {
                surface.triangle([f[2], f[1], f[0]].map(|v| (v, slab.from)));
            }
            if !beside(Some(k + 1), i) {
                surface.triangle([f[0], f[1], f[2]].map(|v| (v, slab.to)));
            }
            for (u, v) in (0..3).map(|c| (f[c], f[(c + 1) % 3])) {
                if !edges.get(&(v, u)).is_some_and(|&other| inside[k][other]) {
                    surface.triangle([(u, slab.from), (v, slab.from), (v, slab.to)]);
                    surface.triangle([(u, slab.from), (v, slab.to), (u, slab.to)]);
                }
            }
        }
    }
    surface.solid
}

/// A place in the plane, in grains.
type Grain = [i64; 2];

/// The sides of all contours, each once.
fn edges(slabs: &[Slab]) -> BTreeSet<[Grain; 2]> {
    let grained = |p: Point| p.map(|v| (v / GRAIN_MM).round() as i64);
    let rings = slabs.iter().flat_map(|slab| slab.solid.iter().chain(&slab.hollow));
    let sides = rings.flat_map(|ring| polygon::sides(ring)).map(|(a, b)| ordered(grained(a), grained(b)));
    sides.filter(|[a, b]| a != b).collect()
}

fn ordered(a: Grain, b: Grain) -> [Grain; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

/// Edges cut where they cross or touch each other.
fn apart(mut edges: BTreeSet<[Grain; 2]>) -> BTreeSet<[Grain; 2]> {
    for _ in 0..CUTTING_ROUNDS {
        let all: Vec<[Grain; 2]> = edges.iter().copied().collect();
        let mut cuts: Vec<Vec<Grain>> = all.iter().map(|e| e.to_vec()).collect();
        let mut is_cut = false;
        for i in 0..all.len() {
            // Sorted by their first ends: what begins to the right of this one's end is not met.
            for j in (i + 1..all.len()).take_while(|&j| all[j][0][0] <= all[i][1][0]) {
                let Some(at) = meeting(all[i], all[j]) else { continue };
                for k in [i, j] {
                    if !all[k].contains(&at) {
                        cuts[k].push(at);
                        is_cut = true;
                    }
                }
            }
        }
        if !is_cut {
            break;
        }
        edges = cuts
            .into_iter()
            .flat_map(|mut points| {
                points.sort_unstable();
                points.dedup();
                points.windows(2).map(|p| ordered(p[0], p[1])).collect::<Vec<_>>()
            })
            .collect();
    }
    edges
}

/// The place where two edges cross or one touches the other, to a grain. None for edges along each other.
fn meeting([a, b]: [Grain; 2], [c, d]: [Grain; 2]) -> Option<Grain> {
    if a[1].max(b[1]) < c[1].min(d[1]) || c[1].max(d[1]) < a[1].min(b[1]) {
        return None;
    }
    let cross = |u: Grain, v: Grain| i128::from(u[0]) * i128::from(v[1]) - i128::from(u[1]) * i128::from(v[0]);
    let minus = |p: Grain, q: Grain| [p[0] - q[0], p[1] - q[1]];
    let (u, v, w) = (minus(b, a), minus(d, c), minus(c, a));
    let across = cross(u, v);
    if across == 0 {
        return None;
    }
    let (s, t) = (cross(w, v) as f64 / across as f64, cross(w, u) as f64 / across as f64);
    let within = |x: f64| (0.0..=1.0).contains(&x);
    (within(s) && within(t)).then(|| [0, 1].map(|k| a[k] + (s * u[k] as f64).round() as i64))
}

/// A solid under construction, its nodes by their place in the plane and their height.
struct Surface<'a> {
    places: &'a [Point],
    nodes: BTreeMap<(usize, u64), usize>,
    solid: Solid,
}

impl Surface<'_> {
    fn triangle(&mut self, corners: [(usize, f64); 3]) {
        let nodes = corners.map(|(v, z)| {
            *self.nodes.entry((v, z.to_bits())).or_insert_with(|| {
                self.solid.nodes.push([self.places[v][0], self.places[v][1], z]);
                self.solid.nodes.len() - 1
            })
        });
        self.solid.triangles.push(nodes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_tube_on_a_plate_is_closed_and_has_its_volume() {
        let plate = bar([-20.0, -20.0], [20.0, 20.0]);
        let slabs = [
            Slab { from: 0.0, to: 2.0, solid: vec![plate], hollow: vec![circle([0.0, 0.0], 5.0)] },
            Slab {
                from: 2.0,
                to: 12.0,
                solid: vec![circle([0.0, 0.0], 10.0)],
                hollow: vec![circle([0.0, 0.0], 5.0), bar([4.0, -1.0], [12.0, 1.0])],
            },
        ];
        let solid = stacked(&slabs);
        let volume = solid.volume_mm3();
        // The slot is 2 mm wide from the bore to the outside.
        let expected = 2.0 * (1600.0 - 25.0 * PI) + 10.0 * (75.0 * PI - 2.0 * 5.05);
        assert!((volume - expected).abs() < 0.002 * expected, "{volume} and {expected}");
        assert!(solid.is_closed());
    }
}
