//! A film that is made of the animation.

use super::done::Done;
use crate::studio::jobs::Running;

/// The job, and how many of its pictures are done.
#[derive(Default)]
pub struct Filming {
    pub running: Option<Running>,
    pub(crate) done: Done,
}

impl Filming {
    /// Pictures that are done, of how many.
    pub fn done(&self) -> [usize; 2] {
        self.done.get().unwrap_or_default()
    }
}
