//! Another mesh under a design: everything that lies on the old one is carried over by where it is at rest.
//!
//! Pins and targets go to the point of the new body at their rest position. A tendon's winch and via points go to the nearest
//! new nodes that can be reached from there in a straight line inside the body, so that none jumps a gap to the next limb;
//! where the straight way between two of them would leave the body, the shortest way along mesh edges is put between.

use super::{Design, FiberSet, MaterialPoint, Tendon};
use crate::mesh::{self, BodyPoint, Mesh, MeshError, MeshSpec};
use crate::outline::{Outline, Point, polygon};
use serde::Serialize;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Points along a straight way at which it is asked whether the body is there.
const PROBES: usize = 12;
/// How far outside the body such a point may be, as a fraction of the body's length: boundary edges are chords.
const OUTSIDE: f64 = 0.004;
/// Nearest nodes that are tried for a via point.
const TRIED: usize = 24;

/// The changes of a design's parts.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Before and after.
    pub fibers: [usize; 2],
    pub nodes: [usize; 2],
    pub triangles: [usize; 2],
    /// How far each pin, target and point of a tendon is from where it was at rest.
    pub moved: Vec<Moved>,
    /// Via points that fell together with their neighbours.
    pub merged: usize,
    /// Via points put in to keep a tendon inside the body.
    pub added: usize,
    /// Tendons of which no length was left, by network and number.
    pub lost_tendons: Vec<[usize; 2]>,
}

/// A part of the design and how far it is from where it was, mm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Moved {
    /// Such as `poses[2].targets[0]`.
    pub what: String,
    pub distance_mm: f64,
}

impl Report {
    /// The farthest that anything moved, mm.
    pub fn farthest_mm(&self) -> f64 {
        self.moved.iter().map(|m| m.distance_mm).fold(0.0, f64::max)
    }
}

/// A mesh, and the fibres on it: one on every edge, or (`finer` above 1) those of a coarse mesh on one that is so many times
/// finer (section 8.2 of the paper).
///
/// # Errors
/// [`MeshError`] where the outline has no such mesh.
pub fn body(outline: &Outline, spec: &MeshSpec, finer: usize) -> Result<(Mesh, FiberSet), MeshError> {
    let coarse = mesh::build(outline, spec)?.mesh;
    if finer <= 1 {
        return Ok((coarse, FiberSet::Edges));
    }
    let parts = finer * finer;
    if coarse.edges().len().saturating_mul(parts) > mesh::MAX_FIBERS {
        return Err(MeshError::Unreachable {
            asked: coarse.edges().len().saturating_mul(parts),
            nearest: mesh::MAX_FIBERS,
        });
    }
    let fibers = FiberSet::Routings(coarse.edges().into_iter().map(Vec::from).collect());
    Ok((mesh::subdivided(&coarse, finer), fibers))
}

/// Puts `mesh` under the design.
pub fn carry(design: &mut Design, mesh: Mesh, set: FiberSet) -> Report {
    let old = std::mem::replace(&mut design.mesh, mesh.into());
    let before = design.fiber_count_on(&old);
    design.fibers.set = set;
    let mut carrier = Carrier::new(&old, &design.mesh);
    for (i, pin) in design.pins.iter_mut().enumerate() {
        pin.at = carrier.point(&pin.at, || format!("pins[{i}]"));
    }
    for (i, pose) in design.poses.iter_mut().enumerate() {
        for (j, target) in pose.targets.iter_mut().enumerate() {
            target.at = carrier.point(&target.at, || format!("poses[{i}].targets[{j}]"));
        }
    }
    for (i, network) in design.networks.iter_mut().enumerate() {
        for (j, tendon) in network.tendons.iter_mut().enumerate() {
            let what = format!("networks[{i}].tendons[{j}]");
            if !carrier.tendon(tendon, &what) {
                carrier.report.lost_tendons.push([i, j]);
            }
        }
    }
    design.stiffness_map = design.stiffness_map.take().map(|map| carrier.factors(&map));
    let mut report = carrier.report;
    let after = &design.mesh;
    report.nodes = [old.nodes.len(), after.nodes.len()];
    report.triangles = [old.triangles.len(), after.triangles.len()];
    report.fibers = [before, design.fiber_routings().len()];
    report
}

struct Carrier<'a> {
    old: &'a Mesh,
    new: &'a Mesh,
    neighbours: Vec<Vec<usize>>,
    outside: f64,
    report: Report,
}

impl<'a> Carrier<'a> {
    fn new(old: &'a Mesh, new: &'a Mesh) -> Self {
        Self { old, new, neighbours: new.neighbours(), outside: OUTSIDE * new.body_length(), report: Report::default() }
    }

