//! Icons drawn with a few strokes, and the buttons that carry them.

use super::style::CORNER;
use crate::picture::layers;
use eframe::egui::{
    Color32, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, epaint::PathShape, pos2, vec2,
};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Icon {
    Undo,
    Redo,
    Hand,
    Pin,
    Tendon,
    Pull,
    Arrange,
    Brush,
    Fit,
    /// Of a layer of the pictures.
    Layer(&'static [layers::Stroke]),
    LeftView,
    RightView,
    Sun,
    Moon,
    Plus,
    Copy,
    Pen,
    Trash,
    Play,
    Pause,
    Loop,
    Key,
    Close,
    Check,
    Warning,
}

/// Side of an icon button, logical pixels.
pub const BUTTON: f32 = 28.0;

/// A square button. `name` is its accessible name; `tip` is what the pointer is told.
pub fn button(ui: &mut Ui, icon: Icon, name: &str, tip: &str) -> Response {
    draw_button(ui, icon, name, None, BUTTON).on_hover_text(tip).on_disabled_hover_text(tip)
}

/// For lists and headings.
pub fn small_button(ui: &mut Ui, icon: Icon, name: &str, tip: &str) -> Response {
    draw_button(ui, icon, name, None, 22.0).on_hover_text(tip).on_disabled_hover_text(tip)
}

/// Chords of the arcs of icons span at most so much: a tenth of a pixel off at their size.
const ARC_DEGREES: f32 = 20.0;

/// A square button of a given side; `on` of one that is on or off.
pub fn draw_button(ui: &mut Ui, icon: Icon, name: &str, on: Option<bool>, side: f32) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(side), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| match on {
        Some(on) => WidgetInfo::selected(Role::Button, enabled, on, name),
        None => WidgetInfo::labeled(Role::Button, enabled, name),
    });
    if ui.is_rect_visible(rect) {
        let visuals = ui.style().interact(&response);
        let mut color = visuals.fg_stroke.color;
        if on == Some(true) {
            ui.painter().rect_filled(rect, CORNER, ui.visuals().selection.bg_fill);
            color = ui.visuals().selection.stroke.color;
        } else if response.hovered() && enabled || response.has_focus() {
            ui.painter().rect_filled(rect, CORNER, visuals.weak_bg_fill);
        }
        let shapes = draw(icon, Rect::from_center_size(rect.center(), Vec2::splat(side * 0.6)), color);
        ui.painter().extend(shapes);
    }
    response
}

