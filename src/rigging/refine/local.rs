//! One step: the quadratic model of `C` around a fit, and where it leads.

use super::task::{Built, Fit, POWER, RULES, SPARING, Task};
use super::trim::{Trim, trims};
use crate::outline::Point;
use crate::rigging::layout::Layout;
use crate::rigging::sewable::Sewable;
use crate::soft_ik::Posture;
use crate::soft_ik::quadratic::Quadratic;
use crate::soft_ik::routing::{self, RoutingPoint};
use nalgebra::{DMatrix, DVector};

/// A pose that is served well is not forgotten: the least weight of its miss, as a part of the whole.
const SERVED: f64 = 1e-3;
/// Farthest that a point moves in one step, as a part of the body.
pub(super) const STRIDE: f64 = 0.04;
/// Step of the differences of the rules, mm: they are distances and angles of straight lines.
const DIFFERENCE_MM: f64 = 1e-4;
/// A curvature counts as at least this part of the largest: what nothing asks to stay does not run away.
const FLAT: f64 = 1e-3;
/// A tangent below this part of `K` counts as slack.
const BARELY_TAUT: f64 = 1e-3;

/// A fit that is improved, and what it is judged by.
pub(super) struct Sample<'t> {
    pub task: &'t Task<'t>,
    pub fit: Fit,
    pub built: Built,
    /// Of its cost among those of others.
    pub weight: f64,
}

/// The quadratic model of the weighted sum of `C` around fits whose layouts are moved alike. Unknowns: both coordinates of every point, then
/// the activations sample by sample, pose by pose.
pub(super) struct Local {
    pub model: Quadratic,
    parts: Vec<Part>,
    /// What else moves than points, after them.
    trims: Vec<Trim>,
    moving: usize,
}

/// What belongs to one pose of one sample.
struct Part {
    /// Activations from which steps start, and the first of them among the unknowns.
    base: Vec<f64>,
    first: usize,
    /// Right-hand sides of `H dx`, column after column.
    columns: Vec<f64>,
}

impl Local {
    pub fn new(samples: &mut [Sample], frozen: bool) -> Option<Self> {
        let lead = samples.first().filter(|_| !frozen);
        let points = lead.map_or(0, |s| 2 * s.fit.layout.spots().len());
        let trims = lead.map_or_else(Vec::new, |s| trims(s.task, &s.fit.layout));
        let moving = points + trims.len();
        let own = |s: &Sample| s.built.actuation.winches.len() * s.fit.poses.len();
        let unknowns = moving + samples.iter().map(own).sum::<usize>();
        let (mut rows, mut residual, mut parts, mut first) = (Vec::new(), Vec::new(), Vec::new(), moving);
        let stride = samples.first().map_or(0.0, |s| STRIDE * s.task.design.body_length_mm());
        let (mut lower, mut upper) = (vec![-stride; points], vec![stride; points]);
        if let Some(lead) = samples.first() {
            let bounds: Vec<[f64; 2]> = trims.iter().map(|trim| trim.bounds(lead.task, &lead.fit.layout)).collect();
            lower.extend(bounds.iter().map(|bounds| bounds[0]));
            upper.extend(bounds.iter().map(|bounds| bounds[1]));
        }
        for sample in samples {
            let rules = sample.task.sewable.filter(|_| !frozen).map(|s| Slopes::of(s, &sample.fit.layout));
            let part = sample.rows(&trims, moving, unknowns, &mut first, frozen)?;
            rows.extend(part.rows);
            residual.extend(part.residual);
            for part in &part.parts {
                let winches = &sample.built.actuation.winches;
                lower.extend(part.base.iter().zip(winches).map(|(b, w)| w.lower - b));
                upper.extend(part.base.iter().zip(winches).map(|(b, w)| w.upper - b));
            }
            parts.extend(part.parts);
            if let Some(rules) = rules {
                let scale = (2.0 * RULES * sample.weight).sqrt();
                for (v, now) in rules.now.iter().enumerate() {
                    let mut row = vec![0.0; unknowns];
                    rules.slopes.iter().zip(&mut row).for_each(|(slopes, slope)| *slope = scale * slopes[v]);
                    rows.push(row);
                    residual.push(scale * now);
                }
            }
        }
        let rows = DMatrix::from_fn(rows.len(), unknowns, |i, j| rows[i][j]);
        let gradient = rows.tr_mul(&DVector::from_vec(residual));
        let mut model = Quadratic { gradient, rows, diagonal: DVector::zeros(unknowns), lower, upper, gram: None };
        model.prepare(&|| false)?;
        Some(Self { model, parts, trims, moving })
    }