    fn note(&mut self, what: String, distance_mm: f64) {
        self.report.moved.push(Moved { what, distance_mm });
    }

    /// The point of the new body at the rest position of one of the old.
    fn point(&mut self, at: &BodyPoint, what: impl Fn() -> String) -> BodyPoint {
        let place = self.old.position(at, &self.old.nodes);
        match self.new.locate_nearest(place, &self.new.nodes) {
            Some((found, distance)) => {
                self.note(what(), distance);
                found
            }
            // Only a mesh without triangles has no point.
            None => *at,
        }
    }

    /// Carries a routing over; whether two different points are left.
    fn tendon(&mut self, tendon: &mut Tendon, what: &str) -> bool {
        let mut routing: Vec<(MaterialPoint, Point)> = Vec::with_capacity(tendon.routing.len());
        for (k, point) in tendon.routing.iter().enumerate() {
            let place = point.place(&self.old.nodes);
            let Some((at, distance)) = self.new.locate_nearest(place, &self.new.nodes) else { return false };
            self.note(format!("{what}.routing[{k}]"), distance);
            let found = MaterialPoint::of_triangle(self.new.triangles[at.triangle], at.weights);
            let there = found.place(&self.new.nodes);
            match routing.last() {
                Some((_, last)) if *last == there => self.report.merged += 1,
                Some(&(_, last)) => {
                    for n in self.way(last, there) {
                        let at = self.new.nodes[n];
                        if at != there && routing.last().is_some_and(|(_, last)| *last != at) {
                            self.report.added += 1;
                            routing.push((MaterialPoint::Node(n), at));
                        }
                    }
                    routing.push((found, there));
                }
                None => routing.push((found, there)),
            }
        }
        let whole = routing.len() >= 2;
        if !whole && let Some((only, there)) = routing.first() {
            // Too short for the new mesh: to the node nearest by.
            let distance = |n: &usize| polygon::length(self.new.nodes[*n], *there);
            let others = (0..self.new.nodes.len()).filter(|n| *only != MaterialPoint::Node(*n));
            let next = others.min_by(|a, b| distance(a).total_cmp(&distance(b)));
            routing.extend(next.map(|n| (MaterialPoint::Node(n), self.new.nodes[n])));
        }
        tendon.routing = routing.into_iter().map(|(point, _)| point).collect();
        whole
    }

    /// The node nearest to a place of the body that can be reached from there straight inside the body.
    fn node(&self, place: Point) -> usize {
        let distance = |n: usize| polygon::length(place, self.new.nodes[n]);
        let mut near: Vec<usize> = (0..self.new.nodes.len()).collect();
        let order = |a: &usize, b: &usize| distance(*a).total_cmp(&distance(*b)).then(a.cmp(b));
        if near.len() > TRIED {
            near.select_nth_unstable_by(TRIED, order);
            near.truncate(TRIED);
        }
        near.sort_by(order);
        let reached = near.iter().copied().find(|&n| self.is_inside(place, self.new.nodes[n]));
        reached.or(near.first().copied()).unwrap_or(0)
    }

    fn is_inside(&self, a: Point, b: Point) -> bool {
        (0..=PROBES).all(|k| {
            let p = polygon::lerp(a, b, k as f64 / PROBES as f64);
            self.new.locate_nearest(p, &self.new.nodes).is_some_and(|(_, away)| away <= self.outside)
        })
    }

    /// The nodes between two places: none if the straight way is inside the body, or else those of the shortest way along edges.
    fn way(&self, from: Point, to: Point) -> Vec<usize> {
        if self.is_inside(from, to) {
            return Vec::new();
        }
        let (from, to) = (self.node(from), self.node(to));
        let mut best: Vec<Option<(f64, usize)>> = vec![None; self.new.nodes.len()];
        let mut open = BinaryHeap::from([(Reverse(Length(0.0)), from)]);
        best[from] = Some((0.0, from));
        while let Some((Reverse(Length(length)), node)) = open.pop() {
            if node == to {
                break;
            }
            if best[node].is_some_and(|(known, _)| known < length) {
                continue;
            }
            for &next in &self.neighbours[node] {
                let longer = length + polygon::length(self.new.nodes[node], self.new.nodes[next]);
                if best[next].is_none_or(|(known, _)| longer < known) {
                    best[next] = Some((longer, node));
                    open.push((Reverse(Length(longer)), next));
                }
            }
        }
        let mut way = vec![to];
        let mut node = to;
        while let Some((_, before)) = best[node]
            && before != node
        {
            way.push(before);
            node = before;
        }
        way.reverse();
        way
    }

