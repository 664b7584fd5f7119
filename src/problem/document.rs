//! The answer document: what is written, key by key in ascending order.
//!
//! What was not asked for is absent. A part that holds a number which JSON cannot write (an infinity) is taken out whole.

use super::failure::{Failure, Part};
use serde::Serialize;
use serde_json::ser::Formatter;
use std::cell::Cell;
use std::io::{self, Write};

pub const FORMAT: &str = "plushwright-answer/1";

/// An answer in the units of the file (`examples/problem-format.md` says what each key means).
#[derive(Clone, Debug, Default, Serialize)]
pub struct Document {
    pub converged: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drag: Option<DragAnswer>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    pub format: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grad_alpha_c: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grad_beta: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iterations: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub objective: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pin_forces: Option<Vec<[f64; 2]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub soft_ik: Option<SoftIkAnswer>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tensions: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<Vec<[f64; 2]>>,
    /// `error` in typed form.
    #[serde(skip)]
    pub failures: Vec<Failure>,
}

/// `soft_ik` of an answer.
#[derive(Clone, Debug, Serialize)]
pub struct SoftIkAnswer {
    pub alpha_c: Vec<f64>,
    pub beta: Vec<f64>,
    pub converged: bool,
    pub factorizations: usize,
    pub iterations: usize,
    pub milliseconds: f64,
    pub minimises: &'static str,
    pub objective: f64,
    /// Absent where the equilibrium has no derivatives.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projected_gradient: Option<f64>,
    pub starts: usize,
    pub tolerance: f64,
    pub x: Vec<[f64; 2]>,
}

/// `drag` of an answer: lists with an entry for each frame, and the frames reported in full.
#[derive(Clone, Debug, Default, Serialize)]
pub struct DragAnswer {
    pub iterations: Vec<usize>,
    pub milliseconds: Vec<f64>,
    pub reported: Vec<ReportedFrame>,
    pub target_error: Vec<f64>,
}

#[derive(Clone, Debug, Serialize)]
pub struct ReportedFrame {
    pub alpha_c: Vec<f64>,
    pub frame: usize,
    pub residual: f64,
    pub x: Vec<[f64; 2]>,
}

impl Document {
    /// The document with all failures, those of numbers that cannot be written included, and what follows from them.
    pub(super) fn concluded(mut self, failures: Vec<Failure>) -> Self {
        self.format = FORMAT;
        self.failures = failures;
        self.remove_infinities();
        self.converged = self.failures.is_empty();
        let texts: Vec<String> = self.failures.iter().map(Failure::to_string).collect();
        self.error = (!self.converged).then(|| texts.join("; "));
        self
    }

    fn remove_infinities(&mut self) {
        let mut overflown = Vec::new();
        clear(&mut self.drag, Part::After(0), &mut overflown);
        clear(&mut self.energy, Part::Statics, &mut overflown);
        clear(&mut self.grad_alpha_c, Part::Statics, &mut overflown);
        clear(&mut self.grad_beta, Part::Statics, &mut overflown);
        clear(&mut self.objective, Part::Statics, &mut overflown);
        clear(&mut self.pin_forces, Part::Statics, &mut overflown);
        clear(&mut self.residual, Part::Statics, &mut overflown);
        clear(&mut self.soft_ik, Part::SoftIk, &mut overflown);
        clear(&mut self.tensions, Part::Statics, &mut overflown);
        clear(&mut self.x, Part::Statics, &mut overflown);
        for part in overflown {
            let failure = Failure::Overflow { part };
            if !self.failures.contains(&failure) {
                self.failures.push(failure);
            }
        }
    }
}

/// Takes out a part with a number that JSON cannot write, and notes which.
fn clear<T: Serialize>(value: &mut Option<T>, part: Part, overflown: &mut Vec<Part>) {
    if value.as_ref().is_some_and(|v| !is_writable(v)) {
        *value = None;
        overflown.push(part);
    }
}

/// Whether JSON can write all numbers of a value: what it cannot write becomes a `null`.
fn is_writable(value: &impl Serialize) -> bool {
    let found = Cell::new(false);
    let written = value.serialize(&mut serde_json::Serializer::with_formatter(io::sink(), Nulls { found: &found }));
    written.is_ok() && !found.get()
}

/// Writes nothing of the numbers, and notices a `null`.
struct Nulls<'a> {
    found: &'a Cell<bool>,
}

impl Formatter for Nulls<'_> {
    fn write_null<W: ?Sized + Write>(&mut self, _: &mut W) -> io::Result<()> {
        self.found.set(true);
        Ok(())
    }

    fn write_f64<W: ?Sized + Write>(&mut self, _: &mut W, _: f64) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_with_an_infinity_goes_and_is_named_once() {
        let document = Document {
            energy: Some(f64::NAN),
            residual: Some(1.0),
            x: Some(vec![[0.0, f64::INFINITY]]),
            tensions: Some(vec![1.0, 2.0]),
            ..Document::default()
        };
        let document = document.concluded(Vec::new());
        assert_eq!(document.failures, [Failure::Overflow { part: Part::Statics }]);
        assert!(document.energy.is_none() && document.x.is_none() && !document.converged);
        let text = serde_json::to_string(&document).unwrap();
        let error = document.error.unwrap();
        let expected = r#""format":"plushwright-answer/1","residual":1.0,"tensions":[1.0,2.0]}"#;
        assert_eq!(text, format!(r#"{{"converged":false,"error":"{error}",{expected}"#));
    }

    #[test]
    fn keys_are_in_ascending_order() {
        let ik = SoftIkAnswer {
            alpha_c: vec![0.5],
            beta: vec![0.5],
            converged: true,
            factorizations: 3,
            iterations: 2,
            milliseconds: 1.5,
            minimises: "objective",
            objective: 1e-9,
            projected_gradient: Some(1e-15),
            starts: 3,
            tolerance: 1e-14,
            x: vec![[1.0, -0.0]],
        };
        let reported = ReportedFrame { alpha_c: vec![], frame: 1, residual: 0.25, x: vec![] };
        let document = Document {
            drag: Some(DragAnswer { reported: vec![reported], ..DragAnswer::default() }),
            soft_ik: Some(ik),
            grad_beta: Some(vec![]),
            iterations: Some(4),
            ..Document::default()
        };
        let document = document.concluded(Vec::new());
        // A tree of values keeps its keys sorted.
        let sorted = serde_json::to_string(&serde_json::to_value(&document).unwrap()).unwrap();
        assert_eq!(serde_json::to_string(&document).unwrap(), sorted);
    }
}
