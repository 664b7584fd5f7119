//! Random layouts, and random changes of one.

use super::layout::{Cable, Layout, Placed, Spot};
use super::sewable::Sewable;
use crate::mesh::Mesh;
use crate::outline::{Point, polygon};
use crate::random::Random;

/// How many tendons each winch may have.
#[derive(Clone, Debug, PartialEq)]
pub struct Topology {
    /// Fewest and most, winch by winch.
    pub tendons: Vec<[usize; 2]>,
    /// Most holes between a winch and an end.
    pub most_holes: usize,
}

/// Where points may be put at random.
pub struct Sampler<'a> {
    mesh: &'a Mesh,
    sewable: Option<&'a Sewable<'a>>,
    size: f64,
    /// Triangles by the area before them, for uniform draws.
    areas: Vec<f64>,
}

/// Holes are put this much deeper than the rule asks for: an improvement moves them about.
const DEEPER: f64 = 1.3;
/// Where along a piece a new point is put, and how far beside it, as a part of the piece.
const MIDDLE: [f64; 2] = [0.2, 0.8];
const ASIDE: f64 = 0.15;
/// How far points are shaken, as parts of the body: within a limb, out of it, across the body.
const SHAKES: [f64; 3] = [0.01, 0.03, 0.1];
/// Draws of a place before the best so far is taken.
const DRAWS: usize = 40;
/// Way points by which a cable is led around a corner, tried before it is led straight.
const DETOURS: usize = 60;

impl<'a> Sampler<'a> {
    pub fn new(mesh: &'a Mesh, sewable: Option<&'a Sewable<'a>>) -> Self {
        let mut sum = 0.0;
        let area = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|n| mesh.nodes[n]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        let areas = mesh.triangles.iter().map(|t| {
            sum += area(t);
            sum
        });
        let areas = areas.collect();
        Self { mesh, sewable, size: mesh.body_length(), areas }
    }

    /// A point of the body, uniform over its area.
    fn anywhere(&self, random: &mut Random) -> Point {
        let whole = self.areas.last().copied().unwrap_or(0.0);
        let at = random.between(0.0, whole);
        let triangle = self.areas.partition_point(|&sum| sum <= at).min(self.areas.len().saturating_sub(1));
        let [a, b, c] = self.mesh.triangles[triangle].map(|n| self.mesh.nodes[n]);
        let (mut s, mut t) = (random.unit(), random.unit());
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        [0, 1].map(|axis| a[axis] + s * (b[axis] - a[axis]) + t * (c[axis] - a[axis]))
    }

    fn depth(&self, p: Point, enough: f64) -> f64 {
        self.sewable.map_or(f64::INFINITY, |s| s.depth(p, enough))
    }

    /// A point at least so deep inside the body, or the deepest of many.
    fn at_depth(&self, depth: f64, random: &mut Random) -> Point {
        let mut best = self.anywhere(random);
        let mut reached = self.depth(best, depth);
        for _ in 0..DRAWS {
            if reached >= depth {
                break;
            }
            let other = self.anywhere(random);
            let deep = self.depth(other, depth);
            if deep > reached {
                (best, reached) = (other, deep);
            }
        }
        best
    }

    fn hole(&self, random: &mut Random) -> Point {
        self.at_depth(self.sewable.map_or(0.0, |s| DEEPER * s.rules.hole_to_seam_mm), random)
    }

    fn winch(&self, random: &mut Random) -> Point {
        self.at_depth(self.sewable.map_or(0.0, |s| 0.5 * s.rules.housing_mm), random)
    }

    fn is_clear(&self, a: Point, b: Point) -> bool {
        self.sewable.is_none_or(|s| s.outside(a, b) == 0.0)
    }

    /// The way of a cable to its end: straight, or around by up to two points where the body is not in between.
    fn way(&self, from: Point, to: Point, most_holes: usize, random: &mut Random) -> Vec<Point> {
        if self.is_clear(from, to) {
            return vec![to];
        }
        let mut best: Option<(f64, Vec<Point>)> = None;
        for k in 0..DETOURS {
            let first = self.hole(random);
            let mut way = vec![first];
            if k % 2 == 1 && most_holes >= 2 {
                way.push(self.hole(random));
            }
            way.push(to);
            if way.len() - 1 > most_holes {
                continue;
            }
            let points = [&[from], &way[..]].concat();
            let length: f64 = points.windows(2).map(|s| polygon::length(s[0], s[1])).sum();
            let shorter = best.as_ref().is_none_or(|(least, _)| length < *least);
            if shorter && points.windows(2).all(|s| self.is_clear(s[0], s[1])) {
                best = Some((length, way));
            }
        }
        best.map_or_else(|| vec![to], |(_, way)| way)
    }

