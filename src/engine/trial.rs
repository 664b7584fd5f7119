//! Trying a rig out: the realizable plushie of a design, posed for every pose, from the activations known so far.

use super::Shape;
use super::compile::{Plushie, View, compile, objective};
use super::solver::{report, target_error};
use crate::design::{Design, Target};
use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::{Actuation, Budget, Method, Posture, Question};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Parts of the range of a new winch from which it is tried.
const START_PARTS: [f64; 3] = [0.05, 0.3, 0.6];
/// Gauss-Newton iterations: enough to tell networks apart, and to settle on one.
const SCREENING_ITERATIONS: usize = 4;
const SETTLING_ITERATIONS: usize = 25;

/// Two states count as the same where their objectives agree to this factor.
const SAME_STATE: f64 = 1.01;

/// How carefully a rig is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Care {
    Screen,
    Settle,
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

    /// Poses the plushie. `known` is the posture of the rig without its last winches: those are tried from several
    /// activations, and from rest as a whole.
    pub fn pose(
        &mut self,
        design: &Design,
        targets: &[Target],
        known: Option<&Posture>,
        care: Care,
        cancel: &AtomicBool,
    ) -> Reached {
        let objective = objective(design, &self.plushie, targets);
        let mut question =
            Question { model: &mut self.plushie.model, actuation: &self.actuation, objective: &objective };
        let stop = || cancel.load(Ordering::Relaxed);
        let count = self.actuation.winches.len();
        let rest = question.model.rest.clone();
        let (old_beta, old_x) = known.map_or((&[][..], rest.as_slice()), |p| (p.beta.as_slice(), p.x.as_slice()));
        let mut starts: Vec<Vec<f64>> = Vec::new();
        let parts = if care == Care::Screen { &START_PARTS[1..2] } else { &START_PARTS[..] };
        for part in parts {
            let new = self.actuation.winches[old_beta.len().min(count)..].iter().map(|w| part * w.upper);
            starts.push(old_beta.iter().take(count).copied().chain(new).collect());
        }
        starts.dedup();
        let iterations = if care == Care::Screen { SCREENING_ITERATIONS } else { SETTLING_ITERATIONS };
        let mut best: Option<Posture> = None;
        for beta in starts {
            let (start, _) = question.settle(&beta, old_x, &stop);
            let answer = GaussNewton::default().solve(&mut question, &start, &Budget { iterations, stop: &stop });
            let better = best.as_ref().is_none_or(|b| answer.posture.objective < b.objective);
            if answer.posture.in_equilibrium && better {
                best = Some(answer.posture);
            }
        }
        let mut posture = best.unwrap_or_else(|| question.settle(&vec![0.0; count], &rest, &stop).0);
        if care == Care::Settle {
            // A soft body can have several equilibria at the same activations. What counts is the one that winding from
            // rest leads to.
            let (fresh, _) = question.settle(&posture.beta, &rest, &stop);
            if fresh.objective > SAME_STATE * posture.objective {
                let budget = Budget { iterations, stop: &stop };
                posture = GaussNewton::default().solve(&mut question, &fresh, &budget).posture;
            }
        }
        let nodes: Vec<[f64; 2]> = posture.x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
        Reached { error: target_error(design, targets, &nodes), posture }
    }

    /// The shape of a posture reached, for showing.
    pub fn shape(&mut self, design: &Design, targets: &[Target], reached: &Reached) -> Shape {
        let contractions = self.actuation.contractions(&reached.posture.beta);
        self.plushie.model.contractile.set_contractions(&contractions);
        report(design, &self.plushie, targets, &reached.posture, 0, Instant::now())
    }
}
