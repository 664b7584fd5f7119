//! Network discovery: what was asked, and what came of it.

use super::basis::Basis;
use crate::design::{Design, Network, Target};
use crate::engine::Shape;
use crate::picture::Stage;
use crate::rigging::{Proposal, ProposeOptions};
use crate::studio::jobs::{Running, cancel};
use std::sync::{Arc, Mutex};

/// Proposals that have come since somebody looked.
pub(crate) type Coming = Arc<Mutex<Option<Vec<Arc<Proposal>>>>>;

/// Network discovery: what was asked, and what came of it.
pub struct Discovery {
    pub options: ProposeOptions,
    pub running: Option<Running>,
    pub proposals: Vec<Arc<Proposal>>,
    /// Which proposal the views show.
    pub shown: Option<usize>,
    /// The proposal under the pointer, which the views show meanwhile, and the shape that it strikes there.
    pub hovered: Option<(usize, Option<Arc<Shape>>)>,
    pub order: Order,
    pub stage: Stage,
    /// What the proposals are for; none before the first question.
    asked: Option<Asked>,
    /// Whether the document or the pose is another one by now.
    stale: bool,
    /// Whether the shown proposal was picked by a hand: then it stays while others come.
    pub(crate) picked: bool,
    dropped: Vec<Network>,
    /// Parameters have changed since the search began.
    pub(crate) restart: bool,
    pub(crate) coming: Coming,
}

/// What proposals are sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// As they were found: the best for the pose, what it costs to make considered.
    #[default]
    Found,
    /// The pose's error.
    Error,
    /// The largest error of all poses.
    Worst,
    Force,
    Thread,
    Holes,
    /// The error when a hand sews it.
    Sewn,
}

/// A design and the targets that networks were looked for.
struct Asked {
    targets: Vec<Target>,
    basis: Basis,
}

impl Discovery {
    /// The proposal that the views show.
    pub fn shown(&self) -> Option<&Arc<Proposal>> {
        self.shown.and_then(|index| self.proposals.get(index))
    }

    /// The proposal that the views show now: that under the pointer before the one that was picked.
    pub fn displayed(&self) -> Option<&Arc<Proposal>> {
        let hovered = self.hovered.as_ref().filter(|_| !self.stale);
        hovered.and_then(|(index, _)| self.proposals.get(*index)).or_else(|| self.shown())
    }

    /// The shape that the proposal under the pointer strikes, where it is another pose than that at hand.
    pub fn struck(&self) -> Option<&Arc<Shape>> {
        self.hovered.as_ref().and_then(|(_, shape)| shape.as_ref())
    }

    /// Numbers of the proposals as they are sorted.
    pub fn sorted(&self) -> Vec<usize> {
        let key = |index: &usize| -> f64 {
            let proposal = &self.proposals[*index];
            match self.order {
                Order::Found => 0.0,
                Order::Error => proposal.error_after(),
                Order::Worst => proposal.poses.iter().map(|pose| pose.after).fold(0.0, f64::max),
                Order::Force => proposal.force_n,
                Order::Thread => proposal.thread_mm,
                Order::Holes => proposal.holes as f64,
                Order::Sewn => proposal.sewn.map_or(f64::INFINITY, |sewn| sewn.median),
            }
        };
        let mut sorted: Vec<usize> = (0..self.proposals.len()).collect();
        sorted.sort_by(|a, b| key(a).total_cmp(&key(b)));
        sorted
    }

    /// Whether what is on the list was found for another body or pose than there is now: its figures do not hold.
    pub fn is_stale(&self) -> bool {
        self.stale
    }

    pub fn cancel(&mut self) {
        cancel(&mut self.running);
    }

    /// Drops what was proposed.
    pub fn clear(&mut self) {
        self.proposals.clear();
        self.dropped.clear();
        (self.shown, self.asked, self.stale, self.picked) = (None, None, false, false);
        self.hovered = None;
        self.coming = Coming::default();
    }

    /// A new question.
    pub(crate) fn ask(&mut self, design: &Arc<Design>, targets: &[Target]) {
        self.clear();
        self.stage = Stage::Result;
        self.asked = Some(Asked { targets: targets.to_vec(), basis: Basis::new(design) });
    }

