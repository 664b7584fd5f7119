//! The pointer in a view: the tool, the menu, what lies under it.

use crate::mesh::BodyPoint;
use crate::operations::network::Part;
use crate::outline::Point;
use crate::studio::action::Actions;
use crate::studio::canvas::{Canvas, Ground, Hit, act, navigate};
use crate::studio::commands::{self, Command, Place};
use crate::studio::panels::{buttons, tendons};
use crate::studio::session::Session;
use crate::studio::style;
use crate::studio::tools::Tool;
use eframe::egui::{Response, Stroke, Ui};

/// Drags, clicks and the context menu; what lies under the pointer. `menu_at`: where the menu was opened, mm.
pub fn interact(
    ui: &mut Ui,
    canvas: &Canvas<'_>,
    tool: &mut dyn Tool,
    menu_at: &mut Option<Point>,
    response: &Response,
    actions: &mut Actions,
) -> Option<Hit> {
    act(ui, canvas, tool, response, actions);
    navigate(ui, canvas, response, actions);
    let pointer = response.hover_pos().map(|p| canvas.to_body(p));
    if response.secondary_clicked() {
        *menu_at = pointer;
    }
    if let Some(at) = *menu_at {
        let hits = [canvas.strung(at).map_or(Hit::Nothing, Hit::Part), canvas.hit(at)];
        response.context_menu(|ui| menu(ui, canvas.session, hits, actions));
    }
    pointer.map(|p| tool.under(canvas, p))
}

/// All that can be done to what lies under the pointer: first to a winch or a cable, then to the body below, then what can always be done.
fn menu(ui: &mut Ui, session: &Session, hits: [Hit; 2], actions: &mut Actions) {
    ui.set_min_width(170.0);
    let allowed = |command: &Command, hit: Hit| command.refused(session, hit).is_none();
    let mut groups: [Vec<(&'static Command, Hit)>; 3] = Default::default();
    for command in commands::at(Place::ContextMenu) {
        let Some(hit) = hits.into_iter().find(|&hit| allowed(command, hit)) else { continue };
        let group = if allowed(command, Hit::Nothing) { 2 } else { usize::from(allowed(command, hits[1])) };
        groups[group].push((command, hit));
    }
    let mut parted = false;
    for group in groups.iter().filter(|group| !group.is_empty()) {
        if std::mem::replace(&mut parted, true) {
            ui.separator();
        }
        for &(command, hit) in group {
            buttons::entry(ui, session, command, hit, actions);
        }
    }
    if let Hit::Part(part) = hits[0] {
        tendons::hand_over(ui, session, part, actions);
    }
}

/// Rings around places that were asked for, with a light around each that is seen from afar.
pub fn marked(ui: &Ui, canvas: &Canvas<'_>) {
    let (Some((design, places)), Ground::Plushie(_, Some(shape))) = (&canvas.session.look.marked, canvas.ground) else {
        return;
    };
    if shape.nodes.len() != design.mesh.nodes.len() {
        return;
    }
    let (painter, warn) = (ui.painter_at(canvas.rect), ui.visuals().warn_fg_color);
    for at in places {
        let middle = canvas.to_screen(design.mesh.position(at, &shape.nodes));
        painter.circle_stroke(middle, 16.0, Stroke::new(6.0, warn.gamma_multiply(0.25)));
        painter.circle_stroke(middle, 16.0, Stroke::new(2.0, warn));
    }
}

/// A ring around what the pointer is on, in both views.
pub fn highlight(ui: &Ui, canvas: &Canvas<'_>, hovered: Option<Hit>) {
    let Canvas { session, rect, .. } = *canvas;
    let Ground::Plushie(_, Some(shape)) = canvas.ground else { return };
    let design = session.design();
    if session.is_dragging() || shape.nodes.len() != design.mesh.nodes.len() {
        return;
    }
    let on_body = |at: &BodyPoint| design.mesh.position(at, &shape.nodes);
    let ring = |p: Point, radius: f32| {
        let stroke = Stroke::new(2.0, style::accent(session.look.theme));
        ui.painter_at(rect).circle_stroke(canvas.to_screen(p), radius, stroke);
    };
    match hovered {
        Some(Hit::Target(index)) => {
            if let Some(target) = session.targets().get(index) {
                ring(target.to, 11.0);
                ring(on_body(&target.at), 9.0);
            }
        }
        Some(Hit::Pin(index)) => {
            if let Some(pin) = design.pins.get(index) {
                ring(on_body(&pin.at), 10.0);
            }
        }
        Some(Hit::Part(part)) => {
            if let Some(place) = canvas.shown_part(part).filter(|_| !matches!(part, Part::Piece(..))) {
                ring(place, 11.0);
            }
        }
        Some(Hit::Body(at)) if at.triangle < design.mesh.triangles.len() => ring(on_body(&at), 7.0),
        _ => {}
    }
}
