//! The two pictures of the plushie: drawing, navigating, dragging.

pub mod camera;
pub mod geometry;
pub mod hit;
pub mod renderer;

use super::action::{Action, Grab};
use super::change::Change;
use super::panels::Actions;
use super::session::{Mode, Selection, Session, Tool};
use super::style;
use crate::design::Design;
use crate::engine::{Proposal, Shape};
use crate::outline::Point;
use crate::picture::palette::Theme;
use crate::picture::scene::{self, Options, Stage};
use camera::Camera;
use eframe::egui::{
    Align2, CursorIcon, FontId, Key, PointerButton, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo,
    pos2,
};
use geometry::Geometry;
use hit::Hit;
use renderer::ViewCallback;
use std::sync::Arc;

/// Which of the two plushies a view shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plushie {
    Idealized,
    Realizable,
}

/// What the views remember from frame to frame.
#[derive(Default)]
pub struct State {
    views: [View; 2],
    /// Body point under the pointer, shown in both views.
    hovered: Hovered,
}

#[derive(Default)]
struct View {
    /// The drawing, and what it was made from.
    drawn: Option<(Drawn, Arc<Geometry>)>,
    /// Where the context menu was opened, mm.
    menu_at: Option<Point>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Hovered {
    hit: Option<Hit>,
}

/// Everything a drawing depends on. It keeps what it was made from alive, so that equal addresses mean equal things.
struct Drawn {
    design: Arc<Design>,
    shape: Option<Arc<Shape>>,
    proposal: Option<Arc<Proposal>>,
    options: (Stage, Option<usize>, Mode, Selection, Theme, bool, bool),
}

impl Drawn {
    fn new(session: &Session, plushie: Plushie) -> Self {
        let look = &session.look;
        Self {
            design: session.design().clone(),
            shape: solved(session, plushie).cloned(),
            proposal: session.shown_proposal().cloned(),
            options: (
                session.discovery.stage,
                session.pose,
                session.mode,
                session.selection,
                look.theme,
                look.fibers,
                look.networks,
            ),
        }
    }

