//! A hold on the body, a target, or the picture itself, and the tools that have one.

use super::tool::Tool;
use crate::design::Target;
use crate::operations::network::Part;
use crate::outline::Point;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Ground, Hit};
use crate::studio::change::Change;
use crate::studio::session::{Selection, Session};
use eframe::egui::{CursorIcon, Key};

/// The thing that the hand holds in a view.
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

/// The winch, the hole or the tendon under a point, or the body.
fn strung(canvas: &Canvas<'_>, at: Point) -> Hit {
    match canvas.strung(at) {
        Some(Part::Piece(winch, tendon, _)) => Hit::Part(Part::Tendon(winch, tendon)),
        Some(part) => Hit::Part(part),
        None => canvas.hit(at),
    }
}

/// A tool whose drags pull at a [`Grip`].
pub struct Gripping {
    grip: Grip,
    /// Whether any point of the body can be held.
    body: bool,
    /// Over the body.
    cursor: CursorIcon,
    /// What a click on that does.
    click: fn(Hit) -> Action,
}

impl Gripping {
    pub fn new(body: bool, cursor: CursorIcon, click: fn(Hit) -> Action) -> Self {
        Self { grip: Grip::Nothing, body, cursor, click }
    }
}

impl Tool for Gripping {
    fn press(&mut self, canvas: &Canvas<'_>, at: Point, actions: &mut Actions) {
        self.grip = Grip::take(canvas, at, self.body, actions);
    }

    fn drag(&mut self, canvas: &Canvas<'_>, way: &[Point], actions: &mut Actions) {
        if let Some(&at) = way.last() {
            self.grip.pull(canvas, at, actions);
        }
    }

    fn release(&mut self, _canvas: &Canvas<'_>, _at: Option<Point>, _actions: &mut Actions) {
        self.grip = Grip::Nothing;
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, _twice: bool, actions: &mut Actions) {
        let hit = match canvas.hit(at) {
            // A cable can be picked out, though what is dragged is the body.
            Hit::Body(_) if self.body => strung(canvas, at),
            hit => hit,
        };
        actions.push((self.click)(hit));
    }

    fn key(&mut self, _session: &Session, key: Key, _actions: &mut Actions) -> bool {
        if key == Key::Escape {
            self.grip = Grip::Nothing;
        }
        false
    }

    fn cursor(&self, _canvas: &Canvas<'_>, under: Hit) -> CursorIcon {
        match (self.grip, under) {
            (Grip::Target { .. }, _) => CursorIcon::Grabbing,
            (_, Hit::Body(_)) => self.cursor,
            (_, Hit::Nothing) => CursorIcon::Default,
            _ => CursorIcon::Grab,
        }
    }
}
