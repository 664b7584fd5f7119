//! The iteration of the all-at-once method, and the state that it moves.

use super::cables::Cables;
use super::dual::{Dual, Subproblem};
use super::fiber::Fiber;
use crate::physics::{HessianForm, Model, statics};
use crate::soft_ik::{Phases, PointTarget, Posture, Question};
use std::time::Instant;

/// First proximal weight `nu`, in units of `rho`: robust from a cold start.
const FIRST_PROXIMAL: f64 = 40.0;
/// Smallest `nu`, in units of `rho`, reached where iterations go well.
const LEAST_PROXIMAL: f64 = 0.1;
/// Largest `nu`, in units of `rho`: beyond it nothing moves.
const LARGEST_PROXIMAL: f64 = 1e8;
/// Largest `nu`, in units of `rho`, with which new targets are met.
const LARGEST_FIRST: f64 = 1e3;
/// A step is good where `O` fell by at least this part of what its model promised, and poor below that part.
const GOOD: f64 = 0.6;
const POOR: f64 = 0.2;
/// A step is excellent where `O` fell by what its model promised, to this part.
const EXCELLENT: f64 = 0.2;
/// Divisors of `nu` after an excellent and a good step, factors after a poor one and after one that made things worse.
const EXCELLENT_DECAY: f64 = 8.0;
const PROXIMAL_DECAY: f64 = 2.0;
const PROXIMAL_GROWTH: f64 = 2.0;
const REJECTION_GROWTH: f64 = 6.0;
/// Iterations in a row that end far from equilibrium, after which the run goes back to its best state.
const PATIENCE: usize = 6;
/// A run stands still where an iteration promises less than this part of `O`, or after `STAGNANT` iterations without a gain
/// of this part.
const STANDSTILL: f64 = 1e-6;
const STAGNANT: usize = 10;
/// A state is kept as the best where its Newton step towards equilibrium is at most this part of the body: farther away,
/// another equilibrium may be nearer than the one expected.
const VERIFIED: f64 = 8e-3;
/// After this many iterations in a row that end farther from it, the next ones balance the forces before they move on.
const UNBALANCED: usize = 5;
/// `O` at an equilibrium is told from a state whose Newton step towards it is at most this part of the body.
const WITHIN_SIGHT: f64 = 0.012;
/// Taut stiffness, in shear moduli, up to which an element is a spring wherever it is taut. A prescribed tension has no
/// stiffness of its own and lets the body buckle where the real cable would not, so a stiffer one is given this stiffness.
const SOFT: f64 = 10.0;
/// Longest step of a node in one iteration, as a part of the body: beyond it the linearised lengths mean nothing.
const LONGEST_STEP: f64 = 0.2;
/// To this it shrinks, by halves, where iterations end far from equilibrium.
const SHORTEST_STEP: f64 = 0.05;
/// First limit on the pull of a single target, as a part of the body; it doubles until it limits nothing.
const FIRST_PULL: f64 = 0.3;
/// A Newton step is taken without a line search where at most this part of the unbalanced forces is left after it.
const BALANCING: f64 = 0.5;
/// Residual, as a part of the forces at work, up to which `O` of a state is taken for that of the equilibrium nearby.
const NEAR_EQUILIBRIUM: f64 = 1e-2;

/// What an iteration did.
pub(in crate::soft_ik) struct Progress {
    pub factorizations: usize,
    /// Longest displacement of a node, as a part of the body.
    pub moved: f64,
    /// Whether no limit of pull or of step length, no change of bounds and no large `nu` played a part in it; or nothing is
    /// left to gain.
    pub settled: bool,
}

