//! How to read an outline.

use super::Point;
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
    /// Kept, but what is drawn in thin lines alone is filled, across a small gap too.
    #[default]
    Found,
    Keep,
    Fill,
}

/// The treatment of what lies below everything else: paper, a card, a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Background {
    /// Left out where there is little doubt: it covers the page, it is white, it is a frame. A note tells either way.
    #[default]
    Found,
    /// What covers everything else is left out, whatever it is.
    Drop,
    Keep,
}

/// How to read an outline.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Import {
    /// Height of the silhouette, mm; without it and the width the file's own size counts.
    pub height_mm: Option<f64>,
    /// Width of the silhouette, mm, in place of its height.
    pub width_mm: Option<f64>,
    pub pieces: Pieces,
    pub holes: Holes,
    pub background: Background,
    /// How far smoothing may move the boundary, mm; 0 for none. `None`: where it is finer than scissors can follow, by less
    /// than these see.
    pub smooth_mm: Option<f64>,
    /// Parts nearer to each other than this are one piece, mm. `None`: where scissors cannot part them.
    pub gap_mm: Option<f64>,
    /// Ends of lines nearer to each other than this meet, mm. `None`: a small part of the drawing's size.
    pub join_mm: Option<f64>,
    /// Parts thinner than this are widened, mm. `None`: hairlines alone, as long as they change little.
    pub min_width_mm: Option<f64>,
    /// Length of a plain number or a pixel, mm, whatever the file says.
    pub unit_mm: Option<f64>,
    /// Difference from the background, or opacity, 0 to 255, from which something counts; `None` finds it.
    pub threshold: Option<u8>,
    /// Names of the layers that count, empty for all. SVG: the `id` or Inkscape label of groups and elements at any depth.
    /// DXF: the layers of the entities.
    pub layers: Vec<String>,
    /// Names of the blocks of a DXF that are read in place of its drawing, empty for none.
    pub blocks: Vec<String>,
}

impl Import {
    /// Whether the size of the silhouette is asked for, so that the file's own does not count.
    pub fn asks_size(&self) -> bool {
        self.height_mm.is_some() || self.width_mm.is_some()
    }

    /// What a silhouette with this box is to be multiplied by, where a size is asked for.
    pub(in crate::outline) fn scale(&self, (low, high): (Point, Point)) -> Option<f64> {
        let height = self.height_mm.map(|height| height / (high[1] - low[1]));
        height.or_else(|| self.width_mm.map(|width| width / (high[0] - low[0])))
    }
}
