//! How much a pose depends on exact lengths of cable: what a millimetre too much or too little does.

use super::measure::target_error;
use crate::design::{Design, Target};
use crate::soft_ik::{Posture, Question};

/// What hands and motors are sure to be off by, mm.
const MILLIMETRE: f64 = 1.0;

/// The worst that a millimetre of cable does to a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Play {
    /// The winch that is a millimetre off, by its number.
    pub winch: usize,
    /// Target error then, in body lengths. No better than that of the pose itself.
    pub error: f64,
}

impl Play {
    /// Turns every winch by a millimetre either way (within its bounds), the others held, from a posture in equilibrium. Two
    /// statics a winch. Leaves the contractions of the posture in the model.
    pub fn of(
        question: &mut Question,
        design: &Design,
        targets: &[Target],
        posture: &Posture,
        stop: &dyn Fn() -> bool,
    ) -> Self {
        let error = |x: &[f64]| {
            let nodes: Vec<[f64; 2]> = x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
            target_error(design, targets, &nodes)
        };
        let mut worst = Self { winch: 0, error: error(&posture.x) };
        for winch in 0..posture.beta.len() {
            for off in [-MILLIMETRE, MILLIMETRE] {
                let mut beta = posture.beta.clone();
                beta[winch] += off;
                question.actuation.clamp(&mut beta);
                if beta == posture.beta || stop() {
                    continue;
                }
                let (there, _) = question.settle(&beta, &posture.x, stop);
                let found = error(&there.x);
                if there.in_equilibrium() && found > worst.error {
                    worst = Self { winch, error: found };
                }
            }
        }
        let contractions = question.actuation.contractions(&posture.beta);
        question.model.contractile.set_contractions(&contractions);
        worst
    }
}
