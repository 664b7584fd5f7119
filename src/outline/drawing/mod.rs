//! Outlines drawn by hand: parts that are joined to what is before them, or cut out of it.
//!
//! A drawing is plain data, in mm with y up, as a file of its own (RON) or in a design:
//!
//! ```ron
//! (parts: [
//!     (primitive: Circle(center: (80, 90), radius: 60)),
//!     (primitive: Capsule(ends: ((40, 60), (30, 0)), radii: (18, 12))),
//!     (primitive: Path(points: [(at: (60, 80)), (at: (90, 80)), (at: (75, 110), corner: true)]), cut: true),
//! ], tracks: [[(50, 90), (80, 95), (110, 90)]])
//! ```

mod fit;
mod item;
mod primitive;
pub mod track;

pub use item::Item;
pub use primitive::{PathPoint, Primitive};
pub use track::Track;

use super::regions::{self, Shapes};
use super::{Outline, OutlineError, Point};
use serde::{Deserialize, Serialize};

/// Parts of a drawing, and points of all its paths together, at most.
const MAX_PARTS: usize = 10_000;
const MAX_POINTS: usize = 200_000;
/// Points of all tracks together, at most: every piece is tried against every other for crossings, on every mesh that is tried.
const MAX_TRACK_POINTS: usize = 200;
/// Largest coordinate and radius, mm.
const MAX_MM: f64 = 1e7;
/// How far the drawing of an outline may stray from it, as a fraction of the longer side of its box: less than the mesh does.
const FIT_FRACTION: f64 = 2.5e-3;

/// The parts that make a silhouette, in the order in which it was drawn.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drawing {
    #[serde(default)]
    pub parts: Vec<Part>,
    /// Where tendons shall be able to run: the mesh of the body has edges along these lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tracks: Vec<Track>,
}

/// One thing drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    pub primitive: Primitive,
    /// Cut out of what was drawn before, not joined to it.
    #[serde(default, skip_serializing_if = "primitive::is_false")]
    pub cut: bool,
}

/// The regions of a silhouette: each an outer polygon, counter-clockwise, then its holes, mm.
pub type Regions = Vec<Vec<Vec<Point>>>;

impl Drawing {
    /// A drawing of an outline with few points, to be changed by hand: the outer polygon, and its holes cut out.
    pub fn of(outline: &Outline) -> Self {
        let (low, high) = outline.bounding_box();
        let tolerance = FIT_FRACTION * (high[0] - low[0]).max(high[1] - low[1]);
        let part = |(k, ring): (usize, &[Point])| Part { primitive: fit::path(ring, tolerance), cut: k > 0 };
        Self { parts: outline.polygons().enumerate().map(part).collect(), tracks: Vec::new() }
    }

    /// Reads a drawing file.
    ///
    /// # Errors
    /// [`OutlineError::Unreadable`], with line and column or the part that is unsound.
    pub fn read(bytes: &[u8]) -> Result<Self, OutlineError> {
        let unreadable = |reason: String| OutlineError::Unreadable { format: "drawing", reason };
        let text = std::str::from_utf8(bytes).map_err(|error| unreadable(error.to_string()))?;
        let drawing: Self = ron::from_str(text).map_err(|error| unreadable(error.to_string()))?;
        drawing.check().map_err(|(at, why)| unreadable(format!("{at}: {why}")))?;
        Ok(drawing)
    }

    /// The text of a drawing file.
    ///
    /// # Errors
    /// Where it cannot be put into words, which no drawing is known to do.
    pub fn to_text(&self) -> Result<String, ron::Error> {
        let pretty = ron::ser::PrettyConfig::new().depth_limit(2);
        Ok(ron::ser::to_string_pretty(self, pretty)? + "\n")
    }

    /// Whether every part can be drawn.
    ///
    /// # Errors
    /// The place of what is unsound, such as `parts[3].radius`, and why.
    pub fn check(&self) -> Result<(), (String, &'static str)> {
        if self.parts.len() > MAX_PARTS {
            return Err(("parts".into(), "more than 10000 parts"));
        }
        let points = self.parts.iter().map(|part| part.primitive.handles().len()).sum::<usize>();
        if points > MAX_POINTS {
            return Err(("parts".into(), "more than 200000 points"));
        }
        for (k, part) in self.parts.iter().enumerate() {
            part.primitive.check(MAX_MM).map_err(|(at, why)| (format!("parts[{k}].{at}"), why))?;
        }
        if self.tracks.iter().map(Vec::len).sum::<usize>() > MAX_TRACK_POINTS {
            return Err(("tracks".into(), "more than 200 points"));
        }
        for (k, line) in self.tracks.iter().enumerate() {
            track::check(line, MAX_MM).map_err(|(at, why)| (format!("tracks[{k}]{at}"), why))?;
        }
        Ok(())
    }

