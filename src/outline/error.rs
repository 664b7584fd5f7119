//! Why a file gave no outline.

use super::notes::Remedy;
use super::options::MAX_FILE_BYTES;
use thiserror::Error;

/// Why a file gave no outline.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum OutlineError {
    #[error("{0}")]
    Unopened(String),
    #[error(
        "neither an SVG, PDF or DXF drawing, nor a picture (PNG, JPEG, WebP, GIF, BMP, TIFF), flat mesh (OBJ, STL, 3MF) or drawing of parts"
    )]
    UnknownFormat,
    #[error("{format} is not read; {advice}")]
    Foreign { format: &'static str, advice: &'static str },
    #[error("not a readable {format}: {reason}")]
    Unreadable { format: &'static str, reason: String },
    #[error("the file is larger than {max} MB, the most that is read", max = MAX_FILE_BYTES >> 20)]
    TooLarge,
    #[error("the drawing {0}, too much for an outline; simplify it")]
    TooComplex(&'static str),
    #[error("the picture has more than {millions} million pixels, or half as many of 16 bits: too much for a texture")]
    TextureTooLarge { millions: u64 },
    #[error("nothing is painted: {0}")]
    NothingPainted(&'static str),
    #[error(
        "nothing is painted: the DXF has no lines, arcs, polylines or splines, but {0}; explode these to lines, and save it anew"
    )]
    OtherKinds(String),
    #[error("there is no layer \"{name}\"; the drawing has: {layers}")]
    NoSuchLayer { name: String, layers: String },
    #[error("{0} have no layers to choose from; SVG and DXF drawings have")]
    NoLayers(&'static str),
    #[error("{0} have no blocks to choose from; DXF drawings have")]
    NoBlocks(&'static str),
    #[error("there is no block \"{name}\"; the drawing has: {blocks}")]
    NoSuchBlock { name: String, blocks: String },
    #[error("nothing is drawn but in blocks that nothing inserts: {0}")]
    BlocksAlone(String),
    #[error(
        "nothing is painted: the DXF has no closed outline; its {lines} lines do not meet, the nearest loose ends are {gap:.3} of its units apart"
    )]
    NotClosed { lines: usize, gap: f64 },
    #[error("all that the DXF draws is hidden, on layers that are off, frozen or not plotted: {0}")]
    HiddenAlone(String),
    #[error("{0} has no colours to make a texture of; an SVG or a picture has")]
    NoTexture(&'static str),
    #[error("the text \"{0}\" has characters that the bundled font lacks; convert it to paths")]
    NoFont(String),
    #[error("the silhouette is in {pieces} separate pieces, the largest with {largest:.0} % of the area")]
    Pieces { pieces: usize, largest: f64 },
    #[error("the silhouette touches itself in a single point near ({x:.1}, {y:.1}) mm; widen or open it there")]
    Pinched { x: f64, y: f64 },
    #[error("the silhouette is degenerate: it covers no area worth the name")]
    Degenerate,
    #[error("{what} must be a length of at least 0 mm, not {value}")]
    Length { what: &'static str, value: f64 },
    #[error("the {what} must be between 0.01 and 1000000 mm, not {value} mm")]
    Asked { what: &'static str, value: f64 },
    #[error("either the height or the width can be asked for, not both: the other follows")]
    TwoSizes,
    #[error("the silhouette would measure {0:e} mm")]
    Size(f64),
}

impl OutlineError {
    /// The setting that would help; how it is called is the caller's to say.
    pub fn remedy(&self) -> Option<Remedy> {
        match self {
            Self::Pieces { .. } => Some(Remedy::Pieces),
            Self::Size(_) => Some(Remedy::Height),
            Self::NotClosed { .. } => Some(Remedy::Join),
            Self::HiddenAlone(_) => Some(Remedy::Layers),
            Self::BlocksAlone(_) => Some(Remedy::Blocks),
            _ => None,
        }
    }
}
