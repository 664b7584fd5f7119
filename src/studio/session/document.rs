//! The document, and where it belongs.

use crate::design::Design;
use crate::design::history::History;
use crate::studio::keeping::Kept;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A design with its history.
pub struct Document {
    pub history: History,
    pub path: Option<PathBuf>,
    /// The file that it was read from: what it names is found from there.
    pub origin: Option<PathBuf>,
    /// The texture of one that was imported, until it is saved.
    pub kept: Option<Kept>,
}

impl Document {
    pub fn new(design: Design, path: Option<PathBuf>) -> Self {
        Self { history: History::new(design), origin: path.clone(), path, kept: None }
    }

    pub fn design(&self) -> &Arc<Design> {
        self.history.current()
    }

    /// Where files of this plushie are likely to be.
    pub fn folder(&self) -> PathBuf {
        let beside = self.path.as_deref().and_then(Path::parent).map(Path::to_path_buf);
        beside.filter(|p| !p.as_os_str().is_empty()).or_else(|| std::env::current_dir().ok()).unwrap_or_default()
    }

    /// What its file is called where it has none.
    pub fn file_name(&self) -> String {
        format!("{}.plush", plain(&self.design().name))
    }

    /// What the folder of its blueprint is called.
    pub fn folder_name(&self) -> String {
        format!("{}-blueprint", plain(&self.design().name))
    }
}

/// A name that every file system takes.
fn plain(name: &str) -> String {
    let name: String = name.trim().chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    if name.is_empty() { "plushie".to_owned() } else { name.to_lowercase() }
}
