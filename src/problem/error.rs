//! What is wrong with a problem file.

use std::fmt::Display;

/// The error of a problem file: one line that names the key and the offending index.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProblemError {
    #[error("malformed JSON: {0}")]
    Json(String),
    #[error("{key}: {what}")]
    Content { key: String, what: String },
    /// The method asked for cannot answer this problem.
    #[error("method: {0}")]
    Method(String),
}

pub(super) fn content(key: impl Display, what: impl Into<String>) -> ProblemError {
    ProblemError::Content { key: key.to_string(), what: what.into() }
}

pub(super) fn finite(key: impl Display, value: f64) -> Result<(), ProblemError> {
    if value.is_finite() { Ok(()) } else { Err(content(key, "is not a finite number")) }
}
