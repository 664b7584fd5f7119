//! How to read an outline.

use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Largest file that is read, bytes. Reading the largest SVG takes about a gigabyte of memory and some seconds.
pub const MAX_FILE_BYTES: usize = 48 << 20;
/// Sizes that a plushie can have, mm. Others are slips, and their squares and cubes would lose digits.
pub(super) const SIZES_MM: RangeInclusive<f64> = 1e-2..=1e6;

/// The treatment of several pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Pieces {
    #[default]
    Refuse,
    /// Keep the one with the largest area.
    Largest,
}

/// The treatment of holes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Holes {
    #[default]
    Keep,
    Fill,
}

/// The treatment of a rectangle that fills the page below everything else.
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
    /// Length of a plain number or a pixel, mm, whatever the file says. An SVG has units of its own.
    pub unit_mm: Option<f64>,
    /// Difference from the background, 0 to 255, from which a pixel is ink; `None` finds it.
    pub threshold: Option<u8>,
    /// Names of the layers that count, empty for all. SVG: the `id` or Inkscape label of groups and elements at any depth.
    /// DXF: the layers of the entities.
    pub layers: Vec<String>,
}
