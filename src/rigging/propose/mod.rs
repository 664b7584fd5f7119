//! Networks for one pose, for somebody to choose from.
//!
//! One more winch is searched for beside those that are there: random layouts bettered in the linear model, improved by exact
//! sensitivities ([`Task::improve`]), changed at random, thinned out; and the networks of Algorithm 2, moved until they can be sewn. What is
//! proposed differs in kind ([`kinds`]), and every figure of it is what a check says of the design with this network ([`figures`]).
//!
//! | file | holds |
//! | --- | --- |
//! | `mod` | the course of the search, and the list as it grows |
//! | `proposal` | a proposal and the options of the search |
//! | `figures` | a network becomes a proposal |
//! | `kinds` | which networks are the same in kind |
//! | `pool` | the layouts that are alive, and how they come about |
//! | `paper` | networks of Algorithm 2 as layouts |

mod figures;
mod kinds;
mod paper;
mod pool;
mod proposal;

pub use proposal::{PoseServed, Proposal, ProposeOptions};

use super::layout::Layout;
use super::moves::{Sampler, Topology};
use super::refine::{Fit, Task};
use super::search::{FREE_HOLES, coarser, rim, sewable};
use crate::design::{Design, Pose, Target};
use crate::discovery::Stages;
use crate::threads::in_order;
use figures::Subject;
use pool::{ALIVE, Origin, Pool};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Proposals on the list.
const PROPOSALS: usize = 8;
/// Batches of new layouts; after the first one something is shown.
const BATCHES: usize = 6;
/// Batches that are shown at once where that takes longer than a batch: on a finer mesh than that of the search.
const EARLY: usize = 2;
/// Rounds in which all layouts that are alive have children.
const ROUNDS: usize = 3;
/// Layouts of which what costs little is left out in the end; the others that are alive are shown as they are.
const THINNED: usize = 4;
/// A proposal is not shown where another one leaves less than this part of its error with no more tendons and holes, and serves the same
/// poses.
const OUTDONE: f64 = 0.5;

/// Networks of one winch for a pose of `targets`, in addition to those that the design has; the best first, by the error that is left when
/// a hand has sewn them. `found` hears of the list whenever it has changed. Empty where nothing helps, and without what was not found yet when
/// cancelled. The same options give the same list, for any number of threads.
pub fn propose(
    design: &Design,
    targets: &[Target],
    options: &ProposeOptions,
    found: &mut dyn FnMut(&[Arc<Proposal>]),
    cancel: &AtomicBool,
) -> Vec<Arc<Proposal>> {
    let Some(subject) = Subject::new(design, targets, cancel) else { return Vec::new() };
    let mut posed = design.clone();
    posed.keyframes.clear();
    posed.poses = vec![Pose { name: String::new(), targets: targets.to_vec() }];
    let coarse = coarser(&posed);
    let searched = coarse.as_ref().unwrap_or(&posed);
    let coarser = coarse.is_some();
    let mut list =
        List { subject: &subject, posed: &posed, coarser, options, cancel, tried: Vec::new(), all: Vec::new() };
    let stop = || cancel.load(Ordering::Relaxed);

    let edge = rim(&searched.mesh);
    let sewable = options.rules.then(|| sewable(searched, &edge));
    let task = Task::new(searched, sewable.as_ref(), &searched.networks);
    if task.poses.is_empty() {
        return Vec::new();
    }
    let sampler = Sampler::new(&searched.mesh, sewable.as_ref());
    let most = options.parameters.tendon_num.max(1);
    let most_holes = if options.rules { design.sewing.most_holes } else { FREE_HOLES };
    let topology = Topology { tendons: vec![[if options.fewer { 1 } else { most }, most]], most_holes };
    let mut pool = Pool::new(&task, &sampler, topology, options.seed);
    for batch in 0..BATCHES {
        pool.begin(batch, &stop);
        if !coarser || batch < EARLY {
            list.show(&pool.best(1), found);
        }
        if stop() {
            return list.best();
        }
    }
    for fit in paper::layouts(searched, coarser, options, most_holes, cancel) {
        pool.take(fit, &stop);
        if stop() {
            return list.best();
        }
    }
    for round in 0..ROUNDS {
        pool.advance(round, &stop);
        if !coarser {
            list.show(&pool.best(2), found);
        }
        if stop() {
            return list.best();
        }
    }
    for few in 0..THINNED.div_ceil(2) {
        pool.thin(2 * few..2 * few + 2, &stop);
        if stop() {
            return list.best();
        }
        list.show(&pool.some(2 * few..2 * few + 2), found);
    }
    list.show(&pool.some(THINNED..ALIVE), found);
    list.best()
}

