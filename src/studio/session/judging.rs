//! How near the realizable plushie comes to each pose, and which rules of sewing the design breaks: worked out by jobs, one after the other.

use super::judgement::Judgement;
use crate::design::{Design, Pose};
use crate::engine::{BodySpec, Solver};
use crate::sewing::Breach;
use crate::studio::jobs::{Running, cancel};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

/// How near the realizable plushie comes to a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseError {
    /// Rms distance of the targets in body lengths.
    pub error: f64,
    /// Whether it is that of the design as it is now.
    pub fresh: bool,
    /// Whether it was found from rest with all effort, as [`check`](crate::operations::check) does.
    pub thorough: bool,
}

/// Solvers that go on from one design to the next, by the name of their pose.
pub type Trackers = Arc<Mutex<BTreeMap<String, Solver>>>;

/// What is known of the design.
#[derive(Default)]
pub struct Judging {
    of: Option<Arc<Design>>,
    errors: Vec<Option<PoseError>>,
    breaches: Vec<Breach>,
    /// Whether what is judged quickly has changed since that was done last.
    due: bool,
    running: Option<Running>,
    /// The pose that is worked on with all effort, and for which design.
    thorough: Option<(Arc<Design>, usize)>,
    pub(crate) trackers: Trackers,
    /// Poses whose job broke: not tried again before the design changes.
    broken: Vec<usize>,
}

impl Judging {
    /// The pose by its number; nothing where that has no targets, or is not known yet.
    pub fn error(&self, pose: usize) -> Option<PoseError> {
        self.errors.get(pose).copied().flatten()
    }

    /// The rules of sewing that the design breaks.
    pub fn breaches(&self) -> &[Breach] {
        &self.breaches
    }

    /// Whether all is known of the design as it is now.
    pub fn is_settled(&self, design: &Arc<Design>) -> bool {
        let current = self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, design));
        current && !self.due && self.running.is_none() && self.next_pose(None).is_none()
    }

    pub fn cancel(&mut self) {
        cancel(&mut self.running);
        self.thorough = None;
    }

    /// Whether a job is at work.
    pub(crate) fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// After a change of the document: what is known of the one before may be old.
    pub(crate) fn follow(&mut self, design: &Arc<Design>) {
        let Some(before) = self.of.clone() else {
            self.begin_with(design);
            return;
        };
        if Arc::ptr_eq(&before, design) {
            return;
        }
        self.broken.clear();
        if before.mesh != design.mesh {
            self.cancel();
            self.begin_with(design);
            return;
        }
        let same_body = BodySpec::of(&before) == BodySpec::of(design);
        self.due |= !same_body || !sewn_alike(&before, design);
        if !strung_alike(&before, design) {
            self.breaches.clear();
        }
        let known = |pose: &Pose| {
            let old = before.poses.iter().position(|old| old.name == pose.name)?;
            let error = self.errors.get(old).copied().flatten()?;
            let same = same_body && before.poses[old].targets == pose.targets;
            Some(PoseError { fresh: error.fresh && same, ..error })
        };
        self.errors = design.poses.iter().map(known).collect();
        self.of = Some(design.clone());
        // A pose that is worked on for another design is given up.
        let outdated = self.thorough.as_ref().is_some_and(|(of, pose)| {
            let targets = |of: &Design| of.poses.get(*pose).map(|pose| pose.targets.clone());
            BodySpec::of(of) != BodySpec::of(design) || targets(of) != targets(design)
        });
        if outdated {
            self.cancel();
        }
    }

    /// What is to be judged quickly now, if anything.
    pub(crate) fn take_due(&mut self) -> Option<Arc<Design>> {
        if std::mem::take(&mut self.due) { self.of.clone() } else { None }
    }

    /// The pose that is to be worked on with all effort next, `first` before the others.
    pub(crate) fn next_pose(&self, first: Option<usize>) -> Option<(Arc<Design>, usize)> {
        let design = self.of.as_ref()?;
        if design.networks.is_empty() {
            return None;
        }
        let known = |pose: usize| self.error(pose).is_some_and(|error| error.fresh && error.thorough);
        let open = |pose: &usize| {
            design.poses.get(*pose).is_some_and(|p| !p.targets.is_empty())
                && !known(*pose)
                && !self.broken.contains(pose)
        };
        first.into_iter().chain(0..design.poses.len()).find(open).map(|pose| (design.clone(), pose))
    }

    /// A job has begun; `thorough`: the pose that it is about.
    pub(crate) fn begin(&mut self, running: Running, thorough: Option<(Arc<Design>, usize)>) {
        self.running = Some(running);
        self.thorough = thorough;
    }

    /// A job is over.
    pub(crate) fn take(&mut self, serial: u64, judgement: Judgement) {
        if !Running::is(self.running.as_ref(), serial) {
            return;
        }
        self.running = None;
        self.thorough = None;
        let Some(now) = self.of.clone() else { return };
        match judgement {
            Judgement::Quick { design, breaches, errors } => {
                if strung_alike(&design, &now) {
                    self.breaches = breaches;
                }
                let fresh = BodySpec::of(&design) == BodySpec::of(&now);
                for (pose, error) in errors {
                    let better = self.error(pose).is_some_and(|known| known.fresh && known.thorough);
                    if !better {
                        self.put(&design, &now, pose, PoseError { error, fresh, thorough: false });
                    }
                }
            }
            Judgement::Thorough { design, pose, error: Some(error) } => {
                let fresh = BodySpec::of(&design) == BodySpec::of(&now);
                self.put(&design, &now, pose, PoseError { error, fresh, thorough: true });
            }
            Judgement::Thorough { error: None, .. } => {}
        }
    }

    /// A job broke.
    pub(crate) fn break_off(&mut self, serial: u64) {
        if Running::is(self.running.as_ref(), serial) {
            self.broken.extend(self.thorough.as_ref().map(|(_, pose)| *pose));
            self.cancel();
        }
    }

    /// Keeps what was found for a pose of `design`, where `now` has it still.
    fn put(&mut self, design: &Design, now: &Design, pose: usize, error: PoseError) {
        let (Some(found), Some(slot)) = (design.poses.get(pose), self.errors.get_mut(pose)) else { return };
        if let Some(is) = now.poses.get(pose).filter(|is| is.name == found.name) {
            *slot = Some(PoseError { fresh: error.fresh && is.targets == found.targets, ..error });
        }
    }

    fn begin_with(&mut self, design: &Arc<Design>) {
        self.errors = vec![None; design.poses.len()];
        self.breaches.clear();
        self.due = true;
        self.of = Some(design.clone());
    }
}

