//! All-at-once Soft IK with tension as the unknown: the fast method for many fibres.
//!
//! Unknowns are the positions `x` and the tensions `tau >= 0` of the free fibres; an element at one of its bounds is a
//! spring held at that bound's rest length. One factorisation an iteration:
//!
//! 1. Assemble `g = dE/dx` and the exact `H` at `(x, tau)`, where a free element contributes `tau d2l` only.
//! 2. Solve `H [Y, u, v] = [S^T, g, Q (x - X)]`.
//! 3. With `G` the rows `dl/dx` of free elements: `J = -Y^T G^T`, `c = -G v`, `r_0 = S (x - u) - x'`.
//! 4. The step in tension minimises `1/2 |r_0 + J dtau|^2 + c dtau + rho/2 |tau|^2 + nu/2 |dtau|^2` with `tau >= 0`: a convex
//!    dual of the size of the targets, solved by a semismooth Newton method ([`Dual`]).
//! 5. `dx = -u - H^-1 G^T dtau` is a Newton step of the statics under the new tensions, capped and line-searched on
//!    `E(.; tau)`.
//! 6. Elements that would leave their bounds are held, those that the objective calls back are released.
//!
//! Tension does not vanish from the model where an element is slack, so the slack stall does not exist here. Contractions
//! follow as `alpha_c = alpha_0 - l + U'^-1(tau)`, and a statics polish ends the work.

use super::objective::PointTarget;
use super::{Answer, Budget, Method, Posture, Question};
use crate::physics::Law;
use nalgebra::{DMatrix, DVector};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AllAtOnce {
    /// Converged when no node moves further than this part of the body in an iteration.
    pub step_tolerance: f64,
}

impl Default for AllAtOnce {
    fn default() -> Self {
        Self { step_tolerance: 1e-7 }
    }
}

/// First proximal weight `nu`, in units of `rho`: robust from a cold start.
const FIRST_PROXIMAL: f64 = 40.0;
/// Smallest `nu`, in units of `rho`, reached where iterations go well.
const LEAST_PROXIMAL: f64 = 2.0;
/// Longest step of a node in one iteration, as a part of the body: beyond it the linearised lengths mean nothing.
const LONGEST_STEP: f64 = 0.25;
/// First limit on the pull of a single target, as a part of the body; it doubles until it limits nothing.
const FIRST_PULL: f64 = 0.3;
/// Part of the way that a held element's rest length moves towards its bound per iteration.
const BOUND_APPROACH: f64 = 0.6;
/// Hysteresis of releasing a held element, relative to the largest derivative by tension.
const RELEASE_MARGIN: f64 = 1e-7;

/// Growth of that margin for an element with every release.
const RELUCTANCE: f64 = 2.0;

/// A free fibre: a winch with one element.
struct Fiber {
    element: usize,
    ratio: f64,
    /// Rest lengths at the bounds of its activation.
    shortest: f64,
    longest: f64,
    /// Where the element is held at present.
    held: Option<Held>,
    /// Factor on the margin of its release: grows with every release, so that no element comes and goes for ever.
    reluctance: f64,
}