/// A state between iterations.
pub(in crate::soft_ik) struct Run {
    pub x: Vec<f64>,
    fibers: Vec<Fiber>,
    /// `dE/dx` under the present tensions.
    gradient: Vec<f64>,
    /// Proximal weight.
    nu: f64,
    /// Longest step of a node, as a part of the body.
    reach: f64,
    /// Present limit on a target's pull, length.
    pull: f64,
    /// `O` at the equilibrium near the state before its step, and how much the step promised to lower it; not known for a
    /// fresh run.
    before: Option<(f64, f64)>,
    /// The multipliers of the step before.
    q: Vec<f64>,
    pub best: Best,
    /// `O` at the equilibrium near the present state.
    now: f64,
    /// Iterations in a row that ended far from equilibrium, and such that ended too far from it to be kept.
    adrift: usize,
    unverified: usize,
    /// Iterations since `O` last fell to `mark`, by more than a standstill.
    stagnant: usize,
    mark: f64,
    /// Whether the run has just gone back to its best state.
    returned: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    On,
    /// To the best state, with shorter steps.
    Back,
}

/// The state of lowest `O` that a run has seen near equilibrium.
pub(in crate::soft_ik) struct Best {
    pub objective: f64,
    pub x: Vec<f64>,
    fibers: Vec<Fiber>,
}

/// What runs work in.
pub(in crate::soft_ik) struct Workspace {
    cables: Cables,
    /// Right-hand sides and solutions, column after column.
    solved: Vec<f64>,
    /// The solutions for the targets and the rest weights, node by node (see [`Cables::rates`]).
    by_node: Vec<f64>,
    jacobian: Vec<f64>,
    row: Vec<f64>,
    linear: Vec<f64>,
    now: Vec<f64>,
    next: Vec<f64>,
    limits: Vec<[f64; 2]>,
    residual: Vec<f64>,
    dx: Vec<f64>,
    pulled: Vec<f64>,
    trial: Vec<f64>,
    forces_there: Vec<f64>,
    /// The largest unbalanced force before the step, under the tensions that it chose.
    unbalanced: f64,
    dual: Dual,
    /// `rho`, never zero.
    rho: f64,
    /// Taut stiffness up to which an element counts as soft.
    softness: f64,
    /// Body size: the longer side of the rest box.
    pub size: f64,
    /// A length of the elements' order.
    scale: f64,
    /// The forces at work where the run began; tensions since then may be larger.
    pub forces: f64,
    pub phases: Phases,
}

impl Workspace {
    pub fn new(question: &Question) -> Self {
        let elements = &question.model.contractile.elements;
        let members = question.actuation.winches.iter().map(|w| w.members[0].0);
        let n = question.model.dimension();
        let count = question.actuation.winches.len();
        let rows = 2 * question.objective.targets.len();
        let mu = question.model.body.material().shear_modulus();
        let weight = question.objective.tension_weight;
        let scale = members.clone().map(|e| elements[e].alpha0).fold(0.0, f64::max);
        Self {
            cables: Cables::new(members.map(|e| &elements[e])),
            solved: vec![0.0; n * (rows + 2)],
            by_node: vec![0.0; n * (rows + 1)],
            jacobian: vec![0.0; count * rows],
            row: vec![0.0; rows + 1],
            linear: vec![0.0; count],
            now: vec![0.0; count],
            next: vec![0.0; count],
            limits: vec![[0.0; 2]; count],
            residual: vec![0.0; rows],
            dx: vec![0.0; n],
            pulled: vec![0.0; n],
            trial: vec![0.0; n],
            forces_there: vec![0.0; n],
            unbalanced: 0.0,
            dual: Dual::default(),
            rho: if weight > 0.0 { weight } else { crate::defaults::TENSION_WEIGHT / (mu * mu) },
            softness: SOFT * mu,
            size: super::extent(&question.model.rest),
            scale,
            forces: 0.0,
            phases: Phases::default(),
        }
    }
}

