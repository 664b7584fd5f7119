//! The poses that a rig should serve, and what a layout reaches in them.

use crate::design::{Design, Network, Target};
use crate::engine::compile::{Plushie, compile_with, objective};
use crate::mesh::BodyPoint;
use crate::outline::Point;
use crate::rigging::layout::Layout;
use crate::rigging::minimax::{self, worst_first};
use crate::rigging::options::Trims;
use crate::rigging::sewable::{Sewable, posed_violation};
use crate::soft_ik::routing::RoutingPoint;
use crate::soft_ik::{Actuation, Objective, Posture, Question};
use std::cmp::Ordering;

/// Power of the misses while searching.
pub(super) const POWER: f64 = 2.0;
/// `W`: a rule broken by a tenth weighs as much as a pose missed by a third of its way.
pub(super) const RULES: f64 = 1.0;
/// `S`: small enough to cost a pose nothing that could be seen, and a winch without use stays at rest.
pub(super) const SPARING: f64 = 1e-6;
/// Farthest that a point moves in one step, as a part of the body.
pub(super) const STRIDE: f64 = 0.04;
/// Activation in which poses are begun, as a part of the range.
const FIRST_ACTIVATION: f64 = 0.25;

/// Targets are known to the search as whole multiples of this length, mm. A search by chance would turn another way for a difference that
/// nobody can see, or type.
const GRAIN_MM: f64 = 1e-3;

/// Errors that differ by less cannot be told from each other on the table, body lengths: half a millimetre of a hand's length.
pub const SEEN: f64 = 2e-3;

/// Activations and positions that a pose is begun from.
pub type Start = (Vec<f64>, Vec<f64>);

/// Poses that a rig should serve, and what it is made in.
pub struct Task<'a> {
    pub design: &'a Design,
    /// Targets of every pose, and the sum of their weighted squares at rest, mm^2.
    pub poses: Vec<(Vec<Target>, f64)>,
    /// Which poses of the design they are.
    pub served: Vec<usize>,
    /// `None` where no rule is asked for.
    pub sewable: Option<&'a Sewable<'a>>,
    /// Winches that are there and stay.
    pub fixed: &'a [Network],
    pub trims: Trims,
    /// The rim of the mesh, ring by ring.
    pub(super) rings: Vec<Vec<usize>>,
    /// Power of the misses, and the miss that counts the same with any.
    pub(super) power: f64,
    pub(super) whole: f64,
}

/// A layout and what it reaches.
#[derive(Clone, Debug)]
pub struct Fit {
    pub layout: Layout,
    /// Activations and equilibrium of every pose; those of the fixed winches first.
    pub poses: Vec<Posture>,
    /// Which poses of the design they are: on another mesh one more may be at rest.
    pub served: Vec<usize>,
    /// `f_k`.
    pub misses: Vec<f64>,
    /// `sum v^2`.
    pub violation: f64,
    /// `C`.
    pub cost: f64,
}

impl Fit {
    /// The activations without those of one winch of the layout, for [`Task::resume`].
    pub fn without(&self, winch: usize) -> Self {
        let mut out = self.clone();
        for posture in &mut out.poses {
            let fixed = posture.beta.len() - self.layout.winches.len();
            posture.beta.remove(fixed + winch);
        }
        out
    }

    /// The errors of the poses as parts of those at rest.
    pub fn parts(&self) -> impl Iterator<Item = f64> {
        self.misses.iter().map(|miss| miss.sqrt())
    }

    /// The worst pose's error as a part of that at rest.
    pub fn worst(&self) -> f64 {
        self.parts().fold(0.0, f64::max)
    }

    /// Whether it serves its poses better than another, the worst first, or worse.
    pub fn compare(&self, other: &Self) -> Ordering {
        let [own, others] = [self, other].map(|fit| worst_first(fit.parts()));
        minimax::compare(&own, &others)
    }
}

/// A layout in the mesh, compiled.
pub(super) struct Built {
    pub points: Vec<BodyPoint>,
    pub plushie: Plushie,
    pub actuation: Actuation,
    pub objectives: Vec<Objective>,
}

