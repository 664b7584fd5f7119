//! The sheet on which the outline is drawn: parts, their handles, and what they make together.

use super::ground::{Canvas, Ground};
use super::surface::Surface;
use super::{camera::Camera, paint, pointer};
use crate::outline::{Drawing, Point, polygon};
use crate::studio::action::Action;
use crate::studio::action::Actions;
use crate::studio::action::Sketch;
use crate::studio::language::t;
use crate::studio::session::Session;
use crate::studio::tools::Tool;
use eframe::egui::{Rect, Role, Sense, Ui, WidgetInfo};

/// Shown where nothing is drawn yet, mm.
const EMPTY_SHEET: (Point, Point) = ([0.0, 0.0], [300.0, 240.0]);

/// The state that the sheet keeps from frame to frame.
#[derive(Default)]
pub struct State {
    surface: Surface,
}

impl State {
    /// The surface of a drawing, worked out anew only where it has changed.
    pub fn surface(&mut self, drawing: &Drawing) -> &Surface {
        self.surface.follow(drawing);
        &self.surface
    }
}

pub fn show(ui: &mut Ui, session: &Session, state: &mut State, tool: &mut dyn Tool, hint: &str, actions: &mut Actions) {
    let rect = ui.available_rect_before_wrap();
    let response = ui.interact(rect, ui.scope_id().with("drawing sheet"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, t("Drawing sheet")));
    if rect.width() < 2.0 || rect.height() < 2.0 {
        return;
    }
    // It stays where it is while the drawing grows: what lies under the hand must not move away.
    let camera = session.sketching().camera.unwrap_or_else(|| {
        let camera = fit(session, rect);
        actions.push(Action::Sketch(Sketch::Camera(Some(camera))));
        camera
    });
    let ground = Ground::Outline(state.surface(session.drawing()));
    let canvas = Canvas { session, rect, camera, ground };
    pointer::act(ui, &canvas, tool, &response, actions);
    pointer::navigate(ui, &canvas, &response, actions);
    paint::show(ui, &canvas);
    tool.paint(&canvas, &ui.painter_at(rect), response.hover_pos());
    paint::captions(ui, &canvas, tool.hint(session).unwrap_or(hint), tool.waits());
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
