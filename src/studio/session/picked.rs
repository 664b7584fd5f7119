//! What is picked out of the document, and what of it the views show.

use crate::design::Design;
use crate::operations::network::Part;

/// The part that is picked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selection {
    Nothing,
    /// Of the current pose.
    Target(usize),
    Pin(usize),
    Keyframe(usize),
    /// A winch, a tendon or a hole.
    Part(Part),
}

/// What the views show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    Pose,
    Animation,
    /// The winches as a hand has wound them.
    Winding,
}

/// The pose, what is selected in it, and whether the views show it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Picked {
    /// `None` is the rest shape.
    pub pose: Option<usize>,
    pub selection: Selection,
    pub mode: Mode,
}

impl Selection {
    /// The network that it is, or belongs to.
    pub fn network(self) -> Option<usize> {
        match self {
            Self::Part(part) => Some(part.winch()),
            _ => None,
        }
    }
}

impl Picked {
    /// The first pose of a document.
    pub fn first(design: &Design) -> Self {
        let pose = (!design.poses.is_empty()).then_some(0);
        Self { pose, selection: Selection::Nothing, mode: Mode::Pose }
    }

    /// After any change of the document: nothing may point beyond it.
    pub(crate) fn clamp(&mut self, design: &Design) {
        if self.pose.is_some_and(|pose| pose >= design.poses.len()) {
            self.pose = design.poses.len().checked_sub(1);
        }
        let targets = self.pose.and_then(|p| design.poses.get(p)).map_or(0, |p| p.targets.len());
        let gone = match self.selection {
            Selection::Nothing => false,
            Selection::Target(i) => i >= targets,
            Selection::Pin(i) => i >= design.pins.len(),
            Selection::Keyframe(i) => i >= design.keyframes.len(),
            Selection::Part(part) => !part.is_in(design),
        };
        if gone {
            self.selection = Selection::Nothing;
        }
    }
}