impl Fiber {
    /// The rest length at a bound.
    fn goal(&self, bound: Bound) -> f64 {
        match bound {
            Bound::Shortest => self.shortest,
            Bound::Longest => self.longest,
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
struct Held {
    rest: f64,
    bound: Bound,
}

#[derive(Clone, Copy, PartialEq)]
enum Bound {
    Shortest,
    Longest,
}

impl Method for AllAtOnce {
    fn name(&self) -> &'static str {
        "tension"
    }

    /// Panics if a winch winds several elements (a caller's mistake: see `Actuation::is_fibers_only`).
    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
        assert!(question.actuation.is_fibers_only(), "tension is the unknown of single elements only");
        let mut run = Run::new(question, start);
        let mut answer = Answer { posture: start.clone(), iterations: 0, factorizations: 0, converged: false };
        while answer.iterations < budget.iterations && !(budget.stop)() {
            answer.iterations += 1;
            match run.iterate(question) {
                Some(progress) => {
                    answer.factorizations += progress.factorizations;
                    if progress.settled && progress.longest <= self.step_tolerance * run.size {
                        answer.converged = true;
                        break;
                    }
                }
                None => break,
            }
        }
        let mut candidates = vec![(run.x.clone(), run.activations(question))];
        candidates.extend(run.best.take().map(|(_, x, beta)| (x, beta)));
        for (x, beta) in candidates {
            let (posture, factorizations) = question.settle(&beta, &x, &|| false);
            answer.factorizations += factorizations;
            let better = posture.objective < answer.posture.objective || !answer.posture.in_equilibrium;
            if posture.in_equilibrium && better {
                answer.posture = posture;
            }
            if answer.converged {
                break;
            }
        }
        let contractions = question.actuation.contractions(&answer.posture.beta);
        question.model.contractile.set_contractions(&contractions);
        answer
    }
}

struct Progress {
    longest: f64,
    settled: bool,
    factorizations: usize,
}

struct Run {
    fibers: Vec<Fiber>,
    x: Vec<f64>,
    /// Tension of every fibre (of held ones: that of their spring).
    tension: Vec<f64>,
    /// `rho`, never zero.
    rho: f64,
    nu: f64,
    /// Present limit on a target's pull, length.
    pull: f64,
    /// Body size: the longer side of the rest box.
    size: f64,
    last_objective: f64,
    /// Lowest `O` seen near equilibrium, with its positions and activations.
    best: Option<(f64, Vec<f64>, Vec<f64>)>,
}

impl Run {
    fn new(question: &mut Question, start: &Posture) -> Self {
        let model = &*question.model;
        let actuation = question.actuation;
        let contractions = actuation.contractions(&start.beta);
        let mut tension = Vec::with_capacity(actuation.winches.len());
        let fibers = actuation
            .winches
            .iter()
            .map(|w| {
                let (element, ratio) = w.members[0];
                let e = &model.contractile.elements[element];
                let (shortest, longest) = (e.alpha0 - ratio * w.upper, e.alpha0 - ratio * w.lower);
                let rest = e.alpha0 - contractions[element];
                let tau = e.tension(e.length(&start.x) - rest);
                tension.push(tau);
                let slop = 1e-9 * e.alpha0;
                let held = if rest <= shortest + slop && tau > 0.0 {
                    Some(Held { rest: shortest, bound: Bound::Shortest })
                } else if rest >= longest - slop && tau > 0.0 {
                    Some(Held { rest: longest, bound: Bound::Longest })
                } else {
                    None
                };
                Fiber { element, ratio, shortest, longest, held, reluctance: 1.0 }
            })
            .collect();
        let mu = model.body.material().shear_modulus();
        let rho = if question.objective.tension_weight > 0.0 {
            question.objective.tension_weight
        } else {
            crate::defaults::TENSION_WEIGHT / (mu * mu)
        };
        let size = extent(&model.rest);
        Self {
            fibers,
            x: start.x.clone(),
            tension,
            rho,
            nu: FIRST_PROXIMAL * rho,
            pull: FIRST_PULL * size,
            size,
            last_objective: f64::INFINITY,
            best: None,
        }
    }

    /// Puts the present laws of all elements into the model.
    fn set_laws(&self, question: &mut Question) {
        let contractile = &mut question.model.contractile;
        contractile.set_contractions(&question.actuation.fixed);
        for (fiber, tau) in self.fibers.iter().zip(&self.tension) {
            contractile.laws[fiber.element] = match fiber.held {
                Some(held) => Law::Spring { alpha: held.rest },
                None => Law::Tension(*tau),
            };
        }
    }

