//! What makes one network better than another: one measure a file, and the table of them.

mod pose_error;

use super::criterion::{Criterion, Judged};

/// All measures. A new one is a file and a line here.
const CRITERIA: [&dyn Criterion; 1] = [&pose_error::PoseError];

/// The cost of a rig, all criteria added: smaller is better.
pub fn cost(judged: &Judged) -> f64 {
    CRITERIA.iter().map(|criterion| criterion.cost(judged)).sum()
}
