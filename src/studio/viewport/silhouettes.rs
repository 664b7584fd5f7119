//! The drawn silhouette of the document and its fibres, made anew where its outline, its mesh or their routings have changed.

use crate::design::Design;
use crate::picture::{Silhouette, Weave};
use std::sync::Arc;

/// What is drawn of the newest document's body.
#[derive(Default)]
pub struct Silhouettes {
    of: Option<Arc<Design>>,
    silhouette: Option<Arc<Silhouette>>,
    weave: Option<Arc<Weave>>,
}

impl Silhouettes {
    /// Once a frame.
    pub fn follow(&mut self, design: &Arc<Design>) {
        let before = self.of.replace(design.clone());
        if before.as_ref().is_some_and(|before| Arc::ptr_eq(before, design)) {
            return;
        }
        let is_of = |same: fn(&Design, &Design) -> bool| before.as_ref().is_some_and(|before| same(before, design));
        if !is_of(Silhouette::is_of) {
            self.silhouette = Some(Arc::new(Silhouette::of(design)));
        }
        if !is_of(Weave::is_of) {
            self.weave = Some(Arc::new(Weave::of(design)));
        }
    }

    pub fn newest(&self) -> Option<(&Arc<Silhouette>, &Arc<Weave>)> {
        self.silhouette.as_ref().zip(self.weave.as_ref())
    }
}