/// The strokes of an icon in `rect`.
pub fn draw(icon: Icon, rect: Rect, color: Color32) -> Vec<Shape> {
    let pen = Pen { rect, color, stroke: Stroke::new((rect.width() / 11.0).max(1.2), color) };
    match icon {
        Icon::Undo => {
            vec![pen.arc((0.52, 0.6), 0.34, -150.0, 60.0), pen.line(&[(0.16, 0.12), (0.2, 0.46), (0.52, 0.36)])]
        }
        Icon::Redo => {
            vec![pen.arc((0.48, 0.6), 0.34, -30.0, -240.0), pen.line(&[(0.84, 0.12), (0.8, 0.46), (0.48, 0.36)])]
        }
        Icon::Hand | Icon::Pin | Icon::Tendon | Icon::Pull | Icon::Arrange | Icon::Brush => tool(icon, &pen),
        Icon::Fit => vec![
            pen.line(&[(0.06, 0.32), (0.06, 0.06), (0.32, 0.06)]),
            pen.line(&[(0.68, 0.06), (0.94, 0.06), (0.94, 0.32)]),
            pen.line(&[(0.94, 0.68), (0.94, 0.94), (0.68, 0.94)]),
            pen.line(&[(0.32, 0.94), (0.06, 0.94), (0.06, 0.68)]),
            pen.dot(0.5, 0.5, 0.1),
        ],
        Icon::Layer(strokes) => {
            let shape = |stroke: &layers::Stroke| match *stroke {
                layers::Stroke::Line(points) => pen.line(points),
                layers::Stroke::Dot(x, y, radius) => pen.dot(x, y, radius),
                layers::Stroke::Ring(x, y, radius) => pen.ring(x, y, radius),
            };
            strokes.iter().map(shape).collect()
        }
        Icon::LeftView | Icon::RightView => {
            let frame = pen.line(&[(0.04, 0.14), (0.96, 0.14), (0.96, 0.86), (0.04, 0.86), (0.04, 0.14)]);
            let (from, to) = if icon == Icon::LeftView { (0.04, 0.46) } else { (0.54, 0.96) };
            vec![frame, pen.solid(&[(from, 0.14), (to, 0.14), (to, 0.86), (from, 0.86)])]
        }
        Icon::Sun => {
            let mut shapes = vec![pen.ring(0.5, 0.5, 0.2)];
            shapes.extend((0..8).map(|i| {
                let (s, c) = (i as f32 * std::f32::consts::FRAC_PI_4).sin_cos();
                pen.line(&[(0.5 + 0.34 * c, 0.5 + 0.34 * s), (0.5 + 0.48 * c, 0.5 + 0.48 * s)])
            }));
            shapes
        }
        Icon::Moon => vec![pen.arc((0.46, 0.54), 0.4, 0.0, 250.0), pen.arc((0.72, 0.3), 0.3, 58.0, 212.0)],
        Icon::Plus => vec![pen.line(&[(0.5, 0.12), (0.5, 0.88)]), pen.line(&[(0.12, 0.5), (0.88, 0.5)])],
        Icon::Copy => vec![
            pen.line(&[(0.3, 0.3), (0.92, 0.3), (0.92, 0.92), (0.3, 0.92), (0.3, 0.3)]),
            pen.line(&[(0.3, 0.7), (0.08, 0.7), (0.08, 0.08), (0.7, 0.08), (0.7, 0.3)]),
        ],
        Icon::Pen => vec![pen.line(&[(0.1, 0.9), (0.16, 0.66), (0.72, 0.1), (0.9, 0.28), (0.34, 0.84), (0.1, 0.9)])],
        Icon::Trash => vec![
            pen.line(&[(0.08, 0.22), (0.92, 0.22)]),
            pen.line(&[(0.36, 0.2), (0.36, 0.06), (0.64, 0.06), (0.64, 0.2)]),
            pen.line(&[(0.2, 0.24), (0.26, 0.94), (0.74, 0.94), (0.8, 0.24)]),
            pen.line(&[(0.5, 0.4), (0.5, 0.78)]),
        ],
        Icon::Play => vec![pen.solid(&[(0.2, 0.06), (0.92, 0.5), (0.2, 0.94)])],
        Icon::Pause => vec![
            pen.solid(&[(0.16, 0.08), (0.4, 0.08), (0.4, 0.92), (0.16, 0.92)]),
            pen.solid(&[(0.6, 0.08), (0.84, 0.08), (0.84, 0.92), (0.6, 0.92)]),
        ],
        Icon::Loop => vec![
            pen.line(&[(0.1, 0.56), (0.1, 0.26), (0.86, 0.26)]),
            pen.line(&[(0.68, 0.06), (0.9, 0.26), (0.68, 0.46)]),
            pen.line(&[(0.9, 0.44), (0.9, 0.74), (0.14, 0.74)]),
            pen.line(&[(0.32, 0.54), (0.1, 0.74), (0.32, 0.94)]),
        ],
        Icon::Key => vec![pen.solid(&[(0.5, 0.06), (0.94, 0.5), (0.5, 0.94), (0.06, 0.5)])],
        Icon::Close => vec![pen.line(&[(0.14, 0.14), (0.86, 0.86)]), pen.line(&[(0.86, 0.14), (0.14, 0.86)])],
        Icon::Warning => vec![
            pen.line(&[(0.5, 0.08), (0.96, 0.9), (0.04, 0.9), (0.5, 0.08)]),
            pen.line(&[(0.5, 0.36), (0.5, 0.62)]),
            pen.dot(0.5, 0.76, 0.05),
        ],
        Icon::Check => vec![pen.line(&[(0.08, 0.54), (0.38, 0.84), (0.92, 0.16)])],
    }
}