impl<'a> Task<'a> {
    pub fn new(design: &'a Design, sewable: Option<&'a Sewable<'a>>, fixed: &'a [Network]) -> Self {
        let rounded = |target: &Target| Target { to: target.to.map(|v| (v / GRAIN_MM).round() * GRAIN_MM), ..*target };
        let poses = design.poses.iter().map(|pose| pose.targets.iter().map(rounded).collect());
        let miss = |targets: &[Target]| -> f64 {
            let square = |t: &Target| {
                let p = design.mesh.position(&t.at, &design.mesh.nodes);
                t.weight * ((p[0] - t.to[0]).powi(2) + (p[1] - t.to[1]).powi(2))
            };
            targets.iter().map(square).sum()
        };
        let with_miss = |targets: Vec<Target>| {
            // Within a grain of rest is at rest.
            let grain = GRAIN_MM.powi(2) * targets.iter().map(|t| t.weight).sum::<f64>();
            let miss = miss(&targets);
            (miss > grain).then_some((targets, miss))
        };
        let (served, poses) = poses.map(with_miss).enumerate().filter_map(|(k, pose)| Some((k, pose?))).unzip();
        let rings = design.mesh.boundary();
        Self { design, poses, served, sewable, fixed, trims: Trims::default(), rings, power: POWER, whole: 1.0 }
    }

    /// The part of its error at rest that nobody sees in a pose ([`SEEN`]), for each.
    pub(in crate::rigging) fn unseen(&self) -> Vec<f64> {
        let seen_mm = SEEN * self.design.body_length_mm();
        let part = |(targets, miss): &(Vec<Target>, f64)| {
            seen_mm * (targets.iter().map(|t| t.weight).sum::<f64>() / miss).sqrt()
        };
        self.poses.iter().map(part).collect()
    }

    /// With more unknowns of cables.
    pub fn trimming(self, trims: Trims) -> Self {
        Self { trims, ..self }
    }

    pub(super) fn build(&self, layout: &Layout) -> Option<Built> {
        let mesh = &self.design.mesh;
        let points = layout.located(mesh)?;
        let networks = [self.fixed, &layout.networks(mesh, &points)].concat();
        let mut plushie = compile_with(self.design, &networks).ok()?;
        for winch in &mut plushie.winches {
            winch.lower = 0.0;
        }
        let objectives = self.poses.iter().map(|(targets, _)| objective(self.design, &plushie, targets)).collect();
        let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
        Some(Built { points, plushie, actuation, objectives })
    }

    /// What a layout reaches from these activations and positions of every pose; `None` where it leaves the body or a pose does not
    /// settle.
    pub(super) fn fit(
        &self,
        layout: Layout,
        built: &mut Built,
        from: &[Start],
        stop: &dyn Fn() -> bool,
    ) -> Option<Fit> {
        let mut poses = Vec::with_capacity(from.len());
        for (k, (beta, x)) in from.iter().enumerate() {
            let mut beta = beta.clone();
            built.actuation.clamp(&mut beta);
            let posture = built.question(k).settle(&beta, x, stop).0;
            if !posture.in_equilibrium() {
                return None;
            }
            poses.push(posture);
        }
        Some(self.judged(layout, built, poses))
    }

    pub(super) fn judged(&self, layout: Layout, built: &Built, poses: Vec<Posture>) -> Fit {
        let miss = |k: usize, posture: &Posture| {
            let objective = &built.objectives[k];
            let square = |t: &crate::soft_ik::PointTarget| {
                let [dx, dy] = t.offset(&posture.x);
                t.weight * (dx * dx + dy * dy)
            };
            objective.targets.iter().map(square).sum::<f64>() / self.poses[k].1
        };
        let misses: Vec<f64> = poses.iter().enumerate().map(|(k, posture)| miss(k, posture)).collect();
        let violation = self.sewable.map_or(0.0, |s| s.broken(&layout, f64::INFINITY));
        let posed = poses.iter().map(|posture| self.posed_violation(built, &posture.x));
        let violation = violation + if self.sewable.is_some() { posed.sum() } else { 0.0 };
        let winches = &built.actuation.winches;
        let used =
            poses.iter().flat_map(|p| p.beta.iter().zip(winches)).map(|(b, w)| (b / w.upper).powi(2)).sum::<f64>();
        let missed = |f: &f64| (f / self.whole).powf(self.power) * self.whole.powf(POWER);
        let cost = misses.iter().map(missed).sum::<f64>() + RULES * violation + SPARING * used;
        // A winch without a range has no part of it: such a layout is never the best.
        let cost = if cost.is_nan() { f64::INFINITY } else { cost };
        Fit { layout, poses, served: self.served.clone(), misses, violation, cost }
    }

