//! Products of a blueprint: their inputs and their kinds.

use super::demand::{Demand, demands};
use super::error::ExportError;
use super::guide::Guide;
use super::options::Options;
use super::piece::Piece;
use super::remark::Remark;
use super::sheet::Sheet;
use super::solid::Solid;
use super::stuffing::{Impossible, Stuffed, stuffed};
use super::table::Table;
use crate::design::Design;
use crate::motion::{Program, Trajectory};
use std::cell::OnceCell;
use std::sync::atomic::AtomicBool;

/// A product by its name: that of its files, without an extension.
#[derive(Clone, Debug, PartialEq)]
pub struct Product {
    pub name: String,
    pub content: Content,
}

/// The kinds of products; each writer knows some of them.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Something flat, to be looked at.
    Sheet(Sheet),
    /// Something flat, to be cut by a machine.
    Cut(Sheet),
    /// Pages to be printed, in order.
    Book(Vec<Sheet>),
    /// Words and pictures.
    Guide(Guide),
    /// Something to be printed or milled.
    Solid(Solid),
    /// Figures.
    Table(Table),
    /// Commands to motors, in files that end so.
    Program { program: Program, extension: &'static str },
    /// A text for a machine, in a file that ends so.
    Text { text: String, extension: &'static str },
    /// Words.
    Page(String),
}

/// The inputs of products.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Sound, with one network at least.
    pub design: &'a Design,
    /// The same as it is cut: its pattern may be compensated for stuffing.
    pub skin: &'a Design,
    /// Why it is not, although that was asked for.
    pub uncompensated: Option<&'a Impossible>,
    pub trajectory: &'a Trajectory,
    pub options: &'a Options,
    /// The parts before this one in the table of products.
    pub sections: &'a [Section],
    /// Their remarks.
    pub remarks: &'a [Remark],
    /// What several products need, worked out when the first one asks.
    pub shared: &'a Shared,
}

/// What several products need.
#[derive(Clone, Debug, Default)]
pub struct Shared {
    piece: OnceCell<Piece>,
    demands: OnceCell<Vec<Demand>>,
    stuffed: OnceCell<Stuffed>,
}

impl Source<'_> {
    /// Whether the pattern is cut otherwise than the body is drawn.
    pub fn is_compensated(&self) -> bool {
        !std::ptr::eq(self.skin, self.design)
    }

    /// The front of the skin.
    pub fn piece(&self) -> &Piece {
        self.shared.piece.get_or_init(|| Piece::front(self.skin, self.options.cutting.corners))
    }

    /// What each winch asks of its motor.
    pub fn demands(&self) -> &[Demand] {
        self.shared.demands.get_or_init(|| demands(self.design, self.trajectory, &AtomicBool::new(false)))
    }

    /// The body as it is when it is stuffed.
    pub fn stuffed(&self) -> &Stuffed {
        self.shared.stuffed.get_or_init(|| stuffed(self.skin, self.design))
    }
}

/// A part of the blueprint: products that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    pub products: Vec<Product>,
    /// How to use them, for the page that goes with the blueprint: lines indented by two spaces, each with its end.
    pub guide: String,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

/// A part of the blueprint as files.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    pub files: Vec<String>,
    pub guide: String,
}

/// Makes a part: one line of the table of products.
pub type Make = fn(&Source<'_>) -> Result<Part, ExportError>;

impl Content {
    /// What files of it end with, where that is not the writer's to say.
    pub(super) fn extension(&self) -> Option<&'static str> {
        match self {
            Self::Program { extension, .. } | Self::Text { extension, .. } => Some(extension),
            _ => None,
        }
    }
}

impl Product {
    pub fn new(name: impl Into<String>, content: Content) -> Self {
        Self { name: name.into(), content }
    }
}
