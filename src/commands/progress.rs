//! A bar on standard error for what takes longer than a second, where that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Work that takes less shows nothing.
const SHOWN_AFTER: Duration = Duration::from_secs(1);
/// How often the bar moves while nothing is told.
const TICK: Duration = Duration::from_millis(100);

/// The bar on the terminal: there is one work at a time.
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);
/// Raised for [`Bar`]s that end before they were shown.
static OVER: Condvar = Condvar::new();

/// Shows that work goes on, until it is dropped.
pub struct Bar(());

impl Bar {
    /// Work of a length that nobody knows, until [`at`] says it.
    pub fn of(what: &str) -> Self {
        if std::io::stderr().is_terminal() {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
            bar.set_style(style("{spinner} {msg}, {elapsed}"));
            bar.set_message(what.to_owned());
            *lock() = Some(bar);
            // Without a thread to show it there is no bar; the work goes on.
            let _ = std::thread::Builder::new().spawn(show_later);
        }
        Self(())
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = lock().take() {
            bar.finish_and_clear();
        }
        OVER.notify_all();
    }
}

/// So much of the work is done, and the best that was found by now.
pub fn at(done: usize, of: usize, best: &str) {
    if let Some(bar) = &*lock() {
        if bar.length() != Some(of as u64) {
            bar.set_style(style("{spinner} {bar:24} {pos}/{len}, about {eta} left  {wide_msg}"));
            bar.set_length(of as u64);
        }
        bar.set_message(best.to_owned());
        bar.set_position(done as u64);
    }
}

/// What is being done now, where no length is known.
pub fn now(what: &str) {
    if let Some(bar) = &*lock() {
        bar.set_message(what.to_owned());
    }
}

/// Prints while the bar is out of the way.
pub fn aside<T>(print: impl FnOnce() -> T) -> T {
    match &*lock() {
        Some(bar) => bar.suspend(print),
        None => print(),
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_spinner())
}

fn lock() -> std::sync::MutexGuard<'static, Option<ProgressBar>> {
    BAR.lock().unwrap_or_else(PoisonError::into_inner)
}

fn show_later() {
    let waited = OVER.wait_timeout_while(lock(), SHOWN_AFTER, |bar| bar.is_some());
    let (bar, _) = waited.unwrap_or_else(PoisonError::into_inner);
    if let Some(bar) = &*bar {
        bar.set_draw_target(ProgressDrawTarget::stderr());
        bar.enable_steady_tick(TICK);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_templates_are_understood() {
        for template in ["{spinner} {msg}, {elapsed}", "{spinner} {bar:24} {pos}/{len}, about {eta} left  {wide_msg}"] {
            assert!(ProgressStyle::with_template(template).is_ok(), "{template}");
        }
    }
}