/// The proposals so far, that differ in kind.
struct List<'a> {
    subject: &'a Subject<'a>,
    posed: &'a Design,
    /// Whether the search goes on on a coarser mesh.
    coarser: bool,
    options: &'a ProposeOptions,
    cancel: &'a AtomicBool,
    /// Layouts that were tried out, on the mesh of the search.
    tried: Vec<Layout>,
    /// With the layouts that they were made of, on the mesh of the search.
    all: Vec<(Layout, Arc<Proposal>)>,
}

impl List<'_> {
    /// Makes proposals of layouts that are not on the list, and tells the list if it has changed.
    fn show(&mut self, fits: &[(Fit, Origin)], found: &mut dyn FnMut(&[Arc<Proposal>])) {
        let new: Vec<&(Fit, Origin)> = fits.iter().filter(|(fit, _)| !self.tried.contains(&fit.layout)).collect();
        let mut changed = self.sew();
        // The very first one is shown before it is sewn.
        let first = self.tried.is_empty();
        let made = in_order(&new, |(fit, origin)| {
            let proposal = self.proposal(fit, origin)?;
            let sewn = if first { None } else { self.subject.sewn(&proposal.network, self.cancel) };
            Some(Proposal { sewn, ..proposal })
        });
        if self.cancel.load(Ordering::Relaxed) {
            return;
        }
        self.tried.extend(new.iter().map(|(fit, _)| fit.layout.clone()));
        for ((fit, _), proposal) in new.into_iter().zip(made) {
            changed |= proposal.is_some_and(|proposal| self.add(fit.layout.clone(), proposal));
        }
        if changed {
            found(&self.best());
        }
    }

    /// Works out what is left of those proposals when a hand sews them that were shown without; whether there was any.
    fn sew(&mut self) -> bool {
        let mut changed = false;
        for (_, proposal) in self.all.iter_mut().filter(|(_, proposal)| proposal.sewn.is_none()) {
            if let Some(sewn) = self.subject.sewn(&proposal.network, self.cancel) {
                *proposal = Arc::new(Proposal { sewn: Some(sewn), ..Proposal::clone(proposal) });
                changed = true;
            }
        }
        self.sort();
        changed
    }

    fn sort(&mut self) {
        self.all.sort_by(|a, b| a.1.rank().total_cmp(&b.1.rank()));
    }

    /// `None` where it helps nothing, or breaks a rule that is asked for.
    fn proposal(&self, fit: &Fit, origin: &Origin) -> Option<Proposal> {
        let layout = if self.coarser { self.transferred(fit)?.layout } else { fit.layout.clone() };
        let points = layout.located(&self.posed.mesh)?;
        let network = layout.networks(&self.posed.mesh, &points).pop()?;
        let proposal = self.subject.proposal(network, origin.clone(), self.cancel)?;
        let kept = !self.options.rules || proposal.breaches.is_empty();
        (kept && proposal.error_after() < proposal.error_before()).then_some(proposal)
    }

    /// On the body's own mesh.
    fn transferred(&self, fit: &Fit) -> Option<Fit> {
        let edge = rim(&self.posed.mesh);
        let sewable = self.options.rules.then(|| sewable(self.posed, &edge));
        let task = Task::new(self.posed, sewable.as_ref(), &self.posed.networks);
        task.transferred(fit, &|| self.cancel.load(Ordering::Relaxed))
    }

    /// Whether a proposal came on the list: in the place of one of its kind, where it is better.
    fn add(&mut self, layout: Layout, proposal: Proposal) -> bool {
        let apart = kinds::APART * self.posed.body_length_mm();
        let alike = |(known, _): &(Layout, Arc<Proposal>)| kinds::distance(known, &layout) < apart;
        if self.all.iter().any(|known| alike(known) && known.1.rank() <= proposal.rank()) {
            return false;
        }
        self.all.retain(|known| !alike(known));
        self.all.push((layout, Arc::new(proposal)));
        self.sort();
        true
    }

    /// Without what another one outdoes in everything.
    fn best(&self) -> Vec<Arc<Proposal>> {
        let outdone = |mine: &Proposal| {
            let better = |other: &Proposal| {
                other.rank() < OUTDONE * mine.rank()
                    && other.holes <= mine.holes
                    && other.network.tendons.len() <= mine.network.tendons.len()
                    && other.poses.iter().zip(&mine.poses).all(|(other, mine)| other.is_served() >= mine.is_served())
            };
            self.all.iter().any(|(_, other)| better(other))
        };
        let kept = self.all.iter().map(|(_, proposal)| proposal).filter(|proposal| !outdone(proposal));
        kept.take(PROPOSALS).cloned().collect()
    }
}

/// What a network of Algorithm 2 was found with.
type Paper = Option<(crate::discovery::Parameters, Arc<Stages>)>;

#[cfg(test)]
mod tests;
