//! The idealized plushie: fibres beside the winches.

use super::compile::View;
use super::compiled::{Compiled, Work, compiled};
use super::report::report;
use super::request::Setpoint;
use super::shape::Shape;
use crate::design::Design;
use crate::soft_ik::Actuation;
use std::time::Instant;

/// The fibres, with the winches held at `activations`. `beside`: where these winches alone have brought the realizable plushie.
pub(super) fn idealize(
    slot: &mut Option<Compiled>,
    design: &Design,
    setpoint: &Setpoint,
    activations: &[f64],
    beside: Option<&[f64]>,
    work: &Work,
) -> Shape {
    let clock = Instant::now();
    let compiled = match compiled(slot, design, View::Idealized) {
        Ok(compiled) => compiled,
        Err(message) => return Shape::at_rest(design, message),
    };
    let plushie = &compiled.plushie;
    let count = plushie.fiber_elements.end;
    let all = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; count] };
    let fixed = all.contractions(activations);
    let (targets, winches) = match setpoint {
        Setpoint::Targets(targets) => (targets.as_slice(), plushie.fibers.clone()),
        Setpoint::Activations(_) => (&[][..], Vec::new()),
    };
    let beta = vec![0.0; winches.len()];
    let actuation = Actuation { winches, fixed };
    let answer = compiled.answer(design, targets, &actuation, beta, beside, work);
    let plushie = &compiled.plushie;
    let mut shape = report(design, plushie, targets, &answer.posture, clock).counted(&answer);
    shape.activations_mm = activations.to_vec();
    let contractions = actuation.contractions(&answer.posture.beta);
    let tensions = plushie.model.contractile.tensions(&answer.posture.x);
    shape.fiber_contractions_mm = contractions[plushie.fiber_elements.clone()].to_vec();
    shape.fiber_tensions = tensions[plushie.fiber_elements.clone()].to_vec();
    shape
}
