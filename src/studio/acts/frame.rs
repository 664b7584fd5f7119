//! Shows a part of the plushies as large as the views allow.

use crate::design::MaterialPoint;
use crate::engine::Shape;
use crate::mesh::BodyPoint;
use crate::operations::network::Part;
use crate::outline::{Point, polygon};
use crate::studio::canvas::Hit;
use crate::studio::session::Session;

/// Around a part that is small or a point, mm of body at least, as a part of the body's length.
const AROUND: f64 = 0.12;
/// So far beyond the body at rest, in body lengths, what is shown may not be in a view that fits that.
const BEYOND: f64 = 0.05;
/// Around places that somebody looks for: enough of the body to tell where that is.
const AROUND_PLACES: f64 = 0.4;

/// Fits the body at rest into the views; where the plushies or a goal reach far beyond it, these as well.
pub fn fit(session: &mut Session) {
    session.look.fit();
    let mut points = all(session);
    let design = session.design();
    let (low, high) = polygon::bounding_box(&design.mesh.nodes);
    let far = BEYOND * design.body_length_mm();
    if points.iter().any(|p| (0..2).any(|k| p[k] < low[k] - far || p[k] > high[k] + far)) {
        points.extend([low, high]);
        frame(session, &points, AROUND);
    }
}

/// Frames what a menu is about or what is selected; otherwise both plushies as they are.
pub fn fit_selection(session: &mut Session, at: Hit) {
    let about = if matches!(at, Hit::Nothing | Hit::Body(_)) { session.selected() } else { at };
    let points = points(session, about);
    let points = if points.is_empty() { all(session) } else { points };
    frame(session, &points, AROUND);
}

/// Marks places of the body at rest, mm, and frames them where they are in the shapes that are shown.
pub fn show_places(session: &mut Session, places: &[Point]) {
    let design = session.design().clone();
    let mesh = &design.mesh;
    let at: Vec<BodyPoint> = places.iter().filter_map(|&p| Some(mesh.locate_nearest(p, &mesh.nodes)?.0)).collect();
    let shown = |shape: &Shape| at.iter().map(|at| mesh.position(at, &shape.nodes)).collect::<Vec<_>>();
    let points: Vec<Point> = shapes(session).flat_map(shown).collect();
    session.look.marked = Some((design.clone(), at));
    frame(session, &points, AROUND_PLACES);
}

/// Frames points, with so much of the body around them at least.
fn frame(session: &mut Session, points: &[Point], around: f64) {
    let (low, high) = polygon::bounding_box(points);
    if points.is_empty() {
        return session.look.fit();
    }
    let least = around * session.design().body_length_mm();
    let grown = |axis: usize| 0.5 * (least - (high[axis] - low[axis])).max(0.0);
    session.look.frame = Some([[0, 1].map(|k| low[k] - grown(k)), [0, 1].map(|k| high[k] + grown(k))]);
}

/// Both shapes as they are.
fn shapes(session: &Session) -> impl Iterator<Item = &Shape> {
    let shapes = session.shapes();
    let nodes = session.design().mesh.nodes.len();
    let both = [&shapes.idealized, &shapes.realizable].into_iter().flatten();
    both.map(AsRef::as_ref).filter(move |shape| shape.nodes.len() == nodes)
}

fn all(session: &Session) -> Vec<Point> {
    let goals = session.targets().iter().map(|target| target.to);
    shapes(session).flat_map(|shape| shape.nodes.iter().copied()).chain(goals).collect()
}

/// The places of a part in both shapes, mm.
fn points(session: &Session, about: Hit) -> Vec<Point> {
    let design = session.design();
    match about {
        Hit::Target(index) => session.targets().get(index).map_or(Vec::new(), |target| {
            let on_body = shapes(session).map(|shape| design.mesh.position(&target.at, &shape.nodes));
            on_body.chain([target.to]).collect()
        }),
        Hit::Pin(index) => design.pins.get(index).map_or(Vec::new(), |pin| {
            shapes(session).map(|shape| design.mesh.position(&pin.at, &shape.nodes)).collect()
        }),
        Hit::Part(part) => routed(session, part),
        Hit::Body(_) | Hit::Nothing => Vec::new(),
    }
}

/// All of a network, or the tendon that a part is of.
fn routed(session: &Session, part: Part) -> Vec<Point> {
    let Some(network) = session.design().networks.get(part.winch()) else { return Vec::new() };
    let own = network.tendons.iter().enumerate().filter(|(t, _)| part.tendon().is_none_or(|own| own == *t));
    let routing: Vec<&MaterialPoint> = own.flat_map(|(_, tendon)| &tendon.routing).collect();
    shapes(session)
        .flat_map(|shape| routing.iter().map(|point| point.place(&shape.nodes)).collect::<Vec<_>>())
        .collect()
}
