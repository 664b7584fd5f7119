//! All winches of a rig improved together: where winches, holes and ends are at rest, and the activations of all poses, by a
//! Levenberg-Marquardt method on exact sensitivities.
//!
//! With `f_k` the squared miss of pose `k`, as a part of that at rest, and `v` the violations of the rules of sewing, it brings down
//!
//! ```text
//! C = sum_k f_k^2 + W sum v^2 + S sum (beta / upper)^2
//! ```
//!
//! over the rest positions of all points and `0 <= beta <= upper` in each pose, every trial in equilibrium. The squares of `f` let
//! the worst pose count most. The derivatives of the targets by points and activations are exact ([`routing`]); where the points
//! have moved, their places in the mesh, rest lengths and bounds follow.

use super::layout::Layout;
use super::sewable::{Sewable, posed_violation};
use crate::design::{Design, Network, Target};
use crate::engine::compile::{Plushie, compile_with, objective};
use crate::mesh::BodyPoint;
use crate::outline::Point;
use crate::soft_ik::quadratic::Quadratic;
use crate::soft_ik::routing::{self, RoutingPoint};
use crate::soft_ik::{Actuation, Objective, Posture, Question};
use nalgebra::{DMatrix, DVector};

/// Power of the misses: while searching, and at the end, where nearly the worst pose alone counts.
const POWER: f64 = 2.0;
const SHARP: f64 = 5.0;
/// `W`: a rule broken by a tenth weighs as much as a pose missed by a third of its way.
const RULES: f64 = 1.0;
/// `S`: small enough to cost a pose nothing that could be seen, and a winch without use stays at rest.
const SPARING: f64 = 1e-6;
/// A pose that is served well is not forgotten: the least weight of its miss, as a part of the whole.
const SERVED: f64 = 1e-3;
/// Farthest that a point moves in one step, as a part of the body.
const STRIDE: f64 = 0.04;
/// Step of the differences of the rules, mm: they are distances and angles of straight lines.
const DIFFERENCE_MM: f64 = 1e-4;
/// First and last damping, relative to the curvature; it grows by the second factor after a bad step, and falls by the third
/// after a good one.
const DAMPING: [f64; 2] = [1e-2, 1e4];
const HARDER: f64 = 6.0;
const EASIER: f64 = 0.3;
/// A tangent below this part of `K` counts as slack.
const BARELY_TAUT: f64 = 1e-3;
/// Activation in which poses are begun, as a part of the range.
const FIRST_ACTIVATION: f64 = 0.25;
/// A violation below this is within the margins that the search keeps.
pub(super) const KEPT: f64 = 1e-5;
/// Steps of improvement in another mesh.
const TRANSFER_STEPS: usize = 15;
/// Steps from rest in which an answer is wound, and by how much `C` may differ there.
const WINDING_STEPS: usize = 6;
const SAME_STATE: f64 = 1.02;

/// Poses that a rig should serve, and what it is made in.
pub struct Task<'a> {
    pub design: &'a Design,
    /// Targets of every pose, and the sum of their weighted squares at rest, mm^2.
    pub poses: Vec<(&'a [Target], f64)>,
    /// `None` where no rule is asked for.
    pub sewable: Option<&'a Sewable<'a>>,
    /// Winches that are there and stay.
    pub fixed: &'a [Network],
    /// The rim of the mesh, ring by ring.
    rings: Vec<Vec<usize>>,
    /// Power of the misses, and the miss that counts the same with any.
    power: f64,
    whole: f64,
}

/// A layout and what it reaches.
#[derive(Clone, Debug)]
pub struct Fit {
    pub layout: Layout,
    /// Activations and equilibrium of every pose; those of the fixed winches first.
    pub poses: Vec<Posture>,
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

    /// The worst pose's error as a part of that at rest.
    pub fn worst(&self) -> f64 {
        self.misses.iter().fold(0.0_f64, |m, f| m.max(*f)).sqrt()
    }
}

/// A layout in the mesh, compiled.
struct Built {
    points: Vec<BodyPoint>,
    plushie: Plushie,
    actuation: Actuation,
    objectives: Vec<Objective>,
}

