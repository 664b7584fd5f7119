//! What a reader and the clean-up have to say besides.

use std::fmt;

/// Something that the user should know about an outline that was read.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// A rectangle that fills the page was left out.
    Background,
    /// So begin the texts that were set in the bundled font.
    Text(Vec<String>),
    EmbeddedPictures(usize),
    Filters,
    OffPage,
    /// A file (`an OBJ`) without a unit.
    NoUnit(&'static str),
    /// The triangles of a mesh were taken as areas.
    NotOnePiece,
    OpenLines(usize),
    /// Things of a drawing that bound no area.
    LeftOut {
        count: usize,
        kind: String,
    },
    /// The difference from the background, 0 to 255, from which pixels count.
    Ink(f64),
    /// Specks of a picture smaller than so many pixels.
    Specks {
        count: usize,
        pixels: f64,
    },
    MostlyLines,
    ThinParts {
        count: usize,
        width_mm: f64,
    },
    /// A silhouette of this height is small for a plushie, mm.
    Small(f64),
}

/// A setting of [`super::Import`] that answers a [`Note`] or an error. Each front end has names of its own for them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    Height,
    Unit,
    Threshold,
    /// Keep the background.
    Background,
    /// Fill the holes.
    Holes,
    MinWidth,
    /// Keep the largest piece.
    Pieces,
}

impl Note {
    /// The setting that would change it.
    pub fn remedy(&self) -> Option<Remedy> {
        match self {
            Self::Background => Some(Remedy::Background),
            Self::NoUnit(_) => Some(Remedy::Unit),
            Self::Ink(_) => Some(Remedy::Threshold),
            Self::MostlyLines => Some(Remedy::Holes),
            Self::ThinParts { .. } => Some(Remedy::MinWidth),
            Self::Small(_) => Some(Remedy::Height),
            _ => None,
        }
    }
}

/// What there is, without what to do about it.
impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Background => f.write_str("a background rectangle as large as the page was left out"),
            Self::Text(texts) => {
                let texts: Vec<String> = texts.iter().map(|text| format!("\"{text}\"")).collect();
                write!(f, "text ({}) is set in the bundled font Ubuntu Light", texts.join(", "))
            }
            Self::EmbeddedPictures(count) => write!(f, "{count} embedded picture(s) left out; only drawn shapes count"),
            Self::Filters => f.write_str("filter effects (shadows, blurs) left out"),
            Self::OffPage => f.write_str("parts of the drawing lie off the page; they count"),
            Self::NoUnit(file) => write!(f, "{file} states no unit; a plain number is taken for 1 mm"),
            Self::NotOnePiece => {
                f.write_str("the triangles of the OBJ are not one sound piece; their area is meshed anew")
            }
            Self::OpenLines(count) => write!(f, "{count} open line(s) left out; only closed outlines count"),
            Self::LeftOut { count, kind } => write!(f, "{count} {kind} left out"),
            Self::Ink(level) => write!(f, "ink is what differs from the background by more than {level:.0} of 255"),
            Self::Specks { count, pixels } => {
                write!(f, "{count} speck(s) of the picture, each under {pixels:.0} pixels, left out")
            }
            Self::MostlyLines => f.write_str("the drawing is mostly lines around holes"),
            Self::ThinParts { count, width_mm } => write!(f, "{count} part(s) are thinner than {width_mm:.1} mm"),
            Self::Small(height_mm) => {
                write!(f, "the silhouette is only {height_mm:.1} mm high, small for a plushie")
            }
        }
    }
}
