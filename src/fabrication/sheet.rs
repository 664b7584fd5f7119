//! A sheet in mm, y up: what is cut, sewn or looked at, before a writer gives it a file format.

use crate::outline::Point;

/// One sheet. Groups are painted, and cut, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    pub title: String,
    pub width_mm: f64,
    pub height_mm: f64,
    pub groups: Vec<Group>,
}

/// Entities of one kind and style: a layer of the sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Letters, digits and dashes, unique on the sheet.
    pub name: String,
    pub style: Style,
    pub entities: Vec<Entity>,
}

/// How the entities of a group are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub stroke: Option<Color>,
    pub stroke_mm: f64,
    pub fill: Option<Color>,
}

/// An sRGB colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8);

/// A line, an area or a text.
#[derive(Clone, Debug, PartialEq)]
pub enum Entity {
    /// Closed; the first point is not repeated.
    Polygon(Vec<Point>),
    Polyline(Vec<Point>),
    Circle {
        center: Point,
        radius: f64,
    },
    /// Upright text in the group's stroke colour (its fill colour if it has no stroke), `at` on the base line.
    Text {
        at: Point,
        size_mm: f64,
        anchor: Anchor,
        text: String,
    },
}

/// The part of a text that stands at its point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchor {
    #[default]
    Start,
    Middle,
}

/// Thinnest line, mm: lasers take it for a cut; 0.2 mm and more is engraved by some.
pub const HAIRLINE_MM: f64 = 0.01;
/// Lines that lasers cut.
pub const RED: Color = Color(255, 0, 0);
/// Lines to sew along.
pub const BLUE: Color = Color(0, 0, 255);
/// Marks and labels. Not black: lasers engrave black areas.
pub const GREEN: Color = Color(0, 128, 0);
pub const GREY: Color = Color(128, 128, 128);
pub const BLACK: Color = Color(0, 0, 0);
pub const YELLOW: Color = Color(255, 212, 0);

/// Length of the line on every sheet that shows whether it was printed or imported at its size, mm.
pub const REFERENCE_MM: f64 = 100.0;

impl Style {
    pub fn line(stroke: Color, stroke_mm: f64) -> Self {
        Self { stroke: Some(stroke), stroke_mm, fill: None }
    }

    pub fn hairline(stroke: Color) -> Self {
        Self::line(stroke, HAIRLINE_MM)
    }
}

impl Group {
    pub fn new(name: impl Into<String>, style: Style) -> Self {
        Self { name: name.into(), style, entities: Vec::new() }
    }

    pub fn text(&mut self, at: Point, size_mm: f64, anchor: Anchor, text: impl Into<String>) {
        self.entities.push(Entity::Text { at, size_mm, anchor, text: text.into() });
    }
}

/// The group `reference`: a straight line of [`REFERENCE_MM`] to the right of `start`, and its length in words.
pub fn reference(start: Point) -> Group {
    let mut group = Group::new("reference", Style::line(BLACK, 0.2));
    let end = [start[0] + REFERENCE_MM, start[1]];
    group.entities.push(Entity::Polyline(vec![start, end]));
    let text = format!("{REFERENCE_MM} mm: measure this line before you cut");
    group.text([start[0], start[1] + 2.0], 4.0, Anchor::Start, text);
    group
}
