//! Whether winding from rest leads to a posture: all winches in proportion, in equal steps, each settled from the one before; with
//! ever more steps, until their number makes no difference.

use super::walk::{distance, passing};
use crate::soft_ik::{Posture, Question};

/// Steps of the first attempt; each further one takes twice as many.
const FIRST_STEPS: usize = 8;
/// Steps of the last one. Where that still ends elsewhere than the one before, the end depends on how the winches are turned, and
/// nothing is promised.
const LAST_STEPS: usize = 128;
/// On the way forces balance to this part of those at work: positions are then good to about three digits. The end is settled
/// fully.
const ON_THE_WAY: f64 = 1e-4;
/// Two poses are the same where no node is further away than this part of the body: states on one branch agree to six digits,
/// those of different branches differ by far more.
pub const SAME_POSE: f64 = 1e-3;

/// Winding from `from` to `beta`, unit by unit.
pub struct Proof {
    from: Posture,
    beta: Vec<f64>,
    steps: usize,
    done: usize,
    now: Posture,
    /// Where the attempt before has ended.
    before: Option<Posture>,
    /// Distance below which two poses are the same, length.
    same: f64,
}

/// The verdict so far.
pub enum Verdict {
    Open,
    /// The posture in which winding ends, however many steps it takes.
    Wound(Posture),
    /// It depends on the steps.
    Undecided,
}

impl Proof {
    pub fn new(from: &Posture, beta: &[f64], size: f64) -> Self {
        Self {
            from: from.clone(),
            beta: beta.to_vec(),
            steps: FIRST_STEPS,
            done: 0,
            now: from.clone(),
            before: None,
            same: SAME_POSE * size,
        }
    }

    /// The activations that are wound to.
    pub fn beta(&self) -> &[f64] {
        &self.beta
    }

    /// One more step, and the factorisations it took.
    pub fn step(&mut self, question: &mut Question, stop: &dyn Fn() -> bool) -> (Verdict, usize) {
        self.done += 1;
        let part = self.done as f64 / self.steps as f64;
        if self.done < self.steps {
            let beta: Vec<f64> = self.from.beta.iter().zip(&self.beta).map(|(a, b)| a + part * (b - a)).collect();
            let (next, spent) = question.settle_to(&beta, &self.now.x, &passing(ON_THE_WAY), stop);
            self.now = next;
            return (Verdict::Open, spent);
        }
        let (end, spent) = question.settle(&self.beta, &self.now.x, stop);
        if let Some(before) = &self.before
            && distance(&before.x, &end.x) <= self.same
            && end.in_equilibrium()
        {
            return (Verdict::Wound(end), spent);
        }
        if self.steps >= LAST_STEPS || stop() {
            return (Verdict::Undecided, spent);
        }
        self.before = Some(end);
        self.now = self.from.clone();
        self.steps *= 2;
        self.done = 0;
        (Verdict::Open, spent)
    }
}

/// The posture in which winding from `from` to `beta` ends, however many steps it takes, and the factorisations that took; `None`
/// where it depends on the steps, or `stop` has ended it.
pub fn wound(
    question: &mut Question,
    from: &Posture,
    beta: &[f64],
    stop: &dyn Fn() -> bool,
) -> (Option<Posture>, usize) {
    let size = super::walk::size(&question.model.rest);
    let mut proof = Proof::new(from, beta, size);
    let mut spent = 0;
    loop {
        let (verdict, count) = proof.step(question, stop);
        spent += count;
        match verdict {
            Verdict::Open => {}
            Verdict::Wound(posture) => return (Some(posture), spent),
            Verdict::Undecided => return (None, spent),
        }
    }
}
