//! Products of a blueprint: their inputs and their kinds.

use super::error::ExportError;
use super::options::Options;
use super::sheet::Sheet;
use super::solid::Solid;
use super::table::Table;
use crate::design::Design;
use crate::motion::{Program, Trajectory};

/// A product by its name: that of its files, without an extension.
#[derive(Clone, Debug, PartialEq)]
pub struct Product {
    pub name: String,
    pub content: Content,
}

/// The kinds of products; each writer knows some of them.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Something flat, to be cut, sewn or looked at.
    Sheet(Sheet),
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
    pub trajectory: &'a Trajectory,
    pub options: &'a Options,
    /// The parts before this one in the table of products.
    pub sections: &'a [Section],
    /// Their remarks.
    pub remarks: &'a [String],
}

/// A part of the blueprint: products that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    pub products: Vec<Product>,
    /// How to use them, for the page that goes with the blueprint: lines indented by two spaces, each with its end.
    pub guide: String,
    /// Remarks for the user.
    pub remarks: Vec<String>,
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
