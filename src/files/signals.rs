//! What signals may not do to a file that is being written.

use std::io;
use std::sync::{PoisonError, RwLock, RwLockReadGuard};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Held for reading while files are written.
static WRITING: RwLock<()> = RwLock::new(());
/// Longest time that the end of the program waits for a write under way: a disk that takes longer hangs.
const PATIENCE: Duration = Duration::from_secs(2);

/// To be held while files are written, so that [`before_exit`] waits for them.
pub(super) fn writing() -> RwLockReadGuard<'static, ()> {
    WRITING.read().unwrap_or_else(PoisonError::into_inner)
}

/// Waits for the write under way and lets no other begin: what ends the program at once calls this first.
pub fn before_exit() {
    let since = Instant::now();
    while since.elapsed() < PATIENCE {
        if let Ok(guard) = WRITING.try_write() {
            std::mem::forget(guard);
            return;
        }
        sleep(Duration::from_millis(5));
    }
}

/// Has an interrupt, a request to end or the end of the terminal do this instead of ending the program, on a thread of its own, each time.
///
/// # Errors
/// What the system says; something listens already.
pub fn on_interrupt(act: impl FnMut() + Send + 'static) -> io::Result<()> {
    ctrlc::set_handler(act).map_err(io::Error::other)
}

/// Makes a limit on the size of files an error of the write that meets it. Otherwise the system ends the program there.
pub fn survive_size_limits() {
    #[cfg(unix)]
    {
        use std::sync::Arc;
        use std::sync::atomic::AtomicBool;
        // The flag is of no interest: any handler will do. Where none can be set everything is as it was.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::new(AtomicBool::new(false)));
    }
}
