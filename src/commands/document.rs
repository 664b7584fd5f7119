//! Reading and writing the design file.

use super::error::{CommandError, check_cancel};
use crate::design::Design;
use crate::design::file::{self, FileError, is_design};
use crate::files::{self, Hold, Stamp, shown};
use clap::Args;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// After this long a command that waits for another one says so.
const SAID_AFTER: Duration = Duration::from_secs(5);

/// Where an edited design goes.
#[derive(Debug, Args)]
pub struct Target {
    /// Design file to write; may be the one read
    #[arg(short, long, value_name = "DESIGN")]
    pub output: PathBuf,
    /// Replace a file that is no design, or the design of another plushie
    #[arg(long)]
    pub force: bool,
}

/// A design that is read, changed and written, by nobody else in between.
pub struct Edit<'a> {
    from: &'a Path,
    to: &'a Path,
    /// What was read, where that is what is written to.
    seen: Option<Stamp>,
    _held: Option<Hold>,
}

pub fn load(path: &Path) -> Result<Design, CommandError> {
    file::read(path).map_err(unread)
}

impl Target {
    /// Reads a design to change it. Where it is written back, other commands that do the same wait.
    ///
    /// # Errors
    /// The design is unsound, or something that is no design would be replaced.
    pub fn open<'a>(&'a self, from: &'a Path, cancel: &AtomicBool) -> Result<(Design, Edit<'a>), CommandError> {
        let to = self.output.as_path();
        files::check(to).map_err(|e| CommandError::write(to, e))?;
        if !files::same(from, to) {
            refuse_foreign(to, self.force)?;
            let design = load(from)?;
            refuse_another(to, &design, self.force)?;
            return Ok((design, Edit { from, to, seen: None, _held: None }));
        }
        let held = Hold::of(from, |waited| wait(from, waited, cancel)).map_err(|e| match e.kind() {
            io::ErrorKind::WouldBlock => CommandError::Cancelled,
            _ => CommandError::input(from, e),
        })?;
        let (design, seen) = file::read_stamped(from).map_err(unread)?;
        Ok((design, Edit { from, to, seen: Some(seen), _held: Some(held) }))
    }
}

impl Edit<'_> {
    /// Writes the design whole or not at all, and not once `cancel` is raised. Its texture goes with it to another folder.
    ///
    /// # Errors
    /// The file that it goes back to is not the one any more that was read.
    pub fn save(&self, design: &Design, cancel: &AtomicBool) -> Result<(), CommandError> {
        check_cancel(cancel)?;
        file::save(design, Some(self.from), self.to, self.seen.as_ref()).map(drop).map_err(unwritten)
    }
}

/// Refuses to replace what is no design, without force.
fn refuse_foreign(path: &Path, force: bool) -> Result<(), CommandError> {
    let there = std::fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() > 0);
    if force || !there || is_design(path) {
        return Ok(());
    }
    let path = shown(path);
    Err(CommandError::Usage(format!("{path} exists and is no design; --force replaces it")))
}

/// Refuses to replace a design of another name that somebody has worked on, without force. One of the same name is an earlier output of
/// the same plushie, as where a script goes through settings.
fn refuse_another(path: &Path, design: &Design, force: bool) -> Result<(), CommandError> {
    let there = std::fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() > 0);
    let may_go = |other: Design| other.is_bare() || other.name == design.name;
    if force || !there || file::read(path).is_ok_and(may_go) {
        return Ok(());
    }
    let path = shown(path);
    Err(CommandError::Usage(format!("{path} exists and holds the work on another plushie; --force replaces it")))
}

/// Refuses to replace a design that somebody has worked on, or what is no design, without force.
pub fn refuse_finished(path: &Path, force: bool) -> Result<(), CommandError> {
    refuse_foreign(path, force)?;
    let there = std::fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() > 0);
    if force || !there || file::read(path).is_ok_and(|design| design.is_bare()) {
        return Ok(());
    }
    let path = shown(path);
    Err(CommandError::Usage(format!("{path} exists and holds more than an outline; --force replaces it")))
}

/// What is wrong with a design that cannot be written.
pub fn unwritten(error: FileError) -> CommandError {
    match error {
        FileError::Read { path, source } | FileError::Write { path, source } => CommandError::write(&path, source),
        // Our own work does not validate: that is no fault of the input.
        error @ (FileError::Content { .. } | FileError::Changed { .. }) => CommandError::Failed(error.to_string()),
    }
}

fn unread(error: FileError) -> CommandError {
    match error {
        FileError::Read { path, source } => CommandError::input(&path, source),
        FileError::Write { path, source } => CommandError::write(&path, source),
        FileError::Content { path, error } => CommandError::input(&path, error),
        error @ FileError::Changed { .. } => CommandError::Failed(error.to_string()),
    }
}

/// Whether to go on waiting for another command.
fn wait(path: &Path, waited: Duration, cancel: &AtomicBool) -> bool {
    // Said once: in the round after which the time is over.
    thread_local!(static SAID: std::cell::Cell<bool> = const { std::cell::Cell::new(false) });
    if waited > SAID_AFTER && !SAID.replace(true) {
        eprintln!("plushwright: waiting for another command that changes {}", shown(path));
    }
    !cancel.load(Ordering::SeqCst)
}
