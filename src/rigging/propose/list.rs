//! The list of proposals as it grows.

use super::figures::Subject;
use super::pool::Origin;
use super::proposal::Proposal;
use crate::design::Design;
use crate::rigging::kinds;
use crate::rigging::layout::Layout;
use crate::rigging::refine::{Fit, Task};
use crate::rigging::search::{rim, sewable};
use crate::threads::in_order;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Proposals on the list.
const PROPOSALS: usize = 8;
/// A layout is tried out in the place of one of its kind where its cost is below this part of that one's, or it has fewer holes: what it
/// would really reach takes more time than to find it.
const NEWS: f64 = 0.7;
/// A proposal is not shown where another one leaves less than this part of its error with no more tendons and holes, and serves the same
/// poses.
const OUTDONE: f64 = 0.5;

/// A layout that was tried out, on the mesh of the search, and what became of it.
pub(super) struct Known {
    layout: Layout,
    cost: f64,
    proposal: Option<Arc<Proposal>>,
}

/// The proposals so far, that differ in kind.
pub(super) struct List<'a> {
    pub subject: &'a Subject<'a>,
    /// With the one pose at hand.
    pub posed: &'a Design,
    /// Whether the search goes on on a coarser mesh.
    pub coarser: bool,
    /// Whether only what keeps the rules is shown.
    pub rules: bool,
    pub cancel: &'a AtomicBool,
    pub all: Vec<Known>,
}

impl List<'_> {
    /// Makes proposals of layouts that are worth it, and tells the list if it has changed.
    pub fn show(&mut self, fits: &[(Fit, Origin)], found: &mut dyn FnMut(&[Arc<Proposal>])) {
        let new: Vec<&(Fit, Origin)> = fits.iter().filter(|(fit, _)| self.is_news(fit)).collect();
        // The very first one is shown before it is sewn.
        let first = self.all.is_empty();
        let mut changed = self.sew();
        let made = in_order(&new, |(fit, origin)| {
            let proposal = self.proposal(fit, origin)?;
            let sewn = if first { None } else { self.subject.sewn(&proposal.network, self.cancel) };
            Some(Proposal { sewn, ..proposal })
        });
        if self.cancel.load(Ordering::Relaxed) {
            return;
        }
        for ((fit, _), proposal) in new.into_iter().zip(made) {
            let proposal = proposal.map(Arc::new);
            changed |= self.add(Known { layout: fit.layout.clone(), cost: fit.cost, proposal });
        }
        if changed {
            found(&self.best());
        }
    }

    /// Whether a layout is another one than those that were tried out, or clearly better or simpler than those of its kind.
    fn is_news(&self, fit: &Fit) -> bool {
        let better = |known: &Known| fit.cost < NEWS * known.cost || fit.layout.holes() < known.layout.holes();
        self.all.iter().all(|known| !self.alike(&known.layout, &fit.layout) || better(known))
    }

    fn alike(&self, a: &Layout, b: &Layout) -> bool {
        kinds::distance(a, b) < kinds::APART * self.posed.body_length_mm()
    }

    /// Works out what is left of those proposals when a hand sews them that were shown without; whether there was any.
    fn sew(&mut self) -> bool {
        let mut changed = false;
        let shown = self.all.iter_mut().filter_map(|known| known.proposal.as_mut());
        for proposal in shown.filter(|proposal| proposal.sewn.is_none()) {
            if let Some(sewn) = self.subject.sewn(&proposal.network, self.cancel) {
                *proposal = Arc::new(Proposal { sewn: Some(sewn), ..Proposal::clone(proposal) });
                changed = true;
            }
        }
        self.sort();
        changed
    }

    fn sort(&mut self) {
        self.all.sort_by(|a, b| a.rank().total_cmp(&b.rank()));
    }

    /// `None` where it helps nothing, has no figure under the friction of the design, or breaks a rule that is asked for.
    fn proposal(&self, fit: &Fit, origin: &Origin) -> Option<Proposal> {
        let layout = if self.coarser { self.transferred(fit)?.layout } else { fit.layout.clone() };
        let points = layout.located(&self.posed.mesh)?;
        let network = layout.networks(&self.posed.mesh, &points).pop()?;
        let proposal = self.subject.proposal(network, origin.clone(), self.cancel)?;
        let kept = !self.rules || proposal.breaches.is_empty();
        (kept && proposal.rank() < proposal.error_before()).then_some(proposal)
    }

    /// On the body's own mesh.
    fn transferred(&self, fit: &Fit) -> Option<Fit> {
        let edge = rim(&self.posed.mesh);
        let sewable = self.rules.then(|| sewable(self.posed, &edge));
        let task = Task::new(self.posed, sewable.as_ref(), &self.posed.networks);
        task.transferred(fit, &|| self.cancel.load(Ordering::Relaxed))
    }

    /// Whether the list has changed: one of each kind is on it, the best.
    fn add(&mut self, new: Known) -> bool {
        let alike: Vec<bool> = self.all.iter().map(|known| self.alike(&known.layout, &new.layout)).collect();
        let mut theirs = self.all.iter().zip(&alike).filter(|(_, alike)| **alike);
        if theirs.any(|(known, _)| known.rank() <= new.rank()) {
            return false;
        }
        let mut alike = alike.into_iter();
        self.all.retain(|_| !alike.next().unwrap_or(false));
        let shown = new.proposal.is_some();
        self.all.push(new);
        self.sort();
        shown
    }

    /// Without what another one outdoes in everything.
    pub fn best(&self) -> Vec<Arc<Proposal>> {
        let all = || self.all.iter().filter_map(|known| known.proposal.as_ref());
        let kept = all().filter(|mine| mine.rank().is_finite() && !all().any(|other| outdoes(other, mine)));
        kept.take(PROPOSALS).cloned().collect()
    }
}

impl Known {
    fn rank(&self) -> f64 {
        self.proposal.as_ref().map_or(f64::INFINITY, |proposal| proposal.rank())
    }
}

/// Whether one proposal leaves much less with no more tendons and holes, and serves all that another one serves.
fn outdoes(other: &Proposal, mine: &Proposal) -> bool {
    other.rank() < OUTDONE * mine.rank()
        && other.holes <= mine.holes
        && other.network.tendons.len() <= mine.network.tendons.len()
        && other.poses.iter().zip(&mine.poses).all(|(other, mine)| other.is_served() >= mine.is_served())
}
