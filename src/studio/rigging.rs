//! Networks for all poses at once, looked for on a thread.

use super::jobs::{Outcome, Running};
use super::session::Session;
use super::words;
use crate::discovery::Parameters;
use crate::operations::rig::{self, Error, Note, Options, Rigged};
use crate::operations::{Context, Progress, key};
use crate::rigging::BadTendons;
use std::sync::{Arc, Mutex};

/// What may be built, as the panel has it.
#[derive(Clone, Debug, PartialEq)]
pub struct RigChoice {
    pub max_winches: usize,
    /// Tendons of each winch, as they are typed: `2`, `3,2` winch by winch, or `1..4` to choose from.
    pub tendons: String,
    /// Whether the parameters of discovery hold; otherwise several are tried.
    pub hold: bool,
}

impl Default for RigChoice {
    fn default() -> Self {
        let Options { max_winches, tendons, .. } = Options::default();
        Self { max_winches, tendons: tendons.to_string(), hold: false }
    }
}

impl RigChoice {
    /// With the parameters of discovery.
    fn options(&self, parameters: &Parameters) -> Result<Options, BadTendons> {
        let held = |value: usize| self.hold.then_some(value);
        Ok(Options {
            max_winches: self.max_winches,
            tendons: self.tendons.trim().parse()?,
            seed_num: held(parameters.seed_num),
            join_depth: held(parameters.join_depth),
            join_len: held(parameters.join_len),
            phi: self.hold.then_some(parameters.phi),
        })
    }
}

#[derive(Default)]
pub struct Rigging {
    pub choice: RigChoice,
    pub running: Option<Running>,
    /// What was done last, from the thread.
    step: Arc<Mutex<String>>,
}

impl Rigging {
    /// What was done last.
    pub fn step(&self) -> String {
        self.step.lock().map(|step| step.clone()).unwrap_or_default()
    }
}

impl Session {
    pub fn rigging(&self) -> &Rigging {
        &self.rigging
    }

    /// Why no rig can be looked for now, if so.
    pub fn cannot_rig(&self) -> Option<&'static str> {
        if self.rigging.running.is_some() {
            return Some("A rig is being looked for");
        }
        let posed = self.design().poses.iter().any(|pose| !pose.targets.is_empty());
        (!posed).then_some("Pose the plushie first: drag a point of the body")
    }

    pub(super) fn start_rig(&mut self) {
        if self.rigging.running.is_some() {
            return;
        }
        let options = match self.rigging.choice.options(&self.discovery.parameters) {
            Ok(options) => options,
            Err(error) => return self.messages.warning(format!("Tendons of each winch: {error}")),
        };
        let design = self.design().clone();
        let (step, wake) = (Arc::new(Mutex::new(String::new())), self.jobs.wake());
        self.rigging.step = step.clone();
        self.rigging.running = Some(self.jobs.start("Rigging", move |cancel| {
            let mut progress = |done: &Progress| {
                if let Ok(mut step) = step.lock() {
                    *step = words::progress(done);
                }
                wake();
            };
            let mut context = Context::telling(cancel, &mut progress);
            Outcome::Rigged(rig::prepare(&design, &options, &mut context).map(Box::new))
        }));
    }

    pub(super) fn cancel_rig(&mut self) {
        if let Some(running) = self.rigging.running.take() {
            running.cancel();
        }
    }

    pub(super) fn take_rig(&mut self, serial: u64, rigged: Result<Box<Rigged>, Error>) {
        if !Running::is(self.rigging.running.as_ref(), serial) {
            return;
        }
        self.rigging.running = None;
        let rigged = match rigged {
            Ok(rigged) => rigged,
            Err(error) => return self.messages.warning(words::unrigged(&error)),
        };
        if rigged.is_stale(self.design()) {
            let text = "The body or its networks were changed meanwhile, so what was found does not fit any more.";
            return self.messages.warning(text);
        }
        for Note::Key(key::Note::Unbalanced(unbalanced)) in &rigged.notes {
            self.messages.warning(format!("Rig: {unbalanced}"));
        }
        let found = rigged.networks.len();
        match self.history.edit("Rig", |design| rigged.apply(design)) {
            Ok(()) => self.messages.info(format!("{found} winch{} found.", if found == 1 { "" } else { "es" })),
            Err(error) => self.messages.error(words::unrigged(&error.into())),
        }
    }
}
