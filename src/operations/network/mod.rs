//! Winches and tendons changed by hand: holes moved, added, taken out; tendons added, given to another winch; winches made and split.
//!
//! Places are in mm at rest. They are kept to a micrometre, so that what a hand gives in a view and what is typed is the same.

mod routing;

use super::{Cancelled, Context};
use crate::design::edit::{self, EditError};
use crate::design::{Design, Network, Tendon};
use crate::outline::Point;
use routing::{beside, material_point, take_tendon, through, with_network};
use serde::{Deserialize, Serialize};

/// A part of the networks of a design. Winches, their tendons and the pieces of cable count from 0; holes from the winch, which is hole 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Part {
    Winch(usize),
    Tendon(usize, usize),
    /// A hole of a tendon, or its end: the last one.
    Hole(usize, usize, usize),
    /// The straight stretch of a tendon between two holes.
    Piece(usize, usize, usize),
}

/// A change of the networks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Edit {
    /// Moves a winch with all its tendons, a hole or an end.
    Move {
        part: Part,
        to: Point,
    },
    /// Passes a piece of a tendon through a hole more.
    AddHole {
        winch: usize,
        tendon: usize,
        piece: usize,
        at: Point,
    },
    /// Takes a part away: a hole; an end, where the hole before is the end then; a tendon; a winch with its tendons. A tendon without a
    /// second point goes, and so does a winch without a tendon.
    Remove(Part),
    /// Gives a winch one more tendon, through these places to its end.
    AddTendon {
        winch: usize,
        through: Vec<Point>,
    },
    /// Gives a tendon to another winch: it starts there.
    HandOver {
        winch: usize,
        tendon: usize,
        to: usize,
    },
    /// Gives tendons a winch of their own, wound as the old one is in every keyframe: at a place, or beside the old one.
    Split {
        winch: usize,
        tendons: Vec<usize>,
        at: Option<Point>,
    },
    /// A winch at the first of these places, with a tendon through the others.
    New {
        through: Vec<Point>,
    },
    Rename {
        winch: usize,
        name: String,
    },
    /// Gives the cables of a winch a colour (red, green, blue), or that of its number again.
    Color {
        winch: usize,
        color: Option<[u8; 3]>,
    },
    /// Switches a winch off, or on again: off, it is as if it were not there, but keeps its activations in keyframes.
    Mute {
        winch: usize,
        muted: bool,
    },
    /// Moves a winch to another place in the list; keyframes follow.
    Reorder {
        winch: usize,
        to: usize,
    },
}

/// Why a change was refused; the design is as it was then.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Part {
    /// The winch that it belongs to.
    pub fn winch(self) -> usize {
        match self {
            Self::Winch(winch) | Self::Tendon(winch, _) | Self::Hole(winch, ..) | Self::Piece(winch, ..) => winch,
        }
    }

    /// The tendon that it belongs to; none of a winch.
    pub fn tendon(self) -> Option<usize> {
        match self {
            Self::Winch(_) => None,
            Self::Tendon(_, tendon) | Self::Hole(_, tendon, _) | Self::Piece(_, tendon, _) => Some(tendon),
        }
    }

    /// Whether the design has it.
    pub fn is_in(self, design: &Design) -> bool {
        let tendon = |winch: usize, tendon: usize| design.networks.get(winch).and_then(|n| n.tendons.get(tendon));
        match self {
            Self::Winch(winch) => winch < design.networks.len(),
            Self::Tendon(w, t) => tendon(w, t).is_some(),
            Self::Hole(w, t, hole) => tendon(w, t).is_some_and(|t| hole < t.routing.len()),
            Self::Piece(w, t, piece) => tendon(w, t).is_some_and(|t| piece + 1 < t.routing.len()),
        }
    }

    /// Its place at rest, mm; none of a tendon, the middle of a piece.
    pub fn place(self, design: &Design) -> Option<Point> {
        let hole = |winch: usize, tendon: usize, hole: usize| {
            let point = design.networks.get(winch)?.tendons.get(tendon)?.routing.get(hole)?;
            Some(point.place(&design.mesh.nodes))
        };
        match self {
            Self::Winch(winch) => hole(winch, 0, 0),
            Self::Tendon(..) => None,
            Self::Hole(w, t, h) => hole(w, t, h),
            Self::Piece(w, t, p) => {
                let [a, b] = [hole(w, t, p)?, hole(w, t, p + 1)?];
                Some([0, 1].map(|axis| a[axis].midpoint(b[axis])))
            }
        }
    }
}