    fn iterate(&mut self, question: &mut Question) -> Option<Progress> {
        let n = self.x.len();
        let objective = question.objective;
        self.set_laws(question);
        let form = question.model.factorize_for_descent(&self.x).ok()?;
        let factorizations = 1 + (form == crate::physics::HessianForm::Projected) as usize;
        let rows = 2 * objective.targets.len();
        // Right-hand sides: the rows of S (scaled by the root of their weight), g, Q (x - X).
        let mut solved = vec![0.0; n * (rows + 2)];
        for (t, target) in objective.targets.iter().enumerate() {
            for axis in 0..2 {
                add_row(target, axis, &mut solved[(2 * t + axis) * n..][..n]);
            }
        }
        question.model.gradient(&self.x, &mut solved[rows * n..][..n]);
        objective.rest_gradient(&self.x, &mut solved[(rows + 1) * n..][..n]);
        self.add_held_tension(question, &mut solved[(rows + 1) * n..][..n]);
        question.model.solve_many(&mut solved, rows + 2);
        let u = solved[rows * n..(rows + 1) * n].to_vec();
        let v = solved[(rows + 1) * n..].to_vec();

        let moved: Vec<f64> = self.x.iter().zip(&u).map(|(x, u)| x - u).collect();
        let (residual, limited) = self.limited_residual(&objective.targets, &moved);
        let free: Vec<usize> = (0..self.fibers.len()).filter(|k| self.fibers[*k].held.is_none()).collect();
        let elements = &question.model.contractile.elements;
        let rate = |k: usize, w: &[f64]| elements[self.fibers[k].element].length_rate(&self.x, w);
        let jacobian = DMatrix::from_fn(rows, free.len(), |r, c| -rate(free[c], &solved[r * n..(r + 1) * n]));
        let linear = DVector::from_fn(free.len(), |c, _| -rate(free[c], &v));
        let now = DVector::from_fn(free.len(), |c, _| self.tension[free[c]]);
        let limit = |c: usize, longest: bool| {
            let fiber = &self.fibers[free[c]];
            let element = &elements[fiber.element];
            element.tension(element.length(&self.x) - if longest { fiber.longest } else { fiber.shortest })
        };
        let lowest = DVector::from_fn(free.len(), |c, _| limit(c, true));
        let highest = DVector::from_fn(free.len(), |c, _| limit(c, false));

        let mut dx = vec![0.0; n];
        let mut q = residual.clone();
        let mut next = now.clone();
        for _ in 0..8 {
            let dual = Dual {
                residual: &residual,
                jacobian: &jacobian,
                linear: &linear,
                now: &now,
                lowest: &lowest,
                highest: &highest,
                rho: self.rho,
                nu: self.nu,
            };
            (q, next) = dual.solve(q);
            dx.fill(0.0);
            for (c, &k) in free.iter().enumerate() {
                let change = next[c] - now[c];
                if change != 0.0 {
                    let element = &question.model.contractile.elements[self.fibers[k].element];
                    element.add_length_gradient(&self.x, -change, &mut dx);
                }
            }
            question.model.solve(&mut dx);
            for (d, u) in dx.iter_mut().zip(&u) {
                *d -= u;
            }
            if longest(&dx) <= LONGEST_STEP * self.size || longest(&u) > LONGEST_STEP * self.size {
                break;
            }
            self.nu *= 4.0;
        }
        for (c, &k) in free.iter().enumerate() {
            self.tension[k] = next[c];
        }
        let step = self.search(question, &dx);

        // The pull of the objective on every element's length: positive where a longer element would be better.
        let mut p = v;
        for (r, weight) in q.iter().enumerate() {
            for (a, y) in p.iter_mut().zip(&solved[r * n..(r + 1) * n]) {
                *a += weight * y;
            }
        }
        let by_tension = &linear + jacobian.tr_mul(&q);
        let changed = self.update_bounds(question, &p, &by_tension);
        let settled = !limited && !changed && step >= 0.5;
        if step >= 0.5 {
            self.pull *= 2.0;
        }
        self.judge(question);
        Some(Progress { longest: step * longest(&dx), settled, factorizations })
    }

    /// Adds the derivative by `x` of `rho/2 tau^2` of the held elements: `rho tau U'' dl/dx`.
    fn add_held_tension(&self, question: &Question, out: &mut [f64]) {
        for fiber in &self.fibers {
            if let Some(Held { rest, .. }) = fiber.held {
                let element = &question.model.contractile.elements[fiber.element];
                let gamma = element.length(&self.x) - rest;
                let factor = self.rho * element.tension(gamma) * element.tangent(gamma);
                if factor != 0.0 {
                    element.add_length_gradient(&self.x, factor, out);
                }
            }
        }
    }

    /// `sqrt(q) (S x - x')`, each target's pull limited in length; whether any was.
    fn limited_residual(&self, targets: &[PointTarget], x: &[f64]) -> (DVector<f64>, bool) {
        let mut limited = false;
        let mut out = DVector::zeros(2 * targets.len());
        for (t, target) in targets.iter().enumerate() {
            let [dx, dy] = target.offset(x);
            let distance = dx.hypot(dy);
            let mut factor = target.weight.sqrt();
            if distance > self.pull {
                limited = true;
                factor *= self.pull / distance;
            }
            out[2 * t] = factor * dx;
            out[2 * t + 1] = factor * dy;
        }
        (out, limited)
    }

