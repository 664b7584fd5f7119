//! The winches as a hand has wound them.

use crate::design::Design;

/// Cable that a hand has wound, for the networks of a design.
#[derive(Default)]
pub struct Winding {
    /// mm, in the order of the networks.
    wound_mm: Vec<f64>,
    /// The networks, by their names.
    of: Vec<String>,
}

impl Winding {
    /// Cable wound by each winch, mm.
    pub fn wound_mm(&self) -> &[f64] {
        &self.wound_mm
    }

    /// Whether the design still has those networks, in that order.
    pub(crate) fn fits(&self, design: &Design) -> bool {
        self.of.iter().eq(design.networks.iter().map(|network| &network.name))
    }

    /// Begins with what is wound now.
    pub(crate) fn begin(&mut self, design: &Design, wound_mm: &[f64]) {
        self.of = design.networks.iter().map(|network| network.name.clone()).collect();
        self.wound_mm = wound_mm.to_vec();
        self.wound_mm.resize(self.of.len(), 0.0);
    }

    /// Winds one of them.
    pub(crate) fn wind(&mut self, winch: usize, wound_mm: f64) {
        if let Some(wound) = self.wound_mm.get_mut(winch) {
            *wound = wound_mm;
        }
    }
}