impl Edit {
    /// Its name in the undo history.
    pub fn label(&self) -> &'static str {
        match self {
            Self::Move { part: Part::Winch(_) | Part::Hole(_, _, 0), .. } => "Move winch",
            Self::Move { .. } => "Move hole",
            Self::AddHole { .. } => "Add hole",
            Self::Remove(Part::Winch(_) | Part::Hole(_, _, 0)) => "Delete network",
            Self::Remove(Part::Tendon(..) | Part::Piece(..)) => "Delete tendon",
            Self::Remove(Part::Hole(..)) => "Delete hole",
            Self::AddTendon { .. } => "Add tendon",
            Self::HandOver { .. } => "Hand tendon over",
            Self::Split { .. } => "Split winch",
            Self::New { .. } => "New winch",
            Self::Rename { .. } => "Rename network",
            Self::Color { .. } => "Colour network",
            Self::Mute { muted: true, .. } => "Switch network off",
            Self::Mute { muted: false, .. } => "Switch network on",
            Self::Reorder { .. } => "Reorder networks",
        }
    }
}

/// Makes a change, and returns what it made or moved; none where that is gone.
///
/// # Errors
/// A part that the design does not have, a place that is not on the body, or what makes the networks unsound.
pub fn run(design: &mut Design, edit: &Edit, context: &Context) -> Result<Option<Part>, Error> {
    context.check()?;
    Ok(apply(design, edit)?)
}

/// [`run`] where nobody could cancel.
///
/// # Errors
/// As [`run`].
pub fn apply(design: &mut Design, edit: &Edit) -> Result<Option<Part>, EditError> {
    match edit {
        Edit::Move { part, to } => move_part(design, *part, *to),
        &Edit::AddHole { winch, tendon, piece, at } => {
            let point = material_point(design, at)?;
            with_network(design, winch, |network| {
                let routing = &mut routing::tendon(network, tendon)?.routing;
                routing::check("piece", piece, routing.len() - 1)?;
                routing.insert(piece + 1, point);
                Ok(())
            })?;
            Ok(Some(Part::Hole(winch, tendon, piece + 1)))
        }
        Edit::Remove(part) => remove(design, *part),
        Edit::AddTendon { winch, through: places } => {
            let points = through(design, places)?;
            let tendon = with_network(design, *winch, |network| {
                let routing = network.winch().cloned().into_iter().chain(points).collect();
                network.tendons.push(Tendon { routing, ratio: 1.0, slack_mm: 0.0 });
                Ok(network.tendons.len() - 1)
            })?;
            Ok(Some(Part::Tendon(*winch, tendon)))
        }
        &Edit::HandOver { winch, tendon, to } => hand_over(design, winch, tendon, to),
        Edit::Split { winch, tendons, at } => split(design, *winch, tendons, *at),
        Edit::New { through: places } => {
            let routing = through(design, places)?;
            if routing.len() < 2 {
                return Err(EditError::NoEnd);
            }
            let tendons = vec![Tendon { routing, ratio: 1.0, slack_mm: 0.0 }];
            Ok(Some(Part::Winch(edit::accept_network(design, Network::new("", tendons))?)))
        }
        Edit::Rename { winch, name } => {
            edit::rename_network(design, *winch, name)?;
            Ok(Some(Part::Winch(*winch)))
        }
        &Edit::Color { winch, color } => {
            edit::color_network(design, winch, color)?;
            Ok(Some(Part::Winch(winch)))
        }
        &Edit::Mute { winch, muted } => {
            edit::mute_network(design, winch, muted)?;
            Ok(Some(Part::Winch(winch)))
        }
        &Edit::Reorder { winch, to } => {
            edit::move_network(design, winch, to)?;
            Ok(Some(Part::Winch(to)))
        }
    }
}

