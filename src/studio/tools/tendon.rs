//! Winches and tendons by hand: drags holes, ends and winches over the body, puts holes in, draws tendons. A drag is one undo step.

use super::tool::{Entry, Tool};
use crate::operations::network::{Edit, Part};
use crate::outline::{Point, polygon};
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Hit, hit};
use crate::studio::change::Change;
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::language::mark;
use crate::studio::session::{Selection, Session};
use crate::studio::style;
use eframe::egui::{CursorIcon, Key, Painter, Pos2, Stroke};

pub static ENTRY: Entry = Entry {
    id: TENDON,
    label: "Tendon tool",
    tip: "Move holes, ends and winches by hand, add holes, draw tendons",
    icon: Some(Icon::Tendon),
    keys: &[Keys::plain(Key::W)],
    canvas: Scope::Views,
    hint: "Drag holes and winches; drag a cable for one more hole; drag the body for a tendon of the selected winch, or else a new winch",
    make: || Box::new(Stringing::default()),
};

/// Its id: the views show handles and broken rules while it is taken.
pub const TENDON: &str = "tool.tendon";

/// Shortest tendon that a drag over the body makes, logical pixels: less is a slip of the hand.
const LEAST: f64 = 14.0;

#[derive(Default)]
struct Stringing {
    held: Held,
}

#[derive(Clone, Copy, Debug, Default)]
enum Held {
    #[default]
    Nothing,
    /// A winch or a hole; from the pointer to it, and where the pointer was last.
    Part { part: Part, offset: Point, last: Point },
    /// The body, where a tendon may begin: shown, and at rest.
    Body { press: Point, rest: Point },
    /// The picture: this point stays under the pointer.
    Picture { at: Point },
}

impl Stringing {
    fn take(canvas: &Canvas<'_>, press: Point, actions: &mut Actions) -> Held {
        let Some((rest, miss)) = canvas.at_rest(press) else { return Held::Nothing };
        let part = match canvas.strung(press) {
            Some(Part::Piece(winch, tendon, piece)) => {
                let edit = Edit::AddHole { winch, tendon, piece, at: rest };
                actions.push(Action::Live(Change::Network(edit)));
                return Held::Part { part: Part::Hole(winch, tendon, piece + 1), offset: [0.0; 2], last: press };
            }
            Some(part) => part,
            None if miss <= f64::from(hit::EDGE_REACH) * canvas.mm_per_pixel() => return Held::Body { press, rest },
            None => return Held::Picture { at: press },
        };
        actions.push(Action::Select(Selection::Part(part)));
        let place = canvas.shown_part(part).unwrap_or(press);
        Held::Part { part, offset: [place[0] - press[0], place[1] - press[1]], last: press }
    }

    /// A tendon that begins where the hand took hold of the body, or at the winch that is selected.
    fn begin(canvas: &Canvas<'_>, rest: Point, at: Point, actions: &mut Actions) -> Held {
        let Some((end, _)) = canvas.at_rest(at) else { return Held::Nothing };
        let networks = &canvas.session.design().networks;
        let selected = canvas.session.selection().network();
        let (edit, part) = match selected.and_then(|winch| Some((winch, networks.get(winch)?))) {
            Some((winch, network)) => {
                let part = Part::Hole(winch, network.tendons.len(), 1);
                (Edit::AddTendon { winch, through: vec![end] }, part)
            }
            None => (Edit::New { through: vec![rest, end] }, Part::Hole(networks.len(), 0, 1)),
        };
        actions.push(Action::Live(Change::Network(edit)));
        Held::Part { part, offset: [0.0; 2], last: at }
    }
}

impl Tool for Stringing {
    fn press(&mut self, canvas: &Canvas<'_>, at: Point, actions: &mut Actions) {
        self.held = Self::take(canvas, at, actions);
    }

    fn drag(&mut self, canvas: &Canvas<'_>, way: &[Point], actions: &mut Actions) {
        let Some(&at) = way.last() else { return };
        self.held = match self.held {
            Held::Nothing => return,
            Held::Picture { at: held } => return actions.push(canvas.pan(held, at)),
            Held::Body { press, rest } => {
                if polygon::length(press, at) < LEAST * canvas.mm_per_pixel() {
                    return;
                }
                Self::begin(canvas, rest, at, actions)
            }
            // The body moves on below a hand that rests: what it holds stays.
            Held::Part { last, .. } if last == at => return,
            Held::Part { part, offset, .. } => {
                if let Some((to, _)) = canvas.at_rest([at[0] + offset[0], at[1] + offset[1]]) {
                    actions.push(Action::MovePart(part, to));
                }
                Held::Part { part, offset, last: at }
            }
        };
    }

    fn release(&mut self, _canvas: &Canvas<'_>, _at: Option<Point>, _actions: &mut Actions) {
        self.held = Held::Nothing;
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, _twice: bool, actions: &mut Actions) {
        actions.push(Action::Select(match canvas.strung(at) {
            Some(Part::Piece(winch, tendon, _)) => Selection::Part(Part::Tendon(winch, tendon)),
            Some(part) => Selection::Part(part),
            None => Selection::Nothing,
        }));
    }

    fn key(&mut self, _session: &Session, key: Key, _actions: &mut Actions) -> bool {
        if key == Key::Escape {
            self.held = Held::Nothing;
        }
        false
    }

    fn under(&self, canvas: &Canvas<'_>, at: Point) -> Hit {
        match canvas.strung(at) {
            Some(part) => Hit::Part(part),
            None => canvas.at_rest(at).map_or(Hit::Nothing, |_| match canvas.hit(at) {
                body @ Hit::Body(_) => body,
                _ => Hit::Nothing,
            }),
        }
    }

    fn foretells(&self, under: Hit) -> Option<&'static str> {
        Some(match under {
            Hit::Part(Part::Winch(_)) => mark("Drag moves this winch, a click selects it. Right-click has more"),
            Hit::Part(Part::Hole(..)) => {
                mark("Drag moves this hole; click selects it, then Delete removes it. Right-click has more")
            }
            Hit::Part(_) => mark("Drag puts one more hole into this cable, a click selects it. Right-click has more"),
            _ => return None,
        })
    }

    fn cursor(&self, _canvas: &Canvas<'_>, under: Hit) -> CursorIcon {
        match (self.held, under) {
            (Held::Part { .. }, _) => CursorIcon::Grabbing,
            (_, Hit::Part(Part::Piece(..))) => CursorIcon::Copy,
            (_, Hit::Part(_)) => CursorIcon::Grab,
            (_, Hit::Body(_)) => CursorIcon::Crosshair,
            _ => CursorIcon::Default,
        }
    }

    /// Where a press on a cable would put a hole.
    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, pointer: Option<Pos2>) {
        let Some(pointer) = pointer.filter(|_| matches!(self.held, Held::Nothing)) else { return };
        if let Some(Part::Piece(..)) = canvas.strung(canvas.to_body(pointer)) {
            let accent = style::accent(canvas.session.look().theme);
            painter.circle(pointer, 3.5, style::on_accent(canvas.session.look().theme), Stroke::new(1.6, accent));
        }
    }
}
