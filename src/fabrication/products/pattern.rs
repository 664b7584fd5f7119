//! The pattern: front and back of the skin, to be cut by a laser or by hand and sewn.
//!
//! Both faces carry the same holes, because both are rigged alike; the back is the mirror image of the front, so that
//! the pieces meet with their outer sides together.

use super::seam::{self, grown};
use crate::design::Design;
use crate::fabrication::cables::holes;
use crate::fabrication::error::ExportError;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::sheet::{Anchor, BLUE, Entity, GREEN, Group, RED, REFERENCE_MM, Sheet, Style, reference};
use crate::outline::{Point, polygon::bounding_box};

/// Space around and between the pieces, mm.
const MARGIN_MM: f64 = 15.0;
const TEXT_MM: f64 = 4.0;
/// Line widths, mm: visible on paper, and below what lasers take for an area to engrave.
const STITCH_MM: f64 = 0.1;
const NOTE_MM: f64 = 0.15;
/// Half the width of the cross that marks a pin, mm.
const PIN_MARK_MM: f64 = 3.0;
/// Half the length of the ticks at the ends of the turning gap, mm.
const GAP_TICK_MM: f64 = 2.5;

/// The place of a piece on the sheet.
struct Placement {
    mirrored: bool,
    shift: Point,
}

impl Placement {
    fn point(&self, p: Point) -> Point {
        let x = if self.mirrored { -p[0] } else { p[0] };
        [x + self.shift[0], p[1] + self.shift[1]]
    }

    fn points(&self, points: &[Point]) -> Vec<Point> {
        points.iter().map(|&p| self.point(p)).collect()
    }
}

/// The sheet `pattern`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let (sheet, remarks) = sheet(source.design);
    let guide = format!(
        "  One unit is one millimetre. Measure the 100 mm line before you cut. Red hairlines are cut (holes first), blue lines
  are sewn, green marks are for you. The seam allowance is {} mm. Put front and back together with their outer
  sides facing, sew along the blue line, leave the marked gap open, turn, stuff, close the gap by hand.
  Where a hole lies on the seam or next to it, lead the cable through the seam after sewing.
",
        source.design.fabrication.seam_allowance_mm
    );
    Ok(Part { products: vec![Product::new("pattern", Content::Sheet(sheet))], guide, remarks })
}

/// Both pieces, and remarks for whoever sews them.
fn sheet(design: &Design) -> (Sheet, Vec<String>) {
    let made = &design.fabrication;
    let shapes = grown(&design.outline, made.seam_allowance_mm);
    let outer: Vec<Point> = shapes.iter().filter_map(|s| s.first()).flatten().copied().collect();
    let (low, high) = bounding_box(&outer);
    let size = [high[0] - low[0], high[1] - low[1]];

    let base = 2.0 * MARGIN_MM;
    let front = Placement { mirrored: false, shift: [MARGIN_MM - low[0], base - low[1]] };
    let back = Placement { mirrored: true, shift: [2.0 * MARGIN_MM + size[0] + high[0], base - low[1]] };
    let width_mm = (3.0 * MARGIN_MM + 2.0 * size[0]).max(REFERENCE_MM + 2.0 * MARGIN_MM);
    let height_mm = base + size[1] + MARGIN_MM + TEXT_MM;

    let mut cut = Group::new("cut", Style::hairline(RED));
    let mut stitch = Group::new("stitch", Style::line(BLUE, STITCH_MM));
    let mut note = Group::new("note", Style::line(GREEN, NOTE_MM));
    let holes = holes(design);
    let pins: Vec<Point> = design.pins.iter().map(|p| design.mesh.position(&p.at, &design.mesh.nodes)).collect();
    let seam = seam::of(design);
    let pieces = [(&front, "FRONT"), (&back, "BACK (mirrored)")];

    // Small holes first, then cut-outs, then the outlines: what is cut free may shift.
    for (piece, _) in pieces {
        let hole = |&p: &Point| Entity::Circle { center: piece.point(p), radius: 0.5 * made.tendon_hole_mm };
        cut.entities.extend(holes.iter().map(hole));
    }
    for (piece, _) in pieces {
        cut.entities.extend(shapes.iter().flat_map(|s| s.iter().skip(1)).map(|c| Entity::Polygon(piece.points(c))));
    }
    for (piece, label) in pieces {
        cut.entities.extend(shapes.iter().filter_map(|s| s.first()).map(|c| Entity::Polygon(piece.points(c))));
        stitch.entities.push(Entity::Polyline(piece.points(&seam.stitches)));
        stitch.entities.extend(design.outline.holes.iter().map(|h| Entity::Polygon(piece.points(h))));
        let top = piece.point([0.5 * (low[0] + high[0]), high[1] + 3.0]);
        note.text(top, TEXT_MM, Anchor::Middle, format!("{label}: {}", design.name));
        number_holes(&mut note, piece, &holes);
        mark_pins(&mut note, piece, &pins);
        mark_gap(&mut note, piece, &seam.gap, seam.gap_mm);
    }
    let groups = vec![cut, stitch, note, reference([MARGIN_MM, MARGIN_MM])];
    let sheet = Sheet { title: format!("{}: pattern", design.name), width_mm, height_mm, groups };
    (sheet, remarks(design, &shapes, seam.gap_mm))
}

