//! A hold on the body, a target, or the picture itself.

use crate::design::Target;
use crate::outline::Point;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Ground, Hit};
use crate::studio::change::Change;
use crate::studio::session::Selection;

/// What the hand holds in a view.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Grip {
    #[default]
    Nothing,
    /// The target that is selected; from the pointer to its goal.
    Target { offset: Point },
    /// The picture: this point stays under the pointer.
    Picture { at: Point },
}

impl Grip {
    /// Takes hold of a target, or else of the picture. With `body`, any point of the body becomes a target.
    pub fn take(canvas: &Canvas<'_>, press: Point, body: bool, actions: &mut Actions) -> Self {
        let session = canvas.session;
        let from = |p: Point| [p[0] - press[0], p[1] - press[1]];
        let at = match canvas.hit(press) {
            Hit::Target(index) => {
                let Some(target) = session.targets().get(index) else { return Self::Nothing };
                actions.push(Action::Select(Selection::Target(index)));
                return Self::Target { offset: from(target.to) };
            }
            Hit::Body(at) if body => at,
            Hit::Pin(index) if body => match session.design().pins.get(index) {
                Some(pin) => pin.at,
                None => return Self::Nothing,
            },
            _ => return Self::Picture { at: press },
        };
        let Ground::Plushie(_, Some(shape)) = canvas.ground else { return Self::Nothing };
        let to = session.design().mesh.position(&at, &shape.nodes);
        let pose = session.pose();
        // The animation gives way to the pose.
        actions.push(Action::SelectPose(pose));
        actions.push(Action::Live(Change::AddTarget { pose, target: Target { at, to, weight: 1.0 } }));
        Self::Target { offset: from(to) }
    }

    /// Moves what is held with the pointer.
    pub fn pull(&self, canvas: &Canvas<'_>, at: Point, actions: &mut Actions) {
        match *self {
            Self::Nothing => {}
            Self::Target { offset } => actions.push(Action::DragTarget([at[0] + offset[0], at[1] + offset[1]])),
            Self::Picture { at: held } => actions.push(canvas.pan(held, at)),
        }
    }
}
