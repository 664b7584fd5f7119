//! Over the cables of a view: the network that is selected is lit, holes have handles, and places that no hand can sew are ringed.

use crate::motion::winch_labels;
use crate::operations::network::Part;
use crate::outline::Point;
use crate::picture::palette::Palette;
use crate::sewing::{Breach, Spot};
use crate::studio::canvas::{Canvas, Ground, HANDLE};
use crate::studio::language::tf;
use crate::studio::session::Selection;
use crate::studio::style;
use crate::studio::tools::TENDON;
use eframe::egui::{Color32, Painter, Rect, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, pos2};
use std::collections::BTreeMap;

/// Width of the light around a cable that is selected, logical pixels.
const GLOW: f32 = 9.0;
/// How strong the cables of what is switched off are drawn.
const MUTED: f32 = 0.3;
/// Radius of the ring around a place that breaks a rule, logical pixels.
const RING: f32 = 9.0;

pub fn show(ui: &mut Ui, canvas: &Canvas<'_>) {
    let session = canvas.session;
    if !matches!(canvas.ground, Ground::Plushie(_, Some(_))) || session.displayed_proposal().is_some() {
        return;
    }
    let editing = session.has_taken(TENDON);
    let painter = ui.painter_at(canvas.rect);
    if let Selection::Part(part) = session.selection() {
        lit(&painter, canvas, part);
    }
    if editing {
        handles(&painter, canvas, ui.visuals().extreme_bg_color);
    }
    if editing || session.selection().network().is_some() {
        broken(ui, canvas);
    }
}

/// Light around the part that is selected, and a fainter one around its network.
fn lit(painter: &Painter, canvas: &Canvas<'_>, part: Part) {
    let session = canvas.session;
    let accent = style::accent(session.look().theme);
    let palette = Palette::of(session.look().theme);
    let Some(network) = session.design().networks.get(part.winch()) else { return };
    for (tendon, cable) in network.tendons.iter().enumerate() {
        let whole = part.tendon().is_none_or(|selected| selected == tendon);
        let points: Vec<_> =
            cable.routing.iter().filter_map(|point| canvas.shown(point)).map(|p| canvas.to_screen(p)).collect();
        let strength = if whole { 0.5 } else { 0.2 };
        painter.add(Shape::line(points.clone(), Stroke::new(GLOW, accent.gamma_multiply(strength))));
        let color = style::color32(palette.network(part.winch(), network));
        let color = if network.muted { color.gamma_multiply(MUTED) } else { color };
        painter.add(Shape::line(points, Stroke::new(3.0, color)));
    }
    let ring = |part: Part, radius: f32| {
        if let Some(place) = canvas.shown_part(part) {
            painter.circle_stroke(canvas.to_screen(place), radius, Stroke::new(2.5, accent));
        }
    };
    ring(Part::Winch(part.winch()), 12.0);
    if let Part::Hole(..) = part {
        ring(part, 8.0);
    }
}

/// Every hole and end as something to take hold of.
fn handles(painter: &Painter, canvas: &Canvas<'_>, background: Color32) {
    let palette = Palette::of(canvas.session.look().theme);
    for (winch, network) in canvas.session.design().networks.iter().enumerate() {
        let color = style::color32(palette.network(winch, network));
        for tendon in &network.tendons {
            let last = tendon.routing.len() - 1;
            for (hole, point) in tendon.routing.iter().enumerate().skip(1) {
                let Some(place) = canvas.shown(point) else { continue };
                let at = canvas.to_screen(place);
                if hole == last {
                    let square = Rect::from_center_size(at, Vec2::splat(2.0 * (HANDLE - 0.5)));
                    painter.rect(square, 1.0, background, Stroke::new(1.8, color), eframe::egui::StrokeKind::Middle);
                } else {
                    painter.circle(at, HANDLE, background, Stroke::new(1.8, color));
                }
            }
        }
    }
}

/// Red rings where rules of sewing are broken, with the rules in their tips.
fn broken(ui: &mut Ui, canvas: &Canvas<'_>) {
    let session = canvas.session;
    let breaches = session.judging().breaches();
    if breaches.is_empty() {
        return;
    }
    let mut at: BTreeMap<Part, Vec<&Breach>> = BTreeMap::new();
    for breach in breaches {
        for part in parts(breach).into_iter().flatten().filter(|part| part.is_in(session.design())) {
            at.entry(part).or_default().push(breach);
        }
    }
    let red = ui.visuals().error_fg_color;
    let names = winch_labels(session.design());
    for (part, breaches) in at {
        let (Some(place), radius) = (ringed(canvas, part), if matches!(part, Part::Winch(_)) { 15.0 } else { RING })
        else {
            continue;
        };
        let middle = canvas.to_screen(place);
        if !canvas.rect.contains(middle) {
            continue;
        }
        let painter = ui.painter_at(canvas.rect);
        painter.circle_stroke(middle, radius, Stroke::new(2.0, red));
        let words: Vec<String> = breaches.iter().map(|breach| breach.words(&names).to_string()).collect();
        let words = tf!("Hard to sew: {breaches}", breaches = words.join("\n"));
        let square = Rect::from_center_size(pos2(middle.x, middle.y), Vec2::splat(2.0 * radius));
        let corner = [canvas.rect.min.x as i64, canvas.rect.min.y as i64];
        let response = ui.interact(square, ui.scope_id().with(("broken", corner, part)), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &words));
        if !session.is_dragging() {
            response.on_hover_text_at_pointer(tf!("{words}\nThe tendon tool (W) moves it", words));
        }
    }
}

/// Where the ring of a part is; that of a tendon as a whole is at its end.
fn ringed(canvas: &Canvas<'_>, part: Part) -> Option<Point> {
    match part {
        Part::Tendon(winch, tendon) => {
            let routing = &canvas.session.design().networks.get(winch)?.tendons.get(tendon)?.routing;
            canvas.shown(routing.last()?)
        }
        part => canvas.shown_part(part),
    }
}

/// The parts that break a rule.
fn parts(breach: &Breach) -> [Option<Part>; 2] {
    breach.spots().map(|spot| {
        Some(match spot? {
            Spot::Winch(winch) => Part::Winch(winch),
            Spot::Cable(at) => Part::Tendon(at.winch, at.cable),
            Spot::Hole(at, hole) => Part::Hole(at.winch, at.cable, hole),
            Spot::Piece(at, piece) => Part::Piece(at.winch, at.cable, piece),
        })
    })
}
