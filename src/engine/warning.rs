//! What the user should know about a shape.

use super::compile::Plushie;
use super::measure::target_error;
use super::play::Play;
use crate::design::{Design, Target};
use crate::outline::Point;
use crate::physics::Cause;
use crate::soft_ik::Posture;

/// A triangle of less than this part of its area is pressed flat: stuffing does not go there.
const PRESSED_FLAT: f64 = 1e-2;

/// A triangle of less than this part of its area is pressed together as no felt is: it folds instead. The poses of the examples stay
/// above it everywhere.
const PRESSED: f64 = 1.0 / 3.0;
/// Part of the body's area at rest that may be pressed so before that is told: sharp inner corners are, and fold in felt too.
const PRESSED_AREA: f64 = 0.03;

/// A pose whose target error grows by more than this part of the error at rest where a cable is a millimetre off is a narrow one:
/// hardly a winch is set that well.
const NARROW: f64 = 0.05;

/// Ready to be shown as one line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    #[error("{}", free(*pinned, *at))]
    Free {
        /// Points of the piece that are held: none, or one about which it can turn.
        pinned: usize,
        /// A point of the piece at rest, mm, where the body is in several.
        at: Option<Point>,
    },
    #[error("A part of the body is pressed flat: pull less, pull elsewhere, or soften the cables.")]
    PressedFlat,
    #[error(
        "Crumpled: {:.0} % of the body is pressed to less than a third of its area, where felt would fold. Wind less, or pull \
         elsewhere.",
        100.0 * area
    )]
    Crumpled {
        /// Part of the body's area at rest.
        area: f64,
    },
    #[error(
        "A narrow pose: with a millimetre of cable too much or too little on {winch}, the target error grows from {:.1} % to \
         {:.1} % of the body length.",
        100.0 * before,
        100.0 * after
    )]
    Narrow {
        /// The winch on which it costs most.
        winch: String,
        /// Target errors, in body lengths.
        before: f64,
        after: f64,
    },
    #[error("Not in equilibrium: {0}.")]
    Unbalanced(Cause),
    #[error("{0}")]
    Solver(String),
}

fn free(pinned: usize, at: Option<Point>) -> String {
    let which = at.map_or("The body".to_owned(), |[x, y]| format!("The piece of the body at ({x:.0}, {y:.0}) mm"));
    match pinned {
        0 => format!("{which} is free to move: add pins until two points of it are held."),
        _ => format!("{which} is free to turn about its only pin: hold a second point of it."),
    }
}

impl Warning {
    /// About a plushie in this posture: what is not held comes first, since nothing else means much then.
    pub(super) fn of(plushie: &Plushie, posture: &Posture) -> Option<Self> {
        let model = &plushie.model;
        if let Some(loose) = model.loose().first() {
            let rest = [model.rest[2 * loose.node], model.rest[2 * loose.node + 1]];
            return Some(Self::Free { pinned: loose.pinned, at: (model.pieces() > 1).then_some(rest) });
        }
        if posture.unsettled == Some(Cause::Collapsed) || model.body.smallest_determinant(&posture.x) < PRESSED_FLAT {
            return Some(Self::PressedFlat);
        }
        let area = model.body.pressed_area(&posture.x, PRESSED) / model.body.area();
        if posture.unsettled.is_none() && area > PRESSED_AREA {
            return Some(Self::Crumpled { area });
        }
        posture.unsettled.map(Self::Unbalanced)
    }

    /// About a pose that is only reached where cables have exactly the right length; `before`: its target error.
    pub(super) fn of_play(design: &Design, targets: &[Target], before: f64, play: Option<&Play>) -> Option<Self> {
        let Play { winch, error } = *play?;
        let rest = target_error(design, targets, &design.mesh.nodes);
        let narrow = error - before > NARROW * rest;
        let winch = design.networks.get(winch)?.name.clone();
        narrow.then_some(Self::Narrow { winch, before, after: error })
    }

    /// Whether a shape is in equilibrium as a model alone: felt would have folded.
    pub fn is_crumpled(&self) -> bool {
        matches!(self, Self::PressedFlat | Self::Crumpled { .. })
    }

    /// Whether it will go by itself once the solver has had its time.
    pub fn passes(&self) -> bool {
        matches!(self, Self::Unbalanced(_))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Request, Setpoint, Solver};
    use super::*;
    use crate::design::{Pin, testing};
    use crate::mesh::BodyPoint;
    use crate::soft_ik::Quality;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn what_holds_the_body_is_said_in_words() {
        let mut design = testing::sample();
        let mut held = design.pins.clone();
        held.push(Pin { at: BodyPoint { triangle: 0, weights: [0.0, 1.0, 0.0] }, ..held[0] });
        for (pins, expected) in [(0, Some("free to move")), (1, Some("free to turn")), (held.len(), None)] {
            design.pins = held[..pins].to_vec();
            let request = Request {
                id: 0,
                design: Arc::new(design.clone()),
                setpoint: Setpoint::Targets(Vec::new()),
                quality: Quality::Balanced,
                show_idealized: false,
                show_realizable: true,
            };
            let shape = Solver::default().solve(&request, &AtomicBool::new(false)).realizable.unwrap();
            let text = shape.warning.map(|warning| warning.to_string());
            match expected {
                Some(words) => assert!(text.as_ref().is_some_and(|t| t.contains(words)), "{pins} pins: {text:?}"),
                None => assert_eq!(text, None),
            }
        }
    }

    #[test]
    fn a_piece_among_several_is_named_by_its_place() {
        let text = Warning::Free { pinned: 0, at: Some([12.4, 90.6]) }.to_string();
        assert!(text.contains("at (12, 91) mm"), "{text}");
        assert!(Warning::Unbalanced(Cause::Stalled).passes() && !Warning::PressedFlat.passes());
    }
}