impl Run {
    pub fn new(question: &mut Question, start: &Posture, work: &mut Workspace) -> Self {
        let elements = &question.model.contractile.elements;
        let fibers: Vec<Fiber> = question
            .actuation
            .winches
            .iter()
            .zip(&start.beta)
            .map(|(winch, beta)| Fiber::new(winch, *beta, elements, &start.x, work.softness))
            .collect();
        let mut run = Self {
            x: start.x.clone(),
            gradient: vec![0.0; start.x.len()],
            nu: FIRST_PROXIMAL * work.rho,
            reach: LONGEST_STEP,
            pull: FIRST_PULL * work.size,
            before: None,
            q: vec![0.0; 2 * question.objective.targets.len()],
            best: Best { objective: f64::INFINITY, x: start.x.clone(), fibers: fibers.clone() },
            fibers,
            now: f64::INFINITY,
            adrift: 0,
            unverified: 0,
            stagnant: 0,
            mark: f64::INFINITY,
            returned: false,
        };
        run.retarget(question, true, work);
        run.returned = false;
        run
    }

    /// Begins anew at a posture, without allocation.
    pub fn restart(&mut self, question: &mut Question, x: &[f64], beta: &[f64], work: &mut Workspace) {
        self.x.copy_from_slice(x);
        let elements = &question.model.contractile.elements;
        for ((fiber, winch), beta) in self.fibers.iter_mut().zip(&question.actuation.winches).zip(beta) {
            *fiber = Fiber::new(winch, *beta, elements, x, work.softness);
        }
        self.nu = FIRST_PROXIMAL * work.rho;
        self.unverified = 0;
        self.q.fill(0.0);
        self.take_best(f64::INFINITY);
        self.retarget(question, true, work);
        self.returned = false;
    }

    /// Goes on from a posture that turned out better than the run's best, with shorter steps.
    pub fn go_on_from(&mut self, question: &mut Question, x: &[f64], beta: &[f64], work: &mut Workspace) {
        let nu = (self.nu * REJECTION_GROWTH).min(LARGEST_PROXIMAL * work.rho);
        self.restart(question, x, beta, work);
        self.nu = nu;
    }

    /// Takes note of new targets: `O` of the state, and of the best one, is no longer what it was. `pulled`: fixed contractions
    /// changed too, so that neither is in equilibrium any more.
    pub fn retarget(&mut self, question: &mut Question, pulled: bool, work: &mut Workspace) {
        self.pull = FIRST_PULL * work.size;
        self.nu = self.nu.min(LARGEST_FIRST * work.rho);
        self.reach = LONGEST_STEP;
        self.adrift = 0;
        self.stagnant = 0;
        self.mark = f64::INFINITY;
        self.before = None;
        for fiber in &mut self.fibers {
            fiber.releases = 0;
        }
        self.best.objective = value(&self.best.x, &self.best.fibers, question, work.rho);
        if pulled {
            self.returned = true;
            self.set_laws(question, work.softness);
            work.forces = question.model.force_scale_into(&self.x, &mut work.trial);
            self.gradient_now(question, work);
        }
    }

    /// Puts the present laws of all elements into the model.
    fn set_laws(&self, question: &mut Question, steady: f64) {
        let contractile = &mut question.model.contractile;
        contractile.set_contractions(&question.actuation.fixed);
        for fiber in &self.fibers {
            contractile.laws[fiber.element] = fiber.law(steady);
        }
    }

    fn gradient_now(&mut self, question: &Question, work: &mut Workspace) {
        let clock = Instant::now();
        question.model.gradient(&self.x, &mut self.gradient);
        work.phases.assembly += clock.elapsed().as_secs_f64();
    }

