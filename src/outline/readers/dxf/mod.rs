//! A silhouette from a DXF drawing: the areas inside its closed outlines.
//!
//! Closed polylines (with arcs), circles, ellipses and splines bound areas, and so do lines and arcs whose ends meet, nearly at least
//! (`chain`). Outlines that cross are one area, an outline within another is a hole, copies count once, a frame is left out (`areas`). Blocks
//! are inserted where they are used; where nothing is drawn but in blocks, as in sewing patterns, a block is read by its name. What is
//! hidden does not count. Where layers are chosen, the entities on them count alone; what lies on layer 0 of a block lies on the layer of
//! its insertion. Hatches count where nothing else is closed. `$INSUNITS` tells the unit; without it a plain number is a millimetre.
//!
//! The format is pairs of lines, a code and a value (or the same in bytes), and is read here directly, codes as in Autodesk's DXF Reference.
//! Libraries were looked at again: `dxf` 0.6 leaves hatches out; `acadrust` 0.6 (MPL 2.0, 230 000 lines) reads every entity and DWG besides.
//! Both build a model of the whole document before anything can be refused, and what makes an outline (planes, curves, joins, copies, nested
//! blocks within bounds) would be written here all the same; the pairs themselves are the smaller part.

mod areas;
mod binary;
mod chain;
mod curves;
mod draw;
mod entity;
mod file;
mod hatch;
mod place;
mod through;

use super::finish::finish;
use super::{OutlineReader, Painting, ReadingOption, layers};
use crate::outline::even::{self, EVEN_FRACTION};
use crate::outline::{Import, Imported, Note, OutlineError, Point, polygon};
use curves::Curve;
use draw::{CUT_LINE, Drawn, LAYER_0};
use file::File;
use place::{Place, Point3};
use std::collections::BTreeSet;

/// Most points of all curves.
const MAX_POINTS: usize = 2_000_000;
/// Farthest that a polygon may lie from its curve, as a fraction of the drawing's size.
const FLATTEN_FRACTION: f64 = 2e-5;
/// A drawing whose extent along x or y is less than this part of that along z was drawn in a plane that stands upright.
const UPRIGHT: f64 = 1e-6;

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
        &[ReadingOption::Layers, ReadingOption::Unit, ReadingOption::Background, ReadingOption::Blocks]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        finish(painting(bytes, import)?, import)
    }
}

/// Whether the bytes look like a DXF drawing.
fn is_dxf(bytes: &[u8]) -> bool {
    if bytes.starts_with(binary::SENTINEL) {
        return true;
    }
    // Comments (code 999) may stand before the first section.
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]).into_owned();
    let mut lines = head.trim_start_matches('\u{feff}').lines().map(str::trim).filter(|line| !line.is_empty());
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        match code {
            "0" => return value == "SECTION",
            "999" => {}
            _ => return false,
        }
    }
    false
}

fn painting(bytes: &[u8], import: &Import) -> Result<Painting, OutlineError> {
    let unreadable = |reason: &str| OutlineError::Unreadable { format: "DXF", reason: reason.into() };
    let text = file::text(bytes).map_err(unreadable)?;
    let file = File::read(&text).map_err(unreadable)?;
    let mut painting = Painting::default();
    let mut chosen: Vec<String> = import.layers.iter().map(|name| name.to_lowercase()).collect();
    let blocks = blocks(&file, import, &mut chosen)?;
    let mut drawn = Drawn::new(&file, &chosen);
    if blocks.is_empty() {
        drawn.draw(&file.entities, Place::IDENTITY, LAYER_0, 0)?;
    }
    for name in &blocks {
        if let Some((_, content)) = file.blocks.get(name) {
            drawn.draw(content, Place::IDENTITY, LAYER_0, 1)?;
        }
    }
    if import.blocks.is_empty() && !blocks.is_empty() {
        painting.notes.push(Note::Blocks(blocks.iter().map(|name| (*name).to_owned()).collect()));
    }
    let there: BTreeSet<String> = drawn.layers.keys().map(|name| name.to_lowercase()).collect();
    layers::check(&import.layers, |name| there.contains(&name.to_lowercase()), drawn.layers.keys().copied())?;
    closed_areas(&mut drawn, import, &file, &mut painting)?;
    if drawn.hidden > 0 {
        painting.notes.push(Note::Hidden { layers: drawn.hidden_layers(), count: drawn.hidden });
    }
    for (kind, count) in &drawn.skipped {
        painting.notes.push(Note::LeftOut { count: *count, kind: kind.clone() });
    }
    if import.unit_mm.or(file.unit_mm).is_none() {
        painting.notes.push(Note::NoUnit("the DXF"));
    }
    Ok(painting)
}

