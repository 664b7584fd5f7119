//! How patterns are drawn: for lasers, for cutting plotters, and for paper.

use super::sheet::{BLACK, BLUE, Color, GREEN, RED, Style};
use serde::{Deserialize, Serialize};

/// Line widths for machines, mm: visible on paper, and below what lasers take for an area to engrave.
const STITCH_MM: f64 = 0.1;
const NOTE_MM: f64 = 0.15;
/// Width of lines on paper, mm: thinner ones vanish at 200 dpi.
const PAPER_MM: f64 = 0.3;
/// Dashes of stitches and snips, mm.
const STITCHES: &[f64] = &[3.0, 1.5];
const SNIPS: &[f64] = &[1.0, 1.0];

/// The machine that cuts the felt.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cutter {
    /// Red hairlines are cut, blue ones are scored or left, green ones are marks: what most shops take.
    #[default]
    Laser,
    /// Colours of LightBurn's first layers: holes C05, cut C02, stitches C01, marks C03.
    Lightburn,
    /// A blade cuts black hairlines; a pen draws the others.
    Plotter,
}

/// The sheet that machines cut felt on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SheetSize {
    /// Width and height, mm.
    pub size_mm: [f64; 2],
}

impl Default for SheetSize {
    /// A laser's bed.
    fn default() -> Self {
        Self { size_mm: [600.0, 400.0] }
    }
}

/// The styles of a pattern's layers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    pub cut: Style,
    pub hole: Style,
    pub stitch: Style,
    pub notch: Style,
    pub snip: Style,
    pub note: Style,
}

impl Preset {
    pub fn of(cutter: Cutter) -> Self {
        let marks = |cut: Color, hole: Color, stitch: Color, note: Color| Self {
            cut: Style::hairline(cut),
            hole: Style::hairline(hole),
            stitch: Style::line(stitch, STITCH_MM),
            notch: Style::line(note, NOTE_MM),
            snip: Style::line(note, NOTE_MM).dashed(SNIPS),
            note: Style::line(note, NOTE_MM),
        };
        match cutter {
            Cutter::Laser => marks(RED, RED, BLUE, GREEN),
            Cutter::Lightburn => marks(Color(255, 0, 0), Color(255, 128, 0), Color(0, 0, 255), Color(0, 224, 0)),
            Cutter::Plotter => marks(BLACK, BLACK, BLUE, GREEN),
        }
    }

    /// For printers: no line is thinner than 0.3 mm, and lines differ without their colours.
    pub fn paper() -> Self {
        let line = Style::line(BLACK, PAPER_MM);
        Self {
            cut: Style::line(BLACK, 1.5 * PAPER_MM),
            hole: line,
            stitch: line.dashed(STITCHES),
            notch: line,
            snip: line.dashed(SNIPS),
            note: line,
        }
    }
}