    /// The area that the parts cover together: nothing to several pieces.
    ///
    /// # Errors
    /// [`OutlineError::TooComplex`].
    pub fn regions(&self) -> Result<Regions, OutlineError> {
        let mut covered = Shapes::new();
        let mut rest = self.parts.as_slice();
        while let Some(first) = rest.first() {
            // All that are joined, or cut, in a row at once.
            let run = rest.iter().position(|part| part.cut != first.cut).unwrap_or(rest.len());
            let polygons = rest[..run].iter().map(|part| vec![part.primitive.polygon()]);
            covered = if first.cut {
                regions::difference(&covered, &regions::union(polygons.collect())?)
            } else {
                regions::union(covered.into_iter().chain(polygons).collect())?
            };
            rest = &rest[run..];
        }
        Ok(covered)
    }

    /// The drawing with every point moved.
    pub fn moved(&self, by: Point) -> Self {
        self.each(|primitive| primitive.moved(by), |p| [p[0] + by[0], p[1] + by[1]])
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        if factor == 1.0 {
            return self.clone();
        }
        self.each(|primitive| primitive.scaled(factor), |p| p.map(|v| v * factor))
    }

    fn each(&self, change: impl Fn(&Primitive) -> Primitive, to: impl Fn(Point) -> Point) -> Self {
        let part = |part: &Part| Part { primitive: change(&part.primitive), cut: part.cut };
        let track = |track: &Track| track.iter().map(|&p| to(p)).collect();
        Self { parts: self.parts.iter().map(part).collect(), tracks: self.tracks.iter().map(track).collect() }
    }
}

