//! Winches of several elements, frame after frame.

use super::Tracker;
use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::winding::{Care, Search};
use crate::soft_ik::{Budget, Frame, Method, Phases, Question};
use std::time::Instant;

impl Tracker {
    /// Winches of several elements: Gauss-Newton in their few activations, every trial an equilibrium.
    pub(super) fn wind(
        &mut self,
        question: &mut Question,
        moved: bool,
        budget: usize,
        stop: &dyn Fn() -> bool,
    ) -> Frame {
        let clock = Instant::now();
        question.actuation.contractions_into(&self.posture.beta, &mut self.contractions);
        question.model.contractile.set_contractions(&self.contractions);
        self.posture.objective = question.objective_at(&self.posture.x, &self.contractions);
        let iterations = if moved || !self.wound { budget } else { 0 };
        let mut answer = GaussNewton::default().solve(question, &self.posture, &Budget { iterations, stop });
        // It has ended, too, where no step leads on.
        self.wound = answer.converged || iterations == 0 || answer.iterations < iterations && !stop();
        self.posture = answer.posture;
        if moved {
            self.search = None;
        } else if iterations == 0 {
            answer.factorizations += self.look_around(question, budget, stop);
        }
        let phases = Phases { line_search: clock.elapsed().as_secs_f64(), ..Phases::default() };
        Frame {
            iterations: answer.iterations,
            factorizations: answer.factorizations,
            converged: self.wound && self.search.as_ref().is_some_and(Search::is_done),
            residual: self.posture.residual,
            force_scale: question.model.force_scale_into(&self.posture.x, &mut self.trial),
            phases,
        }
    }

    /// A frame's part of the search for the best wound state; at its end that is shown. Returns the factorisations spent.
    fn look_around(&mut self, question: &mut Question, budget: usize, stop: &dyn Fn() -> bool) -> usize {
        let mut spent = 0;
        // A body that can turn freely ends in another position of the same pose each time: there is nothing to prove.
        let proved = question.model.free_pieces() == 0;
        let mut search = match self.search.take() {
            Some(search) => search,
            None => {
                let mut zero = vec![0.0; self.posture.beta.len()];
                question.actuation.clamp(&mut zero);
                let rest = question.model.rest.clone();
                let (rest, count) = question.settle(&zero, &rest, stop);
                if stop() {
                    return count;
                }
                spent += count;
                let mut search = Search::new(question, &rest, Care { proved, ..Care::THOROUGH });
                search.offer(&self.posture, true);
                search
            }
        };
        if !search.is_done() {
            spent += search.advance(question, budget.saturating_sub(spent), stop);
            let best = search.best();
            if search.is_done() && (proved || best.objective < self.posture.objective) {
                self.posture.clone_from(best);
            }
            question.actuation.contractions_into(&self.posture.beta, &mut self.contractions);
            question.model.contractile.set_contractions(&self.contractions);
        }
        self.search = Some(search);
        spent
    }
}
