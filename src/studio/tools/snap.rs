//! Goals that fall into line: with other goals, with pins, with their own place at rest, and with the axis of the body.

use crate::outline::Point;
use crate::studio::canvas::Canvas;
use crate::studio::session::Selection;
use crate::studio::style;
use eframe::egui::{Painter, Shape, Stroke};

/// How near a goal must come to a line to fall into it, logical pixels.
const REACH: f64 = 6.0;
/// Goals are kept to a micrometre: this near to a line they are on it, mm.
const ON_MM: f64 = 2e-3;

/// An upright or level line.
struct Line {
    /// The coordinate that it fixes.
    axis: usize,
    /// mm.
    value: f64,
    /// What it goes through, mm; nothing of the axis of the body.
    through: Option<Point>,
}

/// The goal, or the place in line with others near it, mm.
pub fn snapped(canvas: &Canvas<'_>, goal: Point) -> Point {
    if !canvas.session.posing().snaps {
        return goal;
    }
    let (reach, lines) = (REACH * canvas.mm_per_pixel(), lines(canvas));
    let mut out = goal;
    for (axis, coordinate) in out.iter_mut().enumerate() {
        let off = |line: &&Line| (line.value - goal[axis]).abs();
        let near = lines.iter().filter(|line| line.axis == axis && off(line) <= reach);
        if let Some(line) = near.min_by(|a, b| off(a).total_cmp(&off(b))) {
            *coordinate = line.value;
        }
    }
    out
}

/// The lines that the selected target's goal is in.
pub fn paint(canvas: &Canvas<'_>, painter: &Painter) {
    let session = canvas.session;
    let Selection::Target(index) = session.selection() else { return };
    let Some(target) = session.targets().get(index).filter(|_| session.posing().snaps) else { return };
    let stroke = Stroke::new(1.0, style::accent(session.look().theme));
    let to = canvas.to_screen(target.to);
    for line in lines(canvas).iter().filter(|line| (line.value - target.to[line.axis]).abs() < ON_MM) {
        match (line.through, line.axis) {
            (Some(place), _) => {
                painter.extend(Shape::dashed_line(&[canvas.to_screen(place), to], stroke, 4.0, 4.0));
            }
            (None, 0) => drop(painter.vline(to.x, canvas.rect.y_range(), stroke)),
            (None, _) => drop(painter.hline(canvas.rect.x_range(), to.y, stroke)),
        }
    }
}

/// What the goal of the selected target may be in line with.
fn lines(canvas: &Canvas<'_>) -> Vec<Line> {
    let session = canvas.session;
    let (design, mesh) = (session.design(), &session.design().mesh);
    let Selection::Target(held) = session.selection() else { return Vec::new() };
    let others = session.targets().iter().enumerate().filter(|(index, _)| *index != held).map(|(_, t)| t.to);
    let pins = design.pins.iter().map(|pin| pin.anchor(mesh));
    let rest = session.targets().get(held).map(|target| mesh.position(&target.at, &mesh.nodes));
    let both = |place: Point| [0, 1].map(|axis| Line { axis, value: place[axis], through: Some(place) });
    let mut lines: Vec<Line> = others.chain(pins).chain(rest).flat_map(both).collect();
    if let Some(own) = session.posing().axis() {
        let across = (0..2).find(|&axis| own.along[axis] == 0.0);
        lines.extend(across.map(|axis| Line { axis, value: own.origin[axis], through: None }));
    }
    lines
}
