//! How the sheet looks.

use super::hand::{Hand, Under, under};
use super::{Sheet, State};
use crate::outline::Point;
use crate::outline::drawing::{Item, Primitive};
use crate::picture::palette::Palette;
use crate::studio::sketching::Pencil;
use crate::studio::style;
use eframe::egui::epaint::{Mesh, Vertex, WHITE_UV};
use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Ui, pos2, vec2};

/// Distances between the lines of the sheet, mm; the first that is far enough apart is taken.
const GRID_MM: [f64; 7] = [1.0, 5.0, 10.0, 50.0, 100.0, 500.0, 5000.0];
/// Least distance between two lines, logical pixels.
const GRID_PIXELS: f32 = 9.0;
const HANDLE: f32 = 4.5;

pub fn show(ui: &Ui, sheet: &Sheet<'_>, state: &State, pointer: Option<Pos2>) {
    let Sheet { session, rect, camera } = *sheet;
    let theme = session.look().theme;
    let palette = Palette::of(theme);
    let painter = ui.painter_at(rect);
    let weak = ui.visuals().weak_text_color();
    let accent = style::accent(theme);
    let screen = |p: Point| camera.to_screen(rect, p);
    grid(&painter, sheet, weak);
    filled(&painter, sheet, state, style::color32(palette.body));
    for ring in state.surface.regions.iter().flatten() {
        closed(&painter, ring.iter().copied().map(screen), Stroke::new(1.6, style::color32(palette.seam)));
    }
    // The body as it is, where it is no longer what is drawn.
    if session.design().drawing.is_some() && !session.sketching().fresh {
        for ring in session.design().outline.polygons() {
            let points: Vec<Pos2> = ring.iter().chain(ring.first()).copied().map(screen).collect();
            painter.extend(Shape::dashed_line(&points, Stroke::new(1.0, weak.gamma_multiply(0.7)), 5.0, 4.0));
        }
    }
    let sketching = session.sketching();
    let drawing = session.drawing();
    let paper = ui.visuals().extreme_bg_color;
    for (k, part) in drawing.parts.iter().enumerate() {
        let item = Item::Part(k);
        let selected = sketching.item == Some(item);
        let color = if part.cut { ui.visuals().warn_fg_color } else { accent };
        let stroke = if selected { Stroke::new(2.0, color) } else { Stroke::new(0.8, color.gamma_multiply(0.55)) };
        closed(&painter, part.primitive.polygon().into_iter().map(screen), stroke);
        if selected {
            handles(&painter, sheet, item, color, paper);
        }
    }
    let thread = style::color32(palette.track);
    for k in 0..drawing.tracks.len() {
        let item = Item::Track(k);
        let selected = sketching.item == Some(item);
        track(&painter, sheet, state, k, thread, if selected { 3.0 } else { 2.0 });
        if selected {
            handles(&painter, sheet, item, thread, paper);
        }
    }
    let ink = if sketching.pencil == Pencil::Track { thread } else { accent };
    pending(&painter, sheet, &state.hand, ink, pointer);
    let hovers = pointer.filter(|_| sketching.pencil == Pencil::Select && state.hand == Hand::Nothing);
    match hovers.map(|p| under(sheet, camera.to_body(rect, p))) {
        Some(Under::Item(Item::Part(k))) => {
            let points = drawing.parts[k].primitive.polygon();
            closed(&painter, points.into_iter().map(screen), Stroke::new(1.6, accent));
        }
        Some(Under::Item(Item::Track(k))) => track(&painter, sheet, state, k, thread, 3.0),
        _ => {}
    }
    captions(ui, sheet, state);
}

fn grid(painter: &Painter, sheet: &Sheet<'_>, ink: Color32) {
    let Sheet { rect, camera, .. } = *sheet;
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
    let text = format!("grid {step:.0} mm");
    let at = rect.left_bottom() + vec2(14.0, -12.0);
    painter.text(at, Align2::LEFT_BOTTOM, text, FontId::proportional(11.0), ink);
}

fn filled(painter: &Painter, sheet: &Sheet<'_>, state: &State, color: Color32) {
    let mut mesh = Mesh::default();
    for trapezoid in &state.surface.trapezoids {
        let first = mesh.vertices.len() as u32;
        for &p in trapezoid {
            mesh.vertices.push(Vertex { pos: sheet.camera.to_screen(sheet.rect, p), uv: WHITE_UV, color });
        }
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|k| first + k));
    }
    painter.add(Shape::mesh(mesh));
}

fn closed(painter: &Painter, points: impl Iterator<Item = Pos2>, stroke: Stroke) {
    painter.add(Shape::closed_line(points.collect(), stroke));
}

