//! Scenes: primitives in painting order, for any renderer.

use super::color::Color;
use super::plush::Felt;
use super::texture::Texture;
use crate::outline::Point;
use std::sync::Arc;

/// A primitive. Coordinates are in mm (y up), widths and radii in logical pixels.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// Triangles over `points`, one colour.
    Mesh {
        points: Vec<Point>,
        triangles: Vec<[usize; 3]>,
        color: Color,
    },
    /// Triangles over `points`, a colour each.
    Cells {
        points: Vec<Point>,
        triangles: Vec<[usize; 3]>,
        colors: Vec<Color>,
    },
    /// Stuffed felt in its light.
    Plush(Felt),
    /// Triangles over `points` with a picture on them; `places` says where each point lies in it, 0 to 1 from the upper left
    /// corner. What lies outside of it is clear.
    Picture {
        points: Vec<Point>,
        places: Vec<Point>,
        triangles: Vec<[usize; 3]>,
        texture: Arc<Texture>,
    },
    /// A polyline, round caps and joins.
    Line {
        points: Vec<Point>,
        width: f32,
        color: Color,
        closed: bool,
    },
    Disc {
        center: Point,
        radius: f32,
        fill: Color,
        stroke: Option<(f32, Color)>,
    },
}

/// Items in painting order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    pub items: Vec<Item>,
}
