//! A silhouette from a DXF drawing: the areas inside its closed outlines.
//!
//! Closed polylines (with arcs), circles, ellipses and splines bound areas, and so do lines and arcs that meet end to end.
//! An outline within another is a hole. Blocks are inserted where they are used. Where layers are chosen, the entities on
//! them count alone; what lies on layer 0 of a block lies on the layer of its insertion. `$INSUNITS` tells the unit; without it a
//! plain number is a millimetre. The format is pairs of lines, a code and a value, and is read here directly: the known
//! libraries build a model of the whole CAD document, allocate what a header tells them, and do not bound nested blocks.
//! Codes as in Autodesk's DXF Reference.

mod chain;
mod curves;
mod entity;
mod place;

use super::finish::finish;
use super::{OutlineReader, Painting, ReadingOption, layers};
use crate::outline::{Import, Imported, Note, OutlineError, Point, regions};
use curves::Curve;
use entity::{Entity, Tags};
use i_overlay::core::fill_rule::FillRule;
use place::Place;
use std::collections::{BTreeMap, BTreeSet};

/// The layer that every drawing has; in a block it is that of the insertion.
const LAYER_0: &str = "0";
/// Deepest nesting of blocks.
const MAX_DEPTH: usize = 12;
/// Most entities after blocks are inserted.
const MAX_ENTITIES: usize = 300_000;
/// Most points of all curves.
const MAX_POINTS: usize = 2_000_000;
/// Farthest that a polygon may lie from its curve, as a fraction of the drawing's size.
const FLATTEN_FRACTION: f64 = 2e-5;

pub(super) struct Dxf;

impl OutlineReader for Dxf {
    fn names(&self) -> [&'static str; 2] {
        ["a DXF drawing", "DXF drawings"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["dxf"]
    }

    fn can_read(&self, head: &[u8]) -> bool {
        is_dxf(head)
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Layers, ReadingOption::Unit]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        finish(painting(bytes, import)?, import)
    }
}

/// Whether the bytes look like a DXF drawing.
fn is_dxf(bytes: &[u8]) -> bool {
    if bytes.starts_with(BINARY) {
        return true;
    }
    // Comments (code 999) may stand before the first section.
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]).into_owned();
    let mut lines = head.lines().map(str::trim).filter(|line| !line.is_empty());
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        match code {
            "0" => return value == "SECTION",
            "999" => {}
            _ => return false,
        }
    }
    false
}

const BINARY: &[u8] = b"AutoCAD Binary DXF";

fn painting(bytes: &[u8], import: &Import) -> Result<Painting, OutlineError> {
    let unreadable = |reason: &str| OutlineError::Unreadable { format: "DXF", reason: reason.into() };
    if bytes.starts_with(BINARY) {
        return Err(unreadable("binary DXF; save it as ASCII DXF"));
    }
    let text = String::from_utf8_lossy(bytes);
    let file = File::read(&text).map_err(unreadable)?;
    let chosen: Vec<String> = import.layers.iter().map(|name| name.to_lowercase()).collect();
    let mut reader = Reader {
        file: &file,
        chosen: &chosen,
        layers: BTreeMap::new(),
        curves: Vec::new(),
        entities: 0,
        skipped: BTreeMap::new(),
    };
    reader.draw(&file.entities, Place::IDENTITY, LAYER_0, 0)?;
    let Reader { curves, skipped, layers, .. } = reader;
    let there: BTreeSet<String> = layers.keys().map(|name| name.to_lowercase()).collect();
    layers::check(&import.layers, |name| there.contains(&name.to_lowercase()), layers.keys().copied())?;
    let size = extent(&curves);
    if !(size.is_finite() && size > 0.0) {
        return Err(OutlineError::NothingPainted("the DXF has no lines, arcs, polylines or splines"));
    }
    let mut points = 0;
    let mut lines = Vec::with_capacity(curves.len());
    for (curve, place) in &curves {
        let line = curve.flat(place, FLATTEN_FRACTION * size);
        points += line.len();
        if points > MAX_POINTS {
            return Err(OutlineError::TooComplex("has more than two million points"));
        }
        lines.push((line, curve.is_closed()));
    }
    let chain::Closed { contours, open } = chain::closed(lines, size);
    if contours.is_empty() {
        return Err(OutlineError::NothingPainted("the DXF has no closed outline; its lines do not meet"));
    }
    let mut notes = Vec::new();
    if open > 0 {
        notes.push(Note::OpenLines(open));
    }
    for (kind, count) in skipped {
        notes.push(Note::LeftOut { count, kind: kind.to_string() });
    }
    let unit_mm = match (import.unit_mm, file.unit_mm) {
        (Some(mm), _) | (None, Some(mm)) => mm,
        (None, None) => {
            notes.push(Note::NoUnit("the DXF"));
            1.0
        }
    };
    Ok(Painting { shapes: regions::resolve(&contours, FillRule::EvenOdd)?, unit_mm, notes })
}

