//! Brushes stiffness on: what is starched keeps its shape.

use super::tool::{Entry, Tool};
use crate::outline::Point;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Ground, Hit};
use crate::studio::change::Change;
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::session::{Brush, Session};
use crate::studio::style;
use eframe::egui::{Color32, CursorIcon, Key, Mesh, Painter, Pos2, Shape, Stroke};

pub static ENTRY: Entry = Entry {
    id: STARCH,
    label: "Starch brush",
    tip: "Brush parts of the body stiffer; soften or clear them with a factor of 1 or less",
    icon: Some(Icon::Brush),
    keys: &[Keys::plain(Key::B)],
    canvas: Scope::Views,
    hint: "Brush over what shall keep its shape. [ and ] change the size of the brush; its stiffness is on the left",
    make: || Box::new(Starch::default()),
};

/// Its id: the panel on the left shows the brush while it is taken.
pub const STARCH: &str = "tool.starch";

/// Factor between two sizes of the brush, and its sizes, mm.
const STEP: f64 = 1.25;
pub const RADIUS_MM: [f64; 2] = [1.0, 500.0];
/// Factor at which starch is shown in full colour; softening is shown by its inverse.
const FULL: f64 = 10.0;

#[derive(Default)]
struct Starch {
    /// The picture is held at this point.
    picture: Option<Point>,
    brushing: bool,
}

/// Dabs along a way in the view, where it is on the body.
fn dabs(canvas: &Canvas<'_>, way: &[Point], actions: &mut Actions) {
    let brush = canvas.session.posing().brush;
    for &p in way {
        if let Some((at, miss)) = canvas.at_rest(p).filter(|(_, miss)| *miss <= brush.radius_mm) {
            // Beside the body only the rim of the brush is on it.
            let brush = Brush { radius_mm: (brush.radius_mm - miss).max(RADIUS_MM[0]), ..brush };
            actions.push(Action::Live(Change::Starch { at, brush }));
        }
    }
}

impl Tool for Starch {
    fn press(&mut self, canvas: &Canvas<'_>, at: Point, actions: &mut Actions) {
        self.brushing = canvas.body(at).is_some();
        self.picture = (!self.brushing).then_some(at);
        if self.brushing {
            dabs(canvas, &[at], actions);
        }
    }

    fn drag(&mut self, canvas: &Canvas<'_>, way: &[Point], actions: &mut Actions) {
        match (self.picture, way.last()) {
            (Some(held), Some(&at)) => actions.push(canvas.pan(held, at)),
            _ if self.brushing => dabs(canvas, way, actions),
            _ => {}
        }
    }

    fn release(&mut self, _canvas: &Canvas<'_>, _at: Option<Point>, _actions: &mut Actions) {
        *self = Self::default();
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, _twice: bool, actions: &mut Actions) {
        if canvas.body(at).is_some() {
            dabs(canvas, &[at], actions);
        }
    }

    fn key(&mut self, session: &Session, key: Key, actions: &mut Actions) -> bool {
        let brush = session.posing().brush;
        let factor = match key {
            Key::OpenBracket => 1.0 / STEP,
            Key::CloseBracket => STEP,
            Key::Escape => {
                *self = Self::default();
                return false;
            }
            _ => return false,
        };
        let radius_mm = (brush.radius_mm * factor).clamp(RADIUS_MM[0], RADIUS_MM[1]);
        actions.push(Action::SetBrush(Brush { radius_mm, ..brush }));
        true
    }

    fn cursor(&self, _canvas: &Canvas<'_>, under: Hit) -> CursorIcon {
        if matches!(under, Hit::Nothing) { CursorIcon::Default } else { CursorIcon::Crosshair }
    }

    /// The starch on the body, and the brush.
    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, pointer: Option<Pos2>) {
        let session = canvas.session;
        let accent = style::accent(session.look().theme);
        if let (Ground::Plushie(_, Some(shape)), Some(map)) = (canvas.ground, &session.design().stiffness_map) {
            let soft = style::soft(session.look().theme);
            let mut mesh = Mesh::default();
            for (triangle, &factor) in session.design().mesh.triangles.iter().zip(map) {
                if factor == 1.0 || triangle.iter().any(|&n| n >= shape.nodes.len()) {
                    continue;
                }
                let strength = (factor.ln().abs() / FULL.ln()).clamp(0.15, 1.0) as f32;
                let color: Color32 = if factor > 1.0 { accent } else { soft }.gamma_multiply(0.55 * strength);
                let first = mesh.vertices.len() as u32;
                triangle.iter().for_each(|&n| mesh.colored_vertex(canvas.to_screen(shape.nodes[n]), color));
                mesh.add_triangle(first, first + 1, first + 2);
            }
            painter.add(Shape::mesh(mesh));
        }
        if let Some(pointer) = pointer {
            let radius = session.posing().brush.radius_mm as f32 * canvas.camera.scale;
            painter.circle_stroke(pointer, radius, Stroke::new(1.5, accent));
        }
    }
}
