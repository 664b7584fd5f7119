//! The log: to a file (`--log`), to standard error (`-v`), and for the window to the platform's folder.

use super::error::CommandError;
use super::report;
use crate::files::{self, printable, state_folder};
use log::{Level, LevelFilter, Log, Metadata, Record};
use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::{Instant, SystemTime};

/// The log of the window in its folder.
const WINDOW_LOG: &str = "plushwright.log";

/// Where lines go.
struct Journal {
    file: Option<Mutex<File>>,
    /// Whether they go to standard error too.
    aloud: bool,
    since: Instant,
}

/// Begins the log. `window`: whether the window opens, which has a log of its own unless another is asked for.
///
/// # Errors
/// The file cannot be written to.
pub fn begin(path: Option<&Path>, aloud: bool, window: bool) -> Result<(), CommandError> {
    let file = match path {
        Some(path) => Some(files::begin_log(path).map_err(|error| CommandError::write(path, error))?),
        // A help, and no work: without a place for it there is none.
        None if window => state_folder().and_then(|folder| files::continue_log(&folder.join(WINDOW_LOG)).ok()),
        None => None,
    };
    let most = if file.is_some() { LevelFilter::Debug } else { LevelFilter::Info };
    let journal = Journal { file: file.map(Mutex::new), aloud, since: Instant::now() };
    if journal.file.is_none() && !aloud {
        return Ok(());
    }
    // There is one in every process, and this is the first.
    if log::set_boxed_logger(Box::new(journal)).is_ok() {
        log::set_max_level(most);
    }
    log::info!("{} at {}", report::program(), report::utc(SystemTime::now()));
    let args: Vec<String> = std::env::args_os().map(|arg| printable(&arg.to_string_lossy())).collect();
    log::debug!("{}", args.join(" "));
    Ok(())
}

impl Journal {
    /// Our own lines all, of others what went wrong.
    fn wants(metadata: &Metadata) -> bool {
        metadata.target().starts_with("plushwright") || metadata.level() <= Level::Warn
    }
}

impl Log for Journal {
    fn enabled(&self, metadata: &Metadata) -> bool {
        Self::wants(metadata)
    }

    fn log(&self, record: &Record) {
        if !Self::wants(record.metadata()) {
            return;
        }
        let text = printable(&record.args().to_string());
        // A log that cannot be written is no reason to stop.
        if let Some(file) = &self.file {
            let line = format!("{:9.3} s {:5} {}\n", self.since.elapsed().as_secs_f64(), record.level(), text);
            let _ = file.lock().unwrap_or_else(PoisonError::into_inner).write_all(line.as_bytes());
        }
        if self.aloud && record.level() <= Level::Info {
            super::progress::aside(|| {
                let _ = writeln!(std::io::stderr(), "plushwright: {text}");
            });
        }
    }

    fn flush(&self) {}
}
