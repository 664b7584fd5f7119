//! Outputs: files and folders that appear whole or not at all, and lines on the given writer.

use super::error::{CommandError, check_cancel};
use super::progress;
use crate::design::file::is_design;
use crate::files::folder::{self, FolderError, MANIFEST, Manifest};
use crate::files::{self, printable, shown};
use crate::picture::film::PAGE_MARK;
use clap::Args;
use serde::{Deserialize, Serialize};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Whether what is in the way of an output may go.
#[derive(Clone, Copy, Debug, Args)]
pub struct Replace {
    /// Replace a file that is no earlier output of this kind
    #[arg(long)]
    pub force: bool,
}

/// The kinds of files, designs apart, that a command writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Picture,
    Answer,
    Drawing,
    Table,
    Plot,
}

/// A file to be written that is no design: an answer, a picture, a drawing.
pub struct Output<'a> {
    path: &'a Path,
    kind: Kind,
    replace: Replace,
    /// What the command reads.
    inputs: Vec<PathBuf>,
}

impl<'a> Output<'a> {
    /// Looks at the place before the work begins.
    ///
    /// # Errors
    /// It is a file that the command reads, a design, or the work of others ([`Kind::is_foreign`]) without force; or it cannot be
    /// written to.
    pub fn new(
        path: &'a Path,
        kind: Kind,
        replace: Replace,
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> Result<Self, CommandError> {
        let output = Self { path, kind, replace, inputs: inputs.into_iter().collect() };
        output.check()?;
        files::check(path).map_err(|e| CommandError::write(path, e))?;
        Ok(output)
    }

    /// Puts `bytes` in the place; nothing is written once `cancel` is raised.
    pub fn write(&self, bytes: &[u8], cancel: &AtomicBool) -> Result<(), CommandError> {
        check_cancel(cancel)?;
        self.check()?;
        log::info!("writing {}", shown(self.path));
        files::write(self.path, bytes).map_err(|e| CommandError::write(self.path, e))
    }

    fn check(&self) -> Result<(), CommandError> {
        self.inputs.iter().try_for_each(|input| refuse_input(self.path, input))?;
        if is_design(self.path) {
            let path = shown(self.path);
            return Err(CommandError::Usage(format!("{path} is a design and would be replaced; choose another name")));
        }
        if !self.replace.force && self.kind.is_foreign(self.path) {
            let (path, what) = (shown(self.path), self.kind.name());
            return Err(CommandError::Usage(format!("{path} exists and is no {what} of ours; --force replaces it")));
        }
        Ok(())
    }
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Answer => "answer",
            Self::Drawing => "drawing",
            Self::Table => "table",
            Self::Plot => "plot",
        }
    }

    /// Whether a file is the work of others, by its content: what does not say that it is ours is theirs, whatever its name. What a command has
    /// written before is replaced, and so is an empty file.
    fn is_foreign(self, path: &Path) -> bool {
        /// Enough to know a picture or a drawing, bytes.
        const HEAD: u64 = 1024;
        let mut head = Vec::new();
        if !files::is_taken(path) {
            return false;
        }
        if !std::fs::File::open(path).is_ok_and(|file| file.take(HEAD).read_to_end(&mut head).is_ok()) {
            return true;
        }
        let is_ours = match self {
            Self::Picture => {
                let ours = [files::is_marked_png, files::is_marked_jpeg, files::is_marked_gif];
                head.starts_with(PAGE_MARK.as_bytes()) || ours.iter().any(|is_ours| is_ours(&head))
            }
            Self::Answer => json_format(path).is_some_and(|format| format.starts_with("plushwright-answer/")),
            Self::Drawing => {
                let text = String::from_utf8_lossy(&head);
                text.trim_start().starts_with('(') && text.contains("parts:")
            }
            Self::Table => head.starts_with(CURVE_HEADING.as_bytes()),
            Self::Plot => head.starts_with(CURVE_MARK.as_bytes()),
        };
        !is_ours && !head.is_empty()
    }
}

/// First heading of the table of a curve, by which a file that was written before is known; and the first line of its plot.
pub const CURVE_HEADING: &str = "up to winches";
pub const CURVE_MARK: &str = "<!-- plushwright: error against winches and tendons -->";

/// What a JSON file says that it is.
fn json_format(path: &Path) -> Option<String> {
    #[derive(Deserialize)]
    struct Head {
        format: String,
    }
    let bytes = files::read(path, MOST_TEXT).ok()?;
    serde_json::from_slice(&bytes).ok().map(|Head { format }| format)
}

/// Refuses to write to the file that is read.
pub fn refuse_input(output: &Path, input: &Path) -> Result<(), CommandError> {
    if !files::same(output, input) {
        return Ok(());
    }
    let path = shown(output);
    Err(CommandError::Usage(format!("{path} is a file that is read and would be replaced; choose another name")))
}

/// Puts files (path below the folder, content) on the disk as one folder with a manifest of that format, in the place of an earlier one
/// of the same format.
pub fn write_folder(
    path: &Path,
    format: &str,
    contents: &[(String, Vec<u8>)],
    cancel: &AtomicBool,
) -> Result<(), CommandError> {
    let mut files: Vec<(&str, &[u8])> =
        contents.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
    let manifest = json(&Manifest::of(format, files.iter().copied()))? + "\n";
    files.push((MANIFEST, manifest.as_bytes()));
    check_cancel(cancel)?;
    folder::write(path, any_version(format), &files).map_err(refused_folder)
}