fn remarks(design: &Design, shapes: &[Vec<Vec<Point>>], gap_mm: f64) -> Vec<String> {
    let mut remarks = Vec::new();
    let wanted = design.fabrication.turning_gap_mm;
    if gap_mm < wanted {
        remarks.push(format!("The turning gap is {gap_mm:.0} mm instead of {wanted:.0} mm: the body is small."));
    }
    let cut_outs: usize = shapes.iter().map(|s| s.len().saturating_sub(1)).sum();
    if cut_outs > design.outline.holes.len() {
        remarks.push("Seam allowances meet in a narrow notch: snip between the seams after sewing.".into());
    }
    remarks
}

fn number_holes(note: &mut Group, piece: &Placement, holes: &[Point]) {
    for (i, &hole) in holes.iter().enumerate() {
        let p = piece.point(hole);
        note.text([p[0] + 1.5, p[1] + 1.5], 3.0, Anchor::Start, (i + 1).to_string());
    }
}

fn mark_pins(note: &mut Group, piece: &Placement, pins: &[Point]) {
    for (i, &pin) in pins.iter().enumerate() {
        let [x, y] = piece.point(pin);
        let r = PIN_MARK_MM;
        note.entities.push(Entity::Polyline(vec![[x - r, y - r], [x + r, y + r]]));
        note.entities.push(Entity::Polyline(vec![[x - r, y + r], [x + r, y - r]]));
        note.text([x + r + 0.5, y - 1.0], 3.0, Anchor::Start, format!("pin {}", i + 1));
    }
}

/// A tick across the seam at each end of the gap, and what it is for.
fn mark_gap(note: &mut Group, piece: &Placement, gap: &[Point], gap_mm: f64) {
    let (Some(&first), Some(&last)) = (gap.first(), gap.last()) else {
        return;
    };
    let (a, b) = (piece.point(first), piece.point(last));
    let chord = (b[0] - a[0]).hypot(b[1] - a[1]).max(f64::MIN_POSITIVE);
    let across = [-(b[1] - a[1]) / chord * GAP_TICK_MM, (b[0] - a[0]) / chord * GAP_TICK_MM];
    for p in [a, b] {
        let ends = [[p[0] - across[0], p[1] - across[1]], [p[0] + across[0], p[1] + across[1]]];
        note.entities.push(Entity::Polyline(ends.to_vec()));
    }
    let at = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) + 2.0];
    note.text(at, 3.0, Anchor::Middle, format!("leave {gap_mm:.0} mm open to turn"));
}
