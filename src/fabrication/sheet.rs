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
    /// The piece of felt that it belongs to; groups of one piece stand together.
    pub piece: Option<String>,
    pub layer: Layer,
    pub style: Style,
    pub entities: Vec<Entity>,
    /// Lower left and upper right corner of the box outside of which nothing of the group is drawn.
    pub clip: Option<[Point; 2]>,
}

/// The purpose of a group for whoever cuts and sews: the layers of pattern files (AAMA, ASTM D6673).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layer {
    /// Drawn to be looked at alone.
    #[default]
    Plain,
    /// The rim of a piece.
    Cut,
    /// Cut out within a piece.
    CutOut,
    /// Small holes within a piece.
    Hole,
    /// Marks on the rim that meet those of another piece.
    Notch,
    Stitch,
    /// The direction of the cloth.
    Grain,
    /// Lines within a piece that no machine cuts.
    Internal,
    Note,
}

/// How the entities of a group are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Style {
    pub stroke: Option<Color>,
    pub stroke_mm: f64,
    pub fill: Option<Color>,
    /// Lengths of dashes and gaps in turn, mm; none for a solid line.
    pub dash: &'static [f64],
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
pub const WHITE: Color = Color(255, 255, 255);
pub const YELLOW: Color = Color(255, 212, 0);

/// Side of the square on every sheet that shows whether it was printed or imported at its size, mm: printers scale the two axes differently.
pub const REFERENCE_MM: f64 = 100.0;
/// Height of the words below the square, mm.
const REFERENCE_TEXT_MM: f64 = 4.0;

impl Style {
    pub fn line(stroke: Color, stroke_mm: f64) -> Self {
        Self { stroke: Some(stroke), stroke_mm, ..Self::default() }
    }

    pub fn hairline(stroke: Color) -> Self {
        Self::line(stroke, HAIRLINE_MM)
    }

    /// Areas and texts without a rim.
    pub fn filled(fill: Color) -> Self {
        Self { fill: Some(fill), ..Self::default() }
    }

    pub fn dashed(self, dash: &'static [f64]) -> Self {
        Self { dash, ..self }
    }
}

impl Group {
    pub fn new(name: impl Into<String>, style: Style) -> Self {
        Self { name: name.into(), piece: None, layer: Layer::Plain, style, entities: Vec::new(), clip: None }
    }

    /// A layer of a piece, `front-cut` of the piece `front`.
    pub fn of_piece(piece: &str, name: &str, layer: Layer, style: Style) -> Self {
        Self { piece: Some(piece.into()), layer, ..Self::new(format!("{piece}-{name}"), style) }
    }

    pub fn text(&mut self, at: Point, size_mm: f64, anchor: Anchor, text: impl Into<String>) {
        self.entities.push(Entity::Text { at, size_mm, anchor, text: text.into() });
    }
}

impl Entity {
    /// The same in another place: every point by `place`, lengths times `scale`.
    pub fn placed(&self, place: impl Fn(Point) -> Point, scale: f64) -> Self {
        match self {
            Self::Polygon(points) => Self::Polygon(points.iter().map(|&p| place(p)).collect()),
            Self::Polyline(points) => Self::Polyline(points.iter().map(|&p| place(p)).collect()),
            Self::Circle { center, radius } => Self::Circle { center: place(*center), radius: radius * scale },
            Self::Text { at, size_mm, anchor, text } => {
                Self::Text { at: place(*at), size_mm: size_mm * scale, anchor: *anchor, text: text.clone() }
            }
        }
    }
}

/// The group `reference`: a straight line of [`REFERENCE_MM`] to the right of `start`, and its length in words.
pub fn reference(start: Point) -> Group {
    let mut group = Group::new("reference", Style::line(BLACK, 0.2));
    let end = [start[0] + REFERENCE_MM, start[1]];
    group.entities.push(Entity::Polyline(vec![start, end]));
    let text = format!("{REFERENCE_MM} mm: measure this line before you cut");
    group.text([start[0], start[1] + 2.0], REFERENCE_TEXT_MM, Anchor::Start, text);
    group
}

/// The group `reference` as a square of [`REFERENCE_MM`] with its lower left corner at `corner`, and what it is for.
pub fn reference_square(corner: Point) -> Group {
    let mut group = Group::new("reference", Style::line(BLACK, 0.3));
    let [x, y] = corner;
    let far = [x + REFERENCE_MM, y + REFERENCE_MM];
    group.entities.push(Entity::Polygon(vec![corner, [far[0], y], far, [x, far[1]]]));
    let middle = [x + 0.5 * REFERENCE_MM, y + 0.5 * REFERENCE_MM];
    for (line, words) in
        ["Measure this square: 100 mm each way.", "Print at 100 %, do not scale."].into_iter().enumerate()
    {
        group.text([middle[0], middle[1] - 6.0 * line as f64], REFERENCE_TEXT_MM, Anchor::Middle, words);
    }
    group
}