    fn same(&self, other: &Self) -> bool {
        fn same<T>(a: &Option<Arc<T>>, b: &Option<Arc<T>>) -> bool {
            a.as_ref().map(Arc::as_ptr) == b.as_ref().map(Arc::as_ptr)
        }
        Arc::ptr_eq(&self.design, &other.design)
            && same(&self.shape, &other.shape)
            && same(&self.proposal, &other.proposal)
            && self.options == other.options
    }
}

/// Shows both views side by side. `gpu`: whether there is anything to draw them with.
pub fn show(ui: &mut Ui, session: &Session, state: &mut State, gpu: bool, actions: &mut Actions) {
    let area = ui.available_rect_before_wrap();
    let middle = area.center().x.round();
    let line = ui.visuals().widgets.noninteractive.bg_stroke;
    ui.painter().vline(middle, area.y_range(), line);
    let left = Rect::from_min_max(area.min, pos2(middle - 1.0, area.bottom()));
    let right = Rect::from_min_max(pos2(middle + 1.0, area.top()), area.max);
    let mut hovered = Hovered::default();
    for (plushie, rect) in [(Plushie::Idealized, left), (Plushie::Realizable, right)] {
        let hit = view(ui, session, state, plushie, rect, gpu, actions);
        hovered.hit = hovered.hit.or(hit);
    }
    if hovered != state.hovered {
        state.hovered = hovered;
        // The other view was drawn before this was known.
        ui.ctx().request_repaint();
    }
    ui.allocate_rect(area, Sense::hover());
}

/// One view; what lies under the pointer, if it is there.
fn view(
    ui: &mut Ui,
    session: &Session,
    state: &mut State,
    plushie: Plushie,
    rect: Rect,
    gpu: bool,
    actions: &mut Actions,
) -> Option<Hit> {
    let name = match plushie {
        Plushie::Idealized => "Idealized view",
        Plushie::Realizable => "Realizable view",
    };
    let response = ui.interact(rect, ui.scope_id().with(name), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, name));
    if rect.width() < 2.0 || rect.height() < 2.0 {
        return None;
    }
    let camera = session.look.camera.unwrap_or_else(|| fit(session.design(), rect.size()));
    let shape = displayed(session, plushie);
    let mut hit = None;
    if let Some(shape) = shape {
        if gpu {
            paint(ui, session, &mut state.views[plushie as usize], plushie, rect, camera, shape);
        }
        hit = interact(ui, session, state, plushie, &response, camera, shape, actions);
        highlight(ui, session, &state.hovered, rect, camera, shape);
    }
    navigate(ui, &response, rect, camera, actions);
    captions(ui, session, plushie, rect, camera);
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
fn displayed(session: &Session, plushie: Plushie) -> Option<&Shape> {
    let preview = session.shown_proposal().map(|proposal| &proposal.preview);
    let preview = preview.filter(|shape| shape.nodes.len() == session.design().mesh.nodes.len());
    match plushie {
        Plushie::Realizable if preview.is_some() => preview,
        _ => solved(session, plushie).map(Arc::as_ref),
    }
}

fn fit(design: &Design, size: Vec2) -> Camera {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in &design.mesh.nodes {
        for axis in 0..2 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
    Camera::fit(low, high, size)
}

fn paint(ui: &Ui, session: &Session, view: &mut View, plushie: Plushie, rect: Rect, camera: Camera, shape: &Shape) {
    let drawn = Drawn::new(session, plushie);
    let geometry = match &view.drawn {
        Some((before, geometry)) if before.same(&drawn) => geometry.clone(),
        _ => {
            let geometry = Arc::new(Geometry::of(&draw(session, plushie, shape)));
            view.drawn = Some((drawn, geometry.clone()));
            geometry
        }
    };
    let callback = ViewCallback { slot: plushie as u64, camera, size: rect.size(), geometry };
    ui.painter().add(egui_wgpu::Callback::new_paint_callback(rect, callback));
}

fn draw(session: &Session, plushie: Plushie, shape: &Shape) -> crate::picture::Scene {
    let look = &session.look;
    let selected_target = match session.selection {
        Selection::Target(index) => Some(index),
        _ => None,
    };
    let options = Options {
        theme: look.theme,
        fibers: look.fibers && plushie == Plushie::Idealized,
        networks: look.networks,
        pins: true,
        targets: session.targets(),
        selected_target,
        stage: None,
    };
    match (plushie, session.shown_proposal()) {
        (Plushie::Idealized, Some(proposal)) => {
            let stage = Some((session.discovery.stage, &proposal.stages));
            scene::scene(session.design(), shape, &Options { stage, ..options })
        }
        (Plushie::Realizable, Some(proposal)) => {
            let mut design = Design::clone(session.design());
            design.networks.push(proposal.network.clone());
            scene::scene(&design, shape, &options)
        }
        _ => scene::scene(session.design(), shape, &options),
    }
}

#[expect(clippy::too_many_arguments)]
fn interact(
    ui: &mut Ui,
    session: &Session,
    state: &mut State,
    plushie: Plushie,
    response: &Response,
    camera: Camera,
    shape: &Shape,
    actions: &mut Actions,
) -> Option<Hit> {
    let rect = response.rect;
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
    let view = &mut state.views[plushie as usize];
    if response.secondary_clicked() {
        view.menu_at = pointer;
    }
    if let Some(at) = view.menu_at {
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
    let mut entry = |ui: &mut Ui, name: &str, action: Action| {
        if ui.button(name).clicked() {
            actions.push(action);
            ui.close();
        }
    };
    match (hit, session.pose) {
        (Hit::Target(index), Some(pose)) => {
            entry(ui, "Remove target", Action::Change(Change::RemoveTarget { pose, index }));
            if let Some(target) = session.targets().get(index) {
                entry(ui, "Pin this point", Action::Change(Change::AddPin(target.at)));
            }
        }
        (Hit::Pin(index), _) => entry(ui, "Unpin", Action::Change(Change::RemovePin(index))),
        (Hit::Body(at), _) => entry(ui, "Pin this point", Action::Change(Change::AddPin(at))),
        _ => {}
    }
    if let Some(pose) = session.pose.filter(|_| !session.targets().is_empty()) {
        entry(ui, "Remove all targets", Action::Change(Change::ClearTargets(pose)));
    }
    entry(ui, "Fit view", Action::Fit);
}

/// A ring around what the pointer is on, in both views.
fn highlight(ui: &Ui, session: &Session, hovered: &Hovered, rect: Rect, camera: Camera, shape: &Shape) {
    if session.is_dragging() {
        return;
    }
    let design = session.design();
    let on_body = |at: &crate::mesh::BodyPoint| design.mesh.position(at, &shape.nodes);
    let ring = |p: Point, radius: f32| {
        let stroke = Stroke::new(2.0, style::accent(session.look.theme));
        ui.painter_at(rect).circle_stroke(camera.to_screen(rect, p), radius, stroke);
    };
    if shape.nodes.len() != design.mesh.nodes.len() {
        return;
    }
    match hovered.hit {
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

fn navigate(ui: &Ui, response: &Response, rect: Rect, camera: Camera, actions: &mut Actions) {
    /// Logical pixels of scrolling that double the scale.
    const SCROLL_TO_DOUBLE: f32 = 260.0;
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
        actions.push(Action::Fit);
    }
    if response.has_focus() {
        let factor = ui.input(|i| {
            let key = |key| i32::from(i.key_pressed(key));
            key(Key::Plus) + key(Key::Equals) - key(Key::Minus)
        });
        if factor != 0 {
            actions.push(Action::SetCamera(camera.zoomed(rect, rect.center(), 1.25_f32.powi(factor))));
        }
    }
}

fn captions(ui: &Ui, session: &Session, plushie: Plushie, rect: Rect, camera: Camera) {
    let painter = ui.painter_at(rect);
    let (title, detail) = match (plushie, session.shown_proposal()) {
        (Plushie::Idealized, Some(_)) => ("Idealized", stage_name(session.discovery.stage).to_owned()),
        (Plushie::Realizable, Some(p)) => {
            ("Realizable", format!("with the proposal, error {:.1} %", 100.0 * p.error_after))
        }
        (Plushie::Idealized, None) => ("Idealized", "muscle fibres".to_owned()),
        (Plushie::Realizable, None) => ("Realizable", networks_text(session)),
    };
    let corner = rect.left_top() + Vec2::new(14.0, 10.0);
    let text = ui.visuals().strong_text_color();
    let weak = ui.visuals().weak_text_color();
    let title = painter.text(corner, Align2::LEFT_TOP, title, FontId::proportional(15.0), text);
    painter.text(
        title.right_bottom() + Vec2::new(8.0, -1.5),
        Align2::LEFT_BOTTOM,
        detail,
        FontId::proportional(12.0),
        weak,
    );
    scale_bar(ui, rect, camera);
}

fn stage_name(stage: Stage) -> &'static str {
    match stage {
        Stage::Activation => "activation graph",
        Stage::Seeds => "seeds and starting component",
        Stage::Tree => "winch tree with joining paths",
        Stage::Result => "winch and tendons",
    }
}

fn networks_text(session: &Session) -> String {
    match session.design().networks.len() {
        0 => "no winches yet".to_owned(),
        1 => "1 winch".to_owned(),
        n => format!("{n} winches"),
    }
}

/// A length in mm, lower left.
fn scale_bar(ui: &Ui, rect: Rect, camera: Camera) {
    let Some(length_mm) = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 5000.0]
        .into_iter()
        .find(|mm| mm * camera.scale > 48.0)
    else {
        return;
    };
    let painter = ui.painter_at(rect);
    let weak = ui.visuals().weak_text_color();
    let stroke = Stroke::new(1.5, weak);
    let start = rect.left_bottom() + Vec2::new(14.0, -14.0);
    let end: Pos2 = start + Vec2::new(length_mm * camera.scale, 0.0);
    painter.line_segment([start, end], stroke);
    for p in [start, end] {
        painter.line_segment([p - Vec2::new(0.0, 3.0), p + Vec2::new(0.0, 3.0)], stroke);
    }
    let text = format!("{length_mm:.0} mm");
    painter.text(
        start.lerp(end, 0.5) - Vec2::new(0.0, 4.0),
        Align2::CENTER_BOTTOM,
        text,
        FontId::proportional(11.0),
        weak,
    );
}
