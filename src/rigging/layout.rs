//! Where the winches and cables of a rig are at rest, apart from any mesh.

use crate::design::{MaterialPoint, Network, Tendon};
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::Point;
use crate::sewing;
use std::ops::{Deref, DerefMut};

/// Winches and their cables, mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    pub winches: Vec<Placed>,
}

/// A winch and its cables.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    pub at: Point,
    pub cables: Vec<Cable>,
}

/// A cable: its points after the winch, the end the last, and how it is wound.
#[derive(Clone, Debug, PartialEq)]
pub struct Cable {
    points: Vec<Point>,
    /// Radius of its groove as a part of the spool's.
    pub ratio: f64,
    /// At assembly, mm.
    pub slack_mm: f64,
}

impl From<Vec<Point>> for Cable {
    fn from(points: Vec<Point>) -> Self {
        Self { points, ratio: 1.0, slack_mm: 0.0 }
    }
}

impl Deref for Cable {
    type Target = Vec<Point>;

    fn deref(&self) -> &Self::Target {
        &self.points
    }
}

impl DerefMut for Cable {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.points
    }
}

/// A point of a layout: a winch, or a point of one of its cables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spot {
    pub winch: usize,
    pub cable: Option<(usize, usize)>,
}

impl Layout {
    /// Where networks are that somebody else made.
    pub fn of(networks: &[Network], mesh: &Mesh) -> Self {
        let cable = |tendon: &Tendon| Cable {
            points: tendon.places(&mesh.nodes).split_off(1),
            ratio: tendon.ratio,
            slack_mm: tendon.slack_mm,
        };
        let placed = |network: &Network| {
            let cables = network.tendons.iter().map(cable).collect();
            Some(Placed { at: network.winch()?.place(&mesh.nodes), cables })
        };
        Self { winches: networks.iter().filter_map(placed).collect() }
    }

    /// All points that can be moved: each winch, then the points of its cables.
    pub fn spots(&self) -> Vec<Spot> {
        let mut out = Vec::new();
        for (winch, placed) in self.winches.iter().enumerate() {
            out.push(Spot { winch, cable: None });
            for (cable, points) in placed.cables.iter().enumerate() {
                out.extend((0..points.len()).map(|k| Spot { winch, cable: Some((cable, k)) }));
            }
        }
        out
    }

    pub fn point(&self, spot: Spot) -> Point {
        let winch = &self.winches[spot.winch];
        spot.cable.map_or(winch.at, |(cable, k)| winch.cables[cable][k])
    }

    pub fn point_mut(&mut self, spot: Spot) -> &mut Point {
        let winch = &mut self.winches[spot.winch];
        match spot.cable {
            None => &mut winch.at,
            Some((cable, k)) => &mut winch.cables[cable][k],
        }
    }

    /// The points of the body at all spots; `None` where one is outside of it.
    pub fn located(&self, mesh: &Mesh) -> Option<Vec<BodyPoint>> {
        self.spots().into_iter().map(|spot| mesh.locate(self.point(spot), &mesh.nodes)).collect()
    }

    /// The networks, from the points of the body at all spots; unnamed.
    pub fn networks(&self, mesh: &Mesh, points: &[BodyPoint]) -> Vec<Network> {
        let mut points = points.iter().map(|at| MaterialPoint::of_triangle(mesh.triangles[at.triangle], at.weights));
        let winches = self.winches.iter().map(|placed| {
            let winch = points.next();
            let tendons = placed.cables.iter().map(|cable| {
                let routing = winch.iter().cloned().chain(points.by_ref().take(cable.len())).collect();
                Tendon { routing, ratio: cable.ratio, slack_mm: cable.slack_mm }
            });
            Network::new("", tendons.collect())
        });
        winches.collect()
    }

    /// As the rules of sewing see it.
    pub fn rigs(&self) -> Vec<sewing::Rig> {
        let whole = |placed: &Placed, cable: &Cable| [&[placed.at], &cable[..]].concat();
        let rig = |placed: &Placed| sewing::Rig {
            winch: placed.at,
            cables: placed.cables.iter().map(|cable| whole(placed, cable)).collect(),
        };
        self.winches.iter().map(rig).collect()
    }

    /// Holes between winches and ends.
    pub fn holes(&self) -> usize {
        self.winches.iter().flat_map(|w| &w.cables).map(|cable| cable.len() - 1).sum()
    }
}

/// Networks that are there, as the rules of sewing see them.
pub fn rigs_of(networks: &[Network], nodes: &[Point]) -> Vec<sewing::Rig> {
    networks.iter().filter_map(|network| network.rig(nodes)).collect()
}
