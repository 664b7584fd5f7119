//! The JSON question-and-answer interface of the numerical core (`examples/problem-format.md`).
//!
//! A problem file puts one numerical question without a design, a window or a mesh generator, in SI units, so that a
//! script or another solver can put the same question and compare.

pub mod answer;
mod checks;
pub mod document;
pub mod equilibrium;
mod error;
pub mod failure;
pub mod file;
mod frame;
mod limits;
mod material;
mod model;
pub mod network;
mod reading;

pub use crate::soft_ik::Quality;
pub use answer::{Answered, Options, answer, solve};
pub use document::Document;
pub use equilibrium::{Statics, equilibrium};
pub use error::ProblemError;
pub use failure::{Failure, Part};
pub use file::Problem;
pub use model::model;
pub use reading::read;
