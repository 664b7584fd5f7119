//! The catalogue of optional energy terms.

mod gravity;

pub use gravity::Gravity;

use super::catalogue::{Kind, Parameter, TermKind};

/// All terms, in the order in which they are added up. A new one is a file and its two lines here.
static TERMS: [&TermKind; 1] = [&gravity::KIND];

/// The kind of [`Gravity`].
pub static GRAVITY: &TermKind = &gravity::KIND;

static NAMES: [&str; TERMS.len()] = {
    let mut names = [""; TERMS.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = TERMS[k].name;
        k += 1;
    }
    names
};

impl Kind for TermKind {
    const OF: &'static str = "Term";

    fn all() -> &'static [&'static Self] {
        &TERMS
    }

    fn names() -> &'static [&'static str] {
        &NAMES
    }

    fn name(&self) -> &'static str {
        self.name
    }

    fn parameters(&self) -> &'static [Parameter] {
        self.parameters
    }
}
