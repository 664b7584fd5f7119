//! The sheet on which the outline is drawn: parts, their handles, and what they make together.

mod hand;
mod paint;
mod surface;

use super::action::{Action, FileAction};
use super::change::Change;
use super::commands::command::Scope;
use super::panels::Actions;
use super::session::Session;
use super::sketching::Sketch;
use super::viewport::camera::Camera;
use crate::outline::drawing::Item;
use crate::outline::{Drawing, Point, polygon};
use eframe::egui::{Rect, Role, Sense, Ui, WidgetInfo};
use surface::Surface;

/// Shown where nothing is drawn yet, mm.
const EMPTY_SHEET: (Point, Point) = ([0.0, 0.0], [300.0, 240.0]);

/// What the sheet remembers from frame to frame.
#[derive(Default)]
pub struct State {
    surface: Surface,
    hand: hand::Hand,
}

impl State {
    /// Puts a polygon or track that is not closed or ended into the drawing, before what ends drawing it is done: another pencil, a
    /// body, a closed sheet. One of too few points is dropped.
    pub fn finish_before(&mut self, session: &Session, actions: &mut Actions) {
        if !session.sketching().open {
            self.hand = hand::Hand::Nothing;
            return;
        }
        let ends = |action: &Action| match action {
            Action::Run(command, _) => {
                command.ends_drawing && !(command.scope == Scope::Outline && command.is_on(session))
            }
            // What was drawn is part of what is saved, or asked about.
            Action::File(FileAction::EditDialog(_) | FileAction::CloseDialog | FileAction::Browse) => false,
            Action::File(_) => true,
            _ => false,
        };
        let is_open = matches!(self.hand, hand::Hand::Corners(_) | hand::Hand::Track(_));
        if let Some(first) = actions.iter().position(ends).filter(|_| is_open) {
            let finished = hand::put_down(session, std::mem::take(&mut self.hand), 1.0);
            actions.splice(first..first, finished);
        }
    }

    /// The drawing with what is only being drawn, if anything is.
    pub fn unfinished(&self, session: &Session) -> Option<Drawing> {
        if !session.sketching().open || matches!(self.hand, hand::Hand::Nothing | hand::Hand::Pans) {
            return None;
        }
        let put_down = hand::put_down(session, self.hand.clone(), 1.0);
        put_down.into_iter().find_map(|action| match action {
            Action::Change(Change::Draw { drawing, .. }) => Some(drawing),
            _ => None,
        })
    }

    /// What is drawn, worked out anew only where it has changed.
    pub fn surface(&mut self, drawing: &Drawing) -> &Surface {
        self.surface.follow(drawing);
        &self.surface
    }
}

/// The sheet in this frame.
#[derive(Clone, Copy)]
struct Sheet<'a> {
    session: &'a Session,
    rect: Rect,
    camera: Camera,
}

impl Sheet<'_> {
    fn mm_per_pixel(&self) -> f64 {
        f64::from(1.0 / self.camera.scale)
    }

    /// What is picked out.
    fn selected(&self) -> Option<Item> {
        self.session.sketching().item.filter(|&item| self.session.drawing().has(item))
    }
}

pub fn show(ui: &mut Ui, session: &Session, state: &mut State, actions: &mut Actions) {
    let rect = ui.available_rect_before_wrap();
    let response = ui.interact(rect, ui.scope_id().with("drawing sheet"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Drawing sheet"));
    if rect.width() < 2.0 || rect.height() < 2.0 {
        return;
    }
    // It stays where it is while the drawing grows: what lies under the hand must not move away.
    let camera = session.sketching().camera.unwrap_or_else(|| {
        let camera = fit(session, rect);
        actions.push(Action::Sketch(Sketch::Camera(Some(camera))));
        camera
    });
    let sheet = Sheet { session, rect, camera };
    state.surface.follow(session.drawing());
    hand::act(ui, &sheet, &mut state.hand, &response, actions);
    navigate(ui, &sheet, &response, actions);
    paint::show(ui, &sheet, state, response.hover_pos());
    ui.allocate_rect(rect, Sense::hover());
}

/// Shows the drawing, and the body as it is.
fn fit(session: &Session, rect: Rect) -> Camera {
    let drawn = session.drawing().parts.iter().map(|part| part.primitive.polygon());
    let mut points: Vec<Point> = drawn.flatten().chain(session.drawing().tracks.iter().flatten().copied()).collect();
    if !points.is_empty() && !session.sketching().fresh {
        points.extend(&session.design().outline.outer);
    }
    let (low, high) = if points.is_empty() { EMPTY_SHEET } else { polygon::bounding_box(&points) };
    Camera::fit(low, high, rect.size())
}

/// Panning with the middle button, zooming with the wheel.
fn navigate(ui: &Ui, sheet: &Sheet<'_>, response: &eframe::egui::Response, actions: &mut Actions) {
    /// Logical pixels of scrolling that double the scale.
    const SCROLL_TO_DOUBLE: f32 = 260.0;
    let Sheet { rect, camera, .. } = *sheet;
    if response.dragged_by(eframe::egui::PointerButton::Middle) {
        let moved = camera.panned(response.drag_delta());
        actions.push(Action::Sketch(Sketch::Camera(Some(moved))));
    }
    if let Some(factor) = sheet.session.look().zoom {
        actions.push(Action::Sketch(Sketch::Camera(Some(camera.zoomed(rect, rect.center(), factor)))));
    }
    if let Some(pointer) = response.hover_pos() {
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta.y, i.zoom_delta()));
        let factor = (scroll / SCROLL_TO_DOUBLE).exp2() * pinch;
        if factor != 1.0 {
            let zoomed = camera.zoomed(rect, pointer, factor);
            actions.push(Action::Sketch(Sketch::Camera(Some(zoomed))));
        }
    }
}
