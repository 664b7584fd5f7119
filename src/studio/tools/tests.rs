use super::*;
use crate::outline::Point;
use crate::outline::drawing::Primitive;
use crate::studio::action::Sketch;
use crate::studio::action::{Action, Actions};
use crate::studio::blank;
use crate::studio::canvas::{Camera, Canvas, Ground, Hit, Plushie, Surface};
use crate::studio::change::Change;
use crate::studio::commands::command::Scope;
use crate::studio::session::{Selection, Session};
use eframe::egui::{CursorIcon, Key, Rect, pos2};
use std::sync::Arc;

const RECT: Rect = Rect { min: pos2(0.0, 0.0), max: pos2(480.0, 300.0) };
const CAMERA: Camera = Camera { center: [120.0, 75.0], scale: 2.0 };

fn session() -> Session {
    Session::new(blank::design(), None, Arc::new(|| ()), crate::studio::services())
}

fn entry(id: &str) -> &'static Entry {
    ALL.into_iter().find(|entry| entry.id == id).unwrap()
}

/// What a hand at work on an outline comes to.
fn draw(session: &Session, id: &str, hand: impl FnOnce(&mut dyn Tool, &Canvas<'_>, &mut Actions)) -> Actions {
    let surface = Surface::default();
    let canvas = Canvas { session, rect: RECT, camera: CAMERA, ground: Ground::Outline(&surface) };
    let (mut tool, mut actions) = ((entry(id).make)(), Vec::new());
    hand(&mut *tool, &canvas, &mut actions);
    actions
}

fn primitive(actions: &[Action]) -> &Primitive {
    let [Action::Change(Change::Draw { drawing, .. }), Action::Sketch(Sketch::Select(Some(_), None))] = actions else {
        panic!("{actions:?}")
    };
    &drawing.parts.last().unwrap().primitive
}

#[test]
fn every_tool_has_a_canvas_a_key_and_a_hint_and_each_canvas_a_first_tool() {
    for (k, entry) in ALL.iter().enumerate() {
        assert!(ALL[..k].iter().all(|other| other.id != entry.id));
        assert!(entry.canvas != Scope::Anywhere && entry.keys.len() == 1 && entry.hint.len() > 3, "{}", entry.id);
        assert_eq!(entry.icon.is_some(), entry.canvas == Scope::Views, "{}", entry.id);
    }
    let session = session();
    let first = [Scope::Views, Scope::Outline].map(|canvas| taken(&session, canvas).id);
    assert_eq!(first, ["tool.drag", "tool.select"]);
}

#[test]
fn a_circle_is_dragged_or_clicked_and_escape_drops_it() {
    let session = session();
    let dragged = draw(&session, "tool.circle", |tool, canvas, actions| {
        tool.press(canvas, [10.0, 10.0], actions);
        tool.drag(canvas, &[[11.0, 10.0], [40.0, 50.0]], actions);
        assert!(tool.pending(canvas.session, 0.5).is_some() && actions.is_empty(), "not before the hand lets go");
        tool.release(canvas, None, actions);
        assert_eq!(tool.pending(canvas.session, 0.5), None);
    });
    assert_eq!(*primitive(&dragged), Primitive::Circle { center: [10.0, 10.0], radius: 50.0 });
    let clicked = draw(&session, "tool.circle", |tool, canvas, actions| tool.click(canvas, [1.0, 2.0], false, actions));
    assert_eq!(*primitive(&clicked), Primitive::Circle { center: [1.0, 2.0], radius: 15.0 }, "30 pixels");
    let dropped = draw(&session, "tool.capsule", |tool, canvas, actions| {
        assert!(!tool.key(canvas.session, Key::Escape, actions), "nothing to drop: the key is somebody else's");
        tool.press(canvas, [10.0, 10.0], actions);
        assert!(tool.key(canvas.session, Key::Escape, actions));
        tool.drag(canvas, &[[40.0, 50.0]], actions);
        tool.release(canvas, Some([40.0, 50.0]), actions);
    });
    assert_eq!(dropped, []);
}

#[test]
fn a_polygon_waits_for_its_corners_and_closes_on_the_first_one() {
    let session = session();
    let corners: [Point; 4] = [[0.0, 0.0], [80.0, 0.0], [40.0, 60.0], [0.5, 0.5]];
    let closed = draw(&session, "tool.polygon", |tool, canvas, actions| {
        for (k, at) in corners.into_iter().enumerate() {
            assert_eq!((tool.waits(), tool.hint(canvas.session).is_some()), (k > 0, k > 0));
            tool.click(canvas, at, false, actions);
        }
        assert!(!tool.waits());
    });
    assert!(matches!(primitive(&closed), Primitive::Path { points } if points.len() == 3));
    let entered = draw(&session, "tool.polygon", |tool, canvas, actions| {
        assert!(!tool.key(canvas.session, Key::Enter, actions));
        corners[..2].iter().for_each(|&at| tool.click(canvas, at, false, actions));
        assert!(tool.key(canvas.session, Key::Enter, actions) && actions.is_empty(), "too few");
        tool.release(canvas, Some(corners[2]), actions);
        assert!(tool.key(canvas.session, Key::Enter, actions));
    });
    assert_eq!(primitive(&entered), primitive(&closed));
}

#[test]
fn a_freehand_line_takes_every_step_of_the_way() {
    let session = session();
    let round: Vec<Point> = (0..60).map(|k| f64::from(k) * 0.104).map(|a| [60.0 * a.cos(), 60.0 * a.sin()]).collect();
    let drawn = draw(&session, "tool.freehand", |tool, canvas, actions| {
        tool.press(canvas, round[0], actions);
        tool.drag(canvas, &round[1..30], actions);
        tool.drag(canvas, &round[30..], actions);
        tool.release(canvas, None, actions);
    });
    assert!(matches!(primitive(&drawn), Primitive::Path { points } if (4..20).contains(&points.len())));
}

#[test]
fn a_hand_holds_the_body_a_target_or_the_picture() {
    let session = session();
    let shape = crate::engine::Shape { nodes: session.design().mesh.nodes.clone(), ..Default::default() };
    let ground = Ground::Plushie(Plushie::Idealized, Some(&shape));
    let canvas = Canvas { session: &session, rect: RECT, camera: CAMERA, ground };
    let (mut tool, mut actions) = ((entry("tool.drag").make)(), Vec::new());
    assert_eq!(tool.cursor(&canvas, Hit::Nothing), CursorIcon::Default);
    tool.press(&canvas, [120.0, 70.0], &mut actions);
    tool.drag(&canvas, &[[121.0, 70.0], [130.0, 90.0]], &mut actions);
    assert_eq!(tool.cursor(&canvas, Hit::Nothing), CursorIcon::Grabbing);
    let [Action::SelectPose(None), Action::Live(Change::AddTarget { target, .. }), Action::DragTarget(to)] =
        actions.as_slice()
    else {
        panic!("{actions:?}")
    };
    assert!((to[0] - target.to[0] - 10.0).abs() < 1e-9 && (to[1] - target.to[1] - 20.0).abs() < 1e-9);
    // Escape lets go, and leaves the key to the command that takes the change back.
    assert!(!tool.key(&session, Key::Escape, &mut actions));
    actions.clear();
    tool.drag(&canvas, &[[140.0, 90.0]], &mut actions);
    assert_eq!(actions, []);
    // Beside the body the picture moves, and what was under the pointer stays there.
    tool.press(&canvas, [-50.0, 0.0], &mut actions);
    tool.drag(&canvas, &[[-40.0, 5.0]], &mut actions);
    assert_eq!(actions, [Action::SetCamera(Plushie::Idealized, Camera { center: [110.0, 70.0], ..CAMERA })]);
    let (mut tool, mut actions) = ((entry("tool.pin").make)(), Vec::new());
    tool.click(&canvas, [120.0, 70.0], false, &mut actions);
    tool.click(&canvas, [-50.0, 0.0], false, &mut actions);
    assert!(matches!(actions[..], [Action::Change(Change::AddPin(_)), Action::Select(Selection::Nothing)]));
}
