//! Reading and writing the design file.

use super::error::{CommandError, check_cancel};
use super::meant;
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
    /// Design file to write [default: the one that is read]
    #[arg(short, long, value_name = "DESIGN")]
    pub output: Option<PathBuf>,
    /// Replace a file that is no design, or a design that holds other work
    #[arg(long)]
    pub force: bool,
}

/// A design that is read, changed and written, by nobody else in between.
pub struct Edit<'a> {
    from: &'a Path,
    to: &'a Path,
    place: Place,
}

/// Where an edited design goes.
enum Place {
    /// Back to where it was read: what was read, held.
    Back { seen: Stamp, _held: Hold },
    /// To another file: the design that was read, whether what is there may be lost.
    Away(Box<Design>, bool),
}

/// Reads a design.
///
/// # Errors
/// A file that cannot be read or is no sound design; [`CommandError`] names it.
pub fn load(path: &Path) -> Result<Design, CommandError> {
    file::read(path).map_err(|error| unread(path, error))
}

impl Target {
    /// Where a design goes that was read from `from`.
    pub fn path<'a>(&'a self, from: &'a Path) -> &'a Path {
        self.output.as_deref().unwrap_or(from)
    }

    /// Reads a design to change it. Where it is written back, other commands that do the same wait.
    ///
    /// # Errors
    /// The design is unsound, or something that is no design would be replaced.
    pub fn open<'a>(&'a self, from: &'a Path, cancel: &AtomicBool) -> Result<(Design, Edit<'a>), CommandError> {
        let to = self.path(from);
        files::check(to).map_err(|e| CommandError::write(to, e))?;
        if !files::same(from, to) {
            refuse_foreign(to, self.force)?;
            let design = load(from)?;
            refuse_another(to, &design, self.force)?;
            let place = Place::Away(Box::new(design.clone()), self.force);
            return Ok((design, Edit { from, to, place }));
        }
        let held = Hold::of(from, |waited| wait(from, waited, cancel)).map_err(|e| match e.kind() {
            io::ErrorKind::WouldBlock => CommandError::Cancelled,
            _ => unopened(from, e),
        })?;
        let (design, seen) = file::read_stamped(from).map_err(|error| unread(from, error))?;
        Ok((design, Edit { from, to, place: Place::Back { seen, _held: held } }))
    }
}

impl Edit<'_> {
    /// Writes the design whole or not at all, and not once `cancel` is raised. Its texture goes with it to another folder.
    ///
    /// # Errors
    /// The file that it goes back to is not the one any more that was read; another one holds work that would be lost.
    pub fn save(&self, design: &Design, cancel: &AtomicBool) -> Result<(), CommandError> {
        check_cancel(cancel)?;
        log::info!("writing {}", shown(self.to));
        let save = |seen| file::save(design, Some(self.from.into()), self.to, seen).map(drop).map_err(unwritten);
        match &self.place {
            Place::Back { seen, .. } => save(Some(seen)),
            Place::Away(read, force) => alone_in(self.to, cancel, || {
                refuse_lost(self.to, &[read, design], *force)?;
                save(None)
            }),
        }
    }
}

impl Edit<'_> {
    /// Writes what a search of minutes has found, as [`Self::save`], though the program be told to stop. Where it may not go where it should, it
    /// goes to a file beside that, which the error names.
    ///
    /// # Errors
    /// As [`Self::save`].
    pub fn save_found(&self, design: &Design) -> Result<(), CommandError> {
        let refused = match self.save(design, &AtomicBool::new(false)) {
            Err(refused) => refused,
            saved => return saved,
        };
        match self.save_beside(design, "found") {
            Ok(path) => Err(refused.adding(&format!("what was found is in {}", shown(&path)))),
            Err(_) => Err(refused),
        }
    }

    /// Writes a design to `NAME.what.plush`, or `NAME.what-2.plush` and so on, whichever is free. Returns the file.
    fn save_beside(&self, design: &Design, what: &str) -> Result<PathBuf, CommandError> {
        alone_in(self.to, &AtomicBool::new(false), || {
            let mut path = self.to.with_extension(format!("{what}.plush"));
            let mut number = 1;
            while path.symlink_metadata().is_ok() {
                number += 1;
                path = self.to.with_extension(format!("{what}-{number}.plush"));
            }
            file::save(design, Some(self.from.into()), &path, None).map_err(unwritten)?;
            Ok(path)
        })
    }

    /// Writes what an interrupted command has found. Where it would take the place of finished work that was asked to be forgotten, it goes
    /// to a file beside that, `NAME.interrupted.plush`. Returns the file.
    ///
    /// # Errors
    /// As [`Self::save_found`].
    pub fn save_interrupted(&self, design: &Design, fresh: bool) -> Result<PathBuf, CommandError> {
        let had_work = match &self.place {
            Place::Back { .. } => file::read(self.from).is_ok_and(|before| !before.networks.is_empty()),
            Place::Away(..) => false,
        };
        if !(fresh && had_work) {
            return self.save_found(design).map(|()| self.to.to_owned());
        }
        self.save_beside(design, "interrupted")
    }
}