    /// Moves `x` along `dx`: capped before inversion, then Armijo on `E(.; tau)`. Returns the step taken.
    fn search(&mut self, question: &mut Question, dx: &[f64]) -> f64 {
        self.set_laws(question);
        let model = &*question.model;
        let mut gradient = vec![0.0; dx.len()];
        model.gradient(&self.x, &mut gradient);
        let slope: f64 = gradient.iter().zip(dx).map(|(g, d)| g * d).sum();
        let energy = model.energy(&self.x);
        let noise = 1e-12 * (energy.abs() + model.body.material().shear_modulus() * model.body.area());
        let mut t = model.step_limit(&self.x, dx);
        for _ in 0..40 {
            let trial: Vec<f64> = self.x.iter().zip(dx).map(|(x, d)| x + t * d).collect();
            let value = model.energy(&trial);
            if value <= energy + 1e-4 * t * slope.min(0.0) + noise {
                self.x = trial;
                return t;
            }
            t *= 0.5;
        }
        0.0
    }

    /// Holds elements that left their bounds, moves held ones to their bound, and releases those that the objective calls
    /// back. Whether any changed.
    fn update_bounds(&mut self, question: &mut Question, p: &[f64], by_tension: &DVector<f64>) -> bool {
        let margin = RELEASE_MARGIN * by_tension.amax();
        let released = self.released(question, p, margin);
        let mut changed = !released.is_empty();
        for k in released {
            self.fibers[k].held = None;
            self.fibers[k].reluctance *= RELUCTANCE;
        }
        for (fiber, tau) in self.fibers.iter_mut().zip(&mut self.tension) {
            let element = &question.model.contractile.elements[fiber.element];
            let length = element.length(&self.x);
            let slop = 1e-10 * element.alpha0;
            match fiber.held {
                None => {
                    let rest = length - element.deformation(*tau);
                    let bound = if *tau > 0.0 && rest < fiber.shortest - slop {
                        Bound::Shortest
                    } else if rest > fiber.longest + slop && element.tension(length - fiber.longest) > *tau {
                        Bound::Longest
                    } else {
                        continue;
                    };
                    fiber.held = Some(Held { rest, bound });
                    changed = true;
                }
                Some(Held { rest, bound }) => {
                    let goal = fiber.goal(bound);
                    let mut next = rest + BOUND_APPROACH * (goal - rest);
                    if (next - goal).abs() < 1e-3 * element.alpha0 {
                        next = goal;
                    }
                    changed |= rest != goal;
                    fiber.held = Some(Held { rest: next, bound });
                    *tau = element.tension(length - next);
                }
            }
        }
        changed
    }

    /// The elements held at their bound whose release lowers `O`.
    ///
    /// `dO/dalpha_c = U'' (rho tau - G p)` with `p = H^-1 dO/dx`, the springs of held elements in both. An element on its way
    /// to its bound pulls too much or too little, so that its slope says nothing yet.
    fn released(&self, question: &Question, p: &[f64], margin: f64) -> Vec<usize> {
        let release = |fiber: &Fiber| {
            let Some(Held { rest, bound }) = fiber.held else { return false };
            let element = &question.model.contractile.elements[fiber.element];
            let tau = element.tension(element.length(&self.x) - rest);
            let slope = self.rho * tau - element.length_rate(&self.x, p);
            let margin = margin * fiber.reluctance;
            let called = match bound {
                Bound::Shortest => slope > margin,
                Bound::Longest => slope < -margin,
            };
            rest == fiber.goal(bound) && (called || tau == 0.0)
        };
        (0..self.fibers.len()).filter(|k| release(&self.fibers[*k])).collect()
    }

    /// Keeps the best state near equilibrium, and lets `nu` follow success.
    fn judge(&mut self, question: &mut Question) {
        self.set_laws(question);
        let free: f64 = self.tension.iter().map(|t| t * t).sum();
        let value = question.objective.position_value(&self.x) + 0.5 * self.rho * free;
        let mut gradient = vec![0.0; self.x.len()];
        question.model.gradient(&self.x, &mut gradient);
        let residual = crate::physics::statics::norm(&gradient);
        let within = self.fibers.iter().all(|f| f.held.is_none_or(|h| h.rest == f.goal(h.bound)));
        let near = within && residual <= 1e-2 * question.model.force_scale(&self.x);
        if near && self.best.as_ref().is_none_or(|(o, ..)| value < *o) {
            self.best = Some((value, self.x.clone(), self.activations(question)));
        }
        if value > self.last_objective * 1.05 {
            self.nu *= 3.0;
        } else {
            self.nu = (self.nu / 1.7).max(LEAST_PROXIMAL * self.rho);
        }
        self.last_objective = value;
    }

