//! Jobs of panels: one for each panel, and what came of it.

use crate::studio::jobs::{Running, Told};
use std::any::Any;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Work for a thread, asked for by a panel. `work` is given what tells it to stop.
#[derive(Clone)]
pub struct Task {
    /// The panel, by its name.
    pub owner: &'static str,
    /// Names the work should it break.
    pub name: &'static str,
    pub work: Arc<dyn Fn(&AtomicBool) -> Told + Send + Sync>,
}

#[derive(Default)]
pub struct Tasks {
    running: BTreeMap<&'static str, Running>,
    told: BTreeMap<&'static str, Told>,
}

impl Tasks {
    /// The result of the newest job of a panel.
    pub fn told<T: Any>(&self, owner: &str) -> Option<&T> {
        self.told.get(owner)?.downcast_ref()
    }

    pub fn running(&self, owner: &str) -> Option<&Running> {
        self.running.get(owner)
    }

    /// Stops all of them, and waits for none any more.
    pub fn cancel(&mut self) {
        std::mem::take(&mut self.running).values().for_each(Running::cancel);
    }

    /// Stops the job of a panel, and waits for it no more.
    pub fn stop(&mut self, owner: &str) {
        if let Some(running) = self.running.remove(owner) {
            running.cancel();
        }
    }

    /// A job has begun in the place of the one before.
    pub fn begin(&mut self, owner: &'static str, running: Running) {
        if let Some(before) = self.running.insert(owner, running) {
            before.cancel();
        }
    }

    /// A job is over. What an abandoned one tells is not wanted.
    pub fn finish(&mut self, owner: &'static str, serial: u64, told: Told) {
        if Running::is(self.running.get(owner), serial) {
            self.running.remove(owner);
            self.told.insert(owner, told);
        }
    }

    /// A job broke.
    pub fn break_off(&mut self, serial: u64) {
        self.running.retain(|_, running| running.serial != serial);
    }
}

impl fmt::Debug for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.owner)
    }
}

impl PartialEq for Task {
    fn eq(&self, other: &Self) -> bool {
        self.owner == other.owner && Arc::ptr_eq(&self.work, &other.work)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::jobs::{Jobs, Outcome};

    #[test]
    fn what_an_abandoned_job_tells_is_not_wanted() {
        let mut jobs = Jobs::new(Arc::new(|| ()));
        let mut tasks = Tasks::default();
        let mut start = |tasks: &mut Tasks, number: u32| {
            let running =
                jobs.start("Counting", move |_| Outcome::Told { owner: "panel.count", told: Arc::new(number) });
            let serial = running.serial;
            tasks.begin("panel.count", running);
            serial
        };
        let (first, second) = (start(&mut tasks, 1), start(&mut tasks, 2));
        tasks.finish("panel.count", first, Arc::new(1_u32));
        assert!(tasks.told::<u32>("panel.count").is_none() && tasks.running("panel.count").is_some());
        tasks.finish("panel.count", second, Arc::new(2_u32));
        assert_eq!((tasks.told::<u32>("panel.count"), tasks.running("panel.count").is_none()), (Some(&2), true));
        assert!(tasks.told::<f64>("panel.count").is_none() && tasks.told::<u32>("panel.other").is_none());
        let third = start(&mut tasks, 3);
        tasks.break_off(third);
        assert!(tasks.running("panel.count").is_none());
        let fourth = start(&mut tasks, 4);
        tasks.cancel();
        tasks.finish("panel.count", fourth, Arc::new(4_u32));
        assert_eq!((tasks.told::<u32>("panel.count"), tasks.running("panel.count").is_none()), (Some(&2), true));
    }
}
