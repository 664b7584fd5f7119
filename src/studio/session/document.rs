//! The document, and where it belongs.

use crate::design::Design;
use crate::design::history::History;
use crate::studio::keeping::Kept;
use std::cell::RefCell;
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
    pub figures: Figures,
    /// What [`Document::is_modified`] found last, and of which design: two large designs are not compared in every frame.
    modified: RefCell<Option<(Arc<Design>, bool)>>,
}

/// Figures of a body that are shown all the time, worked out once.
pub struct Figures {
    of: Arc<Design>,
    pub fibers: usize,
    pub edges: usize,
    pub body_length_mm: f64,
}

impl Document {
    pub fn new(design: Design, path: Option<PathBuf>) -> Self {
        let history = History::new(design);
        let figures = Figures::of(history.current());
        Self { history, origin: path.clone(), path, kept: None, figures, modified: RefCell::default() }
    }

    /// Whether the design differs from the one last saved.
    pub fn is_modified(&self) -> bool {
        let design = self.history.current();
        let mut known = self.modified.borrow_mut();
        match &*known {
            Some((of, modified)) if Arc::ptr_eq(of, design) => *modified,
            _ => known.insert((design.clone(), self.history.is_modified())).1,
        }
    }

    /// The design as it is now has been saved.
    pub fn mark_saved(&mut self) {
        self.history.mark_saved();
        self.modified.take();
    }

    /// The design is nowhere but here: modified until it is saved.
    pub fn mark_unsaved(&mut self) {
        self.history.mark_unsaved();
        self.modified.take();
    }

    /// After any change: the figures are those of the body as it is now.
    pub(crate) fn follow(&mut self) {
        let design = self.history.current();
        if Arc::ptr_eq(design, &self.figures.of) {
            return;
        }
        let of = &self.figures.of;
        if of.mesh == design.mesh && of.fibers.set == design.fibers.set {
            self.figures.of = design.clone();
        } else {
            self.figures = Figures::of(design);
        }
    }

    pub fn design(&self) -> &Arc<Design> {
        self.history.current()
    }

    /// Where files of this plushie are likely to be.
    pub fn folder(&self) -> PathBuf {
        let beside = self.path.as_deref().and_then(Path::parent).map(Path::to_path_buf);
        beside.filter(|p| !p.as_os_str().is_empty()).or_else(|| std::env::current_dir().ok()).unwrap_or_default()
    }

    /// A name for its file where it has none.
    pub fn file_name(&self) -> String {
        format!("{}.plush", plain(&self.design().name))
    }

    /// A name for the folder of its blueprint.
    pub fn folder_name(&self) -> String {
        format!("{}-blueprint", plain(&self.design().name))
    }
}

impl Figures {
    fn of(design: &Arc<Design>) -> Self {
        Self {
            of: design.clone(),
            fibers: design.fiber_routings().len(),
            edges: design.mesh.edges().len(),
            body_length_mm: design.body_length_mm(),
        }
    }
}

/// A name that every file system takes.
fn plain(name: &str) -> String {
    let name: String = name.trim().chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    if name.is_empty() { "plushie".to_owned() } else { name.to_lowercase() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::edit;
    use crate::design::edit::EditError;
    use crate::studio::blank;

    fn rename(document: &mut Document, name: &str) {
        document.history.edit("Rename", |design| edit::rename(design, name)).unwrap();
    }

    #[test]
    fn what_is_known_of_the_design_follows_it() {
        let mut document = Document::new(blank::design(), None);
        assert!(!document.is_modified());
        rename(&mut document, "other");
        assert!(document.is_modified());
        document.mark_saved();
        assert!(!document.is_modified());
        document.mark_unsaved();
        assert!(document.is_modified());
        document.mark_saved();
        document.history.undo();
        assert!(document.is_modified());
        document.history.redo();
        assert!(!document.is_modified());
    }

    #[test]
    fn figures_are_worked_out_for_another_body_alone() {
        let mut document = Document::new(blank::design(), None);
        let counted = |document: &Document| {
            let figures = &document.figures;
            (figures.fibers, figures.edges, figures.body_length_mm)
        };
        let before = counted(&document);
        document.figures.edges = 0;
        rename(&mut document, "other");
        document.follow();
        assert_eq!(document.figures.edges, 0, "the body is the same");
        let larger = |design: &mut Design| -> Result<(), EditError> {
            design.mesh.nodes.iter_mut().flatten().for_each(|v| *v *= 2.0);
            design.outline.outer.iter_mut().flatten().for_each(|v| *v *= 2.0);
            Ok(())
        };
        document.history.edit("Scale", larger).unwrap();
        document.follow();
        assert_eq!(counted(&document), (before.0, before.1, 2.0 * before.2));
    }
}
