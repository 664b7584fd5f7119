//! Rules of sewing that a design breaks, as remarks on its blueprint.

use super::remark::Remark;
use crate::design::Design;
use crate::motion::winch_labels;
use crate::outline::{Point, polygon};
use crate::sewing::{self, Breach, Place, Spot};

/// Breaches told one by one among the remarks on a blueprint; the others are counted.
const TOLD: usize = 5;

/// Remarks for the maker of a blueprint on the rules that it breaks, the most severe breaches first.
pub(super) fn remarks(design: &Design) -> Vec<Remark> {
    let breaches = design.breaches();
    let names = winch_labels(design);
    let sorted = sewing::most_severe(&breaches, breaches.len());
    let (told, counted) = sorted.split_at(TOLD.min(sorted.len()));
    let sentence =
        |breach: &Breach| Remark::at(places(design, breach), format!("Hard to sew: {}.", breach.words(&names))).grave();
    let mut remarks: Vec<Remark> = told.iter().map(sentence).collect();
    let others = counted.iter().flat_map(|breach| places(design, breach));
    match counted.len() {
        0 => {}
        1 => remarks.push(Remark::at(others, "Hard to sew: one more place breaks a rule.").grave()),
        more => remarks.push(Remark::at(others, format!("Hard to sew: {more} more places break a rule.")).grave()),
    }
    remarks
}

/// Where a rule is broken, at rest, mm: at its holes, winches and ends of cables, and in the middle of its pieces.
fn places(design: &Design, breach: &Breach) -> Vec<Point> {
    let nodes = &design.mesh.nodes;
    let hole = |at: Place, hole: usize| {
        let tendon = design.networks.get(at.winch)?.tendons.get(at.cable)?;
        Some(tendon.routing.get(hole)?.place(nodes))
    };
    let place = |spot: Spot| match spot {
        Spot::Winch(winch) => hole(Place { winch, cable: 0 }, 0),
        Spot::Hole(at, number) => hole(at, number),
        Spot::Cable(at) => hole(at, design.networks.get(at.winch)?.tendons.get(at.cable)?.routing.len() - 1),
        Spot::Piece(at, piece) => Some(polygon::lerp(hole(at, piece)?, hole(at, piece + 1)?, 0.5)),
    };
    breach.spots().into_iter().flatten().filter_map(place).collect()
}