    /// One iteration; `None` where the stiffness matrix cannot be factorised.
    pub fn iterate(&mut self, question: &mut Question, work: &mut Workspace) -> Option<Progress> {
        let clock = Instant::now();
        work.cables.update(&self.x, work.scale);
        let elements = &question.model.contractile.elements;
        for (fiber, length) in self.fibers.iter_mut().zip(&work.cables.lengths) {
            fiber.release_slack(&elements[fiber.element], *length);
        }
        self.set_laws(question, work.softness);
        work.phases.assembly += clock.elapsed().as_secs_f64();
        let form = factorize(question.model, &self.x, &mut work.phases)?;
        let factorizations = 1 + (form == HessianForm::Projected) as usize;

        let clock = Instant::now();
        self.solve_sides(question, work);
        work.phases.solves += clock.elapsed().as_secs_f64();
        if self.judge(question, work) == Verdict::Back {
            let stuck = self.nu >= LARGEST_PROXIMAL * work.rho;
            self.go_back(question, work);
            return Some(Progress { factorizations, moved: if stuck { 0.0 } else { f64::INFINITY }, settled: stuck });
        }
        let clock = Instant::now();
        let limited = self.linearise(question, work);
        work.phases.dual += clock.elapsed().as_secs_f64();
        if self.unverified > UNBALANCED {
            // Balance first.
            let rows = work.residual.len();
            let n = self.x.len();
            for (d, u) in work.dx.iter_mut().zip(&work.solved[(rows + 1) * n..]) {
                *d = -u;
            }
            work.next.copy_from_slice(&work.now);
            work.unbalanced = statics::norm(&self.gradient);
            self.before = None;
        } else {
            self.choose(question, work);
            self.before = Some((self.now, self.promise(work)));
        }
        let longest = longest(&work.dx);
        let clock = Instant::now();
        let elements = &question.model.contractile.elements;
        for (k, fiber) in self.fibers.iter_mut().enumerate() {
            fiber.take(&elements[fiber.element], work.cables.lengths[k], work.next[k], work.limits[k]);
        }
        self.set_laws(question, work.softness);
        let step = self.search(question, form, work);
        let mut changed = false;
        work.cables.update(&self.x, work.scale);
        let elements = &question.model.contractile.elements;
        for (k, fiber) in self.fibers.iter_mut().enumerate() {
            fiber.follow(&elements[fiber.element], work.cables.lengths[k], work.softness);
            let (before, prescribed) = (fiber.tension, fiber.held.is_none());
            changed |= fiber.update(&elements[fiber.element], work.cables.lengths[k]);
            if prescribed && fiber.tension != before {
                work.cables.add_gradient(k, fiber.tension - before, &mut self.gradient);
            }
        }
        work.phases.line_search += clock.elapsed().as_secs_f64();
        if limited && step >= 0.5 {
            self.pull *= 2.0;
        }
        self.note(question, work);
        let gentle = self.nu <= LARGEST_FIRST * work.rho;
        let free = !limited && !changed && step >= 0.5 && gentle;
        let promised = self.before.map_or(f64::INFINITY, |(now, promised)| promised / now.abs());
        if !limited && (gentle && promised <= STANDSTILL || self.stagnant > STAGNANT) {
            return Some(Progress { factorizations, moved: 0.0, settled: true });
        }
        Some(Progress { factorizations, moved: step * longest / work.size, settled: free })
    }

    /// `H [Y, v, u] = [S^T, Q (x - X) + held tensions, g]`, targets scaled by the root of their weight.
    fn solve_sides(&self, question: &mut Question, work: &mut Workspace) {
        let n = self.x.len();
        let objective = question.objective;
        let rows = 2 * objective.targets.len();
        work.solved.resize(n * (rows + 2), 0.0);
        work.solved[..n * rows].fill(0.0);
        for (t, target) in objective.targets.iter().enumerate() {
            for axis in 0..2 {
                add_row(target, axis, &mut work.solved[(2 * t + axis) * n..][..n]);
            }
        }
        let mut solved = std::mem::take(&mut work.solved);
        let (pull, g) = solved[rows * n..].split_at_mut(n);
        objective.rest_gradient(&self.x, pull);
        self.add_tension_of_springs(question, work, pull);
        g.copy_from_slice(&self.gradient);
        work.solved = solved;
        question.model.solve_many(&mut work.solved, rows + 2);
    }

