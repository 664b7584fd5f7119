//! The animation as a film: a GIF, numbered pictures, or a page that plays it.

use super::render::{self, Error, Note, Rendered, What};
use super::{Context, Progress};
use crate::design::Design;
use crate::design::animation::duration_s;
use crate::files;
use crate::files::folder::{self, MANIFEST, Manifest};
use crate::picture::film;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::time::Duration;

/// The kind and the measures of a film.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    pub kind: Kind,
    /// Width and height, pixels.
    pub size: (u32, u32),
    /// Time from picture to picture, s; more where there would be more than [`MOST_PICTURES`].
    pub step_s: f64,
    /// Whether the design's texture is drawn.
    pub texture: bool,
    /// A [look](crate::picture::LOOKS) by its name.
    pub look: String,
}

/// The form of a film.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Kind {
    #[default]
    Gif,
    /// A file that a browser plays in a loop.
    Page,
    /// A folder of numbered PNGs.
    Pictures,
}

/// What is to be written.
#[derive(Clone, Debug, PartialEq)]
pub enum Film {
    File(Vec<u8>),
    /// Names and contents, a manifest among them.
    Folder(Vec<(String, Vec<u8>)>),
}

/// A film, and what is to be known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Filmed {
    pub film: Film,
    pub pictures: usize,
    /// The last picture, with the notes on all.
    pub last: Rendered,
}

/// Most pictures of a film: a longer animation is shown in larger steps.
pub const MOST_PICTURES: usize = 401;
/// Format of the manifest of numbered pictures.
pub const FORMAT: &str = "plushwright-pictures/1";

impl Default for Options {
    fn default() -> Self {
        // What most programs show of a GIF as it is asked for.
        Self {
            kind: Kind::Gif,
            size: (640, 360),
            step_s: 0.08,
            texture: true,
            look: crate::picture::LOOKS[0].name.to_owned(),
        }
    }
}

/// Draws the animation, picture by picture. `from`: the file that the design was read from.
///
/// # Errors
/// There is no animation, a picture is too large for the memory; [`Error::Cancelled`].
pub fn run(design: &Design, from: &Path, options: &Options, context: &mut Context) -> Result<Filmed, Error> {
    let duration = duration_s(design);
    let step_s = options.step_s.max(duration / (MOST_PICTURES - 1) as f64);
    let steps = (duration / step_s).floor() as usize;
    let (mut pngs, mut notes): (Vec<Vec<u8>>, Vec<Note>) = (Vec::new(), Vec::new());
    let mut last = None;
    for k in 0..=steps {
        context.tell(&Progress::Picture { done: k, of: steps + 1 });
        let what = What::Time((step_s * k as f64).min(duration));
        let of = render::Options { what, size: options.size, texture: options.texture, look: options.look.clone() };
        let rendered = render::run(design, from, &of, context)?;
        pngs.push(rendered.png.clone());
        let new: Vec<Note> = rendered.notes.iter().filter(|note| !notes.contains(*note)).cloned().collect();
        notes.extend(new);
        last = Some(rendered);
    }
    let last = last.ok_or(Error::NoKeyframes)?;
    context.check()?;
    let pictures = pngs.len();
    let step = Duration::from_secs_f64(step_s);
    let film = match options.kind {
        Kind::Gif => Film::File(film::gif(&pngs, step).map_err(Error::Picture)?),
        Kind::Page => Film::File(film::page(&pngs, step, &design.name).into_bytes()),
        Kind::Pictures => numbered(pngs)?,
    };
    Ok(Filmed { film, pictures, last: Rendered { notes, ..last } })
}

/// Pictures with names that sort as they follow each other.
fn numbered(pngs: Vec<Vec<u8>>) -> Result<Film, Error> {
    let mut files: Vec<(String, Vec<u8>)> =
        pngs.into_iter().enumerate().map(|(k, png)| (format!("{:04}.png", k + 1), png)).collect();
    let manifest = Manifest::of(FORMAT, files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())));
    let json = serde_json::to_string_pretty(&manifest).map_err(|error| Error::Picture(error.to_string()))?;
    files.push((MANIFEST.into(), (json + "\n").into_bytes()));
    Ok(Film::Folder(files))
}

/// Refuses a place where something stands that is no film of ours: a design, a photograph.
///
/// # Errors
/// It does, in words.
pub fn check(path: &Path, kind: Kind) -> Result<(), String> {
    /// Enough to know a GIF or a page, bytes.
    const HEAD: u64 = 1024;
    if kind == Kind::Pictures {
        let (of, _) = FORMAT.split_at(FORMAT.len() - 1);
        return folder::check(path, of).map(drop).map_err(|error| error.to_string());
    }
    if !files::is_taken(path) {
        return Ok(());
    }
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    let ours = match kind {
        Kind::Page => head.starts_with(film::PAGE_MARK.as_bytes()),
        _ => files::is_marked_gif(&head),
    };
    match read.is_ok() && ours {
        true => Ok(()),
        false => Err(format!("{} exists and is no film of ours; choose another name", files::shown(path))),
    }
}

impl Film {
    /// Puts it on the disk, whole or not at all.
    ///
    /// # Errors
    /// What stands in the place is not an earlier one; what the system says.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        match self {
            Self::File(bytes) => files::write(path, bytes).map_err(|error| error.to_string()),
            Self::Folder(files) => {
                let files: Vec<(&str, &[u8])> = files.iter().map(|(name, b)| (name.as_str(), b.as_slice())).collect();
                let (of, _) = FORMAT.split_at(FORMAT.len() - 1);
                folder::write(path, of, &files).map_err(|error| error.to_string())
            }
        }
    }
}
