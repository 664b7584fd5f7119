//! One network alone: of the window, not of the document.

use crate::design::Design;
use std::sync::Arc;

/// The network that is heard alone, if any.
#[derive(Default)]
pub struct Solo {
    name: Option<String>,
    /// A document, and the same with the others switched off.
    made: Option<(Arc<Design>, Arc<Design>)>,
}

impl Solo {
    /// Its name.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// This one alone, or all again where it is already.
    pub(crate) fn toggle(&mut self, name: Option<String>) {
        self.name = if self.name == name { None } else { name };
        self.made = None;
    }

    /// After any change of the document: one that is gone is not waited for.
    pub(crate) fn follow(&mut self, design: &Arc<Design>) {
        let Some(name) = &self.name else { return };
        if self.made.as_ref().is_some_and(|(of, _)| Arc::ptr_eq(of, design)) {
            return;
        }
        let Some(number) = design.networks.iter().position(|network| network.name == *name) else {
            return self.toggle(None);
        };
        let mut alone = Design::clone(design);
        for (other, network) in alone.networks.iter_mut().enumerate() {
            network.muted = other != number;
        }
        self.made = Some((design.clone(), Arc::new(alone)));
    }

    /// The document as it acts.
    pub(crate) fn acting<'a>(&'a self, design: &'a Arc<Design>) -> &'a Arc<Design> {
        match &self.made {
            Some((of, alone)) if Arc::ptr_eq(of, design) => alone,
            _ => design,
        }
    }
}
