//! The pointer in a view: dragging, pinning, menus, panning and zooming.

use super::Pane;
use super::hit::{self, Hit};
use crate::engine::Shape;
use crate::mesh::BodyPoint;
use crate::outline::Point;
use crate::studio::action::{Action, Grab};
use crate::studio::change::Change;
use crate::studio::commands::view::FIT;
use crate::studio::commands::{self, Place};
use crate::studio::panels::{Actions, buttons};
use crate::studio::session::{Selection, Session, Tool};
use crate::studio::style;
use eframe::egui::{CursorIcon, PointerButton, Response, Stroke, Ui, Vec2};

/// Drags, clicks and the context menu; what lies under the pointer. `menu_at`: where the menu was opened, mm.
pub fn interact(
    ui: &mut Ui,
    pane: &Pane<'_>,
    menu_at: &mut Option<Point>,
    response: &Response,
    shape: &Shape,
    actions: &mut Actions,
) -> Option<Hit> {
    let Pane { session, rect, camera, .. } = *pane;
    let mm_per_pixel = f64::from(1.0 / camera.scale);
    let hit_at = |p: Point| hit::test(session.design(), session.targets(), &shape.nodes, p, mm_per_pixel);
    let press = ui.input(|i| i.pointer.press_origin()).map(|p| camera.to_body(rect, p));
    if let Some(press) = press.filter(|_| response.drag_started_by(PointerButton::Primary)) {
        begin_drag(session, hit_at(press), press, shape, actions);
    }
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged_by(PointerButton::Primary)) {
        actions.push(Action::DragTo(camera.to_body(rect, pointer)));
    }
    if response.drag_stopped() {
        actions.push(Action::Release);
    }
    let pointer = response.hover_pos().map(|p| camera.to_body(rect, p));
    if let Some(p) = pointer.filter(|_| response.clicked()) {
        click(session, hit_at(p), actions);
        response.request_focus();
    }
    if response.secondary_clicked() {
        *menu_at = pointer;
    }
    if let Some(at) = *menu_at {
        let hit = hit_at(at);
        response.context_menu(|ui| menu(ui, session, hit, actions));
    }
    let hit = pointer.map(hit_at);
    if session.is_dragging() && response.dragged() {
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    } else if let Some(hit) = hit.filter(|hit| *hit != Hit::Nothing) {
        let over_body = matches!(hit, Hit::Body(_));
        ui.ctx().set_cursor_icon(if session.tool == Tool::Pin && over_body {
            CursorIcon::Crosshair
        } else {
            CursorIcon::Grab
        });
    }
    hit
}

fn begin_drag(session: &Session, hit: Hit, press: Point, shape: &Shape, actions: &mut Actions) {
    let design = session.design();
    let body = |at| Grab::Body(at, design.mesh.position(&at, &shape.nodes));
    let what = match (session.tool, hit) {
        (_, Hit::Target(index)) => Grab::Target(index),
        (Tool::Drag, Hit::Body(at)) => body(at),
        (Tool::Drag, Hit::Pin(index)) => match design.pins.get(index) {
            Some(pin) => body(pin.at),
            None => return,
        },
        _ => return,
    };
    actions.push(Action::Grab { what, pointer: press });
}

fn click(session: &Session, hit: Hit, actions: &mut Actions) {
    actions.push(match (session.tool, hit) {
        (Tool::Pin, Hit::Body(at)) => Action::Change(Change::AddPin(at)),
        (Tool::Pin, Hit::Pin(index)) => Action::Change(Change::RemovePin(index)),
        (_, Hit::Target(index)) => Action::Select(Selection::Target(index)),
        (_, Hit::Pin(index)) => Action::Select(Selection::Pin(index)),
        _ => Action::Select(Selection::Nothing),
    });
}

fn menu(ui: &mut Ui, session: &Session, hit: Hit, actions: &mut Actions) {
    ui.set_min_width(170.0);
    for command in commands::at(Place::ContextMenu).filter(|command| command.refused(session, hit).is_none()) {
        buttons::entry(ui, session, command, hit, actions);
    }
}

/// A ring around what the pointer is on, in both views.
pub fn highlight(ui: &Ui, pane: &Pane<'_>, hovered: Option<Hit>, shape: &Shape) {
    let Pane { session, rect, camera, .. } = *pane;
    if session.is_dragging() {
        return;
    }
    let design = session.design();
    let on_body = |at: &BodyPoint| design.mesh.position(at, &shape.nodes);
    let ring = |p: Point, radius: f32| {
        let stroke = Stroke::new(2.0, style::accent(session.look.theme));
        ui.painter_at(rect).circle_stroke(camera.to_screen(rect, p), radius, stroke);
    };
    if shape.nodes.len() != design.mesh.nodes.len() {
        return;
    }
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
        Some(Hit::Body(at)) if at.triangle < design.mesh.triangles.len() => ring(on_body(&at), 7.0),
        _ => {}
    }
}

/// Panning and zooming.
pub fn navigate(ui: &Ui, pane: &Pane<'_>, response: &Response, actions: &mut Actions) {
    /// Logical pixels of scrolling that double the scale.
    const SCROLL_TO_DOUBLE: f32 = 260.0;
    let Pane { session, rect, camera, .. } = *pane;
    let dragging_view = response.dragged_by(PointerButton::Middle) || response.dragged_by(PointerButton::Primary);
    let delta = response.drag_delta();
    if dragging_view && delta != Vec2::ZERO {
        let always = response.dragged_by(PointerButton::Middle);
        actions.push(Action::Pan { from: camera, delta, always });
    }
    if let Some(pointer) = response.hover_pos() {
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta.y, i.zoom_delta()));
        let factor = (scroll / SCROLL_TO_DOUBLE).exp2() * pinch;
        if factor != 1.0 {
            actions.push(Action::SetCamera(camera.zoomed(rect, pointer, factor)));
        }
    }
    if response.double_clicked() {
        actions.push(Action::Run(&FIT, Hit::Nothing));
    }
    if let Some(factor) = session.look.zoom {
        actions.push(Action::SetCamera(camera.zoomed(rect, rect.center(), factor)));
    }
}