    /// Adds the derivative by `x` of `rho/2 tau^2` where tension changes with length: `rho tau dtau/dl dl/dx`.
    fn add_tension_of_springs(&self, question: &Question, work: &Workspace, out: &mut [f64]) {
        for (k, fiber) in self.fibers.iter().enumerate() {
            let element = &question.model.contractile.elements[fiber.element];
            let (tau, tangent) = fiber.law(work.softness).tension_and_tangent(element, work.cables.lengths[k]);
            let factor = work.rho * tau * tangent;
            if factor != 0.0 {
                work.cables.add_gradient(k, factor, out);
            }
        }
    }

    /// `J`, `c`, `r_0` and the limits. Whether a target's pull was limited.
    fn linearise(&self, question: &Question, work: &mut Workspace) -> bool {
        let n = self.x.len();
        let targets = &question.objective.targets;
        let (rows, columns) = (2 * targets.len(), 2 * targets.len() + 1);
        work.by_node.resize(n * columns, 0.0);
        for (c, column) in work.solved.chunks_exact(n).take(columns).enumerate() {
            for (d, v) in column.iter().enumerate() {
                work.by_node[d * columns + c] = *v;
            }
        }
        let count = self.fibers.len();
        work.jacobian.resize(count * rows, 0.0);
        work.row.resize(columns, 0.0);
        let elements = &question.model.contractile.elements;
        for (k, fiber) in self.fibers.iter().enumerate() {
            work.cables.rates(k, &work.by_node, &mut work.row);
            for (r, rate) in work.row[..rows].iter().enumerate() {
                work.jacobian[r * count + k] = *rate;
            }
            work.linear[k] = work.row[rows];
            work.now[k] = fiber.tension;
            work.limits[k] = fiber.limits(&elements[fiber.element], work.cables.lengths[k]);
        }
        work.residual.resize(rows, 0.0);
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
        limited
    }

    /// The step in tension, and `dx = -u - H^-1 G^T dtau` that follows; shorter by a larger `nu` where it is too long.
    fn choose(&mut self, question: &mut Question, work: &mut Workspace) {
        let n = self.x.len();
        let rows = work.residual.len();
        let most = self.reach * work.size;
        self.q.resize(rows, 0.0);
        let mut q = std::mem::take(&mut self.q);
        if q.iter().all(|q| *q == 0.0) {
            q.copy_from_slice(&work.residual);
        }
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
            work.dual.solve(&problem, &mut q, &mut work.next);
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
            let u = &work.solved[(rows + 1) * n..];
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
    }

