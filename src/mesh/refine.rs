//! Delaunay refinement: nodes are added until every triangle has good angles, then until there are as many as asked for.
//!
//! After Ruppert (*A Delaunay refinement algorithm for quality 2-dimensional mesh generation*, 1995): a poor triangle gets
//! a node at its circumcentre, unless that lies behind or close to a fixed edge, which is then split instead; the new
//! node lies on the outline, not on the chord. Nodes next to a sharp corner are put at distances of powers of two from
//! it, so that its two legs do not split each other for ever. What is still missing is spread farthest point first:
//! at the circumcentre of the triangle that is largest for its place.

use super::boundary::Boundary;
use super::circle::{angle_at, circumcircle, side2};
use super::curve::Curve;
use super::quality::min_angle;
use super::queue::{Entry, Why};
use super::tracks::Sampled;
use super::tri::{NONE, Side, Tri, Way};
use crate::outline::{Point, polygon};
use std::collections::BinaryHeap;

/// Triangles with a smaller angle may be preferred when nodes are shared out, degrees.
const NARROW_DEG: f64 = 30.0;
/// A fixed edge is split where it is seen under more than this angle, degrees: 90 is Ruppert's circle, 180 none at all. More
/// spares nodes, up to what the smallest angle wanted allows (180 - 2 * 23).
const SEEN_DEG: f64 = 125.0;
/// Corners of the rim sharper than this get nodes at equal distances on both legs, degrees.
const SHARP_DEG: f64 = 60.0;
/// Edges shorter than this are not split for the angles' sake, as a fraction of the spacing.
const SHORTEST: f64 = 0.002;
/// Growth of the wanted edge length per length of way from a finely sampled stretch of the boundary.
const GRADATION: f64 = 0.35;
/// Nearest that an interior node may come to the boundary, in wanted edge lengths: below, triangles grow flat.
const BOUNDARY_GAP: f64 = 0.42;
/// Smallest ratio of circumradius to wanted edge length that takes a node: an equilateral triangle of the wanted size has
/// 0.577.
const LEAST_RATIO: f64 = 0.4;
/// Triangles above this ratio are split before their angles are looked at.
const LARGE_RATIO: f64 = 0.85;

/// How the nodes inside are shared out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fill {
    /// Longest wanted edge, in boundary spacings.
    pub coarsest: f64,
    /// Preference for triangles between boundary nodes alone, as a factor on the ratio of circumradius to wanted edge length:
    /// a limb is to be two across before the trunk is filled evenly.
    pub limbs: f64,
    /// Preference for triangles with an angle below [`NARROW_DEG`].
    pub narrow: f64,
    /// Triangles with a smaller angle are split, degrees: the refinement ends well for a little more than 20, smoothing then
    /// adds some ten. Less spares nodes.
    pub poor_deg: f64,
}

/// Where a node lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// On a ring of the outline, at an arc length.
    Rim(usize, f64),
    /// On a track.
    Track,
    Inside,
}

pub(super) struct Refiner<'a> {
    pub tri: Tri,
    pub places: Vec<Place>,
    curves: &'a [Curve<'a>],
    sizes: Vec<f64>,
    h: f64,
    fill: Fill,
    mirror: bool,
    /// Edges on the axis of a half.
    axis: usize,
    queue: BinaryHeap<Entry>,
    star: Vec<usize>,
}

