//! The routing: numbered holes, one line a tendon, as a sheet and as a table.

use crate::design::{Design, Tendon};
use crate::fabrication::cables::{holes, points, tendon_length_mm};
use crate::fabrication::error::ExportError;
use crate::fabrication::judge;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::sheet::{
    Anchor, BLACK, Color, Entity, GREY, Group, REFERENCE_MM, Sheet, Style, YELLOW, reference,
};
use crate::fabrication::table::{Column, Table, Values};
use crate::motion::winch_labels;
use crate::outline::Point;

/// Space around the body and between the blocks of a sheet, mm.
const MARGIN_MM: f64 = 15.0;
/// Least width of the list of tendons beside the body, mm.
const LEGEND_MM: f64 = 90.0;
const LEGEND_LINE_MM: f64 = 6.0;
/// Width of a letter over its height, generously: programs choose their own fonts.
const LETTER_WIDTH: f64 = 0.65;
const WINCH_RADIUS_MM: f64 = 5.0;

const GUIDE: &str =
    "  Lead each cable from its winch through the numbered holes, without tension and without slack (unless a slack is
  noted), and tie it at the last hole. Rig front and back alike: two cables a tendon, both on the winch's spool. Leave
  extra cable on the spool. Lengths are those at rest; pulling the ends by hand works as well.
";

/// The sheet and the table `routing`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let sheet = Product::new("routing", Content::Sheet(sheet(source.design)));
    let table = Product::new("routing", Content::Table(table(source.design)));
    Ok(Part { products: vec![sheet, table], guide: GUIDE.into(), remarks: judge::remarks(source.design) })
}

/// `winch,tendon,length_mm,points`: tendons counted from 1 within each winch, points from the winch outward.
fn table(design: &Design) -> Table {
    let (mut winches, mut numbers, mut lengths, mut routes) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (network, label) in design.networks.iter().zip(winch_labels(design)) {
        for (number, tendon) in (1..).zip(&network.tendons) {
            let route: Vec<String> =
                points(design, tendon).iter().map(|p| format!("{:.6} {:.6}", p[0], p[1])).collect();
            winches.push(label.clone());
            numbers.push(number);
            lengths.push(tendon_length_mm(design, tendon));
            routes.push(route.join(";"));
        }
    }
    let columns = vec![
        Column::new("winch", Values::Words(winches)),
        Column::new("tendon", Values::Counts(numbers)),
        Column::new("length_mm", Values::Figures(lengths)),
        Column::new("points", Values::Words(routes)),
    ];
    Table { columns, ..Table::default() }
}