    /// The decrease of `O` that the linearised model promises for the chosen tensions.
    fn promise(&self, work: &mut Workspace) -> f64 {
        let count = work.now.len();
        let mut promised = 0.0;
        for k in 0..count {
            let (now, next) = (work.now[k], work.next[k]);
            promised -= (work.linear[k] + 0.5 * work.rho * (next + now)) * (next - now);
        }
        for (r, row) in work.residual.iter().zip(work.jacobian.chunks_exact(count.max(1))) {
            let change: f64 = row.iter().zip(&work.next).zip(&work.now).map(|((j, next), now)| j * (next - now)).sum();
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

    /// Compares `O` at the equilibrium that the state is on its way to, `x - u`, with what the last step promised. Keeps it if
    /// it is the best, and lets `nu` follow success.
    fn judge(&mut self, question: &Question, work: &mut Workspace) -> Verdict {
        let n = self.x.len();
        let rows = 2 * question.objective.targets.len();
        let u = &work.solved[(rows + 1) * n..];
        for ((p, x), u) in work.pulled.iter_mut().zip(&self.x).zip(u) {
            *p = x - u;
        }
        let distance = longest(u) / work.size;
        let within_sight = distance <= WITHIN_SIGHT;
        let verified = distance <= VERIFIED;
        self.unverified = if verified { 0 } else { self.unverified + 1 };
        let most = LARGEST_PROXIMAL * work.rho;
        self.now = value(&work.pulled, &self.fibers, question, work.rho);
        if !within_sight {
            self.reach = (self.reach * 0.5).max(SHORTEST_STEP);
            self.adrift += 1;
            self.nu = (self.nu * PROXIMAL_GROWTH).min(most);
            return if self.adrift > PATIENCE && self.best.objective.is_finite() { Verdict::Back } else { Verdict::On };
        }
        self.adrift = 0;
        if self.returned {
            // What it was kept for was foreseen one step ahead; this is what it is.
            self.returned = false;
            self.best.objective = f64::INFINITY;
        }
        if let Some((before, promised)) = self.before {
            let ratio = (before - self.now) / promised.max(f64::MIN_POSITIVE);
            if verified && self.now > self.best.objective * (1.0 + 1e-9) && ratio < 0.0 {
                self.stagnant += 1;
                return Verdict::Back;
            }
            if ratio >= GOOD {
                let decay = if (ratio - 1.0).abs() < EXCELLENT { EXCELLENT_DECAY } else { PROXIMAL_DECAY };
                self.nu = (self.nu / decay).max(LEAST_PROXIMAL * work.rho);
            } else if ratio < POOR {
                self.nu = (self.nu * PROXIMAL_GROWTH).min(most);
            }
        }
        if verified {
            if self.now < (1.0 - STANDSTILL) * self.mark {
                self.mark = self.now;
                self.stagnant = 0;
            } else {
                self.stagnant += 1;
            }
        }
        if verified && self.now < self.best.objective && question.model.body.smallest_determinant(&work.pulled) > 0.0 {
            self.best.objective = self.now;
            self.best.x.copy_from_slice(&work.pulled);
            self.best.fibers.copy_from_slice(&self.fibers);
        }
        Verdict::On
    }

    fn go_back(&mut self, question: &mut Question, work: &mut Workspace) {
        self.x.copy_from_slice(&self.best.x);
        self.fibers.copy_from_slice(&self.best.fibers);
        self.nu = (self.nu * REJECTION_GROWTH).min(LARGEST_PROXIMAL * work.rho);
        self.adrift = 0;
        self.returned = true;
        self.before = None;
        self.set_laws(question, work.softness);
        self.gradient_now(question, work);
    }

    /// Keeps a state that the last step took close to equilibrium, before the next factorisation.
    fn note(&mut self, question: &Question, work: &Workspace) {
        let forces = self.fibers.iter().fold(work.forces, |m, f| m.max(f.tension));
        if statics::norm(&self.gradient) <= NEAR_EQUILIBRIUM * forces {
            let objective = value(&self.x, &self.fibers, question, work.rho);
            if objective < self.best.objective {
                self.take_best(objective);
            }
        }
    }

    fn take_best(&mut self, objective: f64) {
        self.best.objective = objective;
        self.best.x.copy_from_slice(&self.x);
        self.best.fibers.copy_from_slice(&self.fibers);
    }
}

impl Best {
    /// Activations that hold the tensions at the positions, within the bounds, into `beta`.
    pub fn activations_into(&self, question: &Question, beta: &mut [f64]) {
        let elements = &question.model.contractile.elements;
        for (b, fiber) in beta.iter_mut().zip(&self.fibers) {
            let element = &elements[fiber.element];
            *b = fiber.activation(element, element.length(&self.x));
        }
        question.actuation.clamp(beta);
    }
}

/// `O` of the tension form at `x`.
fn value(x: &[f64], fibers: &[Fiber], question: &Question, rho: f64) -> f64 {
    let tensions: f64 = fibers.iter().map(|f| f.tension * f.tension).sum();
    question.objective.position_value(x) + 0.5 * rho * tensions
}

/// Assembles and factorises; both count as factorisation in the phases.
fn factorize(model: &mut Model, x: &[f64], phases: &mut Phases) -> Option<HessianForm> {
    let clock = Instant::now();
    let form = model.factorize_for_descent(x).ok();
    phases.factorization += clock.elapsed().as_secs_f64();
    form
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
