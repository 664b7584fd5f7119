//! Rules of sewing that a design breaks, as remarks on its blueprint.

use crate::design::Design;
use crate::motion::winch_labels;
use crate::sewing::{self, Breach};

/// Breaches told one by one among the remarks on a blueprint; the others are counted.
const TOLD: usize = 5;

/// Remarks for the maker of a blueprint on the rules that it breaks, the most severe breaches first.
pub(super) fn remarks(design: &Design) -> Vec<String> {
    let breaches = design.breaches();
    let names = winch_labels(design);
    let sentence = |breach: &Breach| format!("Hard to sew: {}.", breach.words(&names));
    let mut remarks: Vec<String> = sewing::most_severe(&breaches, TOLD).iter().map(sentence).collect();
    match breaches.len().saturating_sub(TOLD) {
        0 => {}
        1 => remarks.push("Hard to sew: one more place breaks a rule.".into()),
        others => remarks.push(format!("Hard to sew: {others} more places break a rule.")),
    }
    remarks
}
