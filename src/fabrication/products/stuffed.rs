//! The body as it is when it is stuffed, over the pattern.

use crate::fabrication::error::ExportError;
use crate::fabrication::piece::Labels;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::remark::Remark;
use crate::fabrication::sheet::{Anchor, BLACK, Entity, Group, Sheet, Style, reference};
use crate::fabrication::stuffing::{Impossible, Stuffed};
use crate::outline::Point;
use crate::outline::polygon::bounding_box;

const MARGIN_MM: f64 = 15.0;
const WORDS_MM: f64 = 3.4;
/// Limbs told one by one.
const TOLD: usize = 8;
/// How far parts may lie from where they are drawn before it is told, as a part of the body's length.
const TOLD_MOVE: f64 = 0.03;

/// The sheet `stuffed`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let stuffed = source.stuffed();
    let guide = "  Dashed: the stitch line as it is cut. Solid: the silhouette when the body is firmly stuffed, of felt that wrinkles and does not stretch.
  Narrow parts become round: a flat strip is 0.64 of its width then; curved tubes curl more. Compensation widens the pattern for that.
";
    let limbs = stuffed.limbs.iter().take(TOLD).map(|limb| limb.at);
    let mut remarks = vec![Remark::at(limbs, narrowing(source, stuffed))];
    remarks.extend(source.uncompensated.map(|why| {
        let place = if let Impossible::Overlap(place) = why { Some(*place) } else { None };
        Remark::at(place, uncompensated(source, why))
    }));
    remarks.extend(curling(source, stuffed).map(Remark::from));
    let products = vec![Product::new("stuffed", Content::Sheet(sheet(source, stuffed)))];
    Ok(Part { products, guide: guide.into(), remarks })
}

fn narrowing(source: &Source<'_>, stuffed: &Stuffed) -> String {
    let size = |ring: &[Point]| {
        let (low, high) = bounding_box(ring);
        [high[0] - low[0], high[1] - low[1]]
    };
    let flat = size(stuffed.flat.first().map_or(&[], Vec::as_slice));
    let round = size(stuffed.rings.first().map_or(&[], Vec::as_slice));
    let from = source.skin.outline.bounding_box().0;
    let limbs = stuffed.limbs.iter().take(TOLD).map(|limb| {
        let [x, y] = [limb.at[0] - from[0], limb.at[1] - from[1]];
        format!("{:.0} to {:.0} mm at x {x:.0}, y {y:.0}", limb.flat_mm, limb.stuffed_mm)
    });
    let limbs: Vec<String> = limbs.collect();
    let limbs = if limbs.is_empty() { String::new() } else { format!("; limbs narrow from {}", limbs.join(", ")) };
    format!(
        "Stuffed, the body is {:.0} x {:.0} mm, cut from {:.0} x {:.0} mm, and {:.0} mm thick{limbs}.",
        round[0], round[1], flat[0], flat[1], stuffed.thickness_mm
    )
}

/// How far parts of a stuffed body are from where they are drawn, and what to do about it.
fn curling(source: &Source<'_>, stuffed: &Stuffed) -> Option<String> {
    if !stuffed.is_settled {
        return Some("The stuffed silhouette is a rough one: the search for it did not come to its end.".into());
    }
    let size = source.design.mesh.body_length();
    if source.is_compensated() || stuffed.moved_mm <= TOLD_MOVE * size {
        return None;
    }
    let rest = if source.options.compensate {
        ""
    } else {
        " A pattern that is compensated for stuffing is cut so that it comes to lie as drawn."
    };
    let moved_mm = stuffed.moved_mm;
    Some(format!(
        "Stuffed, parts of the body lie up to {moved_mm:.0} mm from where they are drawn: they narrow, and curved ones curl.{rest}"
    ))
}

fn uncompensated(source: &Source<'_>, why: &Impossible) -> String {
    let from = source.skin.outline.bounding_box().0;
    match why {
        Impossible::Overlap(p) => format!(
            "The pattern is not compensated for stuffing: parts of it would overlap at x {:.0}, y {:.0}. Draw the parts there farther from each other.",
            p[0] - from[0],
            p[1] - from[1]
        ),
        Impossible::TooFine => {
            "The pattern is not compensated for stuffing: the mesh is too fine for that. Take a coarser one (plushwright remesh).".into()
        }
        Impossible::Off(mm) => format!(
            "The pattern is not compensated for stuffing: {mm:.1} mm of difference to the drawn silhouette would be left, more than a hundredth of the body."
        ),
    }
}

/// Both silhouettes, and the widths of limbs.
fn sheet(source: &Source<'_>, stuffed: &Stuffed) -> Sheet {
    let drawn = source.is_compensated().then_some(&source.design.outline);
    let as_drawn: Vec<Vec<Point>> = drawn.iter().flat_map(|outline| outline.polygons()).map(Vec::from).collect();
    let all: Vec<Point> = stuffed.flat.iter().chain(&stuffed.rings).chain(&as_drawn).flatten().copied().collect();
    let (low, high) = bounding_box(&all);
    let base = 2.0 * MARGIN_MM;
    let width_mm = (high[0] - low[0] + 2.0 * MARGIN_MM).max(150.0);
    let height_mm = high[1] - low[1] + base + MARGIN_MM + 14.0;
    let place = |p: Point| [p[0] - low[0] + MARGIN_MM, p[1] - low[1] + base];
    let placed = |rings: &[Vec<Point>]| -> Vec<Entity> {
        rings.iter().map(|ring| Entity::Polygon(ring.iter().map(|&p| place(p)).collect())).collect()
    };
    let mut flat = Group::new("flat", Style::line(BLACK, 0.3).dashed(&[3.0, 1.5]));
    flat.entities = placed(&stuffed.flat);
    let mut round = Group::new("stuffed", Style::line(BLACK, 0.7));
    round.entities = placed(&stuffed.rings);
    let mut drawn = Group::new("drawn", Style::line(BLACK, 0.2).dashed(&[0.4, 1.2]));
    drawn.entities = placed(&as_drawn);
    let mut across = Group::new("limbs", Style::line(BLACK, 0.3));
    let mut note = Group::new("note", Style::filled(BLACK));
    let mut labels = Labels::within(vec![[0.0; 2], [width_mm, 0.0], [width_mm, height_mm], [0.0, height_mm]]);
    for limb in &stuffed.limbs {
        let line: Vec<Point> = limb.across.iter().map(|&p| place(p)).collect();
        labels.polyline(&line);
        across.entities.push(Entity::Polyline(line));
    }
    for entity in flat.entities.iter().chain(&round.entities) {
        if let Entity::Polygon(ring) = entity {
            labels.polygon(ring);
        }
    }
    for limb in &stuffed.limbs {
        let text = format!("{:.0} > {:.0}", limb.flat_mm, limb.stuffed_mm);
        if let Some(at) = labels.place(&text, WORDS_MM, place(limb.at)) {
            note.text(at, WORDS_MM, Anchor::Start, text);
        }
    }
    let dotted = if source.is_compensated() { ", dotted as drawn" } else { "" };
    let words = format!(
        "{}: dashed as cut, solid when stuffed{dotted}, {:.0} mm thick",
        source.design.name, stuffed.thickness_mm
    );
    note.text([MARGIN_MM, height_mm - MARGIN_MM], 4.5, Anchor::Start, words);
    let title = format!("{}: stuffed", source.design.name);
    Sheet {
        title,
        width_mm,
        height_mm,
        groups: vec![flat, drawn, round, across, note, reference([MARGIN_MM, MARGIN_MM])],
    }
}
