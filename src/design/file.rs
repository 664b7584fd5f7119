//! The `*.plush` file: RON, versioned, laid out so that people can read it and version control can compare it.
//!
//! Every point, triangle, target, tendon and keyframe stands on a line of its own. Numbers are written in full: reading
//! a file back gives the same bits. The version is read before anything else, so that a file from the future is refused
//! as such and not for the first word this program does not know.

use super::texture::{self, Origin};
use super::version::FORMAT_VERSION;
use super::{Design, DesignError};
use crate::files::{self, Stamp, printable, shown};
use crate::sewing::Rules;
use ron::error::{Position, SpannedError};
use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest design file that is read, bytes. The largest mesh that is made (200 000 fibres) takes a quarter of it.
pub const MAX_BYTES: u64 = 32 << 20;

/// Why a design file could not be read or written.
#[derive(Debug, Error)]
pub enum FileError {
    #[error("cannot read {}: {source}", shown(path))]
    Read { path: PathBuf, source: io::Error },
    #[error("cannot write {}: {source}", shown(path))]
    Write { path: PathBuf, source: io::Error },
    #[error("{}: {error}", shown(path))]
    Content { path: PathBuf, error: TextError },
    #[error("{} was changed by another program since it was read; it is left as it is", shown(path))]
    Changed { path: PathBuf },
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
///
/// # Errors
/// [`FileError`]: what the system says, or what is wrong with the text.
pub fn read(path: &Path) -> Result<Design, FileError> {
    read_stamped(path).map(|(design, _)| design)
}

/// [`read`], with what tells whether the file is still the one that was read.
///
/// # Errors
/// As [`read`].
pub fn read_stamped(path: &Path) -> Result<(Design, Stamp), FileError> {
    let bytes = files::read(path, MAX_BYTES).map_err(|source| FileError::Read { path: path.into(), source })?;
    let content = |error| FileError::Content { path: path.into(), error };
    let text = std::str::from_utf8(&bytes).map_err(|e| content(not_text(&bytes, e.valid_up_to())))?;
    Ok((parse(text).map_err(content)?, Stamp::of(&bytes)))
}

/// Parses and validates the text of a design file.
///
/// # Errors
/// [`TextError`]: where the text is no design, and why.
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
    let mut design: Design = ron::from_str(text).map_err(syntax)?;
    design.validate()?;
    // What an older version could say, this one can: it is written so from now on.
    design.version = FORMAT_VERSION;
    Ok(design)
}

/// The text of a design file. [`parse`] gives back the same design, bit for bit, if it is valid.
///
/// # Errors
/// What RON cannot write, which no valid design has.
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
        sewing,
        drawing,
        texture,
        texture_box,
        gravity,
        terms,
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
    if !terms.is_empty() {
        field(out, "terms", terms, 1)?;
    }
    field(out, "fabrication", fabrication, 1)?;
    field(out, "controller", controller, 1)?;
    if *sewing != Rules::default() {
        field(out, "sewing", sewing, 1)?;
    }
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
///
/// # Errors
/// [`FileError`]: an unsound design; what the system says. The old content stays then.
pub fn write(path: &Path, design: &Design) -> Result<(), FileError> {
    save(design, None, path, None).map(drop)
}

/// Writes a design that was read from `from`: what it finds beside that goes with it (see [`texture::carried`]). Where the file was
/// `seen` it must still be that one, or gone.
///
/// # Errors
/// [`FileError::Changed`], where it is not; a design that is unsound; what the system says. Nothing is written then.
pub fn save(design: &Design, from: Option<Origin<'_>>, to: &Path, seen: Option<&Stamp>) -> Result<Stamp, FileError> {
    let failed = |source| FileError::Write { path: to.into(), source };
    let carried = texture::carried(design, from.unwrap_or(to.into()), to).map_err(failed)?;
    if let Some(seen) = seen
        && !seen.may_be_replaced(to, MAX_BYTES).map_err(failed)?
    {
        return Err(FileError::Changed { path: to.into() });
    }
    write_with(to, carried.design.as_ref().unwrap_or(design), carried.texture)
}

/// [`fn@write`] together with another file, both or neither.
///
/// # Errors
/// As [`write()`].
pub fn write_with(path: &Path, design: &Design, beside: Option<(PathBuf, Vec<u8>)>) -> Result<Stamp, FileError> {
    let content = |error: TextError| FileError::Content { path: path.into(), error };
    design.validate().map_err(|e| content(e.into()))?;
    let text = to_text(design).map_err(|e| content(TextError::Unwritable(e.to_string())))?;
    let beside = beside.as_ref().map(|(path, bytes)| (path.as_path(), bytes.as_slice()));
    let files: Vec<(&Path, &[u8])> = beside.into_iter().chain([(path, text.as_bytes())]).collect();
    files::write_together(&files)
        .map_err(|(number, source)| FileError::Write { path: files[number].0.into(), source })?;
    Ok(Stamp::of(text.as_bytes()))
}

/// Whether a file is a design, or means to be one: a newer or a broken one too.
pub fn is_design(path: &Path) -> bool {
    /// Enough for what an editor or a person may put before the version, bytes.
    const HEAD: u64 = 512;
    let mut head = Vec::new();
    let read = files::is_taken(path)
        && std::fs::File::open(path).is_ok_and(|file| file.take(HEAD).read_to_end(&mut head).is_ok());
    let text = String::from_utf8_lossy(&head);
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let named = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("plush"));
    read && (named || (text.starts_with('(') && text.contains("version:")))
}

/// Where a design that was read from `file` says that its texture is. [`texture::find`] looks whether it may be read.
pub fn texture_path(design: &Design, file: &Path) -> Option<PathBuf> {
    design.texture.as_deref().map(|texture| file.with_file_name(texture))
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
    TextError::Syntax { line, column, message: excerpt(&error.code.to_string()) }
}

/// A message that may quote the file, which may be anything: its beginning, with nothing that a terminal would obey.
fn excerpt(message: &str) -> String {
    /// Characters: a line or two.
    const MOST: usize = 200;
    let mut shown: String = message.chars().take(MOST).collect();
    if shown.len() < message.len() {
        shown.push_str("...");
    }
    printable(&shown)
}

fn not_text(bytes: &[u8], good: usize) -> TextError {
    let before = &bytes[..good];
    let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
    let column = 1 + before.iter().rev().take_while(|&&b| b != b'\n').count();
    TextError::Syntax { line, column, message: "not UTF-8 text".into() }
}
