//! Both views beside each other or stacked, one alone, or one over the other.

use super::picture::{Drawn, Picture};
use super::silhouettes::Silhouettes;
use super::{bars, captions, loads, pointer, rulers, strings, strip};
use crate::engine::Shape;
use crate::outline::{Point, polygon};
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Camera, Canvas, Ground, Hit, Plushie};
use crate::studio::language::t;
use crate::studio::session::{Session, Views};
use crate::studio::tools::Tool;
use eframe::egui::{Pos2, Rect, Role, Sense, Ui, Vec2, WidgetInfo, pos2, vec2};
use std::sync::Arc;

/// The state that the views keep from frame to frame.
#[derive(Default)]
pub struct State {
    views: [View; 2],
    silhouettes: Silhouettes,
    /// What is under the pointer, marked in both views.
    hovered: Option<Hit>,
}

#[derive(Default)]
struct View {
    picture: Picture,
    /// Where it was in the last frame, and what it showed.
    seen: Option<(Rect, Camera)>,
    /// Where the context menu was opened, mm.
    menu_at: Option<Point>,
}

impl State {
    /// Where a place in mm was on the screen in the last frame.
    pub fn on_screen(&self, plushie: Plushie, p: Point) -> Option<Pos2> {
        let (rect, camera) = self.views[plushie as usize].seen?;
        Some(camera.to_screen(rect, p))
    }
}

/// Shows both views, or the one that is not hidden.
pub fn show(ui: &mut Ui, session: &Session, state: &mut State, tool: &mut dyn Tool, actions: &mut Actions) {
    let area = ui.available_rect_before_wrap();
    let views = session.look.views;
    state.silhouettes.follow(session.design());
    let (mut hovered, mut foretold) = (None, None);
    for (plushie, rect) in rects(ui, session, area) {
        if !views.has_place(plushie) {
            state.views[plushie as usize].seen = None;
            continue;
        }
        let camera = session.look.camera_of(plushie).unwrap_or_else(|| fit(session, rect.size()));
        let shape = displayed(session, plushie);
        let canvas = Canvas { session, rect, camera, ground: Ground::Plushie(plushie, shape.map(Arc::as_ref)) };
        let hit = view(ui, &canvas, (plushie, shape), state, tool, actions);
        foretold = foretold.or(hit.and_then(|hit| tool.foretells(hit)));
        hovered = hovered.or(hit);
    }
    if foretold != session.foretold {
        actions.push(Action::Foretell(foretold));
    }
    if hovered != state.hovered {
        state.hovered = hovered;
        // The other view was drawn before this was known.
        ui.ctx().request_repaint();
    }
    strip::show(ui, session, area, actions);
    ui.allocate_rect(area, Sense::hover());
}

/// By how much larger a body must be shown before its views stand one above the other.
const STACKED: f32 = 1.2;

/// Where the views are; one that is hidden leaves its place to the other. Those of a wide body stand one above the other, unless that is not wanted.
fn rects(ui: &Ui, session: &Session, area: Rect) -> [(Plushie, Rect); 2] {
    let scale = |size: Vec2| fit(session, size).scale;
    let half = area.size() / 2.0;
    let wider = scale(vec2(area.width(), half.y)) > STACKED * scale(vec2(half.x, area.height()));
    let stacked = wider && session.look.stacks;
    let (left, right) = match session.look.views {
        Views::Only(_) | Views::Overlay => (area, area),
        Views::Both if stacked => {
            let middle = area.center().y.round();
            ui.painter().hline(area.x_range(), middle, ui.visuals().widgets.noninteractive.bg_stroke);
            let above = Rect::from_min_max(area.min, pos2(area.right(), middle - 1.0));
            (above, Rect::from_min_max(pos2(area.left(), middle + 1.0), area.max))
        }
        Views::Both => {
            let middle = area.center().x.round();
            ui.painter().vline(middle, area.y_range(), ui.visuals().widgets.noninteractive.bg_stroke);
            let left = Rect::from_min_max(area.min, pos2(middle - 1.0, area.bottom()));
            (left, Rect::from_min_max(pos2(middle + 1.0, area.top()), area.max))
        }
    };
    [(Plushie::Idealized, left), (Plushie::Realizable, right)]
}

/// One view; what lies under the pointer, if it is there. `drawn`: what there is to draw.
fn view(
    ui: &mut Ui,
    canvas: &Canvas<'_>,
    (plushie, drawn): (Plushie, Option<&Arc<Shape>>),
    state: &mut State,
    tool: &mut dyn Tool,
    actions: &mut Actions,
) -> Option<Hit> {
    let name = match plushie {
        Plushie::Idealized => t("Idealized view"),
        Plushie::Realizable => t("Realizable view"),
    };
    let response = ui.interact(canvas.rect, ui.scope_id().with(name), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, name));
    if canvas.rect.width() < 2.0 || canvas.rect.height() < 2.0 {
        return None;
    }
    if canvas.session.look().rulers {
        rulers::grid(ui, canvas);
    }
    let view = &mut state.views[plushie as usize];
    view.seen = Some((canvas.rect, canvas.camera));
    let bar = drawn.and_then(|shape| {
        let beside = displayed(canvas.session, plushie.other());
        let beside = beside.filter(|_| canvas.session.look().views.shows(plushie.other()));
        let body = state.silhouettes.newest()?;
        view.picture.paint(ui, canvas, &Drawn { plushie, shape, beside, body })
    });
    let hit = pointer::interact(ui, canvas, tool, &mut view.menu_at, &response, actions);
    strings::show(ui, canvas);
    loads::show(ui, canvas);
    pointer::marked(ui, canvas);
    pointer::highlight(ui, canvas, state.hovered);
    tool.paint(canvas, &ui.painter_at(canvas.rect), response.hover_pos());
    if canvas.session.look().rulers {
        rulers::show(ui, canvas, response.hover_pos());
    }
    captions::show(ui, canvas, plushie);
    if let Some(bar) = bar {
        bars::show(ui, canvas, &bar);
    }
    hit
}

/// The newest shape from the solver.
fn solved(session: &Session, plushie: Plushie) -> Option<&Arc<Shape>> {
    match plushie {
        Plushie::Idealized => session.solver.shapes.idealized.as_ref(),
        Plushie::Realizable => session.solver.shapes.realizable.as_ref(),
    }
}

/// The shape that a view shows now.
fn displayed(session: &Session, plushie: Plushie) -> Option<&Arc<Shape>> {
    let proposed = session.displayed_proposal().map(|proposal| &proposal.preview);
    let preview = proposed.map(|preview| session.discovery.struck().unwrap_or(preview));
    let preview = preview.filter(|shape| shape.nodes.len() == session.design().mesh.nodes.len());
    match plushie {
        Plushie::Realizable if preview.is_some() => preview,
        _ => solved(session, plushie),
    }
}

/// The body at rest, as large as the view allows beside what stands over it.
fn fit(session: &Session, size: Vec2) -> Camera {
    let (low, high) = polygon::bounding_box(&session.design().mesh.nodes);
    let rulers = if session.look().rulers { 2.0 * rulers::WIDTH } else { 0.0 };
    Camera::close(low, high, (size - Vec2::splat(rulers)).max(Vec2::splat(1.0)))
}
