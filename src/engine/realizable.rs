//! The realizable plushie: the winches alone.

use super::compile::View;
use super::compiled::{Compiled, Work, compiled};
use super::report::report;
use super::request::Setpoint;
use super::shape::Shape;
use super::warning::Warning;
use crate::design::Design;
use crate::soft_ik::Actuation;
use std::time::Instant;

/// The winches alone, towards the targets or at given activations.
pub(super) fn realize(slot: &mut Option<Compiled>, design: &Design, setpoint: &Setpoint, work: &Work) -> Shape {
    let clock = Instant::now();
    let compiled = match compiled(slot, design, View::Realizable) {
        Ok(compiled) => compiled,
        Err(message) => return Shape::at_rest(design, message),
    };
    let plushie = &compiled.plushie;
    let (targets, actuation, beta) = match setpoint {
        Setpoint::Targets(targets) => {
            let free = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
            (targets.as_slice(), free, vec![0.0; plushie.winches.len()])
        }
        Setpoint::Activations(beta) => {
            let all = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
            let held = Actuation { winches: Vec::new(), fixed: all.contractions(beta) };
            (&[][..], held, Vec::new())
        }
    };
    let answer = compiled.answer(design, targets, &actuation, beta, None, work);
    let play = compiled.play(design, targets, &actuation, &answer.posture, work);
    let plushie = &compiled.plushie;
    let mut shape = report(design, plushie, targets, &answer.posture, clock).counted(&answer);
    shape.wound = play.is_some() && plushie.model.free_pieces() == 0;
    if shape.warning.is_none() {
        shape.warning = Warning::of_play(design, targets, shape.target_error, play.as_ref());
    }
    shape.play = play;
    if let Setpoint::Activations(beta) = setpoint {
        shape.activations_mm = beta.clone();
    }
    shape
}
