//! From the pointer to the tool, the same on every canvas; and moving about.

use super::camera::Camera;
use super::ground::{Canvas, Ground};
use crate::outline::Point;
use crate::studio::action::Actions;
use crate::studio::tools::Tool;
use eframe::egui::{Context, Event, Id, PointerButton, Response, Ui};

/// Logical pixels of scrolling that double the scale.
const SCROLL_TO_DOUBLE: f32 = 260.0;

/// Where the canvas that was clicked last is known.
const CLICKED_CANVAS: &str = "canvas that was clicked last";

/// Whether a canvas has the focus: there Space and Enter press nothing.
pub fn has_focus(ctx: &Context) -> bool {
    let clicked = ctx.data(|data| data.get_temp::<Id>(Id::unique(CLICKED_CANVAS)));
    clicked.is_some() && ctx.memory(|memory| memory.focused()) == clicked
}

/// Tells the tool what the hand does.
pub fn act(ui: &mut Ui, canvas: &Canvas<'_>, tool: &mut dyn Tool, response: &Response, actions: &mut Actions) {
    let press = ui.input(|i| i.pointer.press_origin()).map(|p| canvas.to_body(p));
    if let Some(press) = press.filter(|_| response.drag_started_by(PointerButton::Primary)) {
        tool.press(canvas, press, actions);
    }
    let pointer = response.interact_pointer_pos().map(|p| canvas.to_body(p));
    if let Some(at) = pointer.filter(|_| response.dragged_by(PointerButton::Primary)) {
        // Where frames are slow a hand goes more than a step in each.
        let mut way: Vec<Point> = ui.input(|i| {
            let moved = i.events.iter().filter_map(|event| match event {
                Event::PointerMoved(p) => Some(canvas.to_body(*p)),
                _ => None,
            });
            moved.collect()
        });
        way.push(at);
        tool.drag(canvas, &way, actions);
    }
    if response.drag_stopped_by(PointerButton::Primary) {
        tool.release(canvas, pointer, actions);
    }
    if let Some(at) = pointer.filter(|_| response.clicked()) {
        response.request_focus();
        ui.data_mut(|data| data.insert_temp(Id::unique(CLICKED_CANVAS), response.id));
        tool.click(canvas, at, response.double_clicked(), actions);
    }
    if let Some(at) = response.hover_pos() {
        ui.ctx().set_cursor_icon(tool.cursor(canvas, tool.under(canvas, canvas.to_body(at))));
    }
}

/// Panning with the middle button, zooming with the wheel, fingers or keys.
pub fn navigate(ui: &Ui, canvas: &Canvas<'_>, response: &Response, actions: &mut Actions) {
    let Canvas { session, rect, camera, .. } = *canvas;
    if response.dragged_by(PointerButton::Middle) {
        actions.push(canvas.look(camera.panned(response.drag_delta())));
    }
    if let Some(pointer) = response.hover_pos() {
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta.y, i.zoom_delta()));
        let factor = (scroll / SCROLL_TO_DOUBLE).exp2() * pinch;
        if factor != 1.0 {
            actions.push(canvas.look(camera.zoomed(rect, pointer, factor)));
        }
    }
    if let (Ground::Plushie(..), Some([low, high])) = (canvas.ground, session.look().frame) {
        actions.push(canvas.look(Camera::close(low, high, rect.size())));
    }
    if let Some(factor) = session.look().zoom {
        actions.push(canvas.look(camera.zoomed(rect, rect.center(), factor)));
    }
}
