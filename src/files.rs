//! The one way to write: a file is there whole or not at all, a folder is exchanged, nothing of value is destroyed.
//!
//! | function | does |
//! | --- | --- |
//! | [`write()`], [`write_together`] | puts bytes in the place of a file, or of several at once |
//! | [`folder::write`] | puts a set of files on the disk as one folder, in the place of an earlier one of ours |
//! | [`read`] | the bytes of a regular file, up to a limit |
//! | [`Hold`] | keeps other processes off a file between reading and writing it |
//! | [`Stamp`] | tells whether a file is still what was read |
//! | [`same`], [`is_taken`] | whether two paths are one file; whether something is there |
//! | [`state_folder`], [`make_private`] | where the platform keeps what the program remembers |
//! | [`begin_log`], [`continue_log`] | files that lines are added to |
//! | [`on_interrupt`], [`before_exit`] | an interrupt asks before it ends, and no file is half written |
//! | [`marked_png`], [`is_marked_png`], and so on | tells our pictures from those of others |
//!
//! A file is written in full beside its place, flushed, and then takes the name. On Linux it has no name until then, so that even a
//! process that is killed leaves nothing behind. A symbolic link is followed; mode, owner, group and access lists of what is replaced
//! stay; another hard link to it keeps the old content. What cannot be replaced like this is refused.

mod draft;
pub mod folder;
mod hold;
mod mark;
mod paths;
mod place;
mod signals;
mod stamp;
mod state;
mod sweep;

pub use hold::Hold;
pub use mark::{is_marked_gif, is_marked_jpeg, is_marked_png, marked_gif, marked_jpeg, marked_png};
pub use paths::parent;
pub use place::{is_taken, same};
pub use signals::{before_exit, on_interrupt, survive_size_limits};
pub use stamp::{Stamp, sha256};
pub use state::{begin_log, continue_log, make_private, state_folder};

use draft::Draft;
use place::Place;
use std::fs;
use std::io::{self, Read, Write};
use std::path::Path;

/// Puts `bytes` in the place of `path`: afterwards the file holds either the old content or the new. A terminal, a pipe or the null
/// device is written to as it is.
///
/// # Errors
/// A folder, a read-only file or one whose owner cannot be kept in the place; what the system says, such as a full disk. The old
/// file is untouched then, and nothing remains of the new one.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_together(&[(path, bytes)]).map_err(|(_, error)| error)
}

/// [`write()`] of several files, all or none: every one is on the disk before the first takes its place, and where one cannot take its
/// place those before it give theirs back.
///
/// # Errors
/// The number of the file that was refused, and why. See [`write()`].
pub fn write_together(files: &[(&Path, &[u8])]) -> Result<(), (usize, io::Error)> {
    let _writing = signals::writing();
    let numbered = |number: usize| move |error: io::Error| (number, error);
    let mut drafts = Vec::with_capacity(files.len());
    for (number, &(path, bytes)) in files.iter().enumerate() {
        let draft = match place::find(path).map_err(numbered(number))? {
            Place::Stream => None,
            place => Some(Draft::new(place, bytes).map_err(numbered(number))?),
        };
        drafts.push((path, bytes, draft));
    }
    let mut undo = Vec::new();
    for (number, (path, bytes, draft)) in drafts.into_iter().enumerate() {
        let last = number + 1 == files.len();
        let done = match draft {
            None => stream(path, bytes),
            // Nothing can fail after the last one.
            Some(draft) if last => draft.commit(),
            Some(draft) => draft.commit_undoable().map(|back| undo.push(back)),
        };
        if let Err(error) = done {
            undo.into_iter().rev().for_each(draft::Undo::undo);
            return Err((number, error));
        }
    }
    Ok(())
}

/// Whether a file can be written to a place, as far as can be told before.
///
/// # Errors
/// As [`write()`].
pub fn check(path: &Path) -> io::Result<()> {
    place::find(path).map(drop)
}

