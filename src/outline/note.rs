//! What a reader or the clean-up has to say besides its steps.

use thiserror::Error;

/// Something that the maker of a file should know. Its text says what happened; what could be asked for instead is for each front end
/// to name, in its own words.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Note {
    #[error("a background rectangle as large as the page was left out")]
    BackgroundLeftOut,
    /// The first texts of the drawing.
    #[error("text ({}) is set in the bundled font Ubuntu Light", quoted(.0))]
    TextSet(Vec<String>),
    #[error("{0} embedded picture(s) left out; only drawn shapes count")]
    PicturesLeftOut(usize),
    #[error("filter effects (shadows, blurs) left out")]
    FiltersLeftOut,
    #[error("parts of the drawing lie off the page; they count")]
    OffPage,
    /// Such as "an OBJ".
    #[error("{0} states no unit; a plain number is taken for 1 mm")]
    NoUnit(&'static str),
    /// The triangles of a mesh do not make one body.
    #[error("the triangles of the OBJ are not one sound piece; their area is meshed anew")]
    Unsound,
    /// The level found, 0 to 1.
    #[error("ink is what differs from the background by more than {:.0} of 255", 255.0 * .0)]
    Ink(f64),
    /// Spots of a picture, each of fewer pixels than `least`.
    #[error("{count} speck(s) of the picture, each under {least:.0} pixels, left out")]
    Specks { count: usize, least: f64 },
    #[error("{0} open line(s) left out; only closed outlines count")]
    OpenLines(usize),
    /// Things that a drawing has besides outlines, by their kind.
    #[error("{count} {kind} left out")]
    LeftOut { kind: String, count: usize },
    #[error("the drawing is mostly lines around holes")]
    MostlyHoles,
    /// Parts that could not be widened without being asked.
    #[error("{parts} part(s) are thinner than {width_mm:.1} mm")]
    Thin { parts: usize, width_mm: f64 },
    #[error("the silhouette is only {height_mm:.1} mm high, small for a plushie")]
    Small { height_mm: f64 },
}

/// The first few of many.
fn quoted(texts: &[String]) -> String {
    const SHOWN: usize = 3;
    texts.iter().take(SHOWN).map(|text| format!("\"{text}\"")).collect::<Vec<_>>().join(", ")
}
