//! How long an interrupted command may go on: what has results to write is not ended before it wrote them.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Commands that have something to write when they are interrupted.
static KEEPERS: AtomicUsize = AtomicUsize::new(0);

/// Held while there are results that an interrupt may not lose.
pub struct Keeping(());

impl Keeping {
    pub fn begin() -> Self {
        KEEPERS.fetch_add(1, Ordering::SeqCst);
        Self(())
    }
}

impl Drop for Keeping {
    fn drop(&mut self) {
        KEEPERS.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Whether an interrupted program still has something to write: it is waited for, until it is interrupted again.
pub fn is_keeping() -> bool {
    KEEPERS.load(Ordering::SeqCst) > 0
}
