//! The `*.plush` file: RON, versioned, laid out so that people can read it and version control can compare it.
//!
//! Every point, triangle, target, tendon and keyframe stands on a line of its own. Numbers are written in full: reading
//! a file back gives the same bits. The version is read before anything else, so that a file from the future is refused
//! as such and not for the first word this program does not know.

use super::{Design, DesignError};
use ron::error::{Position, SpannedError};
use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Version of the file format that this program writes, and the newest it reads.
pub const FORMAT_VERSION: u32 = 1;

/// Why a design file could not be read or written.
#[derive(Debug, Error)]
pub enum FileError {
    #[error("cannot read {}: {source}", path.display())]
    Read { path: PathBuf, source: io::Error },
    #[error("cannot write {}: {source}", path.display())]
    Write { path: PathBuf, source: io::Error },
    #[error("{}: {error}", path.display())]
    Content { path: PathBuf, error: TextError },
}

/// Why a text is not a design.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TextError {
    /// Not the RON of a design; 1-based.
    #[error("line {line}, column {column}: {message}")]
    Syntax { line: usize, column: usize, message: String },
    #[error(
        "format version {found} is newer than this program reads ({FORMAT_VERSION}): a newer plushwright is needed"
    )]
    FutureVersion { found: u64 },
    #[error(transparent)]
    Invalid(#[from] DesignError),
    /// The design could not be put into words.
    #[error("{0}")]
    Unwritable(String),
}

/// Reads and validates a design file.
pub fn read(path: &Path) -> Result<Design, FileError> {
    let bytes = fs::read(path).map_err(|source| FileError::Read { path: path.into(), source })?;
    let content = |error| FileError::Content { path: path.into(), error };
    let text = std::str::from_utf8(&bytes).map_err(|e| content(not_text(&bytes, e.valid_up_to())))?;
    parse(text).map_err(content)
}

/// Parses and validates the text of a design file.
pub fn parse(text: &str) -> Result<Design, TextError> {
    /// Every version of the format has this much.
    #[derive(Deserialize)]
    #[serde(rename = "Design")]
    struct Head {
        version: u64,
    }
    // A byte order mark is what some editors leave at the head of a file.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    // A text too broken for this is reported by the strict reading below, which says more.
    if let Ok(Head { version: found }) = ron::from_str(text)
        && found > u64::from(FORMAT_VERSION)
    {
        return Err(TextError::FutureVersion { found });
    }
    let design: Design = ron::from_str(text).map_err(syntax)?;
    design.validate()?;
    Ok(design)
}

/// The text of a design file. [`parse`] gives back the same design, bit for bit, if it is valid.
pub fn to_text(design: &Design) -> Result<String, ron::Error> {
    // Taken apart in full: a field added to the document cannot be forgotten here.
    let Design {
        version: _,
        name,
        outline,
        mesh,
        material,
        fibers,
        tendons,
        pins,
        poses,
        networks,
        keyframes,
        fabrication,
        controller,
        drawing,
        texture,
        texture_box,
        gravity,
        stiffness_map,
    } = design;
    let mut text = String::from("(\n");
    let out = &mut text;
    field(out, "version", &FORMAT_VERSION, 0)?;
    field(out, "name", name, 0)?;
    field(out, "material", material, 0)?;
    field(out, "fibers", fibers, 2)?;
    field(out, "tendons", tendons, 1)?;
    if texture.is_some() {
        field(out, "texture", texture, 0)?;
    }
    if texture_box.is_some() {
        field(out, "texture_box", texture_box, 0)?;
    }
    if gravity.is_some() {
        field(out, "gravity", gravity, 0)?;
    }
    field(out, "fabrication", fabrication, 1)?;
    field(out, "controller", controller, 1)?;
    field(out, "pins", pins, 1)?;
    field(out, "poses", poses, 3)?;
    field(out, "networks", networks, 3)?;
    field(out, "keyframes", keyframes, 1)?;
    if drawing.is_some() {
        field(out, "drawing", drawing, 3)?;
    }
    field(out, "outline", outline, 3)?;
    field(out, "mesh", mesh, 2)?;
    if stiffness_map.is_some() {
        field(out, "stiffness_map", stiffness_map, 1)?;
    }
    text.push_str(")\n");
    Ok(text)
}

