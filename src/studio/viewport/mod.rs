//! The two pictures of the plushie: drawing, navigating, dragging.

pub mod camera;
mod captions;
pub mod geometry;
pub mod hit;
mod picture;
pub mod renderer;
mod skin;
pub mod thumbnail;
mod tools;

use super::panels::Actions;
use super::session::{Session, Views};
use crate::design::Design;
use crate::engine::Shape;
use crate::outline::Point;
use camera::Camera;
use eframe::egui::{Rect, Role, Sense, Ui, Vec2, WidgetInfo, pos2};
use hit::Hit;
use std::sync::Arc;

/// Which of the two plushies a view shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plushie {
    Idealized,
    Realizable,
}

impl Plushie {
    pub fn other(self) -> Self {
        match self {
            Self::Idealized => Self::Realizable,
            Self::Realizable => Self::Idealized,
        }
    }
}

/// What the views remember from frame to frame.
#[derive(Default)]
pub struct State {
    views: [View; 2],
    /// What is under the pointer, marked in both views.
    hovered: Option<Hit>,
}

#[derive(Default)]
struct View {
    picture: picture::Picture,
    /// Where the context menu was opened, mm.
    menu_at: Option<Point>,
}

/// A view in this frame.
#[derive(Clone, Copy)]
struct Pane<'a> {
    session: &'a Session,
    plushie: Plushie,
    rect: Rect,
    camera: Camera,
}

/// Shows both views side by side, or the one that is not hidden. `gpu`: whether there is anything to draw them with.
pub fn show(ui: &mut Ui, session: &Session, state: &mut State, gpu: bool, actions: &mut Actions) {
    let area = ui.available_rect_before_wrap();
    let views = session.look.views;
    let mut hovered = None;
    for (plushie, rect) in rects(ui, views, area) {
        if !views.shows(plushie) {
            continue;
        }
        let camera = session.look.camera.unwrap_or_else(|| fit(session.design(), rect.size()));
        let hit = view(ui, &Pane { session, plushie, rect, camera }, state, gpu, actions);
        hovered = hovered.or(hit);
    }
    if hovered != state.hovered {
        state.hovered = hovered;
        // The other view was drawn before this was known.
        ui.ctx().request_repaint();
    }
    ui.allocate_rect(area, Sense::hover());
}

/// Where the views are; one that is hidden leaves its place to the other.
fn rects(ui: &Ui, views: Views, area: Rect) -> [(Plushie, Rect); 2] {
    let (left, right) = match views {
        Views::Only(_) => (area, area),
        Views::Both => {
            let middle = area.center().x.round();
            ui.painter().vline(middle, area.y_range(), ui.visuals().widgets.noninteractive.bg_stroke);
            let left = Rect::from_min_max(area.min, pos2(middle - 1.0, area.bottom()));
            (left, Rect::from_min_max(pos2(middle + 1.0, area.top()), area.max))
        }
    };
    [(Plushie::Idealized, left), (Plushie::Realizable, right)]
}

/// One view; what lies under the pointer, if it is there.
fn view(ui: &mut Ui, pane: &Pane<'_>, state: &mut State, gpu: bool, actions: &mut Actions) -> Option<Hit> {
    let name = match pane.plushie {
        Plushie::Idealized => "Idealized view",
        Plushie::Realizable => "Realizable view",
    };
    let response = ui.interact(pane.rect, ui.scope_id().with(name), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, name));
    if pane.rect.width() < 2.0 || pane.rect.height() < 2.0 {
        return None;
    }
    let view = &mut state.views[pane.plushie as usize];
    let mut hit = None;
    if let Some(shape) = displayed(pane.session, pane.plushie) {
        if gpu {
            view.picture.paint(ui, pane, shape);
        }
        hit = tools::interact(ui, pane, &mut view.menu_at, &response, shape, actions);
        tools::highlight(ui, pane, state.hovered, shape);
    }
    tools::navigate(ui, pane, &response, actions);
    captions::show(ui, pane);
    hit
}

/// The newest shape from the solver.
fn solved(session: &Session, plushie: Plushie) -> Option<&Arc<Shape>> {
    match plushie {
        Plushie::Idealized => session.shapes.idealized.as_ref(),
        Plushie::Realizable => session.shapes.realizable.as_ref(),
    }
}

/// The shape that a view shows now.
fn displayed(session: &Session, plushie: Plushie) -> Option<&Arc<Shape>> {
    let preview = session.shown_proposal().map(|proposal| &proposal.preview);
    let preview = preview.filter(|shape| shape.nodes.len() == session.design().mesh.nodes.len());
    match plushie {
        Plushie::Realizable if preview.is_some() => preview,
        _ => solved(session, plushie),
    }
}

fn fit(design: &Design, size: Vec2) -> Camera {
    let (low, high) = bounds(design);
    Camera::fit(low, high, size)
}

/// The box around the rest shape, mm.
fn bounds(design: &Design) -> (Point, Point) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in &design.mesh.nodes {
        for axis in 0..2 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
    (low, high)
}
