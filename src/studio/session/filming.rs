//! A film that is made of the animation.

use crate::studio::jobs::Running;
use std::sync::{Arc, Mutex};

/// The job, and how far it is.
#[derive(Default)]
pub struct Filming {
    pub running: Option<Running>,
    /// Pictures that are done, of how many.
    pub(crate) done: Arc<Mutex<[usize; 2]>>,
}

impl Filming {
    /// Pictures that are done, of how many.
    pub fn done(&self) -> [usize; 2] {
        self.done.lock().map_or([0; 2], |done| *done)
    }
}