impl<'a> Task<'a> {
    pub fn new(design: &'a Design, sewable: Option<&'a Sewable<'a>>, fixed: &'a [Network]) -> Self {
        let poses = design.poses.iter().map(|pose| pose.targets.as_slice());
        let miss = |targets: &[Target]| -> f64 {
            let square = |t: &Target| {
                let p = design.mesh.position(&t.at, &design.mesh.nodes);
                t.weight * ((p[0] - t.to[0]).powi(2) + (p[1] - t.to[1]).powi(2))
            };
            targets.iter().map(square).sum()
        };
        let poses = poses.map(|targets| (targets, miss(targets))).filter(|(_, miss)| *miss > 0.0).collect();
        Self { design, poses, sewable, fixed, rings: design.mesh.boundary(), power: POWER, whole: 1.0 }
    }

    /// A fit improved for its worst pose, at the others' expense; as it was where that gains nothing.
    pub fn sharpened(&self, fit: Fit, steps: usize, stop: &dyn Fn() -> bool) -> Fit {
        let whole = fit.misses.iter().fold(f64::MIN_POSITIVE, |m, f| m.max(*f));
        let sharp = Task { poses: self.poses.clone(), rings: self.rings.clone(), power: SHARP, whole, ..*self };
        let improved = || {
            let begun = sharp.resume(fit.layout.clone(), &fit, stop)?;
            sharp.wound(sharp.improve(begun, steps, false, stop), 0, stop)
        };
        let allowed = fit.violation.max(KEPT);
        improved().filter(|new| new.worst() < fit.worst() && new.violation <= allowed).unwrap_or(fit)
    }

