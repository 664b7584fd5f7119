//! The question, and a state that may answer it.

use super::actuation::Actuation;
use super::objective::Objective;
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

impl Question<'_> {
    /// The equilibrium at activations `beta`, statics started from `from`. The best state reached, where statics fails.
    pub fn settle(&mut self, beta: &[f64], from: &[f64], stop: &dyn Fn() -> bool) -> (Posture, usize) {
        self.settle_to(beta, from, &StaticsSettings::default(), stop)
    }

    /// [`Self::settle`], as far as `settings` ask for.
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
    pub(super) fn just_taut(&self, x: &[f64]) -> Vec<f64> {
        let elements = &self.model.contractile.elements;
        let of = |&(e, r): &(usize, f64)| elements[e].just_taut(x) / r;
        let winches = self.actuation.winches.iter();
        winches.map(|w| w.members.iter().map(of).fold(f64::NEG_INFINITY, f64::max)).collect()
    }

    /// `O` at `x` with all elements springs at `contractions` (as set in the model).
    pub fn objective_at(&self, x: &[f64], contractions: &[f64]) -> f64 {
        let tensions = self.model.contractile.tensions(x);
        self.objective.value(x, &self.model.contractile.elements, contractions, &tensions, self.actuation)
    }

    /// The longer side of the box around the body at rest.
    pub(super) fn body_size(&self) -> f64 {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for p in self.model.rest.chunks_exact(2) {
            for a in 0..2 {
                low[a] = low[a].min(p[a]);
                high[a] = high[a].max(p[a]);
            }
        }
        (high[0] - low[0]).max(high[1] - low[1])
    }
}
