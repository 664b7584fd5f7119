//! The two pictures of the plushie: drawing, navigating, and what lies under the pointer.

mod bars;
mod captions;
pub mod geometry;
mod loads;
mod picture;
mod pointer;
pub mod renderer;
mod rulers;
mod silhouettes;
mod skin;
mod strings;
mod strip;
pub mod thumbnail;
mod views;

pub use super::canvas::{Plushie, camera, hit};
pub use loads::{is_beyond, limit, words as load_words};
pub use views::{State, show};