    /// Activations that hold the present tensions at the present positions, within the bounds.
    fn activations(&self, question: &Question) -> Vec<f64> {
        let x = &self.x;
        let mut beta: Vec<f64> = self
            .fibers
            .iter()
            .zip(&self.tension)
            .map(|(fiber, tau)| {
                let e = &question.model.contractile.elements[fiber.element];
                (e.alpha0 - e.length(x) + e.deformation(*tau)) / fiber.ratio
            })
            .collect();
        question.actuation.clamp(&mut beta);
        beta
    }
}

/// `min 1/2 |r_0 + J (tau - tau_k)|^2 + c (tau - tau_k) + rho/2 |tau|^2 + nu/2 |tau - tau_k|^2` over `lowest <= tau <= highest`.
///
/// With `q` the residual at the solution, `tau(q) = clamp((nu tau_k - c - J^T q)/(rho + nu))`; `q` solves
/// `q = r_0 + J (tau(q) - tau_k)`, the gradient of a convex function, found by a semismooth Newton method.
struct Dual<'a> {
    residual: &'a DVector<f64>,
    jacobian: &'a DMatrix<f64>,
    linear: &'a DVector<f64>,
    now: &'a DVector<f64>,
    lowest: &'a DVector<f64>,
    highest: &'a DVector<f64>,
    rho: f64,
    nu: f64,
}

impl Dual<'_> {
    /// `nu tau_k - c - J^T q`, by which the tensions are pulled.
    fn pull(&self, q: &DVector<f64>) -> DVector<f64> {
        self.now * self.nu - self.linear - self.jacobian.tr_mul(q)
    }

    fn tension(&self, q: &DVector<f64>) -> DVector<f64> {
        let mut out = self.pull(q) / (self.rho + self.nu);
        for i in 0..out.len() {
            out[i] = out[i].min(self.highest[i]).max(self.lowest[i]);
        }
        out
    }

    /// Value of the dual function (to be minimised) and its gradient.
    fn value(&self, q: &DVector<f64>, tension: &DVector<f64>) -> (f64, DVector<f64>) {
        let gradient = q - self.residual - self.jacobian * (tension - self.now);
        let offset = self.residual - self.jacobian * self.now;
        let conjugate = self.pull(q).dot(tension) - 0.5 * (self.rho + self.nu) * tension.norm_squared();
        (0.5 * q.norm_squared() - q.dot(&offset) + conjugate, gradient)
    }

    fn solve(&self, start: DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let rows = self.residual.len();
        let mut q = start;
        let mut tension = self.tension(&q);
        let (mut value, mut gradient) = self.value(&q, &tension);
        for _ in 0..60 {
            if gradient.amax() <= 1e-12 * (self.residual.amax() + q.amax()) {
                break;
            }
            let mut matrix = DMatrix::identity(rows, rows);
            for i in 0..tension.len() {
                if tension[i] > self.lowest[i] && tension[i] < self.highest[i] {
                    let column = self.jacobian.column(i);
                    matrix.ger(1.0 / (self.rho + self.nu), &column, &column, 1.0);
                }
            }
            let Some(cholesky) = matrix.cholesky() else { break };
            let step = -cholesky.solve(&gradient);
            let slope = gradient.dot(&step);
            let mut t = 1.0;
            let mut moved = false;
            for _ in 0..30 {
                let trial = &q + &step * t;
                let trial_tension = self.tension(&trial);
                let (trial_value, trial_gradient) = self.value(&trial, &trial_tension);
                if trial_value <= value + 1e-4 * t * slope + 1e-14 * value.abs() {
                    (q, tension, value, gradient) = (trial, trial_tension, trial_value, trial_gradient);
                    moved = true;
                    break;
                }
                t *= 0.5;
            }
            if !moved {
                break;
            }
        }
        (q, tension)
    }
}

fn add_row(target: &PointTarget, axis: usize, out: &mut [f64]) {
    for (&n, w) in target.nodes.iter().zip(&target.weights) {
        out[2 * n + axis] += target.weight.sqrt() * w;
    }
}

/// The longest displacement of a node.
fn longest(dx: &[f64]) -> f64 {
    dx.chunks_exact(2).map(|d| d[0].hypot(d[1])).fold(0.0, f64::max)
}

/// The longer side of the box around flat coordinates.
pub fn extent(x: &[f64]) -> f64 {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for p in x.chunks_exact(2) {
        for a in 0..2 {
            low[a] = low[a].min(p[a]);
            high[a] = high[a].max(p[a]);
        }
    }
    (high[0] - low[0]).max(high[1] - low[1])
}