/// The blocks that are read in place of the drawing: those asked for, or the only one where nothing else is drawn. With the layer of cut
/// lines, where these blocks are pieces of a sewing pattern.
fn blocks<'a>(file: &'a File<'a>, import: &Import, chosen: &mut Vec<String>) -> Result<Vec<&'a str>, OutlineError> {
    let has_curves =
        |content: &[entity::Entity]| content.iter().any(|entity| entity.kind == "HATCH" || Curve::of(entity).is_some());
    let pieces: Vec<&str> =
        file.blocks.iter().filter(|(_, (_, content))| has_curves(content)).map(|(name, _)| *name).collect();
    let named = |name: &&&str| import.blocks.iter().any(|asked| asked.eq_ignore_ascii_case(name));
    for asked in &import.blocks {
        if !file.blocks.keys().any(|name| asked.eq_ignore_ascii_case(name)) {
            let blocks = if pieces.is_empty() { "no blocks".to_owned() } else { pieces.join(", ") };
            return Err(OutlineError::NoSuchBlock { name: asked.clone(), blocks });
        }
    }
    let asked: Vec<&str> = file.blocks.keys().filter(named).copied().collect();
    let draws = has_curves(&file.entities) || file.entities.iter().any(|entity| entity.kind == "INSERT");
    let read = match (asked.is_empty(), draws, pieces.len()) {
        (false, ..) => asked,
        (true, true, _) | (true, false, 0) => return Ok(Vec::new()),
        (true, false, 1) => pieces,
        (true, false, _) => return Err(OutlineError::BlocksAlone(pieces.join(", "))),
    };
    let on_cut_line = |name: &&str| {
        let content = &file.blocks[*name].1;
        let mut curves = content.iter().filter(|entity| Curve::of(entity).is_some());
        curves.any(|entity| entity.text(8) == Some(CUT_LINE))
    };
    if chosen.is_empty() && !draws && read.iter().all(on_cut_line) {
        chosen.push(CUT_LINE.to_owned());
    }
    Ok(read)
}

/// Closes the curves and fills them.
fn closed_areas(drawn: &mut Drawn, import: &Import, file: &File, painting: &mut Painting) -> Result<(), OutlineError> {
    let none = || match drawn.skipped.is_empty() {
        true => OutlineError::NothingPainted("the DXF has no lines, arcs, polylines or splines"),
        false => OutlineError::OtherKinds(
            drawn.skipped.iter().map(|(kind, count)| format!("{count} {kind}")).collect::<Vec<_>>().join(", "),
        ),
    };
    let hidden = || OutlineError::HiddenAlone(drawn.hidden_layers().join(", "));
    let lines = if drawn.curves.is_empty() { Vec::new() } else { flat(&drawn.curves)? };
    let hatched = if drawn.hatched.is_empty() { Vec::new() } else { flat(&drawn.hatched)? };
    let size = extent(if lines.is_empty() { &hatched } else { &lines });
    if !(size.is_finite() && size > 0.0) {
        return Err(if drawn.hidden > 0 { hidden() } else { none() });
    }
    painting.unit_mm = import.unit_mm.or(file.unit_mm).unwrap_or(1.0);
    let (lines, upright) = projected(lines);
    let (hatched, _) = projected(hatched);
    // What a mm is in the drawing: the size of its figure is not known before it is read.
    let mm = import.scale(box_of(if lines.is_empty() { &hatched } else { &lines })).unwrap_or(painting.unit_mm);
    let join = import.join_mm.map_or(chain::JOIN_FRACTION * size, |join| join / mm);
    let mut found = chain::closed(lines, size, join);
    let (open, nearest) = (found.open, found.nearest_loose);
    if found.contours.is_empty() && !hatched.is_empty() {
        found = chain::Closed { open, ..chain::closed(hatched, size, join) };
        painting.notes.push(Note::Hatches(drawn.hatches));
    } else if drawn.hatches > 0 {
        drawn.skipped.insert("hatch".to_owned(), drawn.hatches);
    }
    if found.contours.is_empty() {
        let gap = nearest.unwrap_or(f64::INFINITY);
        return Err(OutlineError::NotClosed { lines: open, gap });
    }
    if import.smooth_mm != Some(0.0) {
        painting.evened = even::evened(&mut found.contours, EVEN_FRACTION * size);
    }
    let areas = areas::of(found.contours, size, import.background)?;
    painting.notes.extend(areas.notes);
    painting.asides = areas.asides;
    painting.shapes = areas.shapes;
    if found.joined > 0 {
        painting.notes.push(Note::Joined { count: found.joined, farthest_mm: found.farthest * mm });
    }
    if found.copies + areas.copies > 0 {
        painting.notes.push(Note::Copies(found.copies + areas.copies));
    }
    if found.open > 0 {
        painting.notes.push(Note::OpenLines(found.open));
    }
    if let Some(along) = upright {
        painting.notes.push(Note::Upright(along));
    }
    Ok(())
}