    fn cable(&self, winch: Point, most_holes: usize, random: &mut Random) -> Cable {
        let end = self.hole(random);
        let mut way = self.way(winch, end, most_holes, random);
        if way.len() == 1 && most_holes > 0 && random.index(3) == 0 {
            way.insert(0, self.aside(winch, end, random));
        }
        way.into()
    }

    /// A point beside the middle of a piece.
    fn aside(&self, a: Point, b: Point, random: &mut Random) -> Point {
        let middle = polygon::lerp(a, b, random.between(MIDDLE[0], MIDDLE[1]));
        self.near(middle, ASIDE * polygon::length(a, b), random)
    }

    /// A point of the body around another one.
    fn near(&self, p: Point, spread: f64, random: &mut Random) -> Point {
        for _ in 0..DRAWS {
            let by = random.direction();
            let far = spread * (-2.0 * (1.0 - random.unit()).ln()).sqrt();
            let there = [p[0] + far * by[0], p[1] + far * by[1]];
            if self.mesh.locate(there, &self.mesh.nodes).is_some() {
                return there;
            }
        }
        p
    }

    /// A layout of the given topology.
    pub fn layout(&self, topology: &Topology, random: &mut Random) -> Layout {
        let winches = topology.tendons.iter().map(|[fewest, most]| {
            let at = self.winch(random);
            let count = fewest + random.index(most - fewest + 1);
            Placed { at, cables: (0..count).map(|_| self.cable(at, topology.most_holes, random)).collect() }
        });
        Layout { winches: winches.collect() }
    }

    /// A layout with one random change.
    pub fn changed(&self, layout: &Layout, topology: &Topology, random: &mut Random) -> Layout {
        let mut new = layout.clone();
        let winch = random.index(new.winches.len());
        let cable = random.index(new.winches[winch].cables.len());
        let at = new.winches[winch].at;
        let count = new.winches[winch].cables.len();
        let [fewest, most] = topology.tendons[winch];
        match random.index(10) {
            0 | 1 => self.shake(&mut new, random),
            2 | 3 => {
                new.winches[winch].cables[cable] = self.cable(at, topology.most_holes, random);
            }
            4 => {
                let end = new.winches[winch].cables[cable].len() - 1;
                let there = self.hole(random);
                new.winches[winch].cables[cable][end] = there;
            }
            5 => {
                let points = &mut new.winches[winch].cables[cable];
                if points.len() <= topology.most_holes {
                    let k = random.index(points.len() + 1);
                    let before = if k == 0 { at } else { points[k - 1] };
                    let new = match points.get(k) {
                        Some(&after) => self.aside(before, after, random),
                        None => self.near(before, SHAKES[2] * self.size, random),
                    };
                    points.insert(k, new);
                }
            }
            6 => {
                let points = &mut new.winches[winch].cables[cable];
                if points.len() > 1 {
                    let k = random.index(points.len());
                    points.remove(k);
                }
            }
            7 => new.winches[winch].at = self.winch(random),
            8 if count < most => new.winches[winch].cables.push(self.cable(at, topology.most_holes, random)),
            8 if count > fewest => drop(new.winches[winch].cables.remove(cable)),
            _ => {
                let other = random.index(new.winches.len());
                let there = random.index(new.winches[other].cables.len());
                let mine = new.winches[winch].cables[cable].clone();
                let theirs = std::mem::replace(&mut new.winches[other].cables[there], mine);
                new.winches[winch].cables[cable] = theirs;
            }
        }
        new
    }

    /// Moves a point, or all of a winch's, by a random way.
    fn shake(&self, layout: &mut Layout, random: &mut Random) {
        let spread = self.size * SHAKES[random.index(SHAKES.len())];
        let spots = layout.spots();
        let chosen = spots[random.index(spots.len())];
        let whole = random.index(3) == 0;
        let moved = |spot: &&Spot| if whole { spot.winch == chosen.winch } else { **spot == chosen };
        for &spot in spots.iter().filter(moved) {
            let there = self.near(layout.point(spot), spread, random);
            *layout.point_mut(spot) = there;
        }
    }

    /// The winches of one layout, some of them exchanged for those of another.
    pub fn crossed(&self, a: &Layout, b: &Layout, random: &mut Random) -> Layout {
        let winches = a.winches.iter().zip(&b.winches);
        let chosen = winches.map(|(mine, theirs)| if random.index(2) == 0 { mine } else { theirs });
        Layout { winches: chosen.cloned().collect() }
    }
}
