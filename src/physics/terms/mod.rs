//! The catalogue of optional energy terms.

mod gravity;

pub use gravity::Gravity;

use super::catalogue::{TermKind, catalogue};

/// All terms, in the order in which they are added up. A new one is a file and its two lines here.
static TERMS: [&TermKind; 1] = [&gravity::KIND];

/// The kind of [`Gravity`].
pub static GRAVITY: &TermKind = &gravity::KIND;

catalogue!(TermKind, "Term", TERMS);
