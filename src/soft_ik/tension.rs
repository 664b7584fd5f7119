//! All-at-once Soft IK with tension as the unknown: the fast method for many fibres.
//!
//! Unknowns are the positions `x` and the tensions `tau >= 0` of the free fibres; an element at one of its bounds is a
//! spring held at that bound's rest length. One factorisation an iteration:
//!
//! 1. Assemble `g = dE/dx` and the exact `H` at `(x, tau)`, where a free element contributes `tau d2l` only.
//! 2. Solve `H [Y, u, v] = [S^T, g, Q (x - X)]`.
//! 3. With `G` the rows `dl/dx` of free elements: `J = -Y^T G^T`, `c = -G v`, `r_0 = S (x - u) - x'`.
//! 4. The step in tension minimises `1/2 |r_0 + J dtau|^2 + c dtau + rho/2 |tau|^2 + nu/2 |dtau|^2` with every tension between
//!    those at its bounds: a convex dual of the size of the targets, solved by a semismooth Newton method ([`Dual`]).
//! 5. `dx = -u - H^-1 G^T dtau` is a Newton step of the statics under the new tensions, capped and line-searched on
//!    `E(.; tau)`.
//! 6. Elements that reach a bound are held there as springs. A held element stays part of step 4, in the same units: with
//!    its spring in `H`, `dtau = U'' dalpha_c` at fixed `x`. Where the step moves it off its bound it is freed. So held and
//!    free elements are decided on together, against the same targets.
//!
//! Tension does not vanish from the model where an element is slack, so the slack stall does not exist here. Contractions
//! follow as `alpha_c = alpha_0 - l + U'^-1(tau)`, and a statics polish ends the work.

use super::dual::Dual;
use super::objective::PointTarget;
use super::{Answer, Budget, Method, Posture, Question};
use crate::physics::{Element, Law};
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
/// Smallest `nu`, in units of `rho`, reached where iterations go well. Below it elements come and go at their bounds.
const LEAST_PROXIMAL: f64 = 4.0;
/// Factor on `nu` after an iteration in which `O` rose: what keeps the set of held elements from oscillating.
const PROXIMAL_GROWTH: f64 = 2.0;
/// Divisor of `nu` after an iteration in which `O` fell.
const PROXIMAL_DECAY: f64 = 1.3;
/// Longest step of a node in one iteration, as a part of the body: beyond it the linearised lengths mean nothing.
const LONGEST_STEP: f64 = 0.25;
/// First limit on the pull of a single target, as a part of the body; it doubles until it limits nothing.
const FIRST_PULL: f64 = 0.3;
/// A held element is freed once its rest length is off its bound by this part of `alpha_0` for every time it was freed
/// before, so that none comes and goes for ever.
const RELEASE_DISTANCE: f64 = 0.01;
/// Tangent, as a part of `K`, below which an element counts as slack.
const SLACK_TANGENT: f64 = 1e-6;

/// A free fibre: a winch with one element.
struct Fiber {
    element: usize,
    ratio: f64,
    /// Rest lengths at the bounds of its activation.
    shortest: f64,
    longest: f64,
    /// The rest length of the spring that the element is at present, where it is held at or near a bound.
    held: Option<f64>,
    /// How often it was freed.
    releases: usize,
}

