//! One step of the all-at-once method: the linear solves, the choice of tensions, the motion that follows.

use super::dual::Subproblem;
use super::state::{Chosen, LARGEST_PROXIMAL, Run, STANDSTILL};
use super::workspace::{Workspace, longest};
use crate::physics::{HessianForm, statics};
use crate::soft_ik::Question;
use std::time::Instant;

/// A Newton step is taken without a line search where at most this part of the unbalanced forces is left after it.
const BALANCING: f64 = 0.5;
/// The outcome of a step is its own where it moves the body by this part of what the way to equilibrium does.
const TELLING: f64 = 0.5;
/// Right-hand sides that are solved for at once, where there are many targets.
const COLUMNS: usize = 64;

impl Run {
    /// `H [Y, v, u] = [S^T, Q (x - X) + held tensions, g]`, targets scaled by the root of their weight.
    /// `false` where `stop` has ended it.
    pub(super) fn solve_sides(&self, question: &mut Question, work: &mut Workspace, stop: &dyn Fn() -> bool) -> bool {
        let clock = Instant::now();
        let n = self.x.len();
        let objective = question.objective;
        let rows = 2 * objective.targets.len();
        let columns = rows + 2;
        let mut pull = std::mem::take(&mut work.side);
        objective.rest_gradient(&self.x, &mut pull);
        self.add_tension_of_springs(question, work, &mut pull);
        work.solved.resize(n * columns, 0.0);
        let sides = work.solved.chunks_exact_mut(columns);
        for ((side, pull), g) in sides.zip(&pull).zip(&self.gradient) {
            side[..rows].fill(0.0);
            side[rows] = *pull;
            side[rows + 1] = *g;
        }
        work.side = pull;
        for (t, target) in objective.targets.iter().enumerate() {
            let root = target.weight.sqrt();
            for (&n, w) in target.nodes.iter().zip(&target.weights) {
                for axis in 0..2 {
                    work.solved[(2 * n + axis) * columns + 2 * t + axis] += root * w;
                }
            }
        }
        for first in (0..columns).step_by(COLUMNS) {
            if first > 0 && stop() {
                return false;
            }
            question.model.solve_rows(&mut work.solved, columns, first..columns.min(first + COLUMNS));
        }
        for (u, solved) in work.newton.iter_mut().zip(work.solved.chunks_exact(columns)) {
            *u = solved[rows + 1];
        }
        work.phases.solves += clock.elapsed().as_secs_f64();
        true
    }

    /// Adds the derivative by `x` of `rho/2 tau^2` where tension changes with length: `rho tau dtau/dl dl/dx`.
    fn add_tension_of_springs(&self, question: &Question, work: &Workspace, out: &mut [f64]) {
        let steady = self.steady(work);
        for (k, fiber) in self.fibers.iter().enumerate() {
            let element = &question.model.contractile.elements[fiber.element];
            let (tau, tangent) = fiber.law(steady).tension_and_tangent(element, work.cables.lengths[k]);
            let factor = work.rho * tau * tangent;
            if factor != 0.0 {
                work.cables.add_gradient(k, factor, out);
            }
        }
    }

    /// `J`, `c`, `r_0` and the limits; the last row of `J` is left for [`Self::append_secant`]. Whether a target's pull was limited.
    pub(super) fn linearise(&self, question: &Question, work: &mut Workspace) -> bool {
        let clock = Instant::now();
        let targets = &question.objective.targets;
        let rows = 2 * targets.len();
        let count = self.fibers.len();
        work.jacobian.resize(count * (rows + 1), 0.0);
        work.cables.rates(&work.solved, rows + 2, &mut work.jacobian[..rows * count], &mut work.linear);
        let elements = &question.model.contractile.elements;
        for (k, fiber) in self.fibers.iter().enumerate() {
            work.now[k] = fiber.tension;
            work.limits[k] = fiber.limits(&elements[fiber.element], work.cables.lengths[k]);
        }
        work.residual.resize(rows + 1, 0.0);
        let mut limited = false;
        for (t, target) in targets.iter().enumerate() {
            let [dx, dy] = target.offset(&work.pulled);
            let distance = dx.hypot(dy);
            let mut factor = target.weight.sqrt();
            if distance > self.pull {
                limited = true;
                factor *= self.pull / distance;
            }
            work.residual[2 * t] = factor * dx;
            work.residual[2 * t + 1] = factor * dy;
        }
        work.phases.dual += clock.elapsed().as_secs_f64();
        limited
    }

    /// Fills the last row of `J`, which stands for the curvature left out, with residual zero.
    pub(super) fn append_secant(&mut self, work: &mut Workspace) {
        let (last, count) = (work.residual.len() - 1, self.fibers.len());
        let (jacobian, row) = work.jacobian.split_at_mut(last * count);
        self.secant.arrive(jacobian, &work.residual[..last]);
        row.copy_from_slice(&self.secant.row);
        work.residual[last] = 0.0;
    }