impl<'a> Refiner<'a> {
    /// The triangulation of a boundary sampled at spacing `h`, to be refined. A half
    /// (`mirror`) has its axis at y = 0.
    pub fn new(
        boundary: &Boundary,
        tracks: &Sampled,
        curves: &'a [Curve<'a>],
        mirror: bool,
        h: f64,
        fill: Fill,
    ) -> Option<Self> {
        let rim = boundary.nodes.len();
        let points = [boundary.nodes.as_slice(), &tracks.nodes].concat();
        let segments: Vec<[usize; 2]> = tracks.segments.iter().map(|s| s.map(|n| n + rim)).collect();
        let mut places: Vec<Place> = boundary.places.iter().map(|&(ring, s)| Place::Rim(ring, s)).collect();
        places.resize(points.len(), Place::Track);
        let mut sizes = rim_sizes(boundary, h);
        sizes.resize(points.len(), h);
        let on_axis = |n: usize| boundary.nodes[n][1] == 0.0;
        let axis = boundary.segments.iter().filter(|&&[a, b]| mirror && on_axis(a) && on_axis(b)).count();
        let tri = Tri::new(points, &boundary.segments, &segments)?;
        let mut refiner =
            Self { places, sizes, tri, mirror, axis, curves, h, fill, queue: BinaryHeap::new(), star: Vec::new() };
        for t in 0..refiner.tri.corners.len() {
            refiner.enqueue(t);
        }
        Some(refiner)
    }

    /// Number of edges of the mesh, of both halves where only one is meshed.
    pub fn edges(&self) -> usize {
        if self.mirror { 2 * self.tri.edges() - self.axis } else { self.tri.edges() }
    }

    /// Whether a fixed edge lies on the axis.
    fn is_axis(&self, side: Side) -> bool {
        self.mirror
            && self.tri.across[side.0][side.1] == NONE
            && self.tri.ends(side).into_iter().all(|n| self.tri.points[n][1] == 0.0)
    }

    /// Adds nodes until there are `edges` edges, or up to two fewer (five of a mirrored one). `None` where good angles alone need more than that, or so
    /// many find no room.
    pub fn run(&mut self, edges: usize) -> Option<()> {
        let step = if self.mirror { 6 } else { 3 };
        while let Some(entry) = self.queue.pop() {
            if self.tri.corners[entry.triangle] != entry.corners {
                continue;
            }
            if self.edges() > edges {
                return None;
            }
            match entry.why {
                Why::Edge | Why::Angle => self.improve(entry.triangle),
                Why::Large | Why::Size if self.edges() + step > edges => return Some(()),
                Why::Large | Why::Size => self.enlarge(entry.triangle),
            }
        }
        (self.edges() <= edges && self.edges() + step > edges).then_some(())
    }

    /// Adds nodes until the angles are good; `None` beyond `most` edges.
    pub fn run_angles(&mut self, most: usize) -> Option<()> {
        while let Some(entry) = self.queue.pop() {
            if self.edges() > most {
                return None;
            }
            if self.tri.corners[entry.triangle] == entry.corners {
                match entry.why {
                    Why::Edge | Why::Angle => self.improve(entry.triangle),
                    Why::Large => self.enlarge(entry.triangle),
                    Why::Size => {}
                }
            }
        }
        Some(())
    }

    fn enqueue(&mut self, t: usize) {
        let corners = self.tri.corners[t];
        let places = self.tri.places(t);
        let angle = min_angle(places);
        let ratio = self.ratio(t);
        let poor = angle < self.fill.poor_deg && !self.is_given(t);
        let mut put = |why, weight| self.queue.push(Entry { why, weight, corners, triangle: t });
        // A triangle that finds no room for its size may still be improved for its angle.
        if ratio > LARGE_RATIO {
            put(Why::Large, ratio);
        } else if ratio > LEAST_RATIO {
            put(Why::Size, ratio);
        }
        if poor {
            put(Why::Angle, -angle);
        }
        if (0..3).any(|k| self.is_seen((t, k))) {
            self.queue.push(Entry { why: Why::Edge, weight: 0.0, corners, triangle: t });
        }
    }

    /// Circumradius in wanted edge lengths. An edge across a limb counts as that of an equilateral triangle does.
    fn ratio(&self, t: usize) -> f64 {
        let (_, radius) = circumcircle(self.tri.places(t));
        let limb = self.tri.corners[t].iter().all(|&n| self.is_skin(n));
        let narrow = self.fill.narrow > 1.0 && min_angle(self.tri.places(t)) < NARROW_DEG && !self.is_given(t);
        let factor = if limb { self.fill.limbs } else { 1.0 } * if narrow { self.fill.narrow } else { 1.0 };
        let across = self.bridge(t).map_or(0.0, |(_, length)| {
            let radius = length / 3.0_f64.sqrt();
            self.fill.limbs * radius / self.wanted(t, radius)
        });
        across.max(factor * radius / self.wanted(t, radius))
    }

    /// The longest free edge of a triangle that crosses a limb from boundary to boundary.
    fn bridge(&self, t: usize) -> Option<(Side, f64)> {
        let is_ear = |t: usize| self.tri.fixed[t].iter().filter(|&&fixed| fixed).count() >= 2;
        if is_ear(t) {
            return None;
        }
        let length = |side: Side| {
            let [a, b] = self.tri.ends(side).map(|n| self.tri.points[n]);
            polygon::length(a, b)
        };
        let across = |&(t, k): &Side| {
            !self.tri.fixed[t][k]
                && self.tri.ends((t, k)).into_iter().all(|n| self.is_skin(n))
                && !is_ear(self.tri.across[t][k])
        };
        let sides = (0..3).map(|k| (t, k)).filter(across).map(|side| (side, length(side)));
        sides.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether a node lies on the boundary of the body.
    fn is_skin(&self, n: usize) -> bool {
        matches!(self.places[n], Place::Rim(..)) && !(self.mirror && self.tri.points[n][1] == 0.0)
    }

    fn wanted(&self, t: usize, radius: f64) -> f64 {
        let grown = self.tri.corners[t].iter().map(|&n| self.sizes[n] + GRADATION * radius);
        grown.fold(self.fill.coarsest * self.h, f64::min)
    }

    /// Whether a fixed edge is seen from the triangle's apex under so large an angle that it must be split.
    fn is_seen(&self, side: Side) -> bool {
        if !self.tri.fixed[side.0][side.1] {
            return false;
        }
        let [a, b] = self.tri.ends(side).map(|n| self.tri.points[n]);
        seen(a, b, self.tri.points[self.tri.apex(side)]) && polygon::length(a, b) > SHORTEST * self.h
    }

    /// Whether the smallest angle is one of the outline's own corners, or lies behind the base of one.
    fn is_given(&self, t: usize) -> bool {
        let p = self.tri.places(t);
        let Some(k) = (0..3).min_by(|&i, &j| side2(p, i).total_cmp(&side2(p, j))) else { return true };
        // The shortest side is opposite of the smallest angle.
        let fixed = self.tri.fixed[t];
        (fixed[(k + 1) % 3] && fixed[(k + 2) % 3]) || side2(p, k).sqrt() < SHORTEST * self.h
    }

    /// One step against a poor triangle.
    fn improve(&mut self, t: usize) {
        for k in 0..3 {
            if self.is_seen((t, k)) {
                if !self.split((t, k)) {
                    continue;
                }
                return;
            }
        }
        let (centre, _) = circumcircle(self.tri.places(t));
        if !centre.iter().all(|v| v.is_finite()) {
            return;
        }
        match self.tri.walk(t, centre) {
            Way::Blocked(side) => {
                self.split_if_long(side);
            }
            Way::Inside(home) => {
                if let Some(side) = self.seen_from(home, centre) {
                    self.split_if_long(side);
                } else {
                    let size = self.wanted(t, 0.0).min(circumcircle(self.tri.places(t)).1);
                    self.add(home, centre, size);
                }
            }
        }
    }

    /// Splits a fixed edge in the way of a circumcentre. Not one that ends in a sharp corner: its legs would drive each other
    /// into the corner without end.
    fn split_if_long(&mut self, side: Side) {
        let ends = self.tri.ends(side);
        let [a, b] = ends.map(|n| self.tri.points[n]);
        if polygon::length(a, b) > SHORTEST * self.h && !ends.into_iter().any(|n| self.is_sharp(n)) {
            self.split(side);
        }
    }

    /// A node for size: in the middle of a limb, or of the circumcircle; not near a fixed edge.
    fn enlarge(&mut self, t: usize) {
        if let Some((side, length)) = self.bridge(t) {
            let [a, b] = self.tri.ends(side).map(|n| self.tri.points[n]);
            let middle = polygon::lerp(a, b, 0.5);
            let size = self.wanted(t, length / 3.0_f64.sqrt());
            if self.fixed_distance(t, middle) > BOUNDARY_GAP * size
                && let Some(node) = self.tri.split(side, middle)
            {
                self.register(node, size);
                return;
            }
        }
        let (centre, radius) = circumcircle(self.tri.places(t));
        let size = self.wanted(t, radius);
        let Way::Inside(home) = self.tri.walk(t, centre) else { return };
        if self.fixed_distance(home, centre) > BOUNDARY_GAP * size {
            self.add(home, centre, size);
        }
    }

    /// The fixed edges of a triangle and of its neighbours.
    fn fixed_near(&self, t: usize) -> impl Iterator<Item = Side> + '_ {
        let own = (0..3).map(move |k| (t, k));
        let next = (0..3).filter(move |&k| !self.tri.fixed[t][k]).map(move |k| self.tri.across[t][k]);
        let next = next.filter(|&u| u != NONE).flat_map(|u| (0..3).map(move |k| (u, k)));
        own.chain(next).filter(|&(t, k)| self.tri.fixed[t][k])
    }

    /// The fixed edge near `home` that `p` would see under too large an angle.
    fn seen_from(&self, home: usize, p: Point) -> Option<Side> {
        self.fixed_near(home).find(|&side| {
            let [a, b] = self.tri.ends(side).map(|n| self.tri.points[n]);
            seen(a, b, p)
        })
    }

    fn fixed_distance(&self, home: usize, p: Point) -> f64 {
        let distance = |side| {
            let [a, b] = self.tri.ends(side).map(|n| self.tri.points[n]);
            polygon::distance_to_segment(a, b, p)
        };
        self.fixed_near(home).map(distance).fold(f64::INFINITY, f64::min)
    }

    fn add(&mut self, home: usize, p: Point, size: f64) {
        if let Some(node) = self.tri.insert(home, p) {
            self.register(node, size);
        }
    }

    fn register(&mut self, node: usize, size: f64) {
        self.places.push(Place::Inside);
        self.sizes.push(size);
        self.enqueue_star(node);
    }

    /// Splits a fixed edge, on the outline where it belongs to it and the triangles allow; whether that was possible.
    fn split(&mut self, side: Side) -> bool {
        let [a, b] = self.tri.ends(side);
        let (share, axis) = (self.share(side), self.is_axis(side));
        let (pa, pb) = (self.tri.points[a], self.tri.points[b]);
        let on_chord = polygon::lerp(pa, pb, share);
        let (place, goal) = match (self.places[a], self.places[b]) {
            (Place::Rim(ring, from), Place::Rim(_, to)) if self.tri.across[side.0][side.1] == NONE => {
                let curve = &self.curves[ring];
                let to = if to > from { to } else { to + curve.length() };
                let s = from + share * (to - from);
                (Place::Rim(ring, s.rem_euclid(curve.length())), curve.at(s))
            }
            _ => (Place::Track, on_chord),
        };
        let node = [goal, on_chord].into_iter().find_map(|p| {
            let apex = self.tri.points[self.tri.apex(side)];
            let sound = place == Place::Track
                || min_angle([pa, p, apex]).min(min_angle([p, pb, apex])) > 0.25 * min_angle([pa, pb, apex]);
            if sound || p == on_chord { self.tri.split(side, p) } else { None }
        });
        let Some(node) = node else { return false };
        self.axis += usize::from(axis);
        let p = self.tri.points[node];
        self.places.push(place);
        self.sizes.push((0.5 * polygon::length(pa, pb)).min(self.h));
        for (n, end) in [(a, pa), (b, pb)] {
            // A size is the mean of both edges at a node; that of the longer one has just fallen.
            let shorter = polygon::length(end, p);
            self.sizes[n] = self.sizes[n].min(0.5 * (self.sizes[n] + shorter)).max(shorter.min(self.sizes[n]));
        }
        self.enqueue_star(node);
        true
    }

    /// Where along a fixed edge to split it: in the middle, or at a power of two from a sharp corner at one end.
    fn share(&mut self, side: Side) -> f64 {
        let [a, b] = self.tri.ends(side);
        let length = polygon::length(self.tri.points[a], self.tri.points[b]);
        let shell = |length: f64| {
            let power = (0.5 * length).log2().round().exp2() / length;
            if power.is_finite() { power.clamp(0.25, 0.75) } else { 0.5 }
        };
        match (self.is_sharp(a), self.is_sharp(b)) {
            (true, false) => shell(length),
            (false, true) => 1.0 - shell(length),
            _ => 0.5,
        }
    }

    /// Whether the fixed edges at a node enclose a sharp corner of the body.
    fn is_sharp(&mut self, node: usize) -> bool {
        let mut star = std::mem::take(&mut self.star);
        self.tri.star(node, &mut star);
        let mut turned = 0.0;
        let mut sharp = false;
        let mut opened = false;
        for &t in &star {
            let Some(k) = (0..3).find(|&k| self.tri.corners[t][k] == node) else { continue };
            let [p, q, r] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| self.tri.points[self.tri.corners[t][k]]);
            if self.tri.fixed[t][k] {
                opened = true;
                turned = 0.0;
            }
            turned += angle_at(p, q, r);
            if self.tri.fixed[t][(k + 2) % 3] && opened {
                sharp |= turned < SHARP_DEG.to_radians();
                turned = 0.0;
            }
        }
        self.star = star;
        sharp
    }

    fn enqueue_star(&mut self, node: usize) {
        let mut star = std::mem::take(&mut self.star);
        self.tri.star(node, &mut star);
        for &t in &star {
            self.enqueue(t);
        }
        self.star = star;
    }
}

/// The mean length of the two boundary edges at each node, at most `h`.
fn rim_sizes(boundary: &Boundary, h: f64) -> Vec<f64> {
    let mut sizes = vec![0.0; boundary.nodes.len()];
    for &[a, b] in &boundary.segments {
        let half = 0.5 * polygon::length(boundary.nodes[a], boundary.nodes[b]);
        sizes[a] += half;
        sizes[b] += half;
    }
    sizes.into_iter().map(|s: f64| s.min(h)).collect()
}

fn seen(a: Point, b: Point, p: Point) -> bool {
    angle_at(p, a, b).abs() > SEEN_DEG.to_radians()
}
