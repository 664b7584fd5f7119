//! The hand on the sheet: drawing parts, picking them out, pulling their handles.

use super::Sheet;
use crate::outline::drawing::{Item, Part, PathPoint, Primitive};
use crate::outline::{Drawing, Point, polygon};
use crate::studio::action::Action;
use crate::studio::change::Change;
use crate::studio::commands::document::ESCAPE;
use crate::studio::panels::Actions;
use crate::studio::session::Session;
use crate::studio::sketching::{Pencil, Sketch};
use crate::studio::viewport::hit::Hit;
use eframe::egui::{CursorIcon, Event, Key, Modifiers, PointerButton, Popup, Response, Ui};

/// How near the pointer must be to a handle, logical pixels.
const REACH: f64 = 9.0;
/// Least radius of what is drawn, logical pixels.
const LEAST: f64 = 3.0;
/// Radius of a circle or capsule that was clicked and not dragged, logical pixels.
const CLICKED: f64 = 30.0;
/// Distance between the points of a freehand line, and how far its path may stray from it, logical pixels.
const STEP: f64 = 2.0;
const STRAY: f64 = 2.0;

/// What the hand is at.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Hand {
    #[default]
    Nothing,
    /// Moves a part or a track, or one of its handles. The drawing and the pointer as they were when it took hold.
    /// `what` is done so far in this step of undo.
    Holds { drawing: Drawing, item: Item, handle: Option<usize>, from: Point, what: &'static str },
    /// A freehand line, mm.
    Line(Vec<Point>),
    /// The corners of a polygon so far, mm.
    Corners(Vec<Point>),
    /// The points of a track so far, mm.
    Track(Vec<Point>),
    /// A circle or a capsule, from where it was begun to where the pointer is, mm.
    Spans(Point, Point),
    /// Moves the sheet.
    Pans,
}

impl Hand {
    /// The primitive that would be there if the hand let go now.
    pub fn pending(&self, pencil: Pencil, mm_per_pixel: f64) -> Option<Primitive> {
        match (self, pencil) {
            (Self::Line(line), _) => Primitive::along(line, STRAY * mm_per_pixel),
            (Self::Corners(corners), _) if corners.len() >= 3 => {
                let corner = |&at: &Point| PathPoint { at, corner: true };
                Some(Primitive::Path { points: corners.iter().map(corner).collect() })
            }
            (Self::Spans(from, to), Pencil::Circle) => {
                let length = polygon::length(*from, *to);
                let clicked = length < LEAST * mm_per_pixel;
                Some(Primitive::Circle { center: *from, radius: if clicked { CLICKED * mm_per_pixel } else { length } })
            }
            (Self::Spans(from, to), _) => {
                Some(Primitive::Capsule { ends: [*from, *to], radii: [CLICKED * mm_per_pixel; 2] })
            }
            _ => None,
        }
    }
}

pub fn act(ui: &mut Ui, sheet: &Sheet<'_>, hand: &mut Hand, response: &Response, actions: &mut Actions) {
    let Sheet { session, rect, camera, .. } = *sheet;
    let to_sheet = |p| camera.to_body(rect, p);
    let pencil = session.sketching().pencil;
    let press = ui.input(|i| i.pointer.press_origin()).map(to_sheet);
    if let Some(press) = press.filter(|_| response.drag_started_by(PointerButton::Primary)) {
        *hand = begin(sheet, std::mem::take(hand), press, actions);
    }
    let pointer = response.interact_pointer_pos().map(to_sheet);
    if let Some(at) = pointer.filter(|_| response.dragged_by(PointerButton::Primary)) {
        if let Hand::Line(line) = hand {
            // Where frames are slow a hand draws more than a point in each.
            let way = ui.input(|i| {
                let moved = i.events.iter().filter_map(|event| match event {
                    Event::PointerMoved(p) => Some(to_sheet(*p)),
                    _ => None,
                });
                moved.collect::<Vec<Point>>()
            });
            way.into_iter().chain([at]).for_each(|p| draw(line, p, STEP * sheet.mm_per_pixel()));
        } else {
            drag(sheet, hand, at, response, actions);
        }
    }
    if response.drag_stopped_by(PointerButton::Primary) {
        match pointer {
            Some(at) if matches!(pencil, Pencil::Polygon | Pencil::Track) => click(sheet, hand, at, actions),
            _ => finish(sheet, hand, actions),
        }
    }
    if let Some(at) = pointer.filter(|_| response.clicked()) {
        response.request_focus();
        click(sheet, hand, at, actions);
    }
    if response.double_clicked() && pencil == Pencil::Select && sheet.session.sketching().point.is_none() {
        actions.push(Action::Sketch(Sketch::Camera(None)));
    }
    let key = |key| ui.input_mut(|i| i.consume_key(Modifiers::NONE, key));
    if !Popup::is_any_open(ui.ctx()) && key(Key::Escape) {
        // What is only being drawn is not in the document yet.
        if matches!(std::mem::take(hand), Hand::Holds { .. } | Hand::Nothing) {
            actions.push(Action::Run(&ESCAPE, Hit::Nothing));
        }
    }
    let ends = match hand {
        Hand::Corners(_) => key(Key::Enter) || response.double_clicked(),
        // The second click of a double click falls on the last point, which ends it.
        Hand::Track(_) => key(Key::Enter),
        _ => false,
    };
    if ends {
        finish(sheet, hand, actions);
    }
    if response.hovered() {
        ui.ctx().set_cursor_icon(match (pencil, &*hand) {
            (_, Hand::Pans | Hand::Holds { .. }) => CursorIcon::Grabbing,
            (Pencil::Select, _) => CursorIcon::Default,
            _ => CursorIcon::Crosshair,
        });
    }
}

