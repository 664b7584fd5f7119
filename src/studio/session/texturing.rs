//! The texture of the document, as far as it is read.

use crate::picture::Texture;
use std::path::PathBuf;
use std::sync::Arc;

#[derive(Default)]
pub struct Texturing {
    /// The file that was asked for last.
    pub(crate) path: Option<PathBuf>,
    pub(crate) found: Found,
}

#[derive(Default)]
pub enum Found {
    /// No file, or not yet.
    #[default]
    Nothing,
    Picture(Arc<Texture>),
    /// It is missing or broken, which was said.
    Trouble,
}
