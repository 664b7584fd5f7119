//! Lines and discs that several layers draw, and their sizes in logical pixels.

use crate::design::MaterialPoint;
use crate::engine::Shape;
use crate::outline::Point;
use crate::picture::color::Color;
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;
use std::sync::Arc;

pub const SEAM: f32 = 3.0;
/// The seam where the felt beside it is lit.
pub const SEWN: f32 = 2.2;
pub const FIBER_PASSIVE: f32 = 1.0;
pub const FIBER_ACTIVE: f32 = 3.2;
pub const TENDON: f32 = 3.4;
pub const CASING: f32 = 6.0;
pub const VIA: f32 = 2.6;
pub const WINCH: f32 = 8.5;
pub const PIN: f32 = 6.0;
pub const TARGET: f32 = 5.0;
pub const GOAL: f32 = 7.0;

/// The felt in one colour; nothing for a shape of another mesh.
pub fn body(silhouette: &Arc<Silhouette>, shape: &Shape, color: Color) -> Option<Item> {
    let points = silhouette.places(&shape.nodes)?;
    Some(Item::Body { silhouette: silhouette.clone(), points, color })
}

/// Where a point of the body is in a shape; `None` where the shape is of another mesh.
pub fn place(point: &MaterialPoint, shape: &Shape) -> Option<Point> {
    (point.last_node() < shape.nodes.len()).then(|| point.place(&shape.nodes))
}

/// A line through points of the body; those that the shape does not have are left out.
pub fn cable(routing: &[MaterialPoint], shape: &Shape, width: f32, color: Color) -> Item {
    let points = routing.iter().filter_map(|point| place(point, shape)).collect();
    Item::Line { points, width, color, closed: false }
}

/// A line through nodes of a shape; those that it does not have are left out.
pub fn path(routing: &[usize], shape: &Shape, width: f32, color: Color) -> Item {
    let points = routing.iter().filter_map(|&n| shape.nodes.get(n).copied()).collect();
    Item::Line { points, width, color, closed: false }
}

pub fn disc(center: Point, radius: f32, fill: Color, stroke: Option<(f32, Color)>) -> Item {
    Item::Disc { center, radius, fill, stroke }
}