impl Fiber {
    /// The tensions `[lowest, highest]` between which a step may choose, at coordinates `x`.
    ///
    /// A free element's are those at its bounds, the length as it is. A held one's move its rest length to its bounds, with
    /// the tangent as it is.
    fn limits(&self, element: &Element, x: &[f64]) -> [f64; 2] {
        let length = element.length(x);
        match self.held {
            None => [element.tension(length - self.longest), element.tension(length - self.shortest)],
            Some(rest) => {
                let (tau, tangent) = (element.tension(length - rest), element.tangent(length - rest));
                [(tau + tangent * (rest - self.longest)).max(0.0), tau + tangent * (rest - self.shortest)]
            }
        }
    }
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
                    Some(shortest)
                } else if rest >= longest - slop && tau > 0.0 {
                    Some(longest)
                } else {
                    None
                };
                Fiber { element, ratio, shortest, longest, held, releases: 0 }
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
                Some(rest) => Law::Spring { alpha: rest },
                None => Law::Tension(*tau),
            };
        }
    }

    fn iterate(&mut self, question: &mut Question) -> Option<Progress> {
        let n = self.x.len();
        let objective = question.objective;
        self.release_slack(question);
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
        let elements = &question.model.contractile.elements;
        let count = self.fibers.len();
        let rate = |k: usize, w: &[f64]| elements[self.fibers[k].element].length_rate(&self.x, w);
        let jacobian = DMatrix::from_fn(rows, count, |r, k| -rate(k, &solved[r * n..(r + 1) * n]));
        let linear = DVector::from_fn(count, |k, _| -rate(k, &v));
        let now = DVector::from_column_slice(&self.tension);
        let limits: Vec<[f64; 2]> = self.fibers.iter().map(|f| f.limits(&elements[f.element], &self.x)).collect();
        let lowest = DVector::from_fn(count, |k, _| limits[k][0]);
        let highest = DVector::from_fn(count, |k, _| limits[k][1]);

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
            for (k, fiber) in self.fibers.iter().enumerate() {
                let change = next[k] - now[k];
                if change != 0.0 {
                    let element = &question.model.contractile.elements[fiber.element];
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
        for k in 0..count {
            let fiber = &mut self.fibers[k];
            if let Some(rest) = &mut fiber.held {
                let element = &question.model.contractile.elements[fiber.element];
                let tangent = element.tangent(element.length(&self.x) - *rest);
                // Exactly on the bound where the step ends there.
                *rest = if next[k] == highest[k] {
                    fiber.shortest
                } else if next[k] == lowest[k] && fiber.longest.is_finite() && next[k] > 0.0 {
                    fiber.longest
                } else {
                    (*rest - (next[k] - now[k]) / tangent).max(fiber.shortest).min(fiber.longest)
                };
            } else {
                self.tension[k] = next[k];
            }
        }
        let step = self.search(question, &dx);
        let changed = self.update_bounds(question);
        let settled = !limited && !changed && step >= 0.5;
        if limited && step >= 0.5 {
            self.pull *= 2.0;
        }
        self.judge(question);
        Some(Progress { longest: step * longest(&dx), settled, factorizations })
    }

    /// Adds the derivative by `x` of `rho/2 tau^2` of the held elements: `rho tau U'' dl/dx`.
    fn add_held_tension(&self, question: &Question, out: &mut [f64]) {
        for fiber in &self.fibers {
            if let Some(rest) = fiber.held {
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

    /// A held element that has gone slack has no stiffness left to be held by: its tension is the unknown again.
    fn release_slack(&mut self, question: &Question) {
        for (fiber, tau) in self.fibers.iter_mut().zip(&mut self.tension) {
            if let Some(rest) = fiber.held {
                let element = &question.model.contractile.elements[fiber.element];
                let gamma = element.length(&self.x) - rest;
                *tau = element.tension(gamma);
                if element.tangent(gamma) <= SLACK_TANGENT * element.stiffness {
                    fiber.held = None;
                }
            }
        }
    }

    /// Holds elements that left their bounds and frees held ones that the step moved off theirs. Whether any changed.
    fn update_bounds(&mut self, question: &Question) -> bool {
        let mut changed = false;
        for (fiber, tau) in self.fibers.iter_mut().zip(&mut self.tension) {
            let element = &question.model.contractile.elements[fiber.element];
            let length = element.length(&self.x);
            let slop = 1e-10 * element.alpha0;
            match fiber.held {
                None => {
                    let rest = length - element.deformation(*tau);
                    let bound = if *tau > 0.0 && rest < fiber.shortest - slop {
                        fiber.shortest
                    } else if rest > fiber.longest + slop && element.tension(length - fiber.longest) > *tau {
                        fiber.longest
                    } else {
                        continue;
                    };
                    fiber.held = Some(bound);
                    *tau = element.tension(length - bound);
                    changed = true;
                }
                Some(rest) => {
                    *tau = element.tension(length - rest);
                    let inside = (rest - fiber.shortest).min(fiber.longest - rest);
                    if inside > fiber.releases as f64 * RELEASE_DISTANCE * element.alpha0 + slop {
                        fiber.held = None;
                        fiber.releases += 1;
                        changed = true;
                    }
                }
            }
        }
        changed
    }

    /// Keeps the best state near equilibrium, and lets `nu` follow success.
    fn judge(&mut self, question: &mut Question) {
        self.set_laws(question);
        let free: f64 = self.tension.iter().map(|t| t * t).sum();
        let value = question.objective.position_value(&self.x) + 0.5 * self.rho * free;
        let mut gradient = vec![0.0; self.x.len()];
        question.model.gradient(&self.x, &mut gradient);
        let residual = crate::physics::statics::norm(&gradient);
        let near = residual <= 1e-2 * question.model.force_scale(&self.x);
        if near && self.best.as_ref().is_none_or(|(o, ..)| value < *o) {
            self.best = Some((value, self.x.clone(), self.activations(question)));
        }
        if value > self.last_objective {
            self.nu *= PROXIMAL_GROWTH;
        } else {
            self.nu = (self.nu / PROXIMAL_DECAY).max(LEAST_PROXIMAL * self.rho);
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
