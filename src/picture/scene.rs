//! Scenes: primitives in painting order, for any renderer.

use super::color::Color;
use super::plush::Felt;
use super::silhouette::Silhouette;
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
    /// The felt within a silhouette in one colour, its points at `points`.
    Body {
        silhouette: Arc<Silhouette>,
        points: Vec<Point>,
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
    /// Many open polylines.
    Strands(Strands),
    Disc {
        center: Point,
        radius: f32,
        fill: Color,
        stroke: Option<(f32, Color)>,
    },
}

/// Open polylines in painting order, round caps and joins: thousands of them, in two pieces of memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strands {
    points: Vec<Point>,
    lines: Vec<Strand>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Strand {
    /// Where its points end; they begin where those of the one before end.
    end: usize,
    width: f32,
    color: Color,
}

impl Strands {
    /// None yet, with memory for so many of two points.
    pub fn with_capacity(lines: usize) -> Self {
        Self { points: Vec::with_capacity(2 * lines), lines: Vec::with_capacity(lines) }
    }

    /// Adds a line over the others.
    pub fn push(&mut self, points: impl IntoIterator<Item = Point>, width: f32, color: Color) {
        self.points.extend(points);
        self.lines.push(Strand { end: self.points.len(), width, color });
    }

    /// Points, width and colour of each.
    pub fn iter(&self) -> impl Iterator<Item = (&[Point], f32, Color)> {
        let starts = std::iter::once(0).chain(self.lines.iter().map(|line| line.end));
        self.lines.iter().zip(starts).map(|(line, start)| (&self.points[start..line.end], line.width, line.color))
    }

    /// The points of all of them.
    pub fn points(&self) -> &[Point] {
        &self.points
    }
}

/// Items in painting order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    pub items: Vec<Item>,
}
