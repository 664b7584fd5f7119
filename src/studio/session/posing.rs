//! How a hand poses: with symmetry, with snapping, with what brush.

use crate::design::Design;
use crate::mesh::{Axis, axis};
use crate::outline::Outline;
use std::sync::Arc;

/// The ways of posing that are on.
pub struct Posing {
    /// What is dragged is dragged on the other side of the axis too.
    pub symmetric: bool,
    /// Goals fall into line with others.
    pub snaps: bool,
    pub brush: Brush,
    /// The axis of the body's symmetry, and the outline that it is of.
    axis: Option<(Arc<Design>, Outline, Option<Axis>)>,
}

/// The brush of starch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    pub radius_mm: f64,
    /// Stiffness that it leaves, as a multiple of the material's.
    pub factor: f64,
}

impl Posing {
    /// The axis about which the outline is its own mirror image, where there is one.
    pub fn axis(&self) -> Option<Axis> {
        self.axis.as_ref().and_then(|(_, _, axis)| *axis)
    }

    /// After any change of the document.
    pub(crate) fn follow(&mut self, design: &Arc<Design>) {
        match &mut self.axis {
            Some((of, _, _)) if Arc::ptr_eq(of, design) => {}
            Some((of, outline, _)) if *outline == design.outline => *of = design.clone(),
            _ => {
                let found = axis(&design.outline).map(|(axis, _)| axis);
                self.axis = Some((design.clone(), design.outline.clone(), found));
            }
        }
    }
}

impl Default for Posing {
    fn default() -> Self {
        Self { symmetric: false, snaps: true, brush: Brush { radius_mm: 20.0, factor: 4.0 }, axis: None }
    }
}