    /// The damped step, and where it leads; `None` where that is no better.
    pub fn trial<'t>(
        &self,
        samples: &mut [Sample<'t>],
        damping: f64,
        stop: &dyn Fn() -> bool,
    ) -> Option<Vec<Sample<'t>>> {
        let curvatures = self.model.curvatures();
        let largest = curvatures.max().max(f64::MIN_POSITIVE);
        let step = self.model.minimise(&curvatures.map(|c| damping * (c + FLAT * largest)), stop)?;
        let mut parts = self.parts.iter();
        let before = cost(samples);
        let mut next = Vec::with_capacity(samples.len());
        for sample in samples {
            let mut layout = sample.fit.layout.clone();
            if self.moving > 0 {
                for (k, spot) in layout.spots().into_iter().enumerate() {
                    let point = layout.point_mut(spot);
                    *point = [point[0] + step[2 * k], point[1] + step[2 * k + 1]];
                }
                let first = self.moving - self.trims.len();
                self.trims.iter().enumerate().for_each(|(k, trim)| trim.step(&mut layout, step[first + k]));
            }
            let Sample { task, fit, built, weight } = sample;
            let mut from = Vec::with_capacity(fit.poses.len());
            for (posture, part) in fit.poses.iter().zip(&mut parts) {
                let own = step.rows(part.first, part.base.len());
                let beta: Vec<f64> = part.base.iter().zip(own.iter()).map(|(b, d)| b + d).collect();
                from.push((beta, self.predicted(built, part, posture, &step)?));
            }
            let mut there = task.build(&layout)?;
            let trial = task.fit(layout, &mut there, &from, stop)?;
            next.push(Sample { task, fit: trial, built: there, weight: *weight });
        }
        (cost(&next) < before).then_some(next)
    }

    /// Positions after a step, to first order; the old ones where a triangle would turn over.
    fn predicted(&self, built: &mut Built, part: &Part, posture: &Posture, step: &DVector<f64>) -> Option<Vec<f64>> {
        let x = &posture.x;
        let mut dx = vec![0.0; x.len()];
        for (j, column) in part.columns.chunks_exact(x.len()).enumerate() {
            let by = step[if j < self.moving { j } else { part.first + j - self.moving }];
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

/// The weighted sum of the costs.
pub(super) fn cost(samples: &[Sample]) -> f64 {
    samples.iter().map(|sample| sample.weight * sample.fit.cost).sum()
}

/// Rows of the targets and activations of a sample.
struct SampleRows {
    rows: Vec<Vec<f64>>,
    residual: Vec<f64>,
    parts: Vec<Part>,
}

impl Sample<'_> {
    /// `first`: that of its activations among the unknowns, afterwards that of the next sample.
    fn rows(
        &mut self,
        trims: &[Trim],
        moving: usize,
        unknowns: usize,
        first: &mut usize,
        frozen: bool,
    ) -> Option<SampleRows> {
        let (task, fit, built) = (self.task, &self.fit, &mut self.built);
        let points = if frozen { Vec::new() } else { built.routing_points(&fit.layout, task.fixed) };
        let mut out = SampleRows { rows: Vec::new(), residual: Vec::new(), parts: Vec::new() };
        let least = SERVED * fit.misses.iter().sum::<f64>();
        for (k, posture) in fit.poses.iter().enumerate() {
            let pose = PoseRows::new(built, k, posture, &points, trims)?;
            let miss = fit.misses[k].max(least);
            let scale = task.power * (miss / task.whole).powf(task.power - 1.0) * task.whole.powf(POWER - 1.0);
            let weight = (2.0 * scale * self.weight / task.poses[k].1).sqrt();
            for (t, target) in built.objectives[k].targets.iter().enumerate() {
                for (axis, offset) in target.offset(&posture.x).into_iter().enumerate() {
                    let scale = weight * target.weight.sqrt();
                    let mut row = vec![0.0; unknowns];
                    for (j, column) in pose.columns.chunks_exact(posture.x.len()).enumerate() {
                        let adjoint = &pose.adjoints[(2 * t + axis) * posture.x.len()..][..posture.x.len()];
                        let slope: f64 = adjoint.iter().zip(column).map(|(a, c)| a * c).sum();
                        row[if j < moving { j } else { *first + j - moving }] = scale * slope;
                    }
                    out.rows.push(row);
                    out.residual.push(scale * offset);
                }
            }
            for (j, winch) in built.actuation.winches.iter().enumerate() {
                let scale = (2.0 * SPARING * self.weight).sqrt() / winch.upper;
                let mut row = vec![0.0; unknowns];
                row[*first + j] = scale;
                out.rows.push(row);
                out.residual.push(scale * posture.beta[j]);
            }
            out.parts.push(Part { base: pose.base, first: *first, columns: pose.columns });
            *first += built.actuation.winches.len();
        }
        Some(out)
    }
}

/// What the targets of a pose feel.
struct PoseRows {
    /// `H^-1` of every target's rows, two each.
    adjoints: Vec<f64>,
    /// Right-hand sides of `H dx`: by the points and trims, then by the activations.
    columns: Vec<f64>,
    /// Activations, slack winches that are called for just slack.
    base: Vec<f64>,
}

impl PoseRows {
    fn new(built: &mut Built, k: usize, posture: &Posture, points: &[RoutingPoint], trims: &[Trim]) -> Option<Self> {
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
        for trim in trims {
            columns.extend(trim.column(built, x, &base, laws[trim.element].1));
        }
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
