//! One step: the quadratic model of `C` around a fit, and where it leads.

use super::task::{Built, Fit, POWER, RULES, SPARING, Task};
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
const STRIDE: f64 = 0.04;
/// Step of the differences of the rules, mm: they are distances and angles of straight lines.
const DIFFERENCE_MM: f64 = 1e-4;
/// A curvature counts as at least this part of the largest: what nothing asks to stay does not run away.
const FLAT: f64 = 1e-3;
/// A tangent below this part of `K` counts as slack.
const BARELY_TAUT: f64 = 1e-3;

/// The quadratic model of `C` around a fit. Unknowns: both coordinates of every point, then the activations pose by pose.
pub(super) struct Local {
    model: Quadratic,
    /// Activations from which steps start.
    base: Vec<Vec<f64>>,
    /// Right-hand sides of `H dx` of every pose, column after column.
    columns: Vec<Vec<f64>>,
    moving: usize,
}

impl Local {
    pub fn new(task: &Task, fit: &Fit, built: &mut Built, frozen: bool) -> Option<Self> {
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
    pub fn trial(
        &self,
        task: &Task,
        fit: &Fit,
        built: &mut Built,
        damping: f64,
        stop: &dyn Fn() -> bool,
    ) -> Option<(Fit, Built)> {
        let curvatures = self.model.curvatures();
        let largest = curvatures.max().max(f64::MIN_POSITIVE);
        let step = self.model.minimise(&curvatures.map(|c| damping * (c + FLAT * largest)), stop)?;
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