    /// What a layout's broken rules at rest add to `C`, or a part of that which is more than the limit.
    pub fn broken(&self, layout: &Layout, limit: f64) -> f64 {
        self.sewable.map_or(0.0, |s| RULES * s.broken(layout, limit / RULES))
    }

    /// By how much cables leave the body in a pose.
    fn posed_violation(&self, built: &Built, x: &[f64]) -> f64 {
        let ring = |nodes: &Vec<usize>| nodes.iter().map(|&n| [x[2 * n], x[2 * n + 1]]).collect();
        let rings: Vec<Vec<Point>> = self.rings.iter().map(ring).collect();
        let elements = &built.plushie.model.contractile.elements;
        let cables: Vec<Vec<Point>> = elements.iter().map(|e| e.routing.iter().map(|p| p.at(x)).collect()).collect();
        posed_violation(&rings, cables.iter().map(Vec::as_slice))
    }

    /// A layout tried for the first time: every pose is begun with all winches wound a little. `None` where that is no equilibrium.
    pub fn begin(&self, layout: Layout, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let mut built = self.build(&layout)?;
        let beta: Vec<f64> = built.actuation.winches.iter().map(|w| FIRST_ACTIVATION * w.upper).collect();
        let rest = built.plushie.model.rest.clone();
        let from = vec![(beta, rest); self.poses.len()];
        self.fit(layout, &mut built, &from, stop)
    }

    /// A layout from elsewhere, with activations and positions of every pose.
    pub fn taken(&self, layout: Layout, from: &[Start], stop: &dyn Fn() -> bool) -> Option<Fit> {
        let mut built = self.build(&layout)?;
        self.fit(layout, &mut built, from, stop)
    }

    /// A layout that is like another one: begun where that one ended, as far as the winches are the same.
    pub fn resume(&self, layout: Layout, from: &Fit, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let mut built = self.build(&layout)?;
        let winches = &built.actuation.winches;
        let first = |k: usize| FIRST_ACTIVATION * winches[k].upper;
        let pose = |p: &Posture| {
            let beta = (0..winches.len()).map(|k| p.beta.get(k).copied().unwrap_or_else(|| first(k))).collect();
            (beta, p.x.clone())
        };
        let from: Vec<Start> = from.poses.iter().map(pose).collect();
        self.fit(layout, &mut built, &from, stop)
    }
}

impl Built {
    pub fn question(&mut self, pose: usize) -> Question<'_> {
        Question { model: &mut self.plushie.model, actuation: &self.actuation, objective: &self.objectives[pose] }
    }

    /// The layout's points as the elements pass them; `fixed`: winches before those of the layout.
    pub fn routing_points(&self, layout: &Layout, fixed: &[Network]) -> Vec<RoutingPoint> {
        let mut first: usize = fixed.iter().map(|network| network.tendons.len()).sum();
        let mut passes: Vec<Vec<(usize, usize)>> = Vec::new();
        for winch in &layout.winches {
            passes.push((0..winch.cables.len()).map(|cable| (first + cable, 0)).collect());
            for (cable, points) in winch.cables.iter().enumerate() {
                passes.extend((0..points.len()).map(|k| vec![(first + cable, k + 1)]));
            }
            first += winch.cables.len();
        }
        let triangles = self.plushie.model.body.triangles();
        let rest = &self.plushie.model.rest;
        let point = |(at, passes): (&BodyPoint, Vec<(usize, usize)>)| {
            RoutingPoint::new(at.triangle, triangles[at.triangle], rest, passes)
        };
        self.points.iter().zip(passes).map(point).collect()
    }
}