/// The curves as polygons in space, and whether they are closed by definition.
fn flat(curves: &[(Curve, Place)]) -> Result<Vec<(Vec<Point3>, bool)>, OutlineError> {
    let hull = curves.iter().flat_map(|(curve, place)| curve.hull().into_iter().map(|p| place.at(p)));
    let size = extent(&[(hull.collect(), false)]);
    let mut points = 0;
    let mut lines = Vec::with_capacity(curves.len());
    for (curve, place) in curves {
        let line = curve.flat(place, FLATTEN_FRACTION * size);
        points += line.len();
        if points > MAX_POINTS {
            return Err(OutlineError::TooComplex("has more than two million points"));
        }
        lines.push((line, curve.is_closed()));
    }
    Ok(lines)
}

/// The longest side of the box around all.
fn extent(lines: &[(Vec<Point3>, bool)]) -> f64 {
    (0..3).map(|axis| span(lines, axis)).fold(0.0, f64::max)
}

fn span(lines: &[(Vec<Point3>, bool)], axis: usize) -> f64 {
    let all = lines.iter().flat_map(|(line, _)| line);
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[axis]), h.max(p[axis])));
    if low <= high { high - low } else { 0.0 }
}

/// The corners of the box around all.
fn box_of(lines: &[(Vec<Point>, bool)]) -> (Point, Point) {
    let all: Vec<Point> = lines.iter().flat_map(|(line, _)| line).copied().collect();
    polygon::bounding_box(&all)
}

/// Seen from above; or from the front or the side, where nothing is seen from above. Tells from where then.
fn projected(lines: Vec<(Vec<Point3>, bool)>) -> (Vec<(Vec<Point>, bool)>, Option<&'static str>) {
    let [x, y, z] = [0, 1, 2].map(|axis| span(&lines, axis));
    let (axes, along) = if y < UPRIGHT * z {
        ([0, 2], Some("the front (the x-z plane)"))
    } else if x < UPRIGHT * z {
        ([1, 2], Some("the side (the y-z plane)"))
    } else {
        ([0, 1], None)
    };
    let flat = |line: Vec<Point3>| line.into_iter().map(|p| axes.map(|axis| p[axis])).collect();
    (lines.into_iter().map(|(line, closed)| (flat(line), closed)).collect(), along)
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
        assert!(refuse(b"AutoCAD Binary DXF\r\n\x1a\0\0\0SECT").contains("ends early"));
        assert!(refuse(b"0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n").contains("ends early"));
        let own = "0 BLOCK 2 B 10 0 20 0 0 INSERT 2 B 10 1 20 0 70 100 71 100 0 INSERT 2 B 10 1 20 0 0 ENDBLK";
        assert!(refuse(&dxf("4", own, "0 INSERT 2 B 10 0 20 0")).contains("blocks"));
        assert!(import(&dxf("4", "", "0 CIRCLE 10 nan 20 0 40 inf"), &Import::default()).is_err());
    }
}