/// Whether [`write_folder`] may, before the work begins.
pub fn check_folder(path: &Path, format: &str) -> Result<(), CommandError> {
    folder::check(path, any_version(format)).map(drop).map_err(refused_folder)
}

/// `plushwright-demo/` of `plushwright-demo/1`.
fn any_version(format: &str) -> &str {
    format.split_inclusive('/').next().unwrap_or(format)
}

/// Why a folder was not written.
pub fn refused_folder(error: FolderError) -> CommandError {
    match error {
        FolderError::Write { path, source } => CommandError::Write { path, source },
        error => CommandError::Usage(error.to_string()),
    }
}

/// Prints one line: nothing in it makes another one or moves the cursor.
pub fn say(out: &mut dyn Write, line: &str) -> Result<(), CommandError> {
    progress::aside(|| writeln!(out, "{}", printable(line))).map_err(CommandError::Print)
}

/// Prints several lines, as [`say`] does each.
pub fn say_lines(out: &mut dyn Write, text: &str) -> Result<(), CommandError> {
    text.split('\n').try_for_each(|line| say(out, line))
}

/// Prints a record as indented JSON, the name and version of its format first (`plushwright-check/1`).
pub fn say_json(out: &mut dyn Write, format: &str, record: &impl Serialize) -> Result<(), CommandError> {
    say_lines(out, &json(&Formatted { format, record })?)
}

/// A record that says what it is.
#[derive(Serialize)]
pub struct Formatted<'a, T> {
    pub format: &'a str,
    #[serde(flatten)]
    pub record: &'a T,
}

/// A value as indented JSON text; what a terminal would obey is escaped as JSON does.
pub fn json(value: &impl Serialize) -> Result<String, CommandError> {
    let text =
        serde_json::to_string_pretty(value).map_err(|e| CommandError::Failed(format!("cannot form JSON: {e}")))?;
    if !text.chars().any(|c| c != '\n' && files::is_hidden(c)) {
        return Ok(text);
    }
    // Only strings hold such characters, and there the escape means the same.
    let escaped = text.chars().map(|c| match c {
        '\n' => "\n".to_owned(),
        c if files::is_hidden(c) => c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")).collect(),
        c => c.to_string(),
    });
    Ok(escaped.collect())
}

/// Largest text that is read, bytes: a problem of a million triangles takes a third of it.
const MOST_TEXT: u64 = 256 << 20;

/// Reads an input file as text, or what a pipe brings.
pub fn read_text(path: &Path) -> Result<String, CommandError> {
    let refuse = |reason: String| CommandError::input(path, reason);
    let mut text = String::new();
    let file = std::fs::File::open(path).map_err(|e| refuse(e.to_string()))?;
    if file.metadata().is_ok_and(|found| found.len() > MOST_TEXT) {
        return Err(refuse(format!("it is larger than {} MiB", MOST_TEXT >> 20)));
    }
    // A pipe has no length: one byte more than allowed tells.
    file.take(MOST_TEXT + 1).read_to_string(&mut text).map_err(|e| refuse(e.to_string()))?;
    if text.len() as u64 > MOST_TEXT {
        Err(refuse(format!("it is larger than {} MiB", MOST_TEXT >> 20)))
    } else {
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cancelled_write_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let output = Output::new(&path, Kind::Answer, Replace { force: true }, []).unwrap();
        output.write(b"old", &AtomicBool::new(false)).unwrap();
        assert!(output.write(b"new", &AtomicBool::new(true)).is_err());
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_is_read_and_what_is_a_design_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("a.svg"), "<svg/>").unwrap();
        std::fs::write(at("old"), "\n(\n    version: 9,\n").unwrap();
        std::fs::write(at("b.plush"), "x").unwrap();
        std::fs::hard_link(at("a.svg"), at("also-a")).unwrap();
        for (output, input) in [("a.svg", "a.svg"), ("also-a", "a.svg"), ("old", "none"), ("b.plush", "none")] {
            for force in [false, true] {
                let made = Output::new(&at(output), Kind::Picture, Replace { force }, [at(input)]).map(drop);
                assert!(made.is_err_and(|e| e.code() == 2), "{output}");
            }
        }
        for (force, taken) in [(false, false), (true, true)] {
            assert_eq!(Output::new(&at("a.svg"), Kind::Picture, Replace { force }, [at("none")]).is_ok(), taken);
        }
    }

    #[test]
    fn a_folder_replaces_an_earlier_one_of_its_kind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("demo");
        let go = AtomicBool::new(false);
        for (format, name) in [("plushwright-demo/1", "one"), ("plushwright-demo/2", "two")] {
            write_folder(&path, format, &[(name.into(), name.into())], &go).unwrap();
            assert_eq!(std::fs::read(path.join(name)).unwrap(), name.as_bytes());
            assert_eq!(std::fs::read_dir(&path).unwrap().count(), 2);
        }
        assert!(check_folder(&path, "plushwright-bench/1").is_err());
        assert!(write_folder(&path, "plushwright-demo/1", &[], &AtomicBool::new(true)).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_line_stays_one_line_and_json_stays_json() {
        let mut out = Vec::new();
        say(&mut out, "pig\nplushwright: done\u{1b}[2J").unwrap();
        assert_eq!(String::from_utf8(out).unwrap(), "pig\\u{a}plushwright: done\\u{1b}[2J\n");
        let text = json(&["\u{9b}2J\u{202e}é"]).unwrap();
        assert!(text.contains("\\u009b2J\\u202eé"), "{text}");
        assert_eq!(serde_json::from_str::<Vec<String>>(&text).unwrap(), ["\u{9b}2J\u{202e}é"]);
    }
}
