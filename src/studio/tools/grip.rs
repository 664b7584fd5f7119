//! A hold on the body, a target, or the picture itself, and the tools that have one.

use super::snap;
use super::tool::Tool;
use crate::design::Target;
use crate::operations::network::Part;
use crate::outline::Point;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Ground, Hit};
use crate::studio::change::Change;
use crate::studio::session::{Selection, Session};
use eframe::egui::{CursorIcon, Key, Painter, Pos2};

/// The thing that the hand holds in a view.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Grip {
    #[default]
    Nothing,
    /// The target that is selected; from the pointer to its goal.
    Target { offset: Point },
    /// A pin: from the pointer to its anchor.
    Pin { index: usize, offset: Point },
    /// A pin that is put elsewhere on the body.
    Site { index: usize },
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
            Hit::Pin(index) => {
                actions.push(Action::Select(Selection::Pin(index)));
                let Some(pin) = session.design().pins.get(index) else { return Self::Nothing };
                // The hand that poses moves what holds the body; the hand that pins moves where it is held.
                let offset = from(pin.anchor(&session.design().mesh));
                return if body { Self::Pin { index, offset } } else { Self::Site { index } };
            }
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
            Self::Target { offset } => {
                let goal = [at[0] + offset[0], at[1] + offset[1]];
                actions.push(Action::DragTarget(snap::snapped(canvas, goal)));
            }
            Self::Pin { index, offset } => actions.push(Action::DragPin(index, [at[0] + offset[0], at[1] + offset[1]])),
            Self::Site { index } => {
                if let Some(at) = canvas.body(at) {
                    actions.push(Action::Live(Change::SitePin { index, at }));
                }
            }
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
    /// And the words for it.
    foretells: fn(Hit) -> Option<&'static str>,
}

impl Gripping {
    pub fn new(
        body: bool,
        cursor: CursorIcon,
        click: fn(Hit) -> Action,
        foretells: fn(Hit) -> Option<&'static str>,
    ) -> Self {
        Self { grip: Grip::Nothing, body, cursor, click, foretells }
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

    fn foretells(&self, under: Hit) -> Option<&'static str> {
        (self.foretells)(under)
    }

    fn cursor(&self, _canvas: &Canvas<'_>, under: Hit) -> CursorIcon {
        match (self.grip, under) {
            (Grip::Target { .. } | Grip::Pin { .. } | Grip::Site { .. }, _) => CursorIcon::Grabbing,
            (_, Hit::Body(_)) => self.cursor,
            (_, Hit::Nothing) => CursorIcon::Default,
            _ => CursorIcon::Grab,
        }
    }

    /// Lines that the goal in hand has fallen into.
    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, _pointer: Option<Pos2>) {
        if let Grip::Target { .. } = self.grip {
            snap::paint(canvas, painter);
        }
    }
}
