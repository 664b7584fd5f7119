//! What a job finds out about a design.

use crate::design::Design;
use crate::sewing::Breach;
use std::sync::Arc;

/// What a job found out about a design.
pub enum Judgement {
    /// The rules that it breaks, and how near the poses (by their numbers) come at once from where they were.
    Quick { design: Arc<Design>, breaches: Vec<Breach>, errors: Vec<(usize, f64)> },
    /// How near a pose comes from rest; nothing where that was cancelled.
    Thorough { design: Arc<Design>, pose: usize, error: Option<f64> },
}