    fn build(&self, layout: &Layout) -> Option<Built> {
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
    fn fit(
        &self,
        layout: Layout,
        built: &mut Built,
        from: &[(Vec<f64>, Vec<f64>)],
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

    fn judged(&self, layout: Layout, built: &Built, poses: Vec<Posture>) -> Fit {
        let miss = |k: usize, posture: &Posture| {
            let objective = &built.objectives[k];
            let square = |t: &crate::soft_ik::PointTarget| {
                let [dx, dy] = t.offset(&posture.x);
                t.weight * (dx * dx + dy * dy)
            };
            objective.targets.iter().map(square).sum::<f64>() / self.poses[k].1
        };
        let misses: Vec<f64> = poses.iter().enumerate().map(|(k, posture)| miss(k, posture)).collect();
        let violation = self.sewable.map_or(0.0, |s| s.violations(&layout).iter().map(|v| v * v).sum::<f64>());
        let posed = poses.iter().map(|posture| self.posed_violation(built, &posture.x));
        let violation = violation + if self.sewable.is_some() { posed.sum() } else { 0.0 };
        let winches = &built.actuation.winches;
        let used =
            poses.iter().flat_map(|p| p.beta.iter().zip(winches)).map(|(b, w)| (b / w.upper).powi(2)).sum::<f64>();
        let missed = |f: &f64| (f / self.whole).powf(self.power) * self.whole.powf(POWER);
        let cost = misses.iter().map(missed).sum::<f64>() + RULES * violation + SPARING * used;
        Fit { layout, poses, misses, violation, cost }
    }

    /// By how much cables leave the body in a pose.
    fn posed_violation(&self, built: &Built, x: &[f64]) -> f64 {
        let ring = |nodes: &Vec<usize>| nodes.iter().map(|&n| [x[2 * n], x[2 * n + 1]]).collect();
        let rings: Vec<Vec<Point>> = self.rings.iter().map(ring).collect();
        let elements = &built.plushie.model.contractile.elements;
        let cables = elements.iter().map(|e| e.routing.iter().map(|point| point.at(x)).collect());
        posed_violation(&rings, &cables.collect::<Vec<_>>())
    }

    /// A layout tried for the first time: every pose is begun with all winches wound a little. `None` where that is no equilibrium.
    pub fn begin(&self, layout: Layout, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let mut built = self.build(&layout)?;
        let beta: Vec<f64> = built.actuation.winches.iter().map(|w| FIRST_ACTIVATION * w.upper).collect();
        let rest = built.plushie.model.rest.clone();
        let from = vec![(beta, rest); self.poses.len()];
        self.fit(layout, &mut built, &from, stop)
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
        let from: Vec<(Vec<f64>, Vec<f64>)> = from.poses.iter().map(pose).collect();
        self.fit(layout, &mut built, &from, stop)
    }

    /// A fit of the same body in another mesh: wound from rest to its activations, and improved from there.
    pub fn transferred(&self, fit: &Fit, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let mut built = self.build(&fit.layout)?;
        let rest = built.plushie.model.rest.clone();
        let mut poses = Vec::with_capacity(fit.poses.len());
        for (k, posture) in fit.poses.iter().enumerate() {
            let mut beta = posture.beta.clone();
            built.actuation.clamp(&mut beta);
            let mut question = built.question(k);
            let zero = question.settle(&vec![0.0; beta.len()], &rest, stop).0;
            poses.push(question.wind(&zero, &beta, WINDING_STEPS, stop).0);
        }
        let begun = self.judged(fit.layout.clone(), &built, poses);
        self.wound(self.improve(begun, TRANSFER_STEPS, false, stop), TRANSFER_STEPS, stop)
    }

    /// Improves a fit by at most so many steps; `frozen` leaves the points where they are.
    pub fn improve(&self, fit: Fit, steps: usize, frozen: bool, stop: &dyn Fn() -> bool) -> Fit {
        let (mut now, mut damping) = (fit, DAMPING[0]);
        let Some(mut built) = self.build(&now.layout) else { return now };
        for _ in 0..steps {
            let Some(local) = Local::new(self, &now, &mut built, frozen) else { break };
            let before = now.cost;
            let mut better = None;
            while damping < DAMPING[1] && better.is_none() && !stop() {
                better = local.trial(self, &now, &mut built, damping, stop);
                damping *= if better.is_some() { EASIER } else { HARDER };
            }
            let Some((fit, next)) = better else { break };
            (now, built) = (fit, next);
            damping = damping.max(1e-6);
            if now.cost > 0.999 * before {
                break;
            }
        }
        now
    }

    /// The same layout with every pose wound from rest in proportion: what a real plushie does. Poses that end elsewhere are
    /// improved from there.
    pub fn wound(&self, fit: Fit, steps: usize, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let mut built = self.build(&fit.layout)?;
        let rest = built.plushie.model.rest.clone();
        let mut poses = Vec::with_capacity(fit.poses.len());
        for (k, posture) in fit.poses.iter().enumerate() {
            let mut question = built.question(k);
            let zero = question.settle(&vec![0.0; posture.beta.len()], &rest, stop).0;
            let wound = question.wind(&zero, &posture.beta, WINDING_STEPS, stop).0;
            if !wound.in_equilibrium() {
                return None;
            }
            poses.push(wound);
        }
        let wound = self.judged(fit.layout.clone(), &built, poses);
        if wound.cost <= SAME_STATE * fit.cost || steps == 0 {
            return Some(wound);
        }
        let improved = self.improve(wound, steps, false, stop);
        self.wound(improved, 0, stop)
    }
}

impl Built {
    fn question(&mut self, pose: usize) -> Question<'_> {
        Question { model: &mut self.plushie.model, actuation: &self.actuation, objective: &self.objectives[pose] }
    }

    /// The layout's points as the elements pass them; `fixed`: winches before those of the layout.
    fn routing_points(&self, layout: &Layout, fixed: &[Network]) -> Vec<RoutingPoint> {
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

/// The quadratic model of `C` around a fit. Unknowns: both coordinates of every point, then the activations pose by pose.
struct Local {
    model: Quadratic,
    /// Activations from which steps start.
    base: Vec<Vec<f64>>,
    /// Right-hand sides of `H dx` of every pose, column after column.
    columns: Vec<Vec<f64>>,
    moving: usize,
}

impl Local {
    fn new(task: &Task, fit: &Fit, built: &mut Built, frozen: bool) -> Option<Self> {
        let points = if frozen { Vec::new() } else { built.routing_points(&fit.layout, task.fixed) };
        let (moving, winches) = (2 * points.len(), built.actuation.winches.len());
        let unknowns = moving + winches * fit.poses.len();
        let targets: usize = built.objectives.iter().map(|o| 2 * o.targets.len()).sum();
        let rules = task.sewable.filter(|_| !frozen).map(|s| Slopes::of(s, &fit.layout));
        let count = targets + winches * fit.poses.len() + rules.as_ref().map_or(0, |r| r.now.len());
        let (mut rows, mut residual) = (DMatrix::zeros(count, unknowns), DVector::zeros(count));
        let (mut base, mut all_columns, mut row) = (Vec::new(), Vec::new(), 0);
        let least = SERVED * fit.misses.iter().sum::<f64>();
        for (k, posture) in fit.poses.iter().enumerate() {
            let first = moving + k * winches;
            let pose = PoseRows::new(built, k, posture, &points)?;
            let miss = fit.misses[k].max(least);
            let scale = task.power * (miss / task.whole).powf(task.power - 1.0) * task.whole.powf(POWER - 1.0);
            let weight = (2.0 * scale / task.poses[k].1).sqrt();
            for (t, target) in built.objectives[k].targets.iter().enumerate() {
                for (axis, offset) in target.offset(&posture.x).into_iter().enumerate() {
                    let scale = weight * target.weight.sqrt();
                    residual[row] = scale * offset;
                    for (j, column) in pose.columns.chunks_exact(posture.x.len()).enumerate() {
                        let adjoint = &pose.adjoints[(2 * t + axis) * posture.x.len()..][..posture.x.len()];
                        let slope: f64 = adjoint.iter().zip(column).map(|(a, c)| a * c).sum();
                        rows[(row, if j < moving { j } else { first + j - moving })] = scale * slope;
                    }
                    row += 1;
                }
            }
            for (j, winch) in built.actuation.winches.iter().enumerate() {
                let scale = (2.0 * SPARING).sqrt() / winch.upper;
                rows[(row, first + j)] = scale;
                residual[row] = scale * posture.beta[j];
                row += 1;
            }
            base.push(pose.base);
            all_columns.push(pose.columns);
        }
        if let Some(rules) = rules {
            let scale = (2.0 * RULES).sqrt();
            for (v, now) in rules.now.iter().enumerate() {
                residual[row + v] = scale * now;
                for (j, slopes) in rules.slopes.iter().enumerate() {
                    rows[(row + v, j)] = scale * slopes[v];
                }
            }
        }
        let gradient = rows.tr_mul(&residual);
        let stride = STRIDE * task.design.body_length_mm();
        let (mut lower, mut upper) = (vec![-stride; moving], vec![stride; moving]);
        for base in &base {
            lower.extend(base.iter().zip(&built.actuation.winches).map(|(b, w)| w.lower - b));
            upper.extend(base.iter().zip(&built.actuation.winches).map(|(b, w)| w.upper - b));
        }
        let mut model = Quadratic { gradient, rows, diagonal: DVector::zeros(unknowns), lower, upper, gram: None };
        model.prepare(&|| false)?;
        Some(Self { model, base, columns: all_columns, moving })
    }

    /// The damped step, and where it leads; `None` where that is no better.
    fn trial(
        &self,
        task: &Task,
        fit: &Fit,
        built: &mut Built,
        damping: f64,
        stop: &dyn Fn() -> bool,
    ) -> Option<(Fit, Built)> {
        let curvatures = self.model.curvatures();
        let largest = curvatures.max().max(f64::MIN_POSITIVE);
        let step = self.model.minimise(&curvatures.map(|c| damping * (c + 1e-3 * largest)), stop)?;
        let mut layout = fit.layout.clone();
        if self.moving > 0 {
            for (k, spot) in layout.spots().into_iter().enumerate() {
                let point = layout.point_mut(spot);
                *point = [point[0] + step[2 * k], point[1] + step[2 * k + 1]];
            }
        }
        let winches = built.actuation.winches.len();
        let mut from = Vec::with_capacity(fit.poses.len());
        for (k, posture) in fit.poses.iter().enumerate() {
            let own = step.rows(self.moving + k * winches, winches);
            let beta: Vec<f64> = self.base[k].iter().zip(own.iter()).map(|(b, d)| b + d).collect();
            from.push((beta, self.predicted(built, k, posture, &step)?));
        }
        let mut next = task.build(&layout)?;
        let trial = task.fit(layout, &mut next, &from, stop)?;
        (trial.cost < fit.cost).then_some((trial, next))
    }

    /// Positions after a step, to first order; the old ones where a triangle would turn over.
    fn predicted(&self, built: &mut Built, k: usize, posture: &Posture, step: &DVector<f64>) -> Option<Vec<f64>> {
        let (x, winches) = (&posture.x, built.actuation.winches.len());
        let mut dx = vec![0.0; x.len()];
        for (j, column) in self.columns[k].chunks_exact(x.len()).enumerate() {
            let by = step[if j < self.moving { j } else { self.moving + k * winches + j - self.moving }];
            dx.iter_mut().zip(column).for_each(|(d, c)| *d += by * c);
        }
        let model = &mut built.plushie.model;
        let contractions = built.actuation.contractions(&posture.beta);
        model.contractile.set_contractions(&contractions);
        model.factorize_for_descent(x).ok()?;
        model.solve(&mut dx);
        if model.step_limit(x, &dx) < 1.0 {
            return Some(x.clone());
        }
        Some(x.iter().zip(&dx).map(|(a, d)| a + d).collect())
    }
}

/// What the targets of a pose feel.
struct PoseRows {
    /// `H^-1` of every target's rows, two each.
    adjoints: Vec<f64>,
    /// Right-hand sides of `H dx`: by the points, then by the activations.
    columns: Vec<f64>,
    /// Activations, slack winches that are called for just slack.
    base: Vec<f64>,
}

impl PoseRows {
    fn new(built: &mut Built, k: usize, posture: &Posture, points: &[RoutingPoint]) -> Option<Self> {
        let (x, n) = (&posture.x, posture.x.len());
        let contractions = built.actuation.contractions(&posture.beta);
        let model = &mut built.plushie.model;
        model.contractile.set_contractions(&contractions);
        model.factorize_for_descent(x).ok()?;
        let targets = &built.objectives[k].targets;
        let mut adjoints = vec![0.0; 2 * targets.len() * n];
        for (t, target) in targets.iter().enumerate() {
            for (&node, w) in target.nodes.iter().zip(&target.weights) {
                for axis in 0..2 {
                    adjoints[(2 * t + axis) * n + 2 * node + axis] += w;
                }
            }
        }
        model.solve_many(&mut adjoints, 2 * targets.len());
        let mut pull = vec![0.0; n];
        for (t, target) in targets.iter().enumerate() {
            for (axis, offset) in target.offset(x).into_iter().enumerate() {
                let adjoint = &adjoints[(2 * t + axis) * n..][..n];
                pull.iter_mut().zip(adjoint).for_each(|(p, a)| *p += target.weight * offset * a);
            }
        }
        let elements = &model.contractile.elements;
        let mut laws: Vec<(f64, f64)> = elements
            .iter()
            .zip(&model.contractile.laws)
            .map(|(e, law)| law.tension_and_tangent(e, e.length(x)))
            .collect();
        let mut base = posture.beta.clone();
        for (winch, b) in built.actuation.winches.iter().zip(&mut base) {
            if winch.members.iter().any(|&(e, _)| laws[e].1 > BARELY_TAUT * elements[e].stiffness) {
                continue;
            }
            let by_tension: f64 = winch.members.iter().map(|&(e, r)| -r * elements[e].length_rate(x, &pull)).sum();
            let just_slack = winch.members.iter().map(|&(e, r)| elements[e].just_slack(x) / r);
            let just_slack = just_slack.fold(f64::INFINITY, f64::min);
            if by_tension < 0.0 && just_slack < winch.upper {
                *b = b.max(just_slack);
                winch.members.iter().for_each(|&(e, _)| laws[e].1 = elements[e].stiffness);
            }
        }
        let mut columns = routing::force_columns(&built.question(k), x, &laws, points);
        let elements = &built.plushie.model.contractile.elements;
        for winch in &built.actuation.winches {
            let mut column = vec![0.0; n];
            for &(e, ratio) in &winch.members {
                elements[e].add_length_gradient(x, -laws[e].1 * ratio, &mut column);
            }
            columns.extend(column);
        }
        Some(Self { adjoints, columns, base })
    }
}

/// The rules' violations and their slopes by every coordinate.
struct Slopes {
    now: Vec<f64>,
    slopes: Vec<Vec<f64>>,
}

impl Slopes {
    fn of(sewable: &Sewable, layout: &Layout) -> Self {
        let now = sewable.violations(layout);
        let mut moved = layout.clone();
        let mut slopes = Vec::new();
        for spot in layout.spots() {
            let at = layout.point(spot);
            for axis in 0..2 {
                let mut there: Point = at;
                there[axis] += DIFFERENCE_MM;
                *moved.point_mut(spot) = there;
                let after = sewable.violations_after(&moved, spot, &now);
                slopes.push(after.iter().zip(&now).map(|(a, b)| (a - b) / DIFFERENCE_MM).collect());
            }
            *moved.point_mut(spot) = at;
        }
        Self { now, slopes }
    }
}
