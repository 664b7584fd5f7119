//! The JSON question-and-answer interface of the numerical core.

pub mod network;