/// A thread with a knot at either end, so that it is no outline to the eye; thin and dashed where it leaves the body.
fn track(painter: &Painter, sheet: &Sheet<'_>, state: &State, index: usize, color: Color32, width: f32) {
    let screen = |p: Point| sheet.camera.to_screen(sheet.rect, p);
    let points = &sheet.session.drawing().tracks[index];
    for &end in points.first().into_iter().chain(points.last()) {
        painter.circle_filled(screen(end), width + 1.5, color);
    }
    for stretch in state.surface.tracks.get(index).into_iter().flatten() {
        let ends = stretch.ends.map(screen);
        if stretch.inside {
            painter.line_segment(ends, Stroke::new(width, color));
        } else {
            painter.extend(Shape::dashed_line(&ends, Stroke::new(0.6 * width, color), 3.0, 4.0));
        }
    }
}

/// Points of a path or track are round, corners of a path square; between them are the places where one can be put in.
fn handles(painter: &Painter, sheet: &Sheet<'_>, item: Item, color: Color32, paper: Color32) {
    let screen = |p: Point| sheet.camera.to_screen(sheet.rect, p);
    let drawing = sheet.session.drawing();
    for p in drawing.middles(item) {
        painter.circle(screen(p), 2.5, paper, Stroke::new(1.0, color.gamma_multiply(0.7)));
    }
    let primitive = match item {
        Item::Part(k) => drawing.parts.get(k).map(|part| &part.primitive),
        Item::Track(_) => None,
    };
    let is_corner = |k: usize| matches!(primitive, Some(Primitive::Path { points }) if points[k].corner);
    for (k, p) in drawing.handles(item).into_iter().enumerate() {
        let fill = if sheet.session.sketching().point == Some(k) { color } else { paper };
        let stroke = Stroke::new(1.5, color);
        if is_corner(k) {
            let square = Rect::from_center_size(screen(p), vec2(2.0, 2.0) * (HANDLE - 0.5));
            painter.rect(square, 0.0, fill, stroke, eframe::egui::StrokeKind::Middle);
        } else {
            painter.circle(screen(p), HANDLE, fill, stroke);
        }
    }
}

/// What is being drawn.
fn pending(painter: &Painter, sheet: &Sheet<'_>, hand: &Hand, color: Color32, pointer: Option<Pos2>) {
    let screen = |p: Point| sheet.camera.to_screen(sheet.rect, p);
    let stroke = Stroke::new(2.0, color);
    match hand {
        Hand::Line(line) => {
            painter.add(Shape::line(line.iter().copied().map(screen).collect(), stroke));
            if let [first, .., last] = line.as_slice() {
                painter.extend(Shape::dashed_line(&[screen(*last), screen(*first)], stroke, 4.0, 4.0));
            }
        }
        Hand::Corners(corners) => {
            let points: Vec<Pos2> = corners.iter().copied().map(screen).chain(pointer).collect();
            painter.add(Shape::line(points, stroke));
            for (k, &p) in corners.iter().enumerate() {
                painter.circle_filled(screen(p), if k == 0 { HANDLE + 1.0 } else { 3.0 }, color);
            }
        }
        Hand::Track(track) => {
            let points: Vec<Pos2> = track.iter().copied().map(screen).chain(pointer).collect();
            painter.add(Shape::line(points, stroke));
            for &p in track {
                painter.circle_filled(screen(p), 3.5, color);
            }
        }
        Hand::Spans(..) => {
            if let Some(primitive) = hand.pending(sheet.session.sketching().pencil, sheet.mm_per_pixel()) {
                let points: Vec<Pos2> = primitive.polygon().into_iter().map(screen).collect();
                painter.add(Shape::closed_line(points, stroke));
            }
        }
        _ => {}
    }
}

fn captions(ui: &Ui, sheet: &Sheet<'_>, state: &State) {
    let Sheet { session, rect, .. } = *sheet;
    let painter = ui.painter_at(rect);
    let corner = rect.left_top() + vec2(14.0, 10.0);
    let strong = ui.visuals().strong_text_color();
    let title = painter.text(corner, Align2::LEFT_TOP, "Outline", FontId::proportional(15.0), strong);
    let hint = match (session.sketching().pencil, &state.hand) {
        (_, Hand::Corners(_)) => "click the first corner, or press Enter, to close it",
        (_, Hand::Track(_)) => "click the last point again, or press Enter, to end it; Escape drops it",
        (Pencil::Select, _) if session.sketching().item.is_some() => {
            "drag the points; drag a small dot to put one in; Delete removes"
        }
        (Pencil::Select, _) => "click a part or a track to change it",
        (Pencil::Sketch, _) => "draw a line around; its ends are joined",
        (Pencil::Polygon, _) => "click the corners",
        (Pencil::Circle, _) => "drag from the middle",
        (Pencil::Capsule, _) => "drag from one end to the other",
        (Pencil::Track, _) => "click the points of a line inside the body; tendons can run along it",
    };
    let weak = ui.visuals().weak_text_color();
    let at = title.right_bottom() + vec2(8.0, -1.5);
    painter.text(at, Align2::LEFT_BOTTOM, hint, FontId::proportional(12.0), weak);
    if session.drawing().parts.is_empty() && state.hand == Hand::Nothing {
        let middle = pos2(rect.center().x, rect.center().y);
        let text = "An empty sheet: draw the silhouette of a plushie";
        painter.text(middle, Align2::CENTER_CENTER, text, FontId::proportional(14.0), weak);
    }
}