/// The icons of the tools on the views.
fn tool(icon: Icon, pen: &Pen) -> Vec<Shape> {
    match icon {
        Icon::Hand => vec![pen.line(&[
            (0.2, 0.08),
            (0.2, 0.78),
            (0.38, 0.62),
            (0.5, 0.92),
            (0.64, 0.86),
            (0.52, 0.58),
            (0.76, 0.58),
            (0.2, 0.08),
        ])],
        Icon::Pin => vec![pen.ring(0.5, 0.3, 0.2), pen.line(&[(0.5, 0.5), (0.5, 0.94)]), pen.dot(0.5, 0.3, 0.07)],
        Icon::Arrange => vec![
            pen.line(&[(0.14, 0.24), (0.86, 0.24), (0.86, 0.9), (0.14, 0.9), (0.14, 0.24)]),
            pen.line(&[(0.5, 0.24), (0.5, 0.1)]),
            pen.dot(0.5, 0.08, 0.08),
            pen.dot(0.36, 0.48, 0.08),
            pen.dot(0.64, 0.66, 0.08),
        ],
        Icon::Brush => vec![
            pen.line(&[(0.92, 0.08), (0.5, 0.52)]),
            pen.solid(&[(0.44, 0.44), (0.58, 0.58), (0.4, 0.84), (0.1, 0.92), (0.2, 0.62)]),
        ],
        Icon::Pull => vec![
            pen.arc((0.3, 0.5), 0.24, 30.0, 330.0),
            pen.line(&[(0.5, 0.5), (0.94, 0.5)]),
            pen.line(&[(0.76, 0.32), (0.94, 0.5), (0.76, 0.68)]),
        ],
        Icon::Tendon => vec![
            pen.ring(0.2, 0.78, 0.14),
            pen.line(&[(0.3, 0.66), (0.46, 0.34), (0.84, 0.2)]),
            pen.dot(0.46, 0.34, 0.09),
            pen.dot(0.86, 0.2, 0.09),
        ],
        _ => Vec::new(),
    }
}

/// Draws in a rectangle, from 0 to 1 in both directions (y down).
struct Pen {
    rect: Rect,
    color: Color32,
    stroke: Stroke,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> Pos2 {
        pos2(self.rect.left() + x * self.rect.width(), self.rect.top() + y * self.rect.height())
    }

    fn line(&self, points: &[(f32, f32)]) -> Shape {
        Shape::line(points.iter().map(|p| self.at(p.0, p.1)).collect(), self.stroke)
    }

    fn solid(&self, points: &[(f32, f32)]) -> Shape {
        let points = points.iter().map(|p| self.at(p.0, p.1)).collect();
        Shape::Path(PathShape::convex_polygon(points, self.color, Stroke::NONE))
    }

    /// From one angle to another, degrees.
    fn arc(&self, center: (f32, f32), radius: f32, from: f32, to: f32) -> Shape {
        let count = ((to - from).abs() / ARC_DEGREES).ceil().max(1.0) as usize;
        let points = (0..=count).map(|i| {
            let angle = (from + (to - from) * i as f32 / count as f32).to_radians();
            self.at(center.0 + radius * angle.cos(), center.1 + radius * angle.sin())
        });
        Shape::line(points.collect(), self.stroke)
    }

    fn dot(&self, x: f32, y: f32, radius: f32) -> Shape {
        Shape::circle_filled(self.at(x, y), radius * self.rect.width(), self.color)
    }

    fn ring(&self, x: f32, y: f32, radius: f32) -> Shape {
        Shape::circle_stroke(self.at(x, y), radius * self.rect.width(), self.stroke)
    }
}

/// A diamond around `center`.
pub fn diamond(center: Pos2, radius: f32, fill: Color32, stroke: Stroke) -> Shape {
    let points = [vec2(0.0, -radius), vec2(radius, 0.0), vec2(0.0, radius), vec2(-radius, 0.0)];
    Shape::Path(PathShape::convex_polygon(points.map(|v| center + v).to_vec(), fill, stroke))
}