    /// Whether the last question was about this body and these targets.
    pub(crate) fn is_for(&mut self, design: &Arc<Design>, targets: &[Target]) -> bool {
        self.asked.as_mut().is_some_and(|asked| asked.basis.holds(design) && asked.targets == targets)
    }

    /// Whether there was a question.
    pub fn has_asked(&self) -> bool {
        self.asked.is_some()
    }

    /// Finds out whether the list is stale. A stale one is not shown in the views.
    pub(crate) fn follow(&mut self, design: &Arc<Design>, targets: &[Target]) {
        self.stale = self.has_asked() && !self.is_for(design, targets);
        if self.stale && self.running.is_none() && self.proposals.is_empty() {
            // Nothing is there that could be taken for this pose's.
            self.clear();
        } else if self.stale {
            self.shown = None;
        }
    }

    /// Takes the list as it is by now. What was picked out stays so, what was dropped does not come again.
    pub(crate) fn take(&mut self, list: Vec<Arc<Proposal>>) {
        let picked = self.shown().filter(|_| self.picked).cloned();
        self.proposals = list.into_iter().filter(|p| !self.dropped.contains(&p.network)).collect();
        let place = |picked: &Arc<Proposal>| self.proposals.iter().position(|p| p.network == picked.network);
        let first = (!self.stale && !self.proposals.is_empty()).then_some(0);
        let still = picked.as_ref().and_then(place);
        self.picked = still.is_some();
        self.shown = still.or(first);
    }

    /// Takes what has come since.
    pub(crate) fn take_coming(&mut self) {
        let list = self.coming.lock().ok().and_then(|mut coming| coming.take());
        if let Some(list) = list.filter(|_| self.running.is_some()) {
            self.take(list);
        }
    }

    /// Drops the shown proposal; the next one is shown.
    pub(crate) fn reject(&mut self) {
        if let Some(index) = self.shown.filter(|&index| index < self.proposals.len()) {
            self.dropped.push(self.proposals.remove(index).network.clone());
            let left = self.proposals.len();
            self.shown = left.checked_sub(1).map(|last| index.min(last));
        }
    }
}

impl Default for Discovery {
    fn default() -> Self {
        Self {
            options: ProposeOptions::default(),
            running: None,
            proposals: Vec::new(),
            shown: None,
            hovered: None,
            order: Order::default(),
            stage: Stage::Result,
            asked: None,
            stale: false,
            picked: false,
            dropped: Vec::new(),
            restart: false,
            coming: Coming::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;

    #[test]
    fn a_list_is_stale_as_long_as_the_body_or_the_pose_is_another_one() {
        let design = Arc::new(testing::sample());
        let targets = design.poses[0].targets.clone();
        let mut discovery = Discovery::default();
        discovery.follow(&design, &[]);
        assert!(!discovery.is_stale());
        discovery.ask(&design, &targets);
        discovery.take(vec![Arc::new(proposal(&design))]);
        let changed = |change: &dyn Fn(&mut Design)| {
            let mut design = Design::clone(&design);
            change(&mut design);
            Arc::new(design)
        };
        for (stale, design) in [
            (false, changed(&|d| d.name.push('x'))),
            (false, changed(&|d| d.keyframes.clear())),
            (true, changed(&|d| d.networks.truncate(1))),
            (true, changed(&|d| d.tendons.friction += 0.1)),
            (true, changed(&|d| d.sewing.turn_degrees += 1.0)),
            (true, changed(&|d| d.poses[0].targets[0].to[0] += 1.0)),
            (false, design.clone()),
        ] {
            discovery.follow(&design, &targets);
            assert_eq!(discovery.is_stale(), stale);
        }
        discovery.follow(&design, &[]);
        assert!(discovery.is_stale());
        // Without a list there is nothing that could be taken for the other pose's.
        discovery.ask(&design, &targets);
        discovery.follow(&design, &[]);
        assert!(!discovery.is_stale() && !discovery.has_asked());
    }

    fn proposal(design: &Design) -> Proposal {
        Proposal {
            network: design.networks[0].clone(),
            poses: Vec::new(),
            current: 0,
            sewn: None,
            thread_mm: 1.0,
            holes: 0,
            turn_degrees: 0.0,
            turning_degrees: 0.0,
            force_n: 1.0,
            spool_n: 1.0,
            breaches: Vec::new(),
            preview: Arc::default(),
            paper: None,
        }
    }
}