/// The bytes of a regular file of at most `most` bytes. Nothing else is opened: a pipe would hang, a device may act.
///
/// # Errors
/// What the path is instead; that it is larger; what the system says.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let regular = |found: &fs::Metadata| match found.is_file() {
        true => Ok(()),
        false if found.is_dir() => Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")),
        false => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a regular file")),
    };
    regular(&fs::metadata(path)?)?;
    let file = open_at_once(path)?;
    let found = file.metadata()?;
    // Another thing may have taken the name in between.
    regular(&found)?;
    let too_large = || {
        let (size, unit) = if most < 1 << 20 { (most >> 10, "KiB") } else { (most >> 20, "MiB") };
        io::Error::new(io::ErrorKind::FileTooLarge, format!("it is larger than {size} {unit}"))
    };
    if found.len() > most {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(found.len() as usize);
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large()) } else { Ok(bytes) }
}

/// A path in a message: what a terminal would obey or hide is written out.
pub fn shown(path: &Path) -> String {
    printable(&path.to_string_lossy())
}

/// The text without anything that a terminal would obey or hide: control characters, line breaks, changes of the writing direction
/// are written out (`\u{1b}`).
pub fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_hidden(c) { shown.extend(c.escape_unicode()) } else { shown.push(c) }
    }
    shown
}

/// Whether a terminal or a window obeys or hides a character instead of showing it.
pub fn is_hidden(c: char) -> bool {
    let line_or_direction = matches!(c, '\u{2028}' | '\u{2029}' | '\u{200e}' | '\u{200f}' | '\u{61c}' | '\u{feff}');
    c.is_control()
        || line_or_direction
        || ('\u{202a}'..='\u{202e}').contains(&c)
        || ('\u{2066}'..='\u{2069}').contains(&c)
}

/// Opens for reading without waiting for the other end of a pipe.
fn open_at_once(path: &Path) -> io::Result<fs::File> {
    let mut options = fs::OpenOptions::new();
    options.read(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, rustix::fs::OFlags::NONBLOCK.bits() as i32);
    options.open(path)
}

/// Writes to what is no file. A pipe that nobody reads is refused: it would keep the program waiting.
fn stream(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut options = fs::OpenOptions::new();
    options.write(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, rustix::fs::OFlags::NONBLOCK.bits() as i32);
    let mut stream = options.open(path)?;
    #[cfg(unix)]
    rustix::fs::fcntl_setfl(&stream, rustix::fs::fcntl_getfl(&stream)? - rustix::fs::OFlags::NONBLOCK)?;
    stream.write_all(bytes)?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_files_are_written_together_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("a"), "old").unwrap();
        fs::create_dir(at("d")).unwrap();
        let (a, b, d) = (at("a"), at("b"), at("d"));
        let refused = write_together(&[(&a, b"new"), (&b, b"new"), (&d, b"new")]);
        assert_eq!(refused.unwrap_err().0, 2);
        assert_eq!((fs::read(&a).unwrap(), b.exists()), (b"old".to_vec(), false));
        write_together(&[(&a, b"new"), (&b, b"newer")]).unwrap();
        assert_eq!((fs::read(&a).unwrap(), fs::read(&b).unwrap()), (b"new".to_vec(), b"newer".to_vec()));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
    }

    #[test]
    fn only_a_regular_file_of_a_bounded_size_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, vec![b'x'; 3000]).unwrap();
        assert_eq!(read(&path, 3000).unwrap().len(), 3000);
        assert!(read(&path, 2999).unwrap_err().to_string().contains("larger than 2 KiB"));
        assert!(read(folder.path(), 99).is_err());
        #[cfg(unix)]
        assert!(read(Path::new("/dev/zero"), 99).unwrap_err().to_string().contains("regular"));
    }

    #[test]
    fn nothing_that_a_terminal_obeys_is_shown() {
        assert_eq!(printable("pig \u{1b}[2J\n\u{9b}m \u{202e}x é 🐷"), "pig \\u{1b}[2J\\u{a}\\u{9b}m \\u{202e}x é 🐷");
    }
}
