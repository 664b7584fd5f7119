//! How the sheet looks, but for what the tool draws.

use super::ground::{Canvas, Ground};
use super::strokes::{HANDLE, closed, track};
use super::surface::Surface;
use crate::outline::Point;
use crate::outline::drawing::{Item, Primitive};
use crate::picture::palette::Palette;
use crate::studio::language::{t, tf};
use crate::studio::style;
use eframe::egui::epaint::{Mesh, Vertex, WHITE_UV};
use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Ui, vec2};

/// Distances between the lines of the sheet, mm; the first that is far enough apart is taken.
const GRID_MM: [f64; 7] = [1.0, 5.0, 10.0, 50.0, 100.0, 500.0, 5000.0];
/// Least distance between two lines, logical pixels.
const GRID_PIXELS: f32 = 9.0;

pub fn show(ui: &Ui, canvas: &Canvas<'_>) {
    let Canvas { session, rect, ground, .. } = *canvas;
    let Ground::Outline(surface) = ground else { return };
    let theme = session.look().theme;
    let palette = Palette::of(theme);
    let painter = ui.painter_at(rect);
    let weak = ui.visuals().weak_text_color();
    grid(&painter, canvas, weak);
    filled(&painter, canvas, surface, style::color32(palette.body));
    for ring in surface.regions.iter().flatten() {
        closed(&painter, canvas, ring, Stroke::new(1.6, style::color32(palette.seam)));
    }
    // The body as it is, where it is no longer what is drawn.
    if session.design().drawing.is_some() && !session.sketching().fresh {
        for ring in session.design().outline.polygons() {
            let points: Vec<Pos2> = ring.iter().chain(ring.first()).map(|&p| canvas.to_screen(p)).collect();
            painter.extend(Shape::dashed_line(&points, Stroke::new(1.0, weak.gamma_multiply(0.7)), 5.0, 4.0));
        }
    }
    let background = ui.visuals().extreme_bg_color;
    let picked = session.sketching().item;
    for (k, part) in session.drawing().parts.iter().enumerate() {
        let item = Item::Part(k);
        let color = if part.cut { ui.visuals().warn_fg_color } else { style::accent(theme) };
        let is = picked == Some(item);
        let stroke = if is { Stroke::new(2.0, color) } else { Stroke::new(0.8, color.gamma_multiply(0.55)) };
        closed(&painter, canvas, &part.primitive.polygon(), stroke);
        if is {
            handles(&painter, canvas, item, color, background);
        }
    }
    let thread = style::color32(palette.track);
    for k in 0..session.drawing().tracks.len() {
        let item = Item::Track(k);
        let is = picked == Some(item);
        track(&painter, canvas, k, thread, if is { 3.0 } else { 2.0 });
        if is {
            handles(&painter, canvas, item, thread, background);
        }
    }
}

fn grid(painter: &Painter, canvas: &Canvas<'_>, ink: Color32) {
    let Canvas { rect, camera, .. } = *canvas;
    let Some(k) = GRID_MM.iter().position(|&mm| mm as f32 * camera.scale >= GRID_PIXELS) else { return };
    let step = GRID_MM[k];
    let heavy = GRID_MM.get(k + 1).map_or(5, |coarse| (coarse / step).round() as i64);
    let [low, high] = [rect.left_bottom(), rect.right_top()].map(|p| camera.to_body(rect, p));
    let lines = |from: f64, to: f64| ((from / step).ceil() as i64)..=((to / step).floor() as i64);
    let stroke = |i: i64| {
        let strength = if i == 0 {
            0.35
        } else if i % heavy == 0 {
            0.16
        } else {
            0.07
        };
        Stroke::new(1.0, ink.gamma_multiply(strength))
    };
    for i in lines(low[0], high[0]) {
        painter.vline(camera.to_screen(rect, [i as f64 * step, 0.0]).x, rect.y_range(), stroke(i));
    }
    for i in lines(low[1], high[1]) {
        painter.hline(rect.x_range(), camera.to_screen(rect, [0.0, i as f64 * step]).y, stroke(i));
    }
    let text = tf!("grid {step:.0} mm", step);
    let at = rect.left_bottom() + vec2(14.0, -12.0);
    painter.text(at, Align2::LEFT_BOTTOM, text, FontId::proportional(11.0), ink);
}

fn filled(painter: &Painter, canvas: &Canvas<'_>, surface: &Surface, color: Color32) {
    let mut mesh = Mesh::default();
    for trapezoid in &surface.trapezoids {
        let first = mesh.vertices.len() as u32;
        for &p in trapezoid {
            mesh.vertices.push(Vertex { pos: canvas.to_screen(p), uv: WHITE_UV, color });
        }
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|k| first + k));
    }
    painter.add(Shape::mesh(mesh));
}

/// Points of a path or track are round, corners of a path square; between them are the places where one can be put in.
fn handles(painter: &Painter, canvas: &Canvas<'_>, item: Item, color: Color32, background: Color32) {
    let screen = |p: Point| canvas.to_screen(p);
    let drawing = canvas.session.drawing();
    for p in drawing.middles(item) {
        painter.circle(screen(p), 2.5, background, Stroke::new(1.0, color.gamma_multiply(0.7)));
    }
    let primitive = match item {
        Item::Part(k) => drawing.parts.get(k).map(|part| &part.primitive),
        Item::Track(_) => None,
    };
    let is_corner = |k: usize| matches!(primitive, Some(Primitive::Path { points }) if points[k].corner);
    for (k, p) in drawing.handles(item).into_iter().enumerate() {
        let fill = if canvas.session.sketching().point == Some(k) { color } else { background };
        let stroke = Stroke::new(1.5, color);
        if is_corner(k) {
            let square = Rect::from_center_size(screen(p), vec2(2.0, 2.0) * (HANDLE - 0.5));
            painter.rect(square, 0.0, fill, stroke, eframe::egui::StrokeKind::Middle);
        } else {
            painter.circle(screen(p), HANDLE, fill, stroke);
        }
    }
}

/// Captions that say what the sheet is and what can be done on it. `busy`: something is being drawn.
pub fn captions(ui: &Ui, canvas: &Canvas<'_>, hint: &str, busy: bool) {
    let Canvas { session, rect, .. } = *canvas;
    let painter = ui.painter_at(rect);
    let corner = rect.left_top() + vec2(14.0, 10.0);
    let strong = ui.visuals().strong_text_color();
    let title = painter.text(corner, Align2::LEFT_TOP, t("Outline"), FontId::proportional(15.0), strong);
    let weak = ui.visuals().weak_text_color();
    let at = title.right_bottom() + vec2(8.0, -1.5);
    painter.text(at, Align2::LEFT_BOTTOM, hint, FontId::proportional(12.0), weak);
    if session.drawing().parts.is_empty() && !busy {
        let text = t("An empty sheet: draw the silhouette of a plushie");
        painter.text(rect.center(), Align2::CENTER_CENTER, text, FontId::proportional(14.0), weak);
    }
}
