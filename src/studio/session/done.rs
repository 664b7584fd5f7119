//! How far a thread is with its work.

use std::sync::{Arc, Mutex};

/// Steps that are done, of how many; nothing before the first one is told.
#[derive(Clone, Default)]
pub struct Done(Arc<Mutex<Option<[usize; 2]>>>);

impl Done {
    pub fn say(&self, done: usize, of: usize) {
        if let Ok(mut told) = self.0.lock() {
            *told = Some([done, of]);
        }
    }

    pub fn get(&self) -> Option<[usize; 2]> {
        self.0.lock().ok().and_then(|told| *told)
    }
}
