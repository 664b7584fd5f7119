//! What a reader and the clean-up have to say besides.

use super::Point;
use std::fmt;

/// Something that the user should know about an outline that was read.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// What lay below everything else was left out.
    Background(Ground),
    /// It covers everything else, and counts.
    GroundCounts(Ground),
    /// Paint that is hardly seen was left out: shadows, tints.
    Faint {
        count: usize,
        opacity: f64,
    },
    /// So begin the texts that were set in the bundled font.
    Text(Vec<String>),
    /// Text in a form that browsers do not show either.
    FlowedText(usize),
    EmbeddedPictures(usize),
    /// A drawing has pictures alone and is read as one.
    PicturesAlone,
    /// Of so many pages the first was read.
    Pages(usize),
    Filters,
    OffPage,
    /// Styles of the drawing that are not followed.
    Styles(String),
    /// How the size of a file was found that does not state it in a unit of length.
    Size(Sizing),
    /// A file (`an OBJ`) without a unit.
    NoUnit(&'static str),
    /// The triangles of a mesh were taken as areas.
    NotOnePiece,
    /// A mesh has faces of more than four corners, so its area is meshed anew.
    Polygons,
    /// A body was taken for what it covers, seen along an axis.
    Projected {
        along: &'static str,
        thickness: f64,
    },
    /// A drawing was read from the front or the side, since it stands upright.
    Upright(&'static str),
    OpenLines(usize),
    /// Ends of lines that did not quite meet were joined, over so many mm at most.
    Joined {
        count: usize,
        farthest_mm: f64,
    },
    /// Lines drawn more than once count once.
    Copies(usize),
    /// Closed lines that cross are one area.
    United(usize),
    /// Closed lines within others are holes.
    HolesWithin(usize),
    /// Layers that are frozen, off or not plotted, and how many entities on them, or invisible ones, were left out.
    Hidden {
        layers: Vec<String>,
        count: usize,
    },
    /// Blocks that nothing inserts were read.
    Blocks(Vec<String>),
    /// Areas filled with a hatch count, since nothing else is closed.
    Hatches(usize),
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
    /// A sheet seen at an angle was straightened to these proportions.
    Straightened {
        width_to_height: f64,
    },
    /// This part of the boundary of what a picture shows is soft.
    SoftEdge {
        part: f64,
    },
    MostlyLines,
    /// What is drawn in lines was filled.
    LinesFilled,
    /// So many holes that other parts take up for the most part were filled.
    GapsAround(usize),
    /// A line that does not close was closed here, and filled.
    Closed {
        gap_mm: f64,
        at: Point,
    },
    /// A line does not close, with its ends so far apart.
    NotClosed {
        gap_mm: f64,
        at: Point,
    },
    ThinParts {
        count: usize,
        width_mm: f64,
    },
    /// Parts less than this apart were joined, mm.
    GapsClosed {
        count: usize,
        gap_mm: f64,
    },
    /// The boundary was finer than scissors can follow and was evened within so many mm.
    Evened {
        points: usize,
        within_mm: f64,
    },
    /// A silhouette of this height is small for a plushie, mm.
    Small(f64),
}

/// What lies below everything else in a drawing or a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// One rectangle as large as the page.
    Page,
    /// So many shapes that cover the page together.
    Shapes(usize),
    /// A rectangle that everything else lies on.
    Sheet,
    /// One with round corners.
    Card,
    /// A line around everything else.
    Frame,
}

/// How the size of a file was found that does not state it in a unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sizing {
    /// 96 px to the inch.
    Css,
    /// 72 to the inch, as Adobe Illustrator writes them.
    Illustrator,
    /// 90 to the inch, as Inkscape wrote them up to its version 0.91.
    OldInkscape,
    /// As many dots to the inch as the drawing's own scale tells.
    Dots(f64),
    /// A picture without a resolution.
    Pixels,
}