/// What lies under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Under {
    /// A handle of what is picked out.
    Handle(usize),
    /// The middle of a segment of it.
    Middle(usize),
    Item(Item),
    Nothing,
}

pub fn under(sheet: &Sheet<'_>, p: Point) -> Under {
    let reach = REACH * sheet.mm_per_pixel();
    let drawing = sheet.session.drawing();
    let nearest = |points: Vec<Point>| {
        let near = points.into_iter().map(|q| polygon::length(p, q)).enumerate().filter(|(_, d)| *d <= reach);
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    };
    if let Some(selected) = sheet.selected() {
        if let Some(handle) = nearest(drawing.handles(selected)) {
            return Under::Handle(handle);
        }
        if let Some(middle) = nearest(drawing.middles(selected)) {
            return Under::Middle(middle);
        }
    }
    drawing.under(p, reach).map_or(Under::Nothing, Under::Item)
}

fn begin(sheet: &Sheet<'_>, hand: Hand, press: Point, actions: &mut Actions) -> Hand {
    let sketching = sheet.session.sketching();
    let holds = |drawing, item, handle, what| Hand::Holds { drawing, item, handle, from: press, what };
    let drawing = || sheet.session.drawing().clone();
    match sketching.pencil {
        Pencil::Sketch => Hand::Line(vec![press]),
        Pencil::Circle | Pencil::Capsule => Hand::Spans(press, press),
        // A drag is a click that was not held still.
        Pencil::Polygon | Pencil::Track => hand,
        Pencil::Select => match (under(sheet, press), sketching.item) {
            (Under::Handle(handle), Some(item)) => {
                actions.push(Action::Sketch(Sketch::Select(Some(item), Some(handle))));
                holds(drawing(), item, Some(handle), "Move point")
            }
            (Under::Middle(after), Some(item)) => {
                let drawing = sheet.session.drawing().with_point(item, after, press);
                let what = "Add point";
                actions.push(Action::Live(Change::Draw { what, drawing: drawing.clone() }));
                actions.push(Action::Sketch(Sketch::Select(Some(item), Some(after + 1))));
                // Where it is then moved to is the same step.
                holds(drawing, item, Some(after + 1), what)
            }
            (Under::Item(item), _) => {
                actions.push(Action::Sketch(Sketch::Select(Some(item), None)));
                let what = if matches!(item, Item::Part(_)) { "Move part" } else { "Move track" };
                holds(drawing(), item, None, what)
            }
            _ => Hand::Pans,
        },
    }
}

fn drag(sheet: &Sheet<'_>, hand: &mut Hand, at: Point, response: &Response, actions: &mut Actions) {
    let mm = sheet.mm_per_pixel();
    match hand {
        Hand::Holds { drawing, item, handle, from, what } => {
            let changed = match *handle {
                Some(handle) => drawing.with_pulled(*item, handle, at, LEAST * mm),
                None => drawing.with_moved(*item, [at[0] - from[0], at[1] - from[1]]),
            };
            actions.push(Action::Live(Change::Draw { what, drawing: changed }));
        }
        Hand::Spans(_, to) => *to = at,
        Hand::Pans => {
            let moved = sheet.camera.panned(response.drag_delta());
            actions.push(Action::Sketch(Sketch::Camera(Some(moved))));
        }
        Hand::Line(_) | Hand::Corners(_) | Hand::Track(_) | Hand::Nothing => {}
    }
}

