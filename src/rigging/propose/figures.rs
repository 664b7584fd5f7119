//! A network becomes a proposal: every pose wound from rest, as a check does, and what the network asks of a hand.

use super::pool::Origin;
use super::proposal::{PoseServed, Proposal};
use crate::design::{Design, Network, Target, Tendon};
use crate::rigging::checked::Checked;
use crate::rigging::robust::{self, Sewn};
use crate::sewing::{self, Breach};
use crate::threads::in_order;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Bodies of more fibres are not sewn in thought: five more poses of each proposal would take most of the time.
const SEWN_UP_TO: usize = 1500;

/// A design of networks that act, and its poses as they are before anything is proposed.
pub(super) struct Subject<'a> {
    design: &'a Design,
    /// Of a network that comes.
    name: String,
    poses: Vec<(Option<String>, &'a [Target], Checked)>,
    current: usize,
    friction: f64,
}

impl<'a> Subject<'a> {
    /// `None` where the body has no model, and when cancelled.
    pub fn new(design: &'a Design, name: String, targets: &'a [Target], cancel: &AtomicBool) -> Option<Self> {
        let posed = design.poses.iter().filter(|pose| !pose.targets.is_empty());
        let mut poses: Vec<(Option<String>, &[Target])> =
            posed.map(|pose| (Some(pose.name.clone()), pose.targets.as_slice())).collect();
        let current = poses.iter().position(|(_, known)| *known == targets).unwrap_or(poses.len());
        if current == poses.len() {
            poses.push((None, targets));
        }
        let friction = design.tendons.friction;
        let before = in_order(&poses, |(_, targets)| Checked::of(design, targets, friction, cancel));
        if cancel.load(Ordering::Relaxed) || before.iter().any(|checked| checked.shape.nodes.is_empty()) {
            return None;
        }
        let poses = poses.into_iter().zip(before).map(|((name, targets), checked)| (name, targets, checked)).collect();
        Some(Self { design, name, poses, current, friction })
    }

    /// The network tried out; `None` when cancelled.
    pub fn proposal(&self, network: Network, origin: Origin, cancel: &AtomicBool) -> Option<Proposal> {
        let mut with = self.design.clone();
        let network = Network { name: self.name.clone(), ..network };
        with.networks.push(network.clone());
        with.keyframes.clear();
        let own = with.networks.len() - 1;
        let tendons = with.networks[..own].iter().map(|n| n.tendons.len()).sum::<usize>();
        let (mut poses, mut force_n, mut spool_n, mut preview) = (Vec::new(), 0.0_f64, 0.0_f64, None);
        let own_alone = |found: Vec<Breach>| found.into_iter().filter(|b| b.winches().any(|winch| winch == own));
        let mut breaches: Vec<Breach> = own_alone(with.breaches()).collect();
        for (k, (name, targets, before)) in self.poses.iter().enumerate() {
            let after = Checked::of(&with, targets, self.friction, cancel);
            if cancel.load(Ordering::Relaxed) {
                return None;
            }
            let tensions = &after.shape.tendon_tensions[tendons.min(after.shape.tendon_tensions.len())..];
            force_n = tensions.iter().fold(force_n, |m, t| m.max(*t));
            spool_n = spool_n.max(network.tendons.iter().zip(tensions).map(|(tendon, t)| tendon.ratio * t).sum());
            breaches.extend(own_alone(with.breaches_in(&after.shape.nodes)));
            let rubbed = after.with_friction.map(|after| [before.real_error(), after]);
            poses.push(PoseServed {
                name: name.clone(),
                before: before.error(),
                after: after.error(),
                with_friction: rubbed,
            });
            if k == self.current {
                preview = Some(Arc::new(after.shape));
            }
        }
        let cables = network.rig(&with.mesh.nodes)?.cables;
        let turns = cables.iter().flat_map(|cable| cable.windows(3)).map(|p| sewing::turn(p[0], p[1], p[2]));
        Some(Proposal {
            network,
            poses,
            current: self.current,
            sewn: None,
            thread_mm: with.networks[own].tendons.iter().map(|tendon| tendon.cable_mm(&with.mesh.nodes)).sum(),
            holes: with.networks[own].tendons.iter().map(Tendon::holes).sum(),
            turn_degrees: turns.fold(0.0, f64::max),
            turning_degrees: cables.iter().map(|cable| sewing::turning(cable)).fold(0.0, f64::max),
            force_n,
            spool_n,
            breaches,
            preview: preview?,
            paper: origin,
        })
    }

    /// What is left of the pose at hand when a hand sews a network; `None` for a large body, and when cancelled.
    pub fn sewn(&self, network: &Network, cancel: &AtomicBool) -> Option<Sewn> {
        if self.design.mesh.triangles.len() * 3 / 2 > SEWN_UP_TO {
            return None;
        }
        let mut with = self.design.clone();
        with.networks.push(network.clone());
        robust::sewn(&with, &[self.poses[self.current].1], self.friction, cancel).first().copied()
    }
}
