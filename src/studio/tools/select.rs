//! Picks out parts and tracks of a drawing, moves them and their points.

use super::parts::{self, LEAST, REACH};
use super::tool::{Entry, Tool};
use crate::outline::drawing::Item;
use crate::outline::{Drawing, Point, polygon};
use crate::studio::action::Sketch;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Hit, closed, track};
use crate::studio::change::Change;
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::language::{mark, t};
use crate::studio::session::Session;
use crate::studio::style;
use eframe::egui::{CursorIcon, Key, Painter, Pos2, Stroke};

pub static ENTRY: Entry = Entry {
    id: "tool.select",
    label: "Select",
    tip: "Pick parts out, move them and their points",
    icon: None,
    keys: &[Keys::plain(Key::V)],
    canvas: Scope::Outline,
    hint: "click a part or a track to change it",
    make: || Box::new(Select::default()),
};

#[derive(Default)]
struct Select {
    held: Held,
}

#[derive(Default)]
enum Held {
    #[default]
    Nothing,
    /// A part or a track, or one of its handles; the drawing and the pointer as they were when the hand took hold. `what` is done so
    /// far in this step of undo.
    Item { drawing: Drawing, item: Item, handle: Option<usize>, from: Point, what: &'static str },
    /// The sheet: this point stays under the pointer.
    Sheet(Point),
}

/// What lies under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Under {
    /// A handle of what is picked out.
    Handle(usize),
    /// The middle of a segment of it.
    Middle(usize),
    Item(Item),
    Nothing,
}

fn under(canvas: &Canvas<'_>, p: Point) -> Under {
    let reach = REACH * canvas.mm_per_pixel();
    let drawing = canvas.session.drawing();
    let nearest = |points: Vec<Point>| {
        let near = points.into_iter().map(|q| polygon::length(p, q)).enumerate().filter(|(_, d)| *d <= reach);
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    };
    if let Some(picked) = canvas.picked() {
        if let Some(handle) = nearest(drawing.handles(picked)) {
            return Under::Handle(handle);
        }
        if let Some(middle) = nearest(drawing.middles(picked)) {
            return Under::Middle(middle);
        }
    }
    drawing.under(p, reach).map_or(Under::Nothing, Under::Item)
}

fn pick(item: Option<Item>, point: Option<usize>) -> Action {
    Action::Sketch(Sketch::Select(item, point))
}

impl Tool for Select {
    fn press(&mut self, canvas: &Canvas<'_>, at: Point, actions: &mut Actions) {
        let drawing = || canvas.session.drawing().clone();
        let held = |drawing, item, handle, what| Held::Item { drawing, item, handle, from: at, what };
        self.held = match (under(canvas, at), canvas.session.sketching().item) {
            (Under::Handle(handle), Some(item)) => {
                actions.push(pick(Some(item), Some(handle)));
                held(drawing(), item, Some(handle), mark("Move point"))
            }
            (Under::Middle(after), Some(item)) => {
                let (what, drawing) = (mark("Add point"), drawing().with_point(item, after, at));
                actions.push(Action::Live(Change::Draw { what, drawing: drawing.clone() }));
                actions.push(pick(Some(item), Some(after + 1)));
                // Where it is then moved to is the same step.
                held(drawing, item, Some(after + 1), what)
            }
            (Under::Item(item), _) => {
                actions.push(pick(Some(item), None));
                let what = if matches!(item, Item::Part(_)) { mark("Move part") } else { mark("Move track") };
                held(drawing(), item, None, what)
            }
            _ => Held::Sheet(at),
        };
    }

    fn drag(&mut self, canvas: &Canvas<'_>, way: &[Point], actions: &mut Actions) {
        let Some(&at) = way.last() else { return };
        match &self.held {
            Held::Nothing => {}
            Held::Sheet(held) => actions.push(canvas.pan(*held, at)),
            Held::Item { drawing, item, handle, from, what } => {
                let drawing = match *handle {
                    Some(handle) => drawing.with_pulled(*item, handle, at, LEAST * canvas.mm_per_pixel()),
                    None => drawing.with_moved(*item, [at[0] - from[0], at[1] - from[1]]),
                };
                actions.push(Action::Live(Change::Draw { what, drawing }));
            }
        }
    }

    fn release(&mut self, _canvas: &Canvas<'_>, _at: Option<Point>, _actions: &mut Actions) {
        self.held = Held::Nothing;
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, twice: bool, actions: &mut Actions) {
        let sketching = canvas.session.sketching();
        actions.push(match under(canvas, at) {
            Under::Handle(handle) => pick(sketching.item, Some(handle)),
            Under::Middle(_) => pick(sketching.item, None),
            Under::Item(item) => pick(Some(item), None),
            Under::Nothing => pick(None, None),
        });
        if twice && sketching.point.is_none() {
            actions.push(Action::Sketch(Sketch::Camera(None)));
        }
    }

    fn key(&mut self, _session: &Session, key: Key, _actions: &mut Actions) -> bool {
        if key == Key::Escape {
            self.held = Held::Nothing;
        }
        false
    }

    fn hint(&self, session: &Session) -> Option<&'static str> {
        let picked = session.sketching().item.is_some();
        picked.then_some(t("drag the points; drag a small dot to put one in; Delete removes"))
    }

    fn cursor(&self, _canvas: &Canvas<'_>, _under: Hit) -> CursorIcon {
        if matches!(self.held, Held::Nothing) { CursorIcon::Default } else { CursorIcon::Grabbing }
    }

    /// What a click would pick out.
    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, pointer: Option<Pos2>) {
        let Some(pointer) = pointer.filter(|_| matches!(self.held, Held::Nothing)) else { return };
        match under(canvas, canvas.to_body(pointer)) {
            Under::Item(Item::Part(k)) => {
                let accent = style::accent(canvas.session.look().theme);
                let points = canvas.session.drawing().parts[k].primitive.polygon();
                closed(painter, canvas, &points, Stroke::new(1.6, accent));
            }
            Under::Item(Item::Track(k)) => track(painter, canvas, k, parts::thread(canvas), 3.0),
            _ => {}
        }
    }
}
