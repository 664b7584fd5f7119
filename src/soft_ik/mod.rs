//! Soft IK: which contractions bring the body closest to its targets (section 5).
//!
//! Minimises, over the activations `beta` of the free winches within their bounds, with `x` in equilibrium,
//!
//! ```text
//! O = 1/2 sum_T q_t |S_t x - x'_t|^2 + 1/2 sum_i q_i |x_i - X_i|^2 + lambda/2 sum (alpha_c/alpha_0)^2 + rho/2 sum_free tau^2
//! ```
//!
//! `S_t x` is a point of the body. A muscle fibre is a winch with a single element. Four methods implement [`Method`]:
//!
//! | method | unknowns | for |
//! | --- | --- | --- |
//! | [`gradient`] | `xi`, the paper's reparametrisation | the baseline: Algorithm 1 as printed; may stall where elements go slack |
//! | [`contraction`] | `beta`, Gauss-Newton with true bounds | winches |
//! | [`newton`] | `beta`, Newton with true bounds, sparse | the question's own objective, at any number of fibres |
//! | [`tension`] | `x` and the tensions of the free elements, all at once | many fibres under the hand |
//!
//! [`solve`] is the default: it chooses and combines them, and never returns an answer stuck in the slack stall.

pub mod actuation;
pub mod contraction;
pub mod default_method;
mod fibers;
pub mod gradient;
pub mod newton;
pub mod objective;
mod quadratic;
pub mod sensitivity;
pub mod tension;
pub mod tracker;
pub mod winding;

pub use actuation::{Actuation, Winch};
pub use default_method::solve;
pub use objective::{Objective, PointTarget};
pub use tracker::{Frame, Phases, Quality, Tracker};

use crate::physics::{Cause, Model, StaticsSettings, statics};

/// The question: a body, what may pull, and where it should go.
pub struct Question<'a> {
    pub model: &'a mut Model,
    pub actuation: &'a Actuation,
    pub objective: &'a Objective,
}

/// Activations of the free winches with the equilibrium they lead to.
#[derive(Clone, Debug, PartialEq)]
pub struct Posture {
    pub beta: Vec<f64>,
    pub x: Vec<f64>,
    /// `O` of the question.
    pub objective: f64,
    /// `max |dE/dx|`.
    pub residual: f64,
    /// Why statics did not converge at these activations; `None` where it did.
    pub unsettled: Option<Cause>,
}

impl Posture {
    /// Whether statics converged at these activations.
    pub fn in_equilibrium(&self) -> bool {
        self.unsettled.is_none()
    }
}

/// What a method did.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    pub posture: Posture,
    pub iterations: usize,
    pub factorizations: usize,
    /// Whether the method's own objective cannot be lowered any more, by its own measure.
    pub converged: bool,
    /// Starts that were followed.
    pub starts: usize,
}

impl Answer {
    /// Nothing done yet.
    pub fn at(posture: &Posture) -> Self {
        Self { posture: posture.clone(), iterations: 0, factorizations: 0, converged: false, starts: 1 }
    }

    /// Takes the better posture and adds up the work.
    fn absorb(&mut self, other: Self) {
        self.iterations += other.iterations;
        self.factorizations += other.factorizations;
        if other.posture.objective <= self.posture.objective || !self.posture.in_equilibrium() {
            self.posture = other.posture;
            self.converged = other.converged;
        }
    }
}

/// How long a method may go on.
pub struct Budget<'a> {
    pub iterations: usize,
    /// Asked between factorisations; `true` ends the work with the best posture so far.
    pub stop: &'a dyn Fn() -> bool,
}

/// A way to minimise `O` from a starting posture.
pub trait Method {
    fn name(&self) -> &'static str;
    /// What it minimises: the question's own `O`, where nothing else is said.
    fn objective(&self) -> &'static str {
        "objective"
    }
    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer;
}

impl Question<'_> {
    /// The equilibrium at activations `beta`, statics started from `from`. The best state reached, where statics fails.
    pub fn settle(&mut self, beta: &[f64], from: &[f64], stop: &dyn Fn() -> bool) -> (Posture, usize) {
        self.settle_to(beta, from, &StaticsSettings::default(), stop)
    }

    /// The same, as far as `settings` ask for.
    pub fn settle_to(
        &mut self,
        beta: &[f64],
        from: &[f64],
        settings: &StaticsSettings,
        stop: &dyn Fn() -> bool,
    ) -> (Posture, usize) {
        let contractions = self.actuation.contractions(beta);
        self.model.contractile.set_contractions(&contractions);
        let (state, unsettled) = match statics::solve(self.model, from, settings, stop) {
            Ok(state) => (state, None),
            Err(error) => (error.best, Some(error.cause)),
        };
        let objective = self.objective_at(&state.x, &contractions);
        let posture = Posture { beta: beta.to_vec(), x: state.x, objective, residual: state.residual, unsettled };
        (posture, state.factorizations)
    }

    /// The equilibrium that winding from `from` leads to: the activations go to `beta` in `steps` equal steps, each settled
    /// from the one before. A soft body can have several equilibria at the same activations; this is the one a real plushie
    /// would be in.
    pub fn wind(&mut self, from: &Posture, beta: &[f64], steps: usize, stop: &dyn Fn() -> bool) -> (Posture, usize) {
        let mut posture = from.clone();
        let mut factorizations = 0;
        for step in 1..=steps {
            let part = step as f64 / steps as f64;
            let between: Vec<f64> = from.beta.iter().zip(beta).map(|(a, b)| a + part * (b - a)).collect();
            let target = if step == steps { beta } else { &between };
            let (next, count) = self.settle(target, &posture.x, stop);
            posture = next;
            factorizations += count;
        }
        (posture, factorizations)
    }

    /// The activations at which every winch has all its elements taut at `x`, whatever its bounds.
    fn just_taut(&self, x: &[f64]) -> Vec<f64> {
        let elements = &self.model.contractile.elements;
        let of = |&(e, r): &(usize, f64)| (elements[e].alpha0 - elements[e].length(x) + elements[e].epsilon) / r;
        let winches = self.actuation.winches.iter();
        winches.map(|w| w.members.iter().map(of).fold(f64::NEG_INFINITY, f64::max)).collect()
    }

    /// `O` at `x` with all elements springs at `contractions` (as set in the model).
    pub fn objective_at(&self, x: &[f64], contractions: &[f64]) -> f64 {
        let tensions = self.model.contractile.tensions(x);
        self.objective.value(x, &self.model.contractile.elements, contractions, &tensions, self.actuation)
    }
}

/// The method of this name, or `None`.
pub fn method(name: &str) -> Option<Box<dyn Method>> {
    match name {
        "gradient" => Some(Box::new(gradient::Gradient::default())),
        "contraction" => Some(Box::new(contraction::GaussNewton::default())),
        "newton" => Some(Box::new(newton::Newton::default())),
        "tension" => Some(Box::new(tension::AllAtOnce::default())),
        "default" => Some(Box::new(default_method::Default)),
        _ => None,
    }
}

/// The names that [`method`] knows.
pub const METHODS: [&str; 5] = ["default", "gradient", "contraction", "newton", "tension"];
