//! A row of the table: a scene, the range it is swept over, what must come out, and whether it did.

use crate::problem::{Problem, Statics};

/// A row: its cases differ in one figure.
pub struct Row {
    pub group: &'static str,
    pub name: &'static str,
    /// The figure that is swept, with its unit.
    pub swept: &'static str,
    pub cases: Vec<Case>,
}

/// One scene of a row.
pub struct Case {
    /// The swept figure.
    pub at: String,
    pub problem: Problem,
    pub bar: Bar,
    /// The error of an answer of which more is known, as a part of the body length.
    pub exact: Option<Exact>,
}

/// The error of an answer against a closed form.
pub type Exact = Box<dyn Fn(&Statics) -> f64>;

/// The requirement on a case.
#[derive(Clone, Debug)]
pub enum Bar {
    /// Statics that converge.
    Solved(Threshold),
    /// A drag or Soft IK question whose answer is fit to be shown; the last target error is at most this, in body lengths.
    Posed { target_error: f64 },
    /// A refusal or a failure whose text holds these words; nothing else passes.
    Refused(&'static str),
}

/// Limits of a solved case.
#[derive(Clone, Copy, Debug)]
pub struct Threshold {
    /// Residual as a part of the forces at work.
    pub residual: f64,
    pub iterations: usize,
    /// `det F` of every triangle is above this.
    pub determinant: f64,
    /// Digits of the answer: at least `16 - log10(condition)` less this many.
    pub spare_digits: f64,
}

/// The bar of every solved case: fixed before anything was run.
pub const BAR: Threshold = Threshold { residual: 1e-8, iterations: 200, determinant: 0.0, spare_digits: 3.0 };
/// Digits of an `f64`.
const DIGITS: f64 = 16.0;

/// The result of a case.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    pub iterations: usize,
    pub factorizations: usize,
    pub projections: usize,
    pub determinant: f64,
    /// Residual as a part of the forces at work.
    pub residual: f64,
    /// Error against a closed form or a reference of twice the digits, as a part of the body length.
    pub error: Option<f64>,
    pub condition: Option<f64>,
    pub target_error: Option<f64>,
    /// Why it was refused or did not converge.
    pub failure: Option<String>,
    pub milliseconds: f64,
    /// Anything that is not finite where a figure should be.
    pub unsound: Option<String>,
}

impl Outcome {
    /// Digits of the answer that are right.
    pub fn digits(&self) -> Option<f64> {
        self.error.map(|e| -(e.max(10f64.powf(-DIGITS))).log10())
    }

    /// Digits lost of the sixteen.
    pub fn lost(&self) -> Option<f64> {
        self.digits().map(|d| DIGITS - d)
    }
}

impl Case {
    pub fn solved(at: impl ToString, problem: Problem) -> Self {
        Self { at: at.to_string(), problem, bar: Bar::Solved(BAR), exact: None }
    }

    pub fn exact(mut self, exact: impl Fn(&Statics) -> f64 + 'static) -> Self {
        self.exact = Some(Box::new(exact));
        self
    }

    pub fn refused(at: impl ToString, problem: Problem, cause: &'static str) -> Self {
        Self { at: at.to_string(), problem, bar: Bar::Refused(cause), exact: None }
    }

    pub fn posed(at: impl ToString, problem: Problem, target_error: f64) -> Self {
        Self { at: at.to_string(), problem, bar: Bar::Posed { target_error }, exact: None }
    }
}

impl Bar {
    /// The ways in which the outcome falls short; empty if it passes.
    pub fn judge(&self, outcome: &Outcome) -> Vec<String> {
        let mut short = Vec::new();
        let mut require = |holds: bool, what: String| {
            if !holds {
                short.push(what);
            }
        };
        require(outcome.unsound.is_none(), outcome.unsound.clone().unwrap_or_default());
        match self {
            Self::Refused(cause) => {
                let text = outcome.failure.as_deref().unwrap_or("it was solved");
                require(text.contains(cause), format!("should say \"{cause}\": {text}"));
            }
            Self::Solved(bar) => {
                require(outcome.failure.is_none(), outcome.failure.clone().unwrap_or_default());
                require(outcome.residual <= bar.residual, format!("residual {:.1e}", outcome.residual));
                require(outcome.iterations <= bar.iterations, format!("{} iterations", outcome.iterations));
                require(outcome.determinant > bar.determinant, format!("det F {:.1e}", outcome.determinant));
                if let (Some(digits), Some(condition)) = (outcome.digits(), outcome.condition) {
                    let needed = DIGITS - condition.max(1.0).log10() - bar.spare_digits;
                    require(digits >= needed, format!("{digits:.1} digits, {needed:.1} needed"));
                }
            }
            Self::Posed { target_error } => {
                require(outcome.failure.is_none(), outcome.failure.clone().unwrap_or_default());
                require(outcome.residual <= BAR.residual, format!("residual {:.1e}", outcome.residual));
                require(outcome.iterations <= BAR.iterations, format!("{} iterations", outcome.iterations));
                require(outcome.determinant > BAR.determinant, format!("det F {:.1e}", outcome.determinant));
                let error = outcome.target_error.unwrap_or(0.0);
                require(error <= *target_error, format!("target error {error:.1e}, at most {target_error:.1e}"));
            }
        }
        short
    }
}
