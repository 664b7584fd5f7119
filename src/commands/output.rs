//! Outputs: files and folders that appear whole or not at all, and lines on the given writer.

use super::error::{CommandError, check_cancel};
use crate::design::file::is_design;
use crate::files::folder::{self, FolderError, MANIFEST, Manifest};
use crate::files::{self, printable, shown};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// A file to be written that is no design: an answer, a picture, a drawing.
pub struct Output<'a> {
    path: &'a Path,
    /// What the command reads.
    inputs: Vec<PathBuf>,
}

impl<'a> Output<'a> {
    /// Looks at the place before the work begins.
    ///
    /// # Errors
    /// It is a file that the command reads or a design, or it cannot be written to.
    pub fn new(path: &'a Path, inputs: impl IntoIterator<Item = PathBuf>) -> Result<Self, CommandError> {
        let output = Self { path, inputs: inputs.into_iter().collect() };
        output.check()?;
        files::check(path).map_err(|e| CommandError::write(path, e))?;
        Ok(output)
    }

    /// Puts `bytes` in the place; nothing is written once `cancel` is raised.
    pub fn write(&self, bytes: &[u8], cancel: &AtomicBool) -> Result<(), CommandError> {
        check_cancel(cancel)?;
        self.check()?;
        files::write(self.path, bytes).map_err(|e| CommandError::write(self.path, e))
    }

    fn check(&self) -> Result<(), CommandError> {
        self.inputs.iter().try_for_each(|input| refuse_input(self.path, input))?;
        if is_design(self.path) {
            let path = shown(self.path);
            return Err(CommandError::Usage(format!("{path} is a design and would be replaced; choose another name")));
        }
        Ok(())
    }
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

fn refused_folder(error: FolderError) -> CommandError {
    match error {
        FolderError::Write { path, source } => CommandError::Write { path, source },
        error => CommandError::Usage(error.to_string()),
    }
}

/// Prints one line: nothing in it makes another one or moves the cursor.
pub fn say(out: &mut dyn Write, line: &str) -> Result<(), CommandError> {
    writeln!(out, "{}", printable(line)).map_err(CommandError::Print)
}

/// Prints several lines, as [`say`] does each.
pub fn say_lines(out: &mut dyn Write, text: &str) -> Result<(), CommandError> {
    text.split('\n').try_for_each(|line| say(out, line))
}

/// Prints a value as indented JSON.
pub fn say_json(out: &mut dyn Write, value: &impl serde::Serialize) -> Result<(), CommandError> {
    say_lines(out, &json(value)?)
}

/// A value as indented JSON text; what a terminal would obey is escaped as JSON does.
pub fn json(value: &impl serde::Serialize) -> Result<String, CommandError> {
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

/// Reads an input file as text, or what a pipe brings.
pub fn read_text(path: &Path) -> Result<String, CommandError> {
    /// Largest text, bytes: a problem of a million triangles takes a third of it.
    const MOST: u64 = 256 << 20;
    let refuse = |reason: String| CommandError::input(path, reason);
    let mut text = String::new();
    let file = std::fs::File::open(path).map_err(|e| refuse(e.to_string()))?;
    if file.metadata().is_ok_and(|found| found.len() > MOST) {
        return Err(refuse(format!("it is larger than {} MiB", MOST >> 20)));
    }
    // A pipe has no length: one byte more than allowed tells.
    file.take(MOST + 1).read_to_string(&mut text).map_err(|e| refuse(e.to_string()))?;
    if text.len() as u64 > MOST { Err(refuse(format!("it is larger than {} MiB", MOST >> 20))) } else { Ok(text) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cancelled_write_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let output = Output::new(&path, []).unwrap();
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
            assert!(Output::new(&at(output), [at(input)]).is_err_and(|e| e.code() == 2), "{output}");
        }
        assert!(Output::new(&at("a.svg"), [at("none")]).is_ok());
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
