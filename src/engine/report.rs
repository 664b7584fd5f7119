//! A posture as it is shown.

use super::compile::Plushie;
use super::measure::target_error;
use super::shape::Shape;
use super::warning::Warning;
use crate::design::{Design, Target};
use crate::soft_ik::{Answer, Posture};
use std::time::Instant;

/// Activations for display and export: a winch whose cables are all slack is wound just to the point where they are not
/// yet taut, within its bounds.
fn tidy(plushie: &Plushie, posture: &Posture) -> Vec<f64> {
    let elements = &plushie.model.contractile.elements;
    plushie
        .winches
        .iter()
        .zip(&posture.beta)
        .map(|(winch, beta)| {
            let slack = |&(e, ratio): &(usize, f64)| elements[e].just_slack(&posture.x) / ratio;
            let just_slack = winch.members.iter().map(slack).fold(f64::INFINITY, f64::min);
            if just_slack > *beta { just_slack.min(winch.upper) } else { *beta }
        })
        .collect()
}

/// A posture as it is shown. The model's laws must be those of the posture.
pub fn report(design: &Design, plushie: &Plushie, targets: &[Target], posture: &Posture, clock: Instant) -> Shape {
    let tensions = plushie.model.contractile.tensions(&posture.x);
    let nodes: Vec<[f64; 2]> = posture.x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
    Shape {
        target_error: target_error(design, targets, &nodes),
        nodes,
        activations_mm: tidy(plushie, posture),
        fiber_contractions_mm: Vec::new(),
        fiber_tensions: Vec::new(),
        tendon_tensions: tensions[plushie.tendons.clone()].to_vec(),
        residual: posture.residual,
        force_scale: plushie.model.force_scale(&posture.x),
        converged: posture.in_equilibrium(),
        iterations: 0,
        factorizations: 0,
        milliseconds: clock.elapsed().as_secs_f64() * 1e3,
        wound: false,
        play: None,
        warning: Warning::of(plushie, posture),
    }
}

impl Shape {
    pub(super) fn counted(self, answer: &Answer) -> Self {
        Self { iterations: answer.iterations, factorizations: answer.factorizations, ..self }
    }

    /// The rest shape, with what is to be said about it.
    pub fn at_rest(design: &Design, why: String) -> Self {
        Self {
            nodes: design.mesh.nodes.clone(),
            activations_mm: vec![0.0; design.networks.len()],
            warning: Some(Warning::Solver(why)),
            ..Self::default()
        }
    }
}
