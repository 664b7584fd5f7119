//! The damped quadratic model and its points.

use super::form::Form;
use super::saddle::{Local, Saddle, Step};
use crate::soft_ik::Question;

/// The damped model at hand.
pub(super) struct Model<'a, 'q> {
    pub saddle: &'a mut Saddle,
    pub question: &'a mut Question<'q>,
    pub local: &'a Local,
    pub form: Form,
    pub damping: &'a [f64],
    /// How far each winch may move down and up.
    pub room: Vec<[f64; 2]>,
    pub lengths: &'a [f64],
    /// `O` at no step.
    pub objective: f64,
}

/// A point of the model: the step, the slopes there, and the value.
pub(super) struct Point {
    pub step: Step,
    pub slopes: Vec<f64>,
    pub value: f64,
}

impl Model<'_, '_> {
    /// The damped model at a step.
    pub fn evaluate(&mut self, beta: Vec<f64>) -> Point {
        let (step, slopes) = self.saddle.evaluate(self.question, self.local, self.form, self.damping, beta);
        let own: f64 = step.beta.iter().zip(self.damping).map(|(d, w)| w * d * d).sum();
        let value = step.slope + step.curvature + 0.5 * own;
        Point { step, slopes, value }
    }
}
