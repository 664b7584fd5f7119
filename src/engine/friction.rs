//! Poses of the realizable plushie when its cables rub at their holes.

use super::compile::{Plushie, View, compile, objective};
use super::measure::target_error;
use crate::design::{Design, Target};
use crate::physics::{Friction, FrictionError, ModelError};
use crate::soft_ik::{self, Actuation, Question};

/// A pose under friction. Errors are rms distances of the targets in body lengths.
#[derive(Clone, Debug)]
pub struct FrictionPose {
    /// Cable wound by each winch, mm: what serves the pose best when all cables have been pulled.
    pub activations_mm: Vec<f64>,
    pub error: f64,
    /// At the same activations when all cables have been let out: the other end of the band; or why that is not known.
    pub error_letting_out: Result<f64, Box<FrictionError>>,
    /// Whether no other activations promise to come closer.
    pub converged: bool,
    pub factorizations: usize,
}

/// Why there is no pose under friction.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrictionPoseError {
    #[error(transparent)]
    Model(#[from] ModelError),
    #[error(transparent)]
    Friction(#[from] Box<FrictionError>),
}

impl Plushie {
    /// Its tendons rub with this coefficient; fibres do not.
    pub fn friction(&self, mu: f64) -> Friction {
        let elements = 0..self.model.contractile.elements.len();
        let coefficients: Vec<f64> = elements.map(|e| if self.tendons.contains(&e) { mu } else { 0.0 }).collect();
        Friction::new(&self.model, &coefficients)
    }
}

/// The realizable plushie of a design towards targets when its cables rub with the coefficient `mu`, looked for near the activations
/// (mm of cable a winch) that serve it best without friction. The design's own coefficient does not count.
///
/// # Errors
/// No model can be made, or winding from rest to those activations does not stay in balance.
pub fn pose_with_friction(
    design: &Design,
    targets: &[Target],
    frictionless: &[f64],
    mu: f64,
    stop: &dyn Fn() -> bool,
) -> Result<FrictionPose, FrictionPoseError> {
    let (acting, all) = (design.acting(), design);
    let design = &*acting;
    let frictionless = &all.of_acting(frictionless)[..];
    let mut plushie = compile(design, View::Realizable)?;
    let friction = plushie.friction(mu);
    let objective = objective(design, &plushie, targets);
    let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
    let mut question = Question { model: &mut plushie.model, actuation: &actuation, objective: &objective };
    let found = soft_ik::friction::pose(&mut question, &friction, frictionless, stop)?;
    let error = |x: &[f64]| {
        let nodes: Vec<[f64; 2]> = x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
        target_error(design, targets, &nodes)
    };
    Ok(FrictionPose {
        error: error(&found.pulled.x),
        error_letting_out: found.let_out.map(|x| error(&x)),
        activations_mm: all.of_all(&found.pulled.beta),
        converged: found.converged,
        factorizations: found.factorizations,
    })
}