/// Size of the box around the control points of all curves.
fn extent(curves: &[(Curve, Place)]) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (curve, place) in curves {
        for p in curve.hull() {
            let p = place.at(p);
            for axis in 0..2 {
                low[axis] = low[axis].min(p[axis]);
                high[axis] = high[axis].max(p[axis]);
            }
        }
    }
    (high[0] - low[0]).max(high[1] - low[1])
}

/// The parts of a drawing that matter.
struct File<'a> {
    unit_mm: Option<f64>,
    /// Name to base point and content.
    blocks: BTreeMap<&'a str, (Point, Vec<Entity<'a>>)>,
    entities: Vec<Entity<'a>>,
}

impl<'a> File<'a> {
    fn read(text: &'a str) -> Result<Self, &'static str> {
        let mut tags = Tags::new(text);
        let mut file = Self { unit_mm: None, blocks: BTreeMap::new(), entities: Vec::new() };
        let mut ended = false;
        while let Some((code, value)) = tags.next_tag()? {
            match (code, value) {
                (0, "EOF") => {
                    ended = true;
                    break;
                }
                (2, "HEADER") => file.unit_mm = unit(&mut tags)?,
                (2, "BLOCKS") => file.read_blocks(&mut tags)?,
                (2, "ENTITIES") => file.entities = entity::read(&mut tags, "ENDSEC")?,
                _ => {}
            }
        }
        if ended || !file.entities.is_empty() { Ok(file) } else { Err("the file ends early or is no drawing") }
    }

    fn read_blocks(&mut self, tags: &mut Tags<'a>) -> Result<(), &'static str> {
        while let Some((code, value)) = tags.next_tag()? {
            match (code, value) {
                (0, "ENDSEC") => return Ok(()),
                (0, "BLOCK") => {
                    let head = entity::one(tags, "BLOCK")?;
                    let content = entity::read(tags, "ENDBLK")?;
                    let name = head.text(2).unwrap_or_default();
                    self.blocks.insert(name, (head.point(10), content));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// The unit that the header names, mm. 0 is "none", 1 inch, 2 foot, 4 mm, 5 cm, 6 m and so on (`$INSUNITS`).
fn unit(tags: &mut Tags) -> Result<Option<f64>, &'static str> {
    let mut unit = None;
    while let Some((code, value)) = tags.next_tag()? {
        match (code, value) {
            (0, "ENDSEC") => break,
            (9, "$INSUNITS") => {
                unit = match tags.next_tag()? {
                    Some((70, value)) => match value.parse::<i64>() {
                        Ok(1) => Some(25.4),
                        Ok(2) => Some(304.8),
                        Ok(4) => Some(1.0),
                        Ok(5) => Some(10.0),
                        Ok(6) => Some(1000.0),
                        Ok(8) => Some(2.54e-5),
                        Ok(9) => Some(0.0254),
                        Ok(10) => Some(914.4),
                        Ok(13) => Some(1e-3),
                        Ok(14) => Some(100.0),
                        _ => None,
                    },
                    _ => None,
                }
            }
            _ => {}
        }
    }
    Ok(unit)
}

struct Reader<'a> {
    file: &'a File<'a>,
    /// The layers that count, in lower case, as names of layers have no case; empty for all.
    chosen: &'a [String],
    /// The layers that something lies on, and whether they count.
    layers: BTreeMap<&'a str, bool>,
    curves: Vec<(Curve, Place)>,
    entities: usize,
    /// What cannot bound an area, by kind.
    skipped: BTreeMap<String, usize>,
}

impl<'a> Reader<'a> {
    /// Entities that stand for something on `around` where they lie on layer 0.
    fn draw(
        &mut self,
        entities: &'a [Entity<'a>],
        place: Place,
        around: &'a str,
        depth: usize,
    ) -> Result<(), OutlineError> {
        for entity in entities {
            self.entities += 1;
            if self.entities > MAX_ENTITIES || self.curves.len() > MAX_ENTITIES {
                return Err(OutlineError::TooComplex("has more than 300 000 entities"));
            }
            let layer = entity.text(8).filter(|name| *name != LAYER_0).unwrap_or(around);
            if entity.kind == "INSERT" {
                self.insert(entity, place, layer, depth)?;
                continue;
            }
            if !self.counts(layer) {
                continue;
            }
            // An extrusion that points down mirrors the entity (the "arbitrary axis" of the reference).
            let mirrored = entity.number(230).is_some_and(|z| z < 0.0) && entity.kind != "LINE";
            let place = if mirrored { place.after(&Place([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0])) } else { place };
            match Curve::of(entity) {
                Some(curve) => self.curves.push((curve, place)),
                None if matches!(entity.kind, "ATTRIB" | "SEQEND" | "VERTEX" | "VIEWPORT" | "POINT") => {}
                None => *self.skipped.entry(entity.kind.to_lowercase()).or_default() += 1,
            }
        }
        Ok(())
    }

    /// Whether what lies on a layer counts.
    fn counts(&mut self, layer: &'a str) -> bool {
        let chosen = self.chosen;
        *self.layers.entry(layer).or_insert_with(|| chosen.is_empty() || chosen.contains(&layer.to_lowercase()))
    }

    /// A block, scaled, turned and repeated in rows and columns.
    fn insert(
        &mut self,
        entity: &'a Entity<'a>,
        place: Place,
        layer: &'a str,
        depth: usize,
    ) -> Result<(), OutlineError> {
        if depth >= MAX_DEPTH {
            return Err(OutlineError::TooComplex("has blocks nested more than twelve deep"));
        }
        let Some((base, content)) = entity.text(2).and_then(|name| self.file.blocks.get(name)) else { return Ok(()) };
        let at = entity.point(10);
        let scale = [41, 42].map(|code| entity.number(code).unwrap_or(1.0));
        let (sin, cos) = entity.number(50).unwrap_or(0.0).to_radians().sin_cos();
        let repeats = |code| entity.number(code).map_or(1, |n| n.clamp(1.0, 1e4) as usize);
        let steps = [44, 45].map(|code| entity.number(code).unwrap_or(0.0));
        for row in 0..repeats(71) {
            for column in 0..repeats(70) {
                let shift = [column as f64 * steps[0], row as f64 * steps[1]];
                let turn = Place([cos, sin, -sin, cos, at[0], at[1]]);
                let grow = Place([scale[0], 0.0, 0.0, scale[1], shift[0], shift[1]]);
                let base = Place([1.0, 0.0, 0.0, 1.0, -base[0], -base[1]]);
                self.draw(content, place.after(&turn).after(&grow).after(&base), layer, depth + 1)?;
                self.entities += 1;
                if self.entities > MAX_ENTITIES {
                    return Err(OutlineError::TooComplex("has more than 300 000 entities"));
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::{Imported, import};

    fn dxf(unit: &str, blocks: &str, entities: &str) -> Vec<u8> {
        let header = format!("0 SECTION 2 HEADER 9 $INSUNITS 70 {unit} 0 ENDSEC");
        let blocks = format!("0 SECTION 2 BLOCKS {blocks} 0 ENDSEC");
        let entities = format!("0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF");
        let all = [header, blocks, entities].join(" ");
        all.split_whitespace().collect::<Vec<_>>().join("\r\n").into_bytes()
    }

    fn read(bytes: &[u8]) -> Imported {
        import(bytes, &Import::default()).unwrap()
    }

    #[test]
    fn a_square_of_100_mm_is_that_in_every_unit() {
        for (unit, side) in [("4", 100.0), ("5", 10.0), ("1", 100.0 / 25.4), ("0", 100.0), ("6", 0.1)] {
            let square = format!(
                "0 LWPOLYLINE 8 0 90 4 70 1 10 3 20 5 10 {a} 20 5 10 {a} 20 {b} 10 3 20 {b}",
                a = 3.0 + side,
                b = 5.0 + side
            );
            let imported = read(&dxf(unit, "", &square));
            let (_, high) = imported.outline.bounding_box();
            assert!((high[0] - 100.0).abs() < 1e-6 && (high[1] - 100.0).abs() < 1e-6, "{unit}: {high:?}");
            assert_eq!(imported.changes.notes.len(), usize::from(unit == "0"), "{:?}", imported.changes.notes);
        }
        let points = dxf(
            "0",
            "",
            "0 LWPOLYLINE 70 1 10 0 20 0 10 283.4645669 20 0 10 283.4645669 20 283.4645669 10 0 20 283.4645669",
        );
        let unit_mm = Some(25.4 / 72.0);
        let imported = import(&points, &Import { unit_mm, ..Import::default() }).unwrap();
        assert!((imported.outline.bounding_box().1[0] - 100.0).abs() < 1e-6);
    }

    #[test]
    fn lines_and_arcs_that_meet_make_an_outline_and_a_circle_in_it_a_hole() {
        // A stadium of two lines and two arcs, in no order, one of the lines backwards.
        let stadium = "0 LINE 10 0 20 0 11 100 21 0 0 ARC 10 0 20 25 40 25 50 90 51 270 0 LINE 10 0 20 50 11 100 21 50 \
                       0 ARC 10 100 20 25 40 25 50 -90 51 90 0 CIRCLE 10 50 20 25 40 10 0 TEXT 10 0 20 0 1 pig";
        let imported = read(&dxf("4", "", stadium));
        let pi = std::f64::consts::PI;
        let expected = 5000.0 + pi * 625.0 - pi * 100.0;
        assert!((imported.outline.area() / expected - 1.0).abs() < 1e-3, "{}", imported.outline.area());
        assert_eq!(imported.outline.holes.len(), 1);
        assert!(imported.changes.notes.iter().any(|n| n.to_string().contains("text")), "{:?}", imported.changes.notes);
    }

    #[test]
    fn bulges_ellipses_splines_and_blocks() {
        let pi = std::f64::consts::PI;
        let area = |entities: &str, blocks: &str| read(&dxf("4", blocks, entities)).outline.area();
        // Two half circles as bulges of 1.
        let disc = area("0 LWPOLYLINE 70 1 10 0 20 0 42 1 10 60 20 0 42 1", "");
        assert!((disc / (pi * 900.0) - 1.0).abs() < 1e-3, "{disc}");
        let old = "0 POLYLINE 66 1 70 1 0 VERTEX 10 0 20 0 42 1 0 VERTEX 10 60 20 0 42 1 0 SEQEND";
        assert!((area(old, "") - disc).abs() < 1e-6);
        let ellipse = area("0 ELLIPSE 10 5 20 5 11 0 21 50 40 0.5 41 0 42 6.283185307179586", "");
        assert!((ellipse / (pi * 50.0 * 25.0) - 1.0).abs() < 1e-3, "{ellipse}");
        // A rational quadratic spline: the exact circle of radius 30 from four quarter arcs.
        let w = std::f64::consts::FRAC_1_SQRT_2;
        let circle: String = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]]
            .iter()
            .enumerate()
            .map(|(k, p)| format!(" 10 {} 20 {} 41 {}", 30 * p[0], 30 * p[1], if k % 2 == 1 { w } else { 1.0 }))
            .collect();
        let spline = format!("0 SPLINE 70 1 71 2 40 0 40 0 40 0 40 1 40 1 40 2 40 2 40 3 40 3 40 4 40 4 40 4{circle}");
        let spline = area(&spline, "");
        assert!((spline / (pi * 900.0) - 1.0).abs() < 1e-3, "{spline}");
        let block = "0 BLOCK 2 B 10 10 20 0 0 LWPOLYLINE 70 1 10 10 20 0 10 20 20 0 10 20 20 10 10 10 20 10 0 ENDBLK";
        let inserted = area("0 INSERT 2 B 10 7 20 7 41 4 42 2 50 30", block);
        assert!((inserted - 800.0).abs() < 1e-3, "{inserted}");
    }

    #[test]
    fn what_is_no_outline_is_refused() {
        let refuse = |bytes: &[u8]| import(bytes, &Import::default()).unwrap_err().to_string();
        assert!(refuse(&dxf("4", "", "0 LINE 10 0 20 0 11 9 21 9")).contains("no closed outline"));
        assert!(refuse(&dxf("4", "", "")).contains("no lines"));
        assert!(refuse(b"AutoCAD Binary DXF\r\n\x1a\0").contains("binary"));
        assert!(refuse(b"0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n").contains("ends early"));
        let own = "0 BLOCK 2 B 10 0 20 0 0 INSERT 2 B 10 1 20 0 70 100 71 100 0 INSERT 2 B 10 1 20 0 0 ENDBLK";
        assert!(refuse(&dxf("4", own, "0 INSERT 2 B 10 0 20 0")).contains("blocks"));
        assert!(import(&dxf("4", "", "0 CIRCLE 10 nan 20 0 40 inf"), &Import::default()).is_err());
    }
}