/// Does what looks at a place and then writes to it while no other command of ours does so in the same folder.
///
/// # Errors
/// Those of `work`; the waiting was interrupted.
pub fn alone_in<T>(
    path: &Path,
    cancel: &AtomicBool,
    work: impl FnOnce() -> Result<T, CommandError>,
) -> Result<T, CommandError> {
    // Where the folder cannot be held the look alone has to do.
    let held = Hold::of(files::parent(path), |waited| wait(path, waited, cancel));
    check_cancel(cancel)?;
    let done = work();
    drop(held);
    done
}

/// Refuses to replace what is no design, without force.
///
/// # Errors
/// It is there.
pub fn refuse_foreign(path: &Path, force: bool) -> Result<(), CommandError> {
    if force || !files::is_taken(path) || is_design(path) {
        return Ok(());
    }
    let path = shown(path);
    Err(CommandError::Usage(format!("{path} exists and is no design; --force replaces it")))
}

/// Refuses to replace a design of another name that somebody has worked on, without force. One of the same name may be what the same
/// command wrote before, which [`refuse_lost`] tells when its work is done.
fn refuse_another(path: &Path, design: &Design, force: bool) -> Result<(), CommandError> {
    let may_go = |other: Design| other.is_bare() || other.name == design.name;
    if force || !files::is_taken(path) || file::read(path).is_ok_and(may_go) {
        return Ok(());
    }
    let path = shown(path);
    Err(CommandError::Usage(format!("{path} exists and holds the work on another plushie; --force replaces it")))
}

/// Refuses to replace a design that somebody has worked on, without force, unless it is one of those that are `kept`.
///
/// # Errors
/// It is there, or what is no design.
pub fn refuse_lost(path: &Path, kept: &[&Design], force: bool) -> Result<(), CommandError> {
    refuse_foreign(path, force)?;
    // A texture is called after its file.
    let but_texture = |design: &Design| Design { texture: None, ..design.clone() };
    let may_go = |other: Design| {
        let other = but_texture(&other);
        other.is_bare() || kept.iter().any(|design| but_texture(design) == other)
    };
    if force || !files::is_taken(path) || file::read(path).is_ok_and(may_go) {
        return Ok(());
    }
    let path = shown(path);
    Err(CommandError::Usage(format!("{path} exists and holds work that would be lost; --force replaces it")))
}

/// The error of a design that cannot be written.
pub fn unwritten(error: FileError) -> CommandError {
    match error {
        FileError::Read { path, source } | FileError::Write { path, source } => CommandError::write(&path, source),
        // Our own work does not validate: that is no fault of the input.
        error @ (FileError::Content { .. } | FileError::Changed { .. }) => CommandError::Failed(error.to_string()),
    }
}

/// Why there is no design at `path`, and the command that is meant where it is something else.
fn unread(path: &Path, error: FileError) -> CommandError {
    match error {
        FileError::Read { source, .. } => unopened(path, source),
        FileError::Write { path, source } => CommandError::write(&path, source),
        FileError::Content { error, .. } => match meant::instead_of_design(path) {
            Some(advice) => CommandError::input(path, advice),
            None => CommandError::input(path, error),
        },
        error @ FileError::Changed { .. } => CommandError::Failed(error.to_string()),
    }
}

/// A design that cannot be opened, with what is called alike, or what stands there instead.
fn unopened(path: &Path, error: io::Error) -> CommandError {
    let reason = error.to_string();
    match meant::instead_of_design(path).or_else(|| meant::like(path)) {
        Some(advice) => CommandError::input(path, format!("{reason}; {advice}")),
        None => CommandError::input(path, reason),
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