/// A setting of [`super::Import`] that answers a [`Note`] or an error. Each front end has names of its own for them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    Height,
    Unit,
    Threshold,
    /// Another opacity from which paint counts.
    Opacity,
    /// Keep the background.
    Background,
    /// Leave the background out.
    DropBackground,
    /// Fill the holes.
    Holes,
    /// Keep the holes.
    KeepHoles,
    MinWidth,
    /// Keep the largest piece.
    Pieces,
    Gap,
    Join,
    Smooth,
    /// Name the layers that count.
    Layers,
    /// Name the blocks that count.
    Blocks,
}

impl Note {
    /// The setting that would change it.
    pub fn remedy(&self) -> Option<Remedy> {
        match self {
            Self::Background(_) | Self::Straightened { .. } => Some(Remedy::Background),
            Self::GroundCounts(_) => Some(Remedy::DropBackground),
            Self::Faint { .. } => Some(Remedy::Opacity),
            Self::NoUnit(_) | Self::Size(_) => Some(Remedy::Unit),
            Self::Ink(_) | Self::SoftEdge { .. } => Some(Remedy::Threshold),
            Self::MostlyLines | Self::HolesWithin(_) => Some(Remedy::Holes),
            Self::LinesFilled | Self::GapsAround(_) => Some(Remedy::KeepHoles),
            Self::Closed { .. } | Self::NotClosed { .. } | Self::Joined { .. } | Self::OpenLines(_) => {
                Some(Remedy::Join)
            }
            Self::ThinParts { .. } => Some(Remedy::MinWidth),
            Self::GapsClosed { .. } => Some(Remedy::Gap),
            Self::Evened { .. } => Some(Remedy::Smooth),
            Self::Small(_) => Some(Remedy::Height),
            Self::Hidden { .. } => Some(Remedy::Layers),
            Self::Blocks(_) => Some(Remedy::Blocks),
            _ => None,
        }
    }
}