fn move_part(design: &mut Design, part: Part, to: Point) -> Result<Option<Part>, EditError> {
    let point = material_point(design, to)?;
    with_network(design, part.winch(), |network| match part {
        Part::Winch(_) | Part::Hole(_, _, 0) => {
            network.tendons.iter_mut().for_each(|tendon| tendon.routing[0] = point.clone());
            Ok(())
        }
        Part::Hole(_, tendon, hole) => {
            let routing = &mut routing::tendon(network, tendon)?.routing;
            routing::check("hole", hole, routing.len())?;
            routing[hole] = point;
            Ok(())
        }
        // Neither has a place of its own.
        Part::Tendon(_, tendon) | Part::Piece(_, tendon, _) => {
            routing::tendon(network, tendon)?;
            Ok(())
        }
    })?;
    Ok(Some(part))
}

fn remove(design: &mut Design, part: Part) -> Result<Option<Part>, EditError> {
    match part {
        Part::Winch(winch) | Part::Hole(winch, _, 0) => {
            edit::remove_network(design, winch)?;
            Ok(None)
        }
        Part::Tendon(winch, tendon) | Part::Piece(winch, tendon, _) => {
            let (_, left) = take_tendon(design, winch, tendon)?;
            Ok(left.then_some(Part::Winch(winch)))
        }
        Part::Hole(winch, tendon, hole) => {
            let last = with_network(design, winch, |network| {
                let routing = &mut routing::tendon(network, tendon)?.routing;
                routing::check("hole", hole, routing.len())?;
                let last = routing.len() == 2;
                if !last {
                    routing.remove(hole);
                }
                Ok(last)
            })?;
            if last { remove(design, Part::Tendon(winch, tendon)) } else { Ok(Some(Part::Tendon(winch, tendon))) }
        }
    }
}

fn hand_over(design: &mut Design, winch: usize, tendon: usize, to: usize) -> Result<Option<Part>, EditError> {
    routing::check("network", to, design.networks.len())?;
    if winch == to {
        return Ok(Some(Part::Tendon(winch, tendon)));
    }
    let mut changed = design.clone();
    let mut given = routing::tendon(routing::network(&mut changed, winch)?, tendon)?.clone();
    let tendon_there = with_network(&mut changed, to, |network| {
        if let Some(winch) = network.winch() {
            given.routing[0] = winch.clone();
        }
        network.tendons.push(given);
        Ok(network.tendons.len() - 1)
    })?;
    let (_, left) = take_tendon(&mut changed, winch, tendon)?;
    *design = changed;
    // The winch that is gone was one of those before.
    let to = if !left && winch < to { to - 1 } else { to };
    Ok(Some(Part::Tendon(to, tendon_there)))
}

fn split(design: &mut Design, winch: usize, tendons: &[usize], at: Option<Point>) -> Result<Option<Part>, EditError> {
    let mut changed = design.clone();
    let count = routing::network(&mut changed, winch)?.tendons.len();
    tendons.iter().try_for_each(|&tendon| routing::check("tendon", tendon, count))?;
    let is_taken = |tendon: &usize| tendons.contains(tendon);
    let taken: Vec<usize> = (0..count).filter(is_taken).collect();
    if taken.is_empty() || taken.len() == count {
        return Err(EditError::NotSome);
    }
    let mut own: Vec<Tendon> = taken.iter().map(|&tendon| changed.networks[winch].tendons[tendon].clone()).collect();
    let place = at.unwrap_or_else(|| beside(design, winch, &own));
    let point = material_point(design, place)?;
    own.iter_mut().for_each(|tendon| tendon.routing[0] = point.clone());
    with_network(&mut changed, winch, |network| {
        let mut tendon = 0..;
        network.tendons.retain(|_| tendon.next().is_none_or(|tendon| !taken.contains(&tendon)));
        Ok(())
    })?;
    let kept = changed.networks[winch].clone();
    let made = edit::accept_network(&mut changed, Network { tendons: own, ..kept })?;
    for keyframe in &mut changed.keyframes {
        keyframe.activations_mm[made] = keyframe.activations_mm[winch];
    }
    *design = changed;
    Ok(Some(Part::Winch(made)))
}

#[cfg(test)]
mod tests;
