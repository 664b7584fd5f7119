//! From the bytes of a file to one clean outline.

use super::changes::Changes;
use super::drawing::Track;
use super::{Drawing, Note, Outline, OutlineError, Painting, Point, clean, drawing, dxf, obj, picture, svg};
use serde::{Deserialize, Serialize};
use std::io::Read;
use std::ops::RangeInclusive;
use std::path::Path;

/// Largest file that is read, bytes. Reading the largest SVG takes about a gigabyte of memory and some seconds.
pub const MAX_FILE_BYTES: usize = 48 << 20;
/// Without an asked height, a silhouette lower than this is small for a plushie, mm.
const SMALL_MM: f64 = 60.0;

/// How files with outlines are called; what they are is told by their first bytes.
pub const EXTENSIONS: [&str; 7] = ["svg", "png", "jpg", "jpeg", "dxf", "obj", "ron"];
/// Sizes that a plushie can have, mm. Others are slips, and their squares and cubes would lose digits.
const SIZES_MM: RangeInclusive<f64> = 1e-2..=1e6;

/// What to do about several pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Pieces {
    #[default]
    Refuse,
    /// Keep the one with the largest area.
    Largest,
}

/// What to do about holes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Holes {
    #[default]
    Keep,
    Fill,
}

/// What to do about a rectangle that fills the page below everything else.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Background {
    #[default]
    Drop,
    Keep,
}

/// How to read an outline.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Import {
    /// Height of the silhouette, mm; without it the file's own size counts.
    pub height_mm: Option<f64>,
    pub pieces: Pieces,
    pub holes: Holes,
    pub background: Background,
    /// How far smoothing may move the boundary, mm; 0 for none.
    pub smooth_mm: f64,
    /// Parts thinner than this are widened, mm. `None`: hairlines alone, as long as they change little.
    pub min_width_mm: Option<f64>,
    /// What a plain number or a pixel measures, mm, whatever the file says. An SVG has units of its own.
    pub unit_mm: Option<f64>,
    /// Difference from the background, 0 to 255, from which a pixel is ink; `None` finds it.
    pub threshold: Option<u8>,
    /// Names of the layers that count, empty for all. SVG: the `id` or Inkscape label of groups and elements at any depth.
    /// DXF: the layers of the entities.
    pub layers: Vec<String>,
}

/// An outline and what was changed to get it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    pub outline: Outline,
    pub changes: Changes,
    /// The silhouette's box where the file has it: lower left and upper right corner in the file's plain numbers or pixels, y up.
    pub drawn_box: [Point; 2],
    /// The triangles of a file that brings its own mesh, mm, counter-clockwise.
    pub mesh: Option<(Vec<Point>, Vec<[usize; 3]>)>,
    /// The parts that it was drawn from, in the coordinates of `outline`.
    pub drawing: Option<Drawing>,
}

impl Imported {
    /// Lines along which edges of its mesh shall run, in the coordinates of `outline`.
    pub fn tracks(&self) -> &[Track] {
        self.drawing.as_ref().map_or(&[], |drawing| &drawing.tracks)
    }
}

/// The kinds of file that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Svg,
    /// PNG or JPEG.
    Picture,
    Dxf,
    Obj,
    /// Parts, as text.
    Drawing,
}

impl Format {
    /// The format by the first bytes, whatever the file is called.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let head = &bytes[..bytes.len().min(4000)];
        if head.starts_with(b"\x89PNG") || head.starts_with(b"\xff\xd8\xff") {
            Some(Self::Picture)
        } else if dxf::is_dxf(head) {
            Some(Self::Dxf)
        } else if head
            .trim_ascii_start()
            .strip_prefix(b"\xef\xbb\xbf")
            .unwrap_or(head)
            .trim_ascii_start()
            .starts_with(b"<")
        {
            Some(Self::Svg)
        } else if drawing::is_drawing(head) {
            Some(Self::Drawing)
        } else if obj::is_obj(head) {
            Some(Self::Obj)
        } else {
            None
        }
    }
}

/// Reads a file's bytes and cleans the silhouette.
///
/// # Errors
/// See [`OutlineError`]. Never panics, and ends within some seconds, whatever the bytes are.
pub fn import(bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
    import.check()?;
    if bytes.len() > MAX_FILE_BYTES {
        return Err(OutlineError::TooLarge);
    }
    let format = Format::of(bytes).ok_or(OutlineError::UnknownFormat)?;
    match format {
        Format::Picture if !import.layers.is_empty() => return Err(OutlineError::NoLayers("pictures")),
        Format::Drawing if !import.layers.is_empty() => return Err(OutlineError::NoLayers("drawings of parts")),
        Format::Obj if !import.layers.is_empty() => return Err(OutlineError::NoLayers("OBJ meshes")),
        _ => {}
    }
    let painting = match format {
        Format::Svg => svg::painting(bytes, import)?,
        Format::Picture => picture::painting(bytes, import)?,
        Format::Dxf => dxf::painting(bytes, import)?,
        Format::Obj => return obj::read(bytes, import),
        Format::Drawing => return Drawing::read(bytes)?.import(import),
    };
    finish(painting, import)
}

/// [`import`] of a file; one that is too large is not read at all.
///
/// # Errors
/// As [`import`], and what the system says of a file that cannot be read.
pub fn import_file(path: &Path, import: &Import) -> Result<Imported, OutlineError> {
    self::import(&read_file(path)?, import)
}

/// The bytes of a file with an outline.
///
/// # Errors
/// What the system says of a file that cannot be read. Of one that is too large, no more is read than it takes to be
/// refused.
pub fn read_file(path: &Path) -> Result<Vec<u8>, OutlineError> {
    let unopened = |error: std::io::Error| OutlineError::Unopened(error.to_string());
    let file = std::fs::File::open(path).map_err(unopened)?;
    let mut bytes = Vec::new();
    // A pipe or device has no length: one byte more than allowed tells.
    file.take(MAX_FILE_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(unopened)?;
    Ok(bytes)
}

impl Import {
    pub(super) fn check(&self) -> Result<(), OutlineError> {
        if let Some(height) = self.height_mm.filter(|h| !SIZES_MM.contains(h)) {
            return Err(OutlineError::Height(height));
        }
        let lengths = [
            ("the smoothing tolerance", Some(self.smooth_mm)),
            ("the least width", self.min_width_mm),
            ("the unit", self.unit_mm),
        ];
        for (what, value) in lengths {
            if let Some(value) = value.filter(|v| !(v.is_finite() && *v >= 0.0)) {
                return Err(OutlineError::Length { what, value });
            }
        }
        Ok(())
    }
}

/// Cleans what a reader found.
pub(super) fn finish(painting: Painting, import: &Import) -> Result<Imported, OutlineError> {
    import.check()?;
    let imported = clean::clean(painting, import)?;
    let (_, high) = imported.outline.bounding_box();
    if let Some(side) = high.into_iter().find(|side| !SIZES_MM.contains(side)) {
        return Err(OutlineError::Size(side));
    }
    Ok(warned(imported, import))
}

/// With a warning where the file's own size makes a small plushie.
pub(super) fn warned(mut imported: Imported, import: &Import) -> Imported {
    let (_, high) = imported.outline.bounding_box();
    if import.height_mm.is_none() && high[1] < SMALL_MM {
        imported.changes.notes.push(Note::Small { height_mm: high[1] });
    }
    imported
}
