//! What a tool is.

use crate::outline::drawing::Item;
use crate::outline::{Drawing, Point};
use crate::studio::action::Sketch;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Hit};
use crate::studio::change::Change;
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::session::Session;
use eframe::egui::{CursorIcon, Key, Painter, Pos2};

/// A tool in the table: what its command says, and how it is made.
pub struct Entry {
    /// Never changes and stands for it alone: `tool.drag`.
    pub id: &'static str,
    pub label: &'static str,
    /// A sentence about it without its keys, which are added.
    pub tip: &'static str,
    /// Of tools on the views, which stand in the toolbar.
    pub icon: Option<Icon>,
    pub keys: &'static [Keys],
    /// The canvas that it works on: the views, or the sheet of the outline.
    pub canvas: Scope,
    /// Its use, in a few words.
    pub hint: &'static str,
    pub make: fn() -> Box<dyn Tool>,
}

/// A way of working on a canvas by hand. A tool reads the session and asks for actions; a gesture is its own. Points are in mm.
pub trait Tool {
    /// The hand takes hold, to move on without letting go.
    fn press(&mut self, _canvas: &Canvas<'_>, _at: Point, _actions: &mut Actions) {}

    /// It moves on; `way` ends where it is now.
    fn drag(&mut self, _canvas: &Canvas<'_>, _way: &[Point], _actions: &mut Actions) {}

    /// It lets go, on the canvas or elsewhere.
    fn release(&mut self, _canvas: &Canvas<'_>, _at: Option<Point>, _actions: &mut Actions) {}

    /// A press without a move; `twice` for the second one of two.
    fn click(&mut self, _canvas: &Canvas<'_>, _at: Point, _twice: bool, _actions: &mut Actions) {}

    /// Whether a key was meant for it, before any command gets it.
    fn key(&mut self, _session: &Session, _key: Key, _actions: &mut Actions) -> bool {
        false
    }

    /// What would be in the drawing if the hand let go now.
    fn pending(&self, _session: &Session, _mm_per_pixel: f64) -> Option<Drawn> {
        None
    }

    /// Whether something has begun that goes on with the next click.
    fn waits(&self) -> bool {
        false
    }

    /// Whether something is being drawn that is not in the drawing yet.
    fn is_drawing(&self) -> bool {
        self.waits()
    }

    /// What can be done next, where that is not the hint of its entry.
    fn hint(&self, _session: &Session) -> Option<&'static str> {
        None
    }

    /// The part of a plushie under a point that it would act on.
    fn under(&self, canvas: &Canvas<'_>, at: Point) -> Hit {
        canvas.hit(at)
    }

    /// What a press would do to what lies under the pointer, where the hint of its entry does not say it as well; in English.
    fn foretells(&self, _under: Hit) -> Option<&'static str> {
        None
    }

    /// `under`: what of a plushie lies under the pointer.
    fn cursor(&self, canvas: &Canvas<'_>, under: Hit) -> CursorIcon;

    /// Draws what it is at, over everything else.
    fn paint(&self, _canvas: &Canvas<'_>, _painter: &Painter, _pointer: Option<Pos2>) {}
}

/// Another drawing of the outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The label of the step, for undo.
    pub what: &'static str,
    pub drawing: Drawing,
    /// The item that is new in it.
    pub new: Item,
}

impl Drawn {
    /// One step of undo, with what is new picked out.
    pub fn actions(self) -> [Action; 2] {
        let Self { what, drawing, new } = self;
        [Action::Change(Change::Draw { what, drawing }), Action::Sketch(Sketch::Select(Some(new), None))]
    }
}