/// What there is, without what to do about it.
impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Background(Ground::Page) => f.write_str("a background rectangle as large as the page was left out"),
            Self::Background(ground) => write!(f, "{ground} was taken for the background and left out"),
            Self::GroundCounts(ground) => write!(f, "{ground} counts as the body"),
            Self::Faint { count, opacity } => {
                write!(f, "{count} part(s) less than {:.0} % opaque (shadows, tints) left out", 100.0 * opacity)
            }
            Self::Text(texts) => write!(f, "text ({}) is set in the bundled font Ubuntu Light", quoted(texts)),
            Self::FlowedText(count) => {
                write!(f, "{count} flowed text(s) left out, which browsers do not show either; convert them to paths")
            }
            Self::EmbeddedPictures(count) => write!(f, "{count} embedded picture(s) left out; only drawn shapes count"),
            Self::PicturesAlone => f.write_str("the drawing has embedded pictures alone; what they show was read"),
            Self::Pages(count) => write!(f, "of {count} pages the first was read"),
            Self::Filters => f.write_str("filter effects (shadows, blurs) left out"),
            Self::OffPage => f.write_str("parts of the drawing lie off the page; they count"),
            Self::Styles(what) => write!(f, "a style is not followed: {what}"),
            Self::Size(sizing) => write!(f, "the file states no physical size; {sizing}"),
            Self::NoUnit(file) => write!(f, "{file} states no unit; a plain number is taken for 1 mm"),
            Self::NotOnePiece => {
                f.write_str("the triangles of the mesh are not one sound piece; their area is meshed anew")
            }
            Self::Polygons => f.write_str("the mesh has faces of more than four corners; its area is meshed anew"),
            Self::Projected { along, thickness } => {
                write!(f, "the mesh is {thickness:.1} mm thick; what it covers seen along {along} is taken")
            }
            Self::Upright(along) => write!(f, "the drawing stands upright in space; it is seen from {along}"),
            Self::OpenLines(count) => write!(f, "{count} open line(s) left out; only closed outlines count"),
            Self::Joined { count, farthest_mm } => {
                write!(f, "{count} place(s) where lines did not quite meet joined, over {farthest_mm:.2} mm at most")
            }
            Self::Copies(count) => write!(f, "{count} line(s) drawn more than once counted once"),
            Self::United(count) => write!(f, "{count} closed lines cross each other and are joined to one area"),
            Self::HolesWithin(count) => write!(f, "{count} closed line(s) within others are holes"),
            Self::Hidden { layers, count } if layers.is_empty() => write!(f, "{count} invisible thing(s) left out"),
            Self::Hidden { layers, count } => {
                write!(f, "{count} thing(s) that are hidden or on hidden layers ({}) left out", quoted(layers))
            }
            Self::Blocks(names) => write!(f, "nothing is drawn but in blocks; read: {}", quoted(names)),
            Self::Hatches(count) => write!(f, "nothing is closed but {count} hatch(es), whose areas count"),
            Self::LeftOut { count, kind } => write!(f, "{count} {kind} left out"),
            Self::Ink(level) => write!(f, "ink is what differs from the background by more than {level:.0} of 255"),
            Self::SoftEdge { part } => write!(
                f,
                "{:.0} % of the boundary is soft, as where a shadow counts as ink: take the picture in even light, or scan it",
                100.0 * part
            ),
            Self::Specks { count, pixels } => {
                write!(f, "{count} speck(s) of the picture, each under {pixels:.0} pixels, left out")
            }
            Self::Straightened { width_to_height } => {
                write!(
                    f,
                    "the sheet was seen at an angle and straightened to {width_to_height:.3} times as wide as high"
                )
            }
            Self::MostlyLines => f.write_str("the drawing is mostly lines around holes"),
            Self::GapsAround(count) => write!(f, "{count} gap(s) all around a part filled, so that it is one piece"),
            Self::LinesFilled => f.write_str("the drawing is thin lines alone, which were filled"),
            Self::Closed { gap_mm, at: [x, y] } => {
                write!(f, "the outline was open over {gap_mm:.1} mm near ({x:.0}, {y:.0}) mm; it was closed and filled")
            }
            Self::NotClosed { gap_mm, at: [x, y] } => {
                write!(f, "the drawing is a thin line that is open over {gap_mm:.1} mm near ({x:.0}, {y:.0}) mm")
            }
            Self::ThinParts { count, width_mm } => write!(f, "{count} part(s) are thinner than {width_mm:.1} mm"),
            Self::GapsClosed { count, gap_mm } => {
                write!(f, "{count} gap(s) under {gap_mm:.2} mm between parts closed")
            }
            Self::Evened { points, within_mm } => {
                write!(
                    f,
                    "the boundary of {points} points is finer than scissors follow; it was evened within {within_mm:.2} mm"
                )
            }
            Self::Small(height_mm) => {
                write!(f, "the silhouette is only {height_mm:.1} mm high, small for a plushie")
            }
        }
    }
}

impl fmt::Display for Ground {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Page => f.write_str("a rectangle as large as the page"),
            Self::Shapes(count) => write!(f, "what covers the page ({count} shapes below everything else)"),
            Self::Sheet => f.write_str("a rectangle below everything else"),
            Self::Card => f.write_str("a card with round corners below everything else"),
            Self::Frame => f.write_str("a frame around everything else"),
        }
    }
}

impl fmt::Display for Sizing {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Css => f.write_str("a plain number is taken for 1/96 inch"),
            Self::Illustrator => f.write_str("a plain number is taken for 1/72 inch, as Adobe Illustrator writes them"),
            Self::OldInkscape => f.write_str("a plain number is taken for 1/90 inch, as old Inkscape wrote them"),
            Self::Dots(dpi) => write!(f, "its scale tells {dpi:.0} dots to the inch"),
            Self::Pixels => f.write_str("a pixel is taken for 1/96 inch"),
        }
    }
}

fn quoted(texts: &[String]) -> String {
    let quoted: Vec<String> = texts.iter().map(|text| format!("\"{text}\"")).collect();
    quoted.join(", ")
}