    /// A factor for each new triangle: that of the old triangle at its middle.
    fn factors(&self, map: &[f64]) -> Vec<f64> {
        let middle = |t: &[usize; 3]| {
            let [a, b, c] = t.map(|n| self.new.nodes[n]);
            [(a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0]
        };
        let factor = |t: &[usize; 3]| {
            let found = self.old.locate_nearest(middle(t), &self.old.nodes);
            found.and_then(|(at, _)| map.get(at.triangle).copied()).unwrap_or(1.0)
        };
        self.new.triangles.iter().map(factor).collect()
    }
}

/// A length by which ways are ordered.
#[derive(Clone, Copy, Debug)]
struct Length(f64);

impl PartialEq for Length {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Length {}
impl PartialOrd for Length {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Length {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::history::History;
    use super::super::{EditError, bundled};
    use super::*;

    fn remesh(design: &mut Design, spec: &MeshSpec, finer: usize) -> Result<Report, EditError> {
        let (mesh, set) = body(&design.outline, spec, finer)?;
        Ok(carry(design, mesh, set))
    }

    #[test]
    fn every_bundled_design_can_be_made_finer_and_coarser() {
        for (k, example) in bundled::ALL.iter().enumerate() {
            let design = example.design().unwrap();
            for fibers in [if k % 2 == 0 { 250 } else { 700 }] {
                let mut history = History::new(design.clone());
                let spec = MeshSpec::fibers(fibers);
                let report = history.edit("Remesh", |d| remesh(d, &spec, 1)).unwrap();
                let new = history.current().clone();
                let what = format!("{} at {fibers}", example.name);
                assert!(report.fibers[1].abs_diff(fibers) * 100 <= 3 * fibers, "{what}");
                assert_eq!(new.keyframes, design.keyframes, "{what}");
                assert_eq!(new.networks.len(), design.networks.len());
                let edge = new.mesh.area().sqrt() * 2.0 / (new.mesh.nodes.len() as f64).sqrt();
                assert!(report.farthest_mm() < edge, "{what}: {} {edge}", report.farthest_mm());
                for (a, b) in new.pins.iter().zip(&design.pins) {
                    let apart = polygon::length(
                        new.mesh.position(&a.at, &new.mesh.nodes),
                        design.mesh.position(&b.at, &design.mesh.nodes),
                    );
                    assert!(apart < 0.01 * new.body_length_mm(), "{what}: a pin moved {apart} mm");
                }
                assert_eq!(history.undo().as_deref(), Some("Remesh"));
                assert_eq!(**history.current(), design);
            }
        }
    }

    #[test]
    fn a_tendon_does_not_jump_a_gap() {
        // A horseshoe: two limbs with a gap of 4 mm between them.
        let outer = vec![
            [0.0, 0.0],
            [64.0, 0.0],
            [64.0, 100.0],
            [34.0, 100.0],
            [34.0, 30.0],
            [30.0, 30.0],
            [30.0, 100.0],
            [0.0, 100.0],
        ];
        let outline = Outline { outer, holes: Vec::new() };
        let fine = mesh::generate(&outline, 1200).unwrap();
        let node = |p: Point| fine.nearest_node(p, &fine.nodes);
        let routing = vec![node([29.0, 90.0]), node([29.0, 40.0]), node([35.0, 40.0])];
        let mut design = Design::new("horseshoe", outline, fine.clone());
        let tendon = Tendon { routing: MaterialPoint::through(routing), ratio: 1.0, slack_mm: 0.0 };
        design.networks.push(super::super::Network::new("winch", vec![tendon]));
        let report = remesh(&mut design, &MeshSpec::fibers(250), 1).unwrap();
        design.validate().unwrap();
        let routing = &design.networks[0].tendons[0].routing;
        let at = |k: usize| routing[k].place(&design.mesh.nodes);
        assert!(at(0)[0] <= 30.0 && at(routing.len() - 1)[0] >= 34.0 && report.added > 0, "{routing:?}");
        for pair in routing.windows(2) {
            let middle = polygon::lerp(pair[0].place(&design.mesh.nodes), pair[1].place(&design.mesh.nodes), 0.5);
            assert!(design.mesh.locate_nearest(middle, &design.mesh.nodes).unwrap().1 < 0.5);
        }
    }

    #[test]
    fn a_coarse_fibre_set_lies_on_a_finer_mesh() {
        let mut design = bundled::ALL[0].design().unwrap();
        let report = remesh(&mut design, &MeshSpec::fibers(414), 2).unwrap();
        design.validate().unwrap();
        assert_eq!(design.fiber_routings().len(), 414);
        assert_eq!((report.fibers[1], report.triangles[1]), (414, design.mesh.triangles.len()));
        // Every edge halved, and three new ones in every coarse triangle.
        assert_eq!(design.mesh.edges().len(), 2 * 414 + 3 * design.mesh.triangles.len() / 4);
    }
}
