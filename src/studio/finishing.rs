//! What becomes of the jobs that are over.

use super::jobs::{Finished, Outcome, Running};
use super::session::Session;

impl Session {
    pub(super) fn take_finished(&mut self, Finished { serial, outcome }: Finished) {
        if Running::is(self.files.running.as_ref(), serial) {
            self.files.running = None;
            self.files.working = None;
        }
        match outcome {
            Outcome::Proposed(proposals) => self.take_proposals(serial, proposals),
            Outcome::Remeshed(made) => self.take_mesh(serial, made),
            Outcome::Reshaped(made) => self.take_body(serial, made),
            Outcome::Rigged(rigged) => self.take_rig(serial, rigged),
            Outcome::Keyed(keyed) => self.take_key(serial, keyed),
            Outcome::Imported(result) => self.take_import(result),
            Outcome::Exported { folder, result } => self.take_export(&folder, result),
            Outcome::Textured { path, texture } => self.take_texture(path, texture),
            Outcome::Picked { path, at_once } => self.take_path(path, at_once),
            Outcome::Broken { job, why } => {
                self.break_off(serial);
                self.messages.error(format!("{job} failed: {why}"));
            }
        }
    }

    /// Nobody waits for a job any more that broke.
    fn break_off(&mut self, serial: u64) {
        let jobs =
            [&mut self.discovery.running, &mut self.meshing.running, &mut self.rigging.running, &mut self.keying];
        for running in jobs {
            if Running::is(running.as_ref(), serial) {
                *running = None;
            }
        }
    }
}
