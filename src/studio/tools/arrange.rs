//! Picks targets and pins out by a box, and moves, turns and scales them together.

use super::tool::{Entry, Tool};
use crate::operations::arrange::{Handle, Motion, middle, places};
use crate::outline::{Point, polygon};
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Hit};
use crate::studio::change::Change;
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::session::{Mode, Session};
use crate::studio::style;
use eframe::egui::{CursorIcon, Key, Painter, Pos2, Rect, Stroke, StrokeKind, vec2};

pub static ENTRY: Entry = Entry {
    id: "tool.arrange",
    label: "Arrange tool",
    tip: "Pick several targets and pins out with a box; move, turn and scale them together",
    icon: Some(Icon::Arrange),
    keys: &[Keys::plain(Key::A)],
    canvas: Scope::Views,
    hint: "Draw a box around targets and pins; drag the box to move them, a corner to scale, the knob to turn. Arrows move by 1 mm",
    make: || Box::new(Arrange::default()),
};

/// Room between the outermost of what is arranged and the box, the reach of its corners, and the way up to its knob, logical pixels.
const ROOM: f32 = 14.0;
const REACH: f32 = 9.0;
const KNOB: f32 = 26.0;
/// What an arrow key moves by, mm.
const NUDGE_MM: f64 = 1.0;
/// Least distance from the middle at which a corner is taken to scale by, mm.
const LEAST_MM: f64 = 1.0;

#[derive(Default)]
struct Arrange {
    held: Held,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Held {
    #[default]
    Nothing,
    /// A box that is drawn: its first corner and where the hand is, mm.
    Box([Point; 2]),
    Move {
        from: Point,
    },
    Turn {
        from: Point,
        about: Point,
    },
    Scale {
        from: Point,
        about: Point,
    },
}

/// The part of the box that is under the pointer.
#[derive(Clone, Copy, PartialEq)]
enum Grip {
    Inside,
    Corner,
    Knob,
}

/// The box around what is picked out, on the screen.
fn frame(canvas: &Canvas<'_>) -> Option<Rect> {
    let session = canvas.session;
    let handles = session.group().handles();
    if handles.len() < 2 {
        return None;
    }
    let points: Vec<Pos2> =
        places(session.design(), session.pose(), handles).into_iter().map(|p| canvas.to_screen(p)).collect();
    Some(Rect::from_points(&points).expand(ROOM))
}

fn knob(frame: Rect) -> Pos2 {
    frame.center_top() - vec2(0.0, KNOB)
}

fn corners(frame: Rect) -> [Pos2; 4] {
    [frame.left_top(), frame.right_top(), frame.right_bottom(), frame.left_bottom()]
}

fn grip(canvas: &Canvas<'_>, at: Point) -> Option<Grip> {
    let (frame, p) = (frame(canvas)?, canvas.to_screen(at));
    if knob(frame).distance(p) <= REACH {
        Some(Grip::Knob)
    } else if corners(frame).iter().any(|corner| corner.distance(p) <= REACH) {
        Some(Grip::Corner)
    } else {
        frame.contains(p).then_some(Grip::Inside)
    }
}

/// The target or pin under a point.
fn handle(canvas: &Canvas<'_>, at: Point) -> Option<Handle> {
    match canvas.hit(at) {
        Hit::Target(index) => Some(Handle::Target(index)),
        Hit::Pin(index) => Some(Handle::Pin(index)),
        _ => None,
    }
}

/// What lies in a box: goals of targets, and pins where they are shown or anchored.
fn inside(canvas: &Canvas<'_>, [a, b]: [Point; 2]) -> Vec<Handle> {
    let session = canvas.session;
    let within = |p: Point| (0..2).all(|k| p[k] >= a[k].min(b[k]) && p[k] <= a[k].max(b[k]));
    let targets = session.targets().iter().enumerate().filter(|(_, t)| within(t.to)).map(|(k, _)| Handle::Target(k));
    let mesh = &session.design().mesh;
    let pins = session.design().pins.iter().enumerate();
    let pins = pins.filter(|(_, pin)| within(pin.anchor(mesh))).map(|(k, _)| Handle::Pin(k));
    targets.chain(pins).collect()
}

fn arranged(session: &Session, motion: Motion) -> Change {
    Change::Arrange { pose: session.pose(), handles: session.group().handles().to_vec(), motion }
}

/// The motion of what is held from where it was taken to where the hand is.
fn motion(held: Held, at: Point) -> Option<Motion> {
    let away = |p: Point, about: Point| [p[0] - about[0], p[1] - about[1]];
    let angle = |p: Point, about: Point| away(p, about)[1].atan2(away(p, about)[0]).to_degrees();
    Some(match held {
        Held::Nothing | Held::Box(_) => return None,
        Held::Move { from } => Motion { by: away(at, from), ..Motion::default() },
        Held::Turn { from, about } => {
            Motion { turn_degrees: angle(at, about) - angle(from, about), about: Some(about), ..Motion::default() }
        }
        Held::Scale { from, about } => {
            let scale = polygon::length(about, at) / polygon::length(about, from).max(LEAST_MM);
            Motion { scale, about: Some(about), ..Motion::default() }
        }
    })
}

impl Tool for Arrange {
    fn press(&mut self, canvas: &Canvas<'_>, at: Point, actions: &mut Actions) {
        let session = canvas.session;
        // What is arranged are targets of a pose: the animation gives way to it.
        if session.mode() != Mode::Pose {
            actions.push(Action::SelectPose(session.pose()));
        }
        let about = middle(session.design(), session.pose(), session.group().handles());
        self.held = match (grip(canvas, at), handle(canvas, at)) {
            (Some(Grip::Knob), _) => Held::Turn { from: at, about },
            (Some(Grip::Corner), _) => Held::Scale { from: at, about },
            (_, Some(handle)) if !session.group().has(handle) => {
                actions.push(Action::Gather(vec![handle]));
                Held::Move { from: at }
            }
            (Some(Grip::Inside), _) | (_, Some(_)) => Held::Move { from: at },
            (None, None) => Held::Box([at; 2]),
        };
    }