/// The routing on the front of the body, seen from the front; the back is rigged the same way.
fn sheet(design: &Design) -> Sheet {
    let (low, high) = design.outline.bounding_box();
    let tendons: usize = design.networks.iter().map(|n| n.tendons.len()).sum();
    let legend_height = LEGEND_LINE_MM * (tendons + design.networks.len() + 2) as f64;
    let base = 2.0 * MARGIN_MM;
    let place = |p: Point| [p[0] - low[0] + MARGIN_MM, p[1] - low[1] + base];
    let legend_x = high[0] - low[0] + 2.0 * MARGIN_MM;
    let height_mm = base + (high[1] - low[1]).max(legend_height) + MARGIN_MM;

    let mut body = Group::new("body", Style::line(GREY, 0.3));
    for polygon in design.outline.polygons() {
        body.entities.push(Entity::Polygon(polygon.iter().map(|&p| place(p)).collect()));
    }
    let mut note = Group::new("note", Style { stroke: None, stroke_mm: 0.0, fill: Some(BLACK) });
    let mut lines = Vec::new();
    let mut winches = Group::new("winch", Style { stroke: Some(BLACK), stroke_mm: 0.3, fill: Some(YELLOW) });
    let mut row = height_mm - MARGIN_MM;
    note.text([legend_x, row], 4.0, Anchor::Start, format!("{}: front, seen from the front", design.name));
    row -= LEGEND_LINE_MM;
    note.text([legend_x, row], 3.5, Anchor::Start, "Rig the back in the same way: two cables a tendon.");
    for (n, (network, label)) in design.networks.iter().zip(winch_labels(design)).enumerate() {
        row -= LEGEND_LINE_MM;
        note.text([legend_x, row], 4.0, Anchor::Start, label.clone());
        for (t, tendon) in network.tendons.iter().enumerate() {
            row -= LEGEND_LINE_MM;
            let mut line = Group::new(format!("tendon-{}-{}", n + 1, t + 1), Style::line(color(lines.len()), 1.0));
            line.entities.push(Entity::Polyline(points(design, tendon).into_iter().map(place).collect()));
            line.entities.push(Entity::Polyline(vec![[legend_x + 2.0, row + 1.2], [legend_x + 10.0, row + 1.2]]));
            lines.push(line);
            note.text([legend_x + 12.0, row], 3.5, Anchor::Start, legend(design, t, tendon));
        }
        if let Some(winch) = network.winch() {
            let center = place(winch.place(&design.mesh.nodes));
            winches.entities.push(Entity::Circle { center, radius: WINCH_RADIUS_MM });
            note.text([center[0], center[1] + WINCH_RADIUS_MM + 1.5], 4.0, Anchor::Middle, label);
        }
    }
    let mut marks =
        Group::new("holes", Style { stroke: Some(BLACK), stroke_mm: 0.2, fill: Some(Color(255, 255, 255)) });
    for (i, &hole) in holes(design).iter().enumerate() {
        let center = place(hole);
        marks.entities.push(Entity::Circle { center, radius: 0.5 * design.fabrication.tendon_hole_mm });
        note.text([center[0] + 1.5, center[1] + 1.5], 3.0, Anchor::Start, (i + 1).to_string());
    }
    let right = note.entities.iter().map(right_end).fold(legend_x + LEGEND_MM, f64::max);
    let width_mm = (right + MARGIN_MM).max(REFERENCE_MM + 2.0 * MARGIN_MM);
    let mut groups = vec![body, winches];
    groups.extend(lines);
    groups.extend([marks, note, reference([MARGIN_MM, MARGIN_MM])]);
    Sheet { title: format!("{}: routing of the cables", design.name), width_mm, height_mm, groups }
}

/// One line of the list: number, length, holes from the winch outward, and what departs from the plain cable.
fn legend(design: &Design, index: usize, tendon: &Tendon) -> String {
    let holes = holes(design);
    let number = |p: Point| holes.iter().position(|h| *h == p).map_or(0, |i| i + 1).to_string();
    let through: Vec<String> = points(design, tendon).into_iter().map(number).collect();
    let mut text = format!("{}: {:.1} mm, holes {}", index + 1, tendon_length_mm(design, tendon), through.join("-"));
    if tendon.ratio != 1.0 {
        text += &format!(", spool x {:.3}", tendon.ratio);
    }
    if tendon.slack_mm != 0.0 {
        text += &format!(", slack {:.1} mm", tendon.slack_mm);
    }
    text
}

/// About how far to the right a text reaches, mm.
fn right_end(entity: &Entity) -> f64 {
    match entity {
        Entity::Text { at, size_mm, anchor, text } => {
            let width = LETTER_WIDTH * size_mm * text.chars().count() as f64;
            at[0] + if *anchor == Anchor::Middle { 0.5 * width } else { width }
        }
        _ => f64::NEG_INFINITY,
    }
}

/// Colours that tell neighbours apart on white paper: twelve chosen by hand, then the same darker and darker.
fn color(index: usize) -> Color {
    const HUES: [Color; 12] = [
        Color(31, 119, 180),
        Color(214, 39, 40),
        Color(44, 160, 44),
        Color(148, 103, 189),
        Color(255, 127, 14),
        Color(23, 190, 207),
        Color(227, 119, 194),
        Color(140, 86, 75),
        Color(0, 90, 50),
        Color(8, 48, 107),
        Color(128, 0, 38),
        Color(112, 128, 0),
    ];
    let Color(r, g, b) = HUES[index % HUES.len()];
    let darker = |v: u8| (f64::from(v) * 0.8f64.powf((index / HUES.len()) as f64)) as u8;
    Color(darker(r), darker(g), darker(b))
}
