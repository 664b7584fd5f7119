//! What the window does: functions that change the [`session`](super::session), a subject a file.
//!
//! What concerns one part alone is a method of that part; here is what several have to do with.

pub mod animate;
pub mod apply;
pub mod discover;
pub mod edit;
pub mod escape;
pub mod filing;
pub mod film;
pub mod follow;
pub mod frame;
pub mod import;
pub mod judge;
pub mod keep;
pub mod mesh;
pub mod motors;
pub mod onion;
pub mod open;
pub mod paths;
pub mod replace;
pub mod rig;
pub mod save;
pub mod sheet;
pub mod texture;
pub mod tick;
pub mod timing;
pub mod wind;