    fn drag(&mut self, canvas: &Canvas<'_>, way: &[Point], actions: &mut Actions) {
        let Some(&at) = way.last() else { return };
        if let Held::Box([_, to]) = &mut self.held {
            *to = at;
        } else if let Some(motion) = motion(self.held, at) {
            actions.push(Action::Again(arranged(canvas.session, motion)));
        }
    }

    fn release(&mut self, canvas: &Canvas<'_>, at: Option<Point>, actions: &mut Actions) {
        if let (Held::Box([from, to]), at) = (self.held, at) {
            actions.push(Action::Gather(inside(canvas, [from, at.unwrap_or(to)])));
        }
        self.held = Held::Nothing;
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, _twice: bool, actions: &mut Actions) {
        let mut handles = canvas.session.group().handles().to_vec();
        match handle(canvas, at) {
            None => handles.clear(),
            Some(handle) if handles.contains(&handle) => handles.retain(|other| *other != handle),
            Some(handle) => handles.push(handle),
        }
        actions.push(Action::Gather(handles));
    }

    fn key(&mut self, session: &Session, key: Key, actions: &mut Actions) -> bool {
        let by = match key {
            Key::ArrowLeft => [-NUDGE_MM, 0.0],
            Key::ArrowRight => [NUDGE_MM, 0.0],
            Key::ArrowUp => [0.0, NUDGE_MM],
            Key::ArrowDown => [0.0, -NUDGE_MM],
            Key::Escape => {
                self.held = Held::Nothing;
                return false;
            }
            _ => return false,
        };
        if session.group().handles().is_empty() {
            return false;
        }
        actions.push(Action::Change(arranged(session, Motion { by, ..Motion::default() })));
        true
    }

    fn cursor(&self, canvas: &Canvas<'_>, under: Hit) -> CursorIcon {
        match (self.held, under) {
            (Held::Nothing, Hit::Target(_) | Hit::Pin(_)) => CursorIcon::Grab,
            (Held::Nothing, _) if frame(canvas).is_some() => CursorIcon::Default,
            (Held::Nothing | Held::Box(_), _) => CursorIcon::Crosshair,
            _ => CursorIcon::Grabbing,
        }
    }

    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, _pointer: Option<Pos2>) {
        let accent = style::accent(canvas.session.look().theme);
        let stroke = Stroke::new(1.2, accent);
        if let Held::Box(corners) = self.held {
            let rect = Rect::from_points(&corners.map(|p| canvas.to_screen(p)));
            painter.rect(rect, 2.0, accent.gamma_multiply(0.12), stroke, StrokeKind::Middle);
        }
        let session = canvas.session;
        for place in places(session.design(), session.pose(), session.group().handles()) {
            painter.circle_stroke(canvas.to_screen(place), 10.0, stroke);
        }
        let Some(frame) = frame(canvas) else { return };
        painter.rect_stroke(frame, 3.0, stroke, StrokeKind::Middle);
        painter.line_segment([frame.center_top(), knob(frame)], stroke);
        painter.circle_filled(knob(frame), 5.0, accent);
        for corner in corners(frame) {
            painter.rect_filled(Rect::from_center_size(corner, vec2(7.0, 7.0)), 1.0, accent);
        }
    }
}
