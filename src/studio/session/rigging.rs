//! Networks for all poses at once: what may be built, and who looks for them.

use super::basis::Basis;
use crate::design::Design;
use crate::discovery::Parameters;
use crate::operations::explore::Point;
use crate::operations::rig::{Method, Options};
use crate::rigging::{BadTendons, Trims};
use crate::studio::jobs::{Running, cancel};
use std::sync::{Arc, Mutex};

/// Rigs with more and more winches and tendons, to choose from.
#[derive(Default)]
pub struct Curve {
    pub running: Option<Running>,
    pub points: Vec<Arc<Point>>,
    /// Whether the design is another one by now than that which they were found for.
    pub stale: bool,
    basis: Option<Basis>,
    pub(crate) coming: Arc<Mutex<Option<Vec<Arc<Point>>>>>,
}

impl Curve {
    /// Nothing is known yet of a design.
    pub(crate) fn begin(&mut self, design: &Arc<Design>) {
        *self = Self { basis: Some(Basis::new(design)), ..Self::default() };
    }

    /// Takes what has come since, and finds out whether it holds for a design.
    pub(crate) fn follow(&mut self, design: &Arc<Design>) {
        self.stale = self.basis.as_mut().is_some_and(|basis| !basis.holds(design));
        let list = self.coming.lock().ok().and_then(|mut coming| coming.take());
        if let Some(list) = list.filter(|_| self.running.is_some()) {
            self.points = list;
        }
    }
}

/// The options of a rig, as the panel has them.
#[derive(Clone, Debug, PartialEq)]
pub struct RigChoice {
    pub max_winches: usize,
    /// Tendons of each winch, as they are typed: `2`, `3,2` winch by winch, or `1..4` to choose from.
    pub tendons: String,
    /// Whether networks keep the rules of sewing.
    pub rules: bool,
    /// Whether cables get spool radii and slack of their own.
    pub trims: Trims,
    /// Winch by winch, with the parameters of discovery as they are; otherwise all winches are looked for together.
    pub hold: bool,
}

impl Default for RigChoice {
    fn default() -> Self {
        let Options { max_winches, tendons, rules, trims, .. } = Options::default();
        Self { max_winches, tendons: tendons.to_string(), rules, trims, hold: false }
    }
}

impl RigChoice {
    /// With the parameters of discovery.
    pub(crate) fn options(&self, parameters: &Parameters) -> Result<Options, BadTendons> {
        let held = |value: usize| self.hold.then_some(value);
        Ok(Options {
            method: if self.hold { Method::Algorithm2 } else { Method::Joint },
            rules: self.rules,
            trims: self.trims,
            max_winches: self.max_winches,
            tendons: self.tendons.trim().parse()?,
            seed_num: held(parameters.seed_num),
            join_depth: held(parameters.join_depth),
            join_len: held(parameters.join_len),
            phi: self.hold.then_some(parameters.phi),
            // A search that is told to stop while somebody waits for it is to end with what it has.
            keep: true,
            ..Options::default()
        })
    }
}

#[derive(Default)]
pub struct Rigging {
    pub choice: RigChoice,
    pub running: Option<Running>,
    /// Whether that was told to end with what it has.
    pub(crate) ending: bool,
    pub curve: Curve,
    /// The step that was done last, from the thread.
    pub(crate) step: Arc<Mutex<String>>,
}

impl Rigging {
    pub fn cancel(&mut self) {
        cancel(&mut self.running);
        cancel(&mut self.curve.running);
    }

    /// Tells the search for a rig to end with the best that it has.
    pub fn keep_best(&mut self) {
        if let Some(running) = &self.running {
            running.stop();
            self.ending = true;
        }
    }

    /// The step that was done last.
    pub fn step(&self) -> String {
        self.step.lock().map(|step| step.clone()).unwrap_or_default()
    }
}