/// Goes on with a freehand line, if that is far enough.
fn draw(line: &mut Vec<Point>, to: Point, step: f64) {
    if line.last().is_none_or(|&last| polygon::length(last, to) >= step) {
        line.push(to);
    }
}

/// Puts what the hand was drawing into the drawing.
fn finish(sheet: &Sheet<'_>, hand: &mut Hand, actions: &mut Actions) {
    match hand {
        Hand::Corners(corners) if corners.len() < 3 => {}
        Hand::Track(track) if track.len() < 2 => {}
        _ => actions.extend(put_down(sheet.session, std::mem::take(hand), sheet.mm_per_pixel())),
    }
}

/// What puts it into the drawing, as one step of undo; nothing where there is too little of it. The scale matters to what is drawn
/// freehand or by dragging alone.
pub fn put_down(session: &Session, hand: Hand, mm_per_pixel: f64) -> Actions {
    match hand {
        Hand::Track(track) if track.len() < 2 => Vec::new(),
        Hand::Track(track) => {
            let mut drawing = session.drawing().clone();
            drawing.tracks.push(track);
            let last = Item::Track(drawing.tracks.len() - 1);
            put(drawing, "Draw a track", last)
        }
        hand => match hand.pending(session.sketching().pencil, mm_per_pixel) {
            Some(primitive) => add(session, primitive),
            None => Vec::new(),
        },
    }
}

fn add(session: &Session, primitive: Primitive) -> Actions {
    let cut = session.sketching().cut;
    let what = match (&primitive, cut) {
        (_, true) => "Cut out a part",
        (Primitive::Circle { .. }, _) => "Draw a circle",
        (Primitive::Capsule { .. }, _) => "Draw a capsule",
        (Primitive::Path { .. }, _) => "Draw a path",
    };
    let mut drawing = session.drawing().clone();
    drawing.parts.push(Part { primitive, cut });
    let last = Item::Part(drawing.parts.len() - 1);
    put(drawing, what, last)
}

/// One step of undo, with what is new picked out.
fn put(drawing: Drawing, what: &'static str, new: Item) -> Actions {
    vec![Action::Change(Change::Draw { what, drawing }), Action::Sketch(Sketch::Select(Some(new), None))]
}

fn click(sheet: &Sheet<'_>, hand: &mut Hand, at: Point, actions: &mut Actions) {
    let sketching = sheet.session.sketching();
    match sketching.pencil {
        Pencil::Select => {
            let selected = match (under(sheet, at), sketching.item) {
                (Under::Handle(handle), item) => (item, Some(handle)),
                (Under::Middle(_), item) => (item, None),
                (Under::Item(item), _) => (Some(item), None),
                (Under::Nothing, _) => (None, None),
            };
            actions.push(Action::Sketch(Sketch::Select(selected.0, selected.1)));
        }
        Pencil::Polygon => {
            let mut corners = match std::mem::take(hand) {
                Hand::Corners(corners) => corners,
                _ => Vec::new(),
            };
            let closes = corners.len() >= 3
                && corners.first().is_some_and(|&first| polygon::length(first, at) <= REACH * sheet.mm_per_pixel());
            let twice = corners.last().is_some_and(|&last| polygon::length(last, at) < sheet.mm_per_pixel());
            if !closes && !twice {
                corners.push(at);
            }
            *hand = Hand::Corners(corners);
            if closes {
                finish(sheet, hand, actions);
            }
        }
        Pencil::Track => {
            let mut track = match std::mem::take(hand) {
                Hand::Track(track) => track,
                _ => Vec::new(),
            };
            let ends = track.last().is_some_and(|&last| polygon::length(last, at) <= REACH * sheet.mm_per_pixel());
            if !ends {
                track.push(at);
            }
            *hand = Hand::Track(track);
            if ends {
                finish(sheet, hand, actions);
            }
        }
        Pencil::Circle | Pencil::Capsule => {
            *hand = Hand::Spans(at, at);
            finish(sheet, hand, actions);
        }
        Pencil::Sketch => {}
    }
}
