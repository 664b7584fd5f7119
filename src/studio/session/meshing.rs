//! Another resolution of the mesh: what is wanted, and who works on it.

use super::document::Figures;
use crate::operations::reshape::Reshaped;
use crate::outline::Drawing;
use crate::studio::jobs::{Running, cancel};

/// Largest `finer`.
pub const FINEST: usize = 16;

/// The resolution that is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Muscle fibres.
    pub fibers: usize,
    /// The simulation mesh is this many times finer than that of the fibres.
    pub finer: usize,
}

#[derive(Default)]
pub struct Meshing {
    /// The resolution of the controls; `None`: that of the design.
    pub(crate) wanted: Option<Resolution>,
    pub running: Option<Running>,
    /// The drawing of the body that is being made.
    pub(crate) drawn: Drawing,
    /// That body, until the hand rests.
    pub(crate) made: Option<Box<Reshaped>>,
}

impl Meshing {
    /// The resolution that is wanted, or else that of the design.
    pub(crate) fn resolution(&self, &Figures { fibers, edges, .. }: &Figures) -> Resolution {
        let present = || {
            let finer = (edges as f64 / fibers.max(1) as f64).sqrt().round() as usize;
            Resolution { fibers, finer: finer.clamp(1, FINEST) }
        };
        self.wanted.unwrap_or_else(present)
    }

    pub fn cancel(&mut self) {
        cancel(&mut self.running);
        self.made = None;
    }

    /// Whether the mesh that is waited for is there; it is not waited for any more then.
    pub(crate) fn take(&mut self, serial: u64) -> bool {
        let wanted = Running::is(self.running.as_ref(), serial);
        if wanted {
            self.running = None;
        }
        wanted
    }
}