impl Part {
    /// A part that is joined.
    pub fn joined(primitive: Primitive) -> Self {
        Self { primitive, cut: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::readers::reader_of;
    use crate::outline::{Import, Pieces, polygon};
    use std::f64::consts::PI;

    fn is_drawing(bytes: &[u8]) -> bool {
        reader_of(bytes).is_some_and(|reader| reader.extensions() == ["ron"])
    }

    fn circle(x: f64, y: f64, radius: f64) -> Part {
        Part::joined(Primitive::Circle { center: [x, y], radius })
    }

    fn square(x: f64, y: f64, side: f64) -> Primitive {
        let corner = |p: Point| PathPoint { at: p, corner: true };
        Primitive::Path { points: [[x, y], [x + side, y], [x + side, y + side], [x, y + side]].map(corner).to_vec() }
    }

    #[test]
    fn parts_are_joined_and_cut_in_their_order() {
        let cut = Part { primitive: square(20.0, 20.0, 20.0), cut: true };
        let parts = vec![Part::joined(square(0.0, 0.0, 60.0)), cut.clone()];
        let mut drawing = Drawing { parts, tracks: vec![vec![[10.0, 5.0], [50.0, 10.0]]] };
        let outline = drawing.import(&Import::default()).unwrap().outline;
        assert!((outline.area() - 3200.0).abs() < 1e-6 && outline.holes.len() == 1);
        let double = drawing.import(&Import { height_mm: Some(120.0), ..Import::default() }).unwrap();
        assert!((double.outline.area() - 12_800.0).abs() < 1e-6);
        let double = double.drawing.unwrap();
        assert_eq!(double.parts[1].primitive, square(40.0, 40.0, 40.0));
        assert_eq!(double.tracks, [[[20.0, 10.0], [100.0, 20.0]]]);
        // What is drawn after the cut stays.
        drawing.parts.push(circle(30.0, 30.0, 5.0));
        drawing.parts.push(Part::joined(square(24.0, -10.0, 12.0)));
        let area: f64 = drawing.regions().unwrap().iter().flatten().map(|r| polygon::signed_area(r)).sum();
        assert!((area - 3200.0 - 120.0 - 25.0 * PI).abs() < 0.05, "{area}");
        // Without the island in the hole.
        let largest = Import { pieces: Pieces::Largest, ..Import::default() };
        let corner = drawing.import(&largest).unwrap().drawn_box[0];
        assert!(corner[0].abs() < 1e-6 && (corner[1] + 10.0).abs() < 1e-6, "{corner:?}");
        let of = |parts: Vec<Part>| Drawing { parts, ..Drawing::default() };
        let everything = of(vec![circle(0.0, 0.0, 9.0), Part { cut: true, ..circle(0.0, 0.0, 10.0) }]);
        for nothing in [Drawing::default(), everything, of(vec![cut])] {
            assert!(matches!(nothing.import(&Import::default()), Err(OutlineError::NothingPainted(_))));
        }
        let two = of(vec![circle(0.0, 0.0, 40.0), circle(100.0, 0.0, 40.0)]);
        assert!(matches!(two.import(&Import::default()), Err(OutlineError::Pieces { pieces: 2, .. })));
    }

    #[test]
    fn the_text_reads_back_and_what_is_unsound_is_named() {
        let drawing = Drawing {
            parts: vec![
                circle(1.0 / 3.0, -2.5, 60.0),
                Part::joined(Primitive::Capsule { ends: [[0.0, 1.0], [40.0, 7.0]], radii: [12.0, 8.0] }),
                Part { primitive: square(0.0, 0.0, 5.0), cut: true },
            ],
            tracks: vec![vec![[1.0 / 3.0, 0.0], [20.0, 1e-3]], vec![[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]]],
        };
        let text = drawing.to_text().unwrap();
        assert!(is_drawing(text.as_bytes()));
        assert_eq!(Drawing::read(text.as_bytes()).unwrap(), drawing);
        for (bad, at) in [
            ("(parts: [(primitive: Circle(center: (0, 0), radius: -1))])", "parts[0].radius"),
            ("(parts: [(primitive: Circle(center: (0, 1e9), radius: 1))])", "parts[0].center"),
            ("(parts: [(primitive: Capsule(ends: ((0, 0), (1, 1)), radii: (1, 0)))])", "parts[0].radii[1]"),
            ("(parts: [(primitive: Path(points: [(at: (0, 0)), (at: (1, 0))]))])", "parts[0].points"),
            ("(parts: [(primitive: Blob(radius: 1))])", "1:"),
            ("(tracks: [[(0, 0), (1, 1)], [(0, 0)]])", "tracks[1]: a track needs"),
            ("(tracks: [[(0, 0), (1, 1), (0, 1e9)]])", "tracks[0][2]: a coordinate"),
        ] {
            let why = Drawing::read(bad.as_bytes()).unwrap_err().to_string();
            assert!(why.contains(at), "{bad}: {why}");
        }
        // A text from before there were tracks, and one that begins with them.
        let old = Drawing::read(b"(parts: [(primitive: Circle(center: (0, 0), radius: 1))])").unwrap();
        assert!(old.tracks.is_empty() && !old.to_text().unwrap().contains("tracks"));
        assert!(is_drawing(b"(\n  tracks: [[(0, 0), (1, 1)]], parts: [])"));
        let many = Drawing { parts: Vec::new(), tracks: vec![vec![[0.0; 2]; MAX_TRACK_POINTS + 1]] };
        assert_eq!(many.check(), Err(("tracks".into(), "more than 200 points")));
    }

    #[test]
    fn an_outline_is_drawn_with_few_points() {
        let source = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/pig.svg")).unwrap();
        let outline = crate::outline::svg::read(&source, Some(250.0)).unwrap();
        let drawing = Drawing::of(&outline);
        let points = drawing.parts[0].primitive.handles().len();
        let again = drawing.import(&Import::default()).unwrap();
        let (again, corner) = (again.outline, again.drawn_box[0]);
        let (_, high) = outline.bounding_box();
        let stray = FIT_FRACTION * high[0].max(high[1]);
        let far =
            outline.outer.iter().map(|p| again.distance([p[0] - corner[0], p[1] - corner[1]])).fold(0.0, f64::max);
        assert!(far < 1.2 * stray, "{far} mm of {stray}");
        let Primitive::Path { points: path } = &drawing.parts[0].primitive else { panic!() };
        assert!(path.iter().filter(|p| p.corner).count() * 2 < points, "mostly corners: {path:?}");
        assert!(points < 120 && points * 2 < outline.outer.len(), "{points} of {}", outline.outer.len());
    }
}