/// Whether two designs on one mesh are equal in all that the rules of sewing are asked of.
fn sewn_alike(a: &Design, b: &Design) -> bool {
    a.networks == b.networks && a.sewing == b.sewing && a.fabrication == b.fabrication && a.outline == b.outline
}

/// Whether two designs have the same numbers of winches, tendons and holes: breaches of one can be shown on the other.
fn strung_alike(a: &Design, b: &Design) -> bool {
    let holes = |design: &Design| -> Vec<Vec<usize>> {
        let tendons = |network: &crate::design::Network| network.tendons.iter().map(|t| t.routing.len()).collect();
        design.networks.iter().map(tendons).collect()
    };
    holes(a) == holes(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use crate::studio::jobs::{Jobs, Outcome};

    #[test]
    fn figures_are_old_as_soon_as_what_they_are_about_changes() {
        let mut jobs = Jobs::new(Arc::new(|| ()));
        let mut judging = Judging::default();
        let first = Arc::new(testing::sample());
        judging.follow(&first);
        assert!(!judging.is_settled(&first) && judging.take_due().is_some() && judging.take_due().is_none());
        let mut found = |judging: &mut Judging, design: &Arc<Design>, error: f64| {
            let running = jobs.start("Judging", |_| Outcome::Broken { job: "Judging", why: String::new() });
            let serial = running.serial;
            judging.begin(running, Some((design.clone(), 0)));
            (serial, Judgement::Thorough { design: design.clone(), pose: 0, error: Some(error) })
        };
        let (serial, told) = found(&mut judging, &first, 0.1);
        judging.take(serial, told);
        let error = |judging: &Judging| judging.error(0).map(|error| (error.error, error.fresh, error.thorough));
        assert_eq!(error(&judging), Some((0.1, true, true)));
        // The second pose has no targets.
        assert!(judging.next_pose(None).is_none() && judging.is_settled(&first));
        let changed = |change: fn(&mut Design)| {
            let mut design = testing::sample();
            change(&mut design);
            Arc::new(design)
        };
        judging.follow(&changed(|d| d.name.push('x')));
        assert_eq!(error(&judging), Some((0.1, true, true)));
        let moved = changed(|d| d.poses[0].targets[0].to[0] += 1.0);
        judging.follow(&moved);
        assert_eq!(
            (error(&judging), judging.next_pose(None).map(|(_, pose)| pose)),
            (Some((0.1, false, true)), Some(0))
        );
        // What is found for a design that is there no more is given up.
        let (serial, told) = found(&mut judging, &moved, 0.2);
        let strung = changed(|d| drop(d.networks[0].tendons.pop()));
        judging.follow(&strung);
        judging.take(serial, told);
        assert_eq!((error(&judging), judging.is_running()), (Some((0.1, false, true)), false));
        assert!(judging.take_due().is_some());
        // One that breaks is not tried again and again.
        let (serial, _) = found(&mut judging, &strung, 0.3);
        judging.break_off(serial);
        assert!(judging.next_pose(None).is_none());
        judging.follow(&moved);
        assert!(judging.next_pose(None).is_some());
    }
}