    /// The step in tension, and `dx = -u - H^-1 G^T dtau` that follows; shorter by a larger `nu` where it is too long.
    ///
    /// Leaves `O` before it and the decrease that it promises in `before`; nothing where that is an increase: `H` is so near
    /// to singular that the choice drowns in rounding. `false` where `stop` has ended it.
    pub(super) fn choose(&mut self, question: &mut Question, work: &mut Workspace, stop: &dyn Fn() -> bool) -> bool {
        let first = self.nu;
        let rows = work.residual.len();
        let most = self.reach * work.size;
        self.q.resize(rows, 0.0);
        let mut q = std::mem::take(&mut self.q);
        if !std::mem::replace(&mut self.warm, true) {
            q.copy_from_slice(&work.residual);
        }
        let mut own = 0.0;
        for _ in 0..8 {
            let clock = Instant::now();
            let problem = Subproblem {
                residual: &work.residual,
                jacobian: &work.jacobian,
                linear: &work.linear,
                now: &work.now,
                limits: &work.limits,
                rho: work.rho,
                nu: self.nu,
            };
            if !work.dual.solve(&problem, &mut q, &mut work.next, stop) {
                self.warm = false;
                self.q = q;
                return false;
            }
            work.phases.dual += clock.elapsed().as_secs_f64();
            let clock = Instant::now();
            work.dx.fill(0.0);
            for k in 0..work.next.len() {
                let change = work.next[k] - work.now[k];
                if change != 0.0 {
                    work.cables.add_gradient(k, -change, &mut work.dx);
                }
            }
            work.unbalanced = self.gradient.iter().zip(&work.dx).fold(0.0, |m, (g, d)| f64::max(m, (g - d).abs()));
            question.model.solve(&mut work.dx);
            let u = &work.newton;
            own = longest(&work.dx);
            for (d, u) in work.dx.iter_mut().zip(u) {
                *d -= u;
            }
            work.phases.solves += clock.elapsed().as_secs_f64();
            if longest(&work.dx) <= most || longest(u) > most || self.nu >= LARGEST_PROXIMAL * work.rho {
                break;
            }
            self.nu *= 4.0;
        }
        self.q = q;
        let promised = self.promise(work);
        if promised >= -STANDSTILL * self.now.abs() {
            let telling = own >= TELLING * longest(&work.newton);
            self.before = Some(Chosen { objective: self.now, promised, telling });
        } else {
            self.nu = first;
        }
        true
    }

    /// The decrease of `O` that the linearised model promises for the chosen tensions.
    fn promise(&self, work: &mut Workspace) -> f64 {
        let count = work.now.len();
        let mut promised = 0.0;
        for k in 0..count {
            let (now, next) = (work.now[k], work.next[k]);
            promised -= (work.linear[k] + 0.5 * work.rho * (next + now)) * (next - now);
        }
        for (r, change) in work.residual.iter().zip(work.dual.change(&work.residual, &self.q)) {
            promised -= change * (r + 0.5 * change);
        }
        promised
    }

    /// Moves `x` along `dx`, capped before inversion, and leaves the forces there in `gradient`. Returns the step taken.
    ///
    /// A full Newton step that balances most forces is taken at once: the forces are needed anyway. Else Armijo on
    /// `E(.; tau)`.
    fn search(&mut self, question: &Question, form: HessianForm, work: &mut Workspace) -> f64 {
        let model = &*question.model;
        let limit = model.step_limit(&self.x, &work.dx);
        if limit == 1.0 && form == HessianForm::Exact {
            for ((p, x), d) in work.trial.iter_mut().zip(&self.x).zip(&work.dx) {
                *p = x + d;
            }
            model.gradient(&work.trial, &mut work.forces_there);
            if statics::norm(&work.forces_there) <= BALANCING * work.unbalanced {
                std::mem::swap(&mut self.x, &mut work.trial);
                std::mem::swap(&mut self.gradient, &mut work.forces_there);
                return 1.0;
            }
        }
        model.gradient(&self.x, &mut work.forces_there);
        let slope: f64 = work.forces_there.iter().zip(&work.dx).map(|(g, d)| g * d).sum();
        let energy = model.energy(&self.x);
        let noise = 1e-12 * (energy.abs() + model.body.material().shear_modulus() * model.body.area());
        let mut t = limit;
        for _ in 0..40 {
            for ((p, x), d) in work.trial.iter_mut().zip(&self.x).zip(&work.dx) {
                *p = x + t * d;
            }
            let value = model.energy(&work.trial);
            if value <= energy + 1e-4 * t * slope.min(0.0) + noise {
                std::mem::swap(&mut self.x, &mut work.trial);
                model.gradient(&self.x, &mut self.gradient);
                return t;
            }
            t *= 0.5;
        }
        std::mem::swap(&mut self.gradient, &mut work.forces_there);
        0.0
    }

    /// A Newton step of the statics under the tensions as they are.
    pub(super) fn balance(&self, work: &mut Workspace) {
        for (d, u) in work.dx.iter_mut().zip(&work.newton) {
            *d = -u;
        }
        work.next.copy_from_slice(&work.now);
        work.unbalanced = statics::norm(&self.gradient);
    }

    /// Gives the elements the chosen tensions and moves the body; elements that reach or leave a bound change their law there.
    /// Returns the part of `dx` that was taken and whether any law changed.
    pub(super) fn take(&mut self, question: &mut Question, form: HessianForm, work: &mut Workspace) -> (f64, bool) {
        let clock = Instant::now();
        let elements = &question.model.contractile.elements;
        for (k, fiber) in self.fibers.iter_mut().enumerate() {
            fiber.take(&elements[fiber.element], work.cables.lengths[k], work.next[k], work.limits[k]);
        }
        self.set_laws(question, work);
        let step = self.search(question, form, work);
        let mut changed = false;
        let steady = self.steady(work);
        work.cables.update(&self.x);
        let elements = &question.model.contractile.elements;
        for (k, fiber) in self.fibers.iter_mut().enumerate() {
            fiber.follow(&elements[fiber.element], work.cables.lengths[k], steady);
            let (before, prescribed) = (fiber.tension, fiber.held.is_none());
            changed |= fiber.update(&elements[fiber.element], work.cables.lengths[k]);
            if prescribed && fiber.tension != before {
                work.cables.add_gradient(k, fiber.tension - before, &mut self.gradient);
            }
        }
        work.phases.line_search += clock.elapsed().as_secs_f64();
        (step, changed)
    }
}
