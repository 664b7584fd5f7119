//! The two pictures of the plushie: drawing, navigating, and what lies under the pointer.

mod captions;
pub mod geometry;
mod picture;
mod pointer;
pub mod renderer;
mod skin;
mod strings;
pub mod thumbnail;
mod views;

pub use super::canvas::{Plushie, camera, hit};
pub use views::{State, show};
