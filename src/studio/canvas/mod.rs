//! The canvas that a tool works on: a view of a plushie, or the sheet on which the outline is drawn.

pub mod camera;
mod ground;
pub mod hit;
mod paint;
mod plushie;
mod pointer;
mod sheet;
mod strokes;
mod strung;
mod surface;

pub use camera::Camera;
pub use ground::{Canvas, Ground};
pub use hit::Hit;
pub use plushie::Plushie;
pub use pointer::{act, has_focus, navigate};
pub use sheet::{State, show};
pub use strokes::{HANDLE, closed, open, track};
pub use surface::Surface;
