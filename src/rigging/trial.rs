//! Trying a rig out: the realizable plushie of a design, posed for every pose, from the activations known so far.

use crate::design::{Design, Target};
use crate::engine::compile::{Plushie, View, compile, objective};
use crate::engine::target_error;
use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::winding::{self, Search};
use crate::soft_ik::{Actuation, Budget, Method, Posture, Question};
use std::sync::atomic::{AtomicBool, Ordering};

/// Steps in which new winches are wound over their range.
const SCREENING_STEPS: usize = 4;
const SETTLING_STEPS: usize = 8;
/// Gauss-Newton iterations: enough to tell networks apart, and to settle on one.
const SCREENING_ITERATIONS: usize = 4;
const SETTLING_ITERATIONS: usize = 25;
/// Factorisations of a look at other valleys: about what settling in one costs.
const LOOKING: usize = 150;

/// How carefully a rig is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scrutiny {
    /// Enough to tell candidates apart.
    Screen,
    /// A look at the other valleys as well; what is reached is proved to be wound from rest.
    Look,
    /// All effort: what is told of a pose that is kept.
    Whole,
}

/// A pose reached by a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    pub posture: Posture,
    /// Rms distance of the targets, in body lengths.
    pub error: f64,
}

/// The realizable plushie of a design, ready for several poses.
pub struct Trial {
    plushie: Plushie,
    actuation: Actuation,
}

impl Trial {
    /// `None` where the design has no model.
    pub fn new(design: &Design) -> Option<Self> {
        let plushie = compile(design, View::Realizable).ok()?;
        let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
        Some(Self { plushie, actuation })
    }

    /// Poses the plushie. `known` is the posture of the rig without its last winches: those are wound over their
    /// range first.
    pub fn pose(
        &mut self,
        design: &Design,
        targets: &[Target],
        known: Option<&Posture>,
        scrutiny: Scrutiny,
        cancel: &AtomicBool,
    ) -> Reached {
        let objective = objective(design, &self.plushie, targets);
        let mut question =
            Question { model: &mut self.plushie.model, actuation: &self.actuation, objective: &objective };
        let stop = || cancel.load(Ordering::Relaxed);
        let count = self.actuation.winches.len();
        let rest = question.model.rest.clone();
        let (old_beta, old_x) = known.map_or((&[][..], rest.as_slice()), |p| (p.beta.as_slice(), p.x.as_slice()));
        let known_count = old_beta.len().min(count);
        let at = |part: f64| -> Vec<f64> {
            let new = self.actuation.winches[known_count..].iter().map(|w| part * w.upper);
            old_beta.iter().take(count).copied().chain(new).collect()
        };
        // Wind what is new slowly and go on from where the body came closest.
        let (mut posture, _) = question.settle(&at(0.0), old_x, &stop);
        let mut closest = posture.clone();
        let steps = match scrutiny {
            _ if known_count == count => 0,
            Scrutiny::Screen => SCREENING_STEPS,
            _ => SETTLING_STEPS,
        };
        for step in 1..=steps {
            (posture, _) = question.settle(&at(step as f64 / steps as f64), &posture.x, &stop);
            if posture.in_equilibrium() && posture.objective < closest.objective {
                closest = posture.clone();
            }
        }
        let iterations = if scrutiny == Scrutiny::Screen { SCREENING_ITERATIONS } else { SETTLING_ITERATIONS };
        let budget = Budget { iterations, stop: &stop };
        let mut posture = GaussNewton::default().solve(&mut question, &closest, &budget).posture;
        if scrutiny != Scrutiny::Screen {
            posture = look(&mut question, &posture, scrutiny, &stop);
        }
        let nodes: Vec<[f64; 2]> = posture.x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
        Reached { error: target_error(design, targets, &nodes), posture }
    }
}

/// The best that winding from rest reaches, `known` included where winding leads there.
fn look(question: &mut Question, known: &Posture, scrutiny: Scrutiny, stop: &dyn Fn() -> bool) -> Posture {
    let count = known.beta.len();
    let rest = question.model.rest.clone();
    let (zero, _) = question.settle(&vec![0.0; count], &rest, stop);
    let care = match scrutiny {
        Scrutiny::Whole => winding::Care::THOROUGH,
        // With many winches a look around costs more than it finds: what is known is proved.
        _ if count > winding::LATTICE => winding::Care { walking: 0, polished: 0, ..winding::Care::quick(count) },
        _ => winding::Care { walking: LOOKING, ..winding::Care::quick(count) },
    };
    // A body that can turn freely has nothing to prove.
    let proved = question.model.free_pieces() == 0;
    let mut search = Search::new(question, &zero, winding::Care { proved, ..care });
    search.offer(known, false);
    search.run(question, stop).posture
}
