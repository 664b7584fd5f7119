//! A network that might be accepted, and what it is compared with.

use super::trial::Reached;
use crate::design::{Design, MaterialPoint, Network, Target, Tendon};
use crate::discovery::{Parameters, Stages};

/// A network that is tried out, and where it came from.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Mesh nodes of each tendon, from the winch outward.
    pub tendons: Vec<Vec<usize>>,
    pub parameters: Parameters,
    pub stages: Stages,
}

/// A pose that a network should serve, and what the rig reaches without it.
pub struct Baseline<'a> {
    pub targets: &'a [Target],
    pub before: &'a Reached,
}

/// The design with one more network, under a name that is not in use.
pub fn with_network(design: &Design, tendons: &[Vec<usize>]) -> Design {
    let mut with = design.clone();
    let tendons = tendons.iter().map(|routing| Tendon {
        routing: MaterialPoint::through(routing.iter().copied()),
        ratio: 1.0,
        slack_mm: 0.0,
    });
    with.networks.push(Network::new(unused_name(design), tendons.collect()));
    with
}

/// A name for one more network.
pub(super) fn unused_name(design: &Design) -> String {
    let mut k = design.networks.len() + 1;
    loop {
        let name = format!("winch {k}");
        if design.networks.iter().all(|n| n.name != name) {
            return name;
        }
        k += 1;
    }
}
