//! Pulls at cables and winches: what is pulled is wound, and the body follows.

use super::tool::{Entry, Tool};
use crate::operations::network::Part;
use crate::outline::Point;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Hit};
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::language::mark;
use crate::studio::session::{Mode, Selection, Session};
use eframe::egui::{CursorIcon, Key};

pub static ENTRY: Entry = Entry {
    id: PULL,
    label: "Pull tool",
    tip: "Pull at a cable towards its winch, or at a winch away from its cables, and feel what that takes",
    icon: Some(Icon::Pull),
    keys: &[Keys::plain(Key::E)],
    canvas: Scope::Views,
    hint: "Pull at a cable towards its winch to wind it, back to let it out; or at a winch, away from its cables. K keys what you see",
    make: || Box::new(Pull::default()),
};

/// Its id: the views show loads while it is taken.
pub const PULL: &str = "tool.pull";

#[derive(Default)]
struct Pull {
    held: Held,
}

#[derive(Clone, Copy, Debug, Default)]
enum Held {
    #[default]
    Nothing,
    /// A cable: its winch, what was wound when the hand took hold, where that was, and the way that winds.
    Cable { winch: usize, wound_mm: f64, press: Point, way: Point },
    /// The picture: this point stays under the pointer.
    Picture { at: Point },
}

/// The direction in which a pull winds: along a piece of cable towards its winch, at a winch away from the mean of its cables.
fn way(canvas: &Canvas<'_>, part: Part) -> Option<Point> {
    // What is switched off winds nothing.
    let network = canvas.session.acting().networks.get(part.winch()).filter(|network| !network.muted)?;
    let unit = |from: Point, to: Point| {
        let (x, y) = (to[0] - from[0], to[1] - from[1]);
        let length = x.hypot(y);
        (length > 0.0).then(|| [x / length, y / length])
    };
    let piece = |tendon: usize, piece: usize| {
        let routing = &network.tendons.get(tendon)?.routing;
        unit(canvas.shown(routing.get(piece + 1)?)?, canvas.shown(routing.get(piece)?)?)
    };
    match part {
        Part::Piece(_, tendon, number) => piece(tendon, number),
        Part::Hole(_, tendon, hole) => piece(tendon, hole.saturating_sub(1)),
        Part::Winch(_) | Part::Tendon(..) => {
            let ways = (0..network.tendons.len()).filter_map(|tendon| piece(tendon, 0));
            let sum = ways.fold([0.0; 2], |sum, way| [sum[0] + way[0], sum[1] + way[1]]);
            // Cables all around: up, as one pulls at a puppet.
            unit([0.0; 2], sum).or(Some([0.0, 1.0]))
        }
    }
}

impl Tool for Pull {
    fn press(&mut self, canvas: &Canvas<'_>, press: Point, actions: &mut Actions) {
        let Some(part) = canvas.strung(press) else {
            self.held = Held::Picture { at: press };
            return;
        };
        let Some(way) = way(canvas, part) else { return };
        let session = canvas.session;
        let shown = || session.shapes().realizable.as_ref().or(session.shapes().idealized.as_ref());
        let wound = match session.mode() {
            Mode::Winding => session.winding().wound_mm().get(part.winch()).copied(),
            _ => shown().and_then(|shape| shape.activations_mm.get(part.winch()).copied()),
        };
        actions.push(Action::Select(Selection::Part(Part::Winch(part.winch()))));
        self.held = Held::Cable { winch: part.winch(), wound_mm: wound.unwrap_or(0.0), press, way };
    }

    fn drag(&mut self, canvas: &Canvas<'_>, moved: &[Point], actions: &mut Actions) {
        let Some(&at) = moved.last() else { return };
        match self.held {
            Held::Nothing => {}
            Held::Picture { at: held } => actions.push(canvas.pan(held, at)),
            Held::Cable { winch, wound_mm, press, way } => {
                let pulled = (at[0] - press[0]) * way[0] + (at[1] - press[1]) * way[1];
                actions.push(Action::Wind(winch, wound_mm + pulled));
            }
        }
    }

    fn release(&mut self, _canvas: &Canvas<'_>, _at: Option<Point>, _actions: &mut Actions) {
        self.held = Held::Nothing;
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, _twice: bool, actions: &mut Actions) {
        let part = canvas.strung(at).map(|part| Part::Winch(part.winch()));
        actions.push(Action::Select(part.map_or(Selection::Nothing, Selection::Part)));
    }

    fn key(&mut self, _session: &Session, key: Key, _actions: &mut Actions) -> bool {
        if key == Key::Escape {
            self.held = Held::Nothing;
        }
        false
    }

    fn under(&self, canvas: &Canvas<'_>, at: Point) -> Hit {
        canvas.strung(at).map_or(Hit::Nothing, Hit::Part)
    }

    fn foretells(&self, under: Hit) -> Option<&'static str> {
        match under {
            Hit::Part(Part::Winch(_)) => Some(mark("Drag away from its cables winds this winch, a click selects it")),
            Hit::Part(_) => {
                Some(mark("Drag towards the winch winds this cable, back lets it out; a click selects its winch"))
            }
            _ => None,
        }
    }

    fn cursor(&self, _canvas: &Canvas<'_>, under: Hit) -> CursorIcon {
        match (self.held, under) {
            (Held::Cable { .. }, _) => CursorIcon::Grabbing,
            (_, Hit::Part(_)) => CursorIcon::Grab,
            _ => CursorIcon::Default,
        }
    }
}