/// Validates a design and writes it: the file holds either the old content or the new, never a part of it.
pub fn write(path: &Path, design: &Design) -> Result<(), FileError> {
    let content = |error: TextError| FileError::Content { path: path.into(), error };
    design.validate().map_err(|e| content(e.into()))?;
    let text = to_text(design).map_err(|e| content(TextError::Unwritable(e.to_string())))?;
    replace(path, text.as_bytes()).map_err(|source| FileError::Write { path: path.into(), source })
}

/// A design read from `from` as it is to be written to `to`, where that differs: what it finds relative to its own folder stays
/// the same file.
pub fn seen_from(design: &Design, from: &Path, to: &Path) -> Option<Design> {
    let texture = moved(design.texture.as_deref()?, from, to)?;
    Some(Design { texture: Some(texture), ..design.clone() })
}

/// A path relative to the folder of `from` as seen from the folder of `to`; none where it stays as it is.
fn moved(path: &str, from: &Path, to: &Path) -> Option<String> {
    let [from, to] = [from, to].map(|file| parent(file).canonicalize().ok());
    let (from, to) = (from?, to?);
    if from == to || Path::new(path).is_absolute() {
        return None;
    }
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    if common == 0 {
        // Another drive.
        return from.join(path).to_str().map(str::to_owned);
    }
    let up = to.components().skip(common).map(|_| Some(".."));
    let down = from.components().skip(common).map(|part| part.as_os_str().to_str());
    let parts: Option<Vec<&str>> = up.chain(down).chain([Some(path)]).collect();
    Some(parts?.join("/"))
}

/// Replaces a file in one step: a new file beside it, flushed to the disk, takes its place and its permissions.
fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A link stays a link: what it points to is replaced.
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let folder = parent(&path);
    let mut builder = tempfile::Builder::new();
    builder.prefix(".plushwright-").suffix(".tmp");
    // A temporary file is private by default; a document gets what the user's umask says.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    if let Ok(old) = fs::metadata(&path) {
        if old.permissions().readonly() {
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is read-only"));
        }
        file.as_file().set_permissions(old.permissions())?;
    }
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(&path).map_err(|e| e.error)?;
    // The new name itself is on the disk once the folder is. Not every system can do that; the content is safe anyway.
    #[cfg(unix)]
    if let Ok(folder) = fs::File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// Where a design that was read from `file` finds its texture.
pub fn texture_path(design: &Design, file: &Path) -> Option<PathBuf> {
    design.texture.as_deref().map(|texture| file.with_file_name(texture))
}

/// The folder of a file.
pub fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Writes one field; what is nested deeper than `depth` levels in it stays on one line.
fn field<T: Serialize>(out: &mut String, name: &str, value: &T, depth: usize) -> Result<(), ron::Error> {
    const INDENT: &str = "    ";
    let layout = PrettyConfig::new().new_line("\n").indentor(INDENT).depth_limit(depth);
    // Strings are escaped, so that every line break is one of the layout.
    let value = ron::ser::to_string_pretty(value, layout)?.replace('\n', &format!("\n{INDENT}"));
    out.push_str(&format!("{INDENT}{name}: {value},\n"));
    Ok(())
}

fn syntax(error: SpannedError) -> TextError {
    let Position { line, col: column } = error.span.start;
    TextError::Syntax { line, column, message: error.code.to_string() }
}

fn not_text(bytes: &[u8], good: usize) -> TextError {
    let before = &bytes[..good];
    let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
    let column = 1 + before.iter().rev().take_while(|&&b| b != b'\n').count();
    TextError::Syntax { line, column, message: "not UTF-8 text".into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_relative_path_leads_to_the_same_file_from_another_folder() {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        for path in ["a/b", "c"] {
            std::fs::create_dir_all(at(path)).unwrap();
        }
        let seen = |from: &str, to: &str| moved("x.png", &at(from), &at(to));
        assert_eq!(seen("a/p.plush", "a/q.plush"), None);
        assert_eq!(seen("a/p.plush", "a/../a/b/../q.plush"), None);
        assert_eq!(seen("a/p.plush", "c/q.plush").as_deref(), Some("../a/x.png"));
        assert_eq!(seen("p.plush", "a/b/q.plush").as_deref(), Some("../../x.png"));
        assert_eq!(seen("a/b/p.plush", "q.plush").as_deref(), Some("a/b/x.png"));
        assert_eq!(moved("/x.png", &at("a/p.plush"), &at("c/q.plush")), None);
    }
}
