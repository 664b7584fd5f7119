//! Onion skins: the plushie at the keyframes before and after, as outlines.

use crate::design::{Design, Keyframe};
use crate::engine::Shape;
use crate::studio::jobs::{Running, Told};
use std::sync::Arc;

/// The name of the job that works them out.
pub const ONION: &str = "onion skins";

/// Whether they are shown, and those that are worked out.
#[derive(Default)]
pub struct Onion {
    pub on: bool,
    /// Of which keyframes and design they are, or will be.
    pub of: Option<Neighbours>,
    pub(crate) running: Option<Running>,
    /// The realizable plushie before and after.
    pub shapes: [Option<Arc<Shape>>; 2],
}

/// Keyframes before and after a time.
#[derive(Clone)]
pub struct Neighbours {
    pub design: Arc<Design>,
    /// Cable wound by each winch, mm.
    pub activations_mm: [Option<Vec<f64>>; 2],
}

impl Neighbours {
    /// Those of a time; a keyframe at the time itself is none of them.
    pub fn of(design: &Arc<Design>, time_s: f64) -> Self {
        use crate::design::animation::SAME_TIME_S;
        let wound = |key: &Keyframe| key.activations_mm.clone();
        let before = design.keyframes.iter().rev().find(|key| key.time_s < time_s - SAME_TIME_S);
        let after = design.keyframes.iter().find(|key| key.time_s > time_s + SAME_TIME_S);
        Self { design: design.clone(), activations_mm: [before.map(wound), after.map(wound)] }
    }

    /// Whether it looks the same.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.design, &other.design) && self.activations_mm == other.activations_mm
    }
}

impl Onion {
    /// Takes what the job has found, if it is still wanted.
    pub(crate) fn take(&mut self, serial: u64, told: &Told) {
        if Running::is(self.running.as_ref(), serial) {
            self.running = None;
            if let Some(shapes) = told.downcast_ref::<[Option<Arc<Shape>>; 2]>() {
                self.shapes = shapes.clone();
            }
        }
    }

    /// Nothing is shown or waited for.
    pub(crate) fn clear(&mut self) {
        crate::studio::jobs::cancel(&mut self.running);
        (self.of, self.shapes) = (None, [None, None]);
    }
}
