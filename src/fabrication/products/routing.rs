//! How the cables run: numbered holes, one line a tendon, and the same as a table.

use super::drawing::{Anchor, BLACK, Color, Drawing, GREY, Group, Item, REFERENCE_MM, Style, YELLOW, reference};
use crate::design::{Design, Tendon};
use crate::outline::{Point, polygon};
use std::collections::HashSet;

/// Space around the body and between the blocks of a sheet, mm.
const MARGIN_MM: f64 = 15.0;
/// Least width of the list of tendons beside the body, mm.
const LEGEND_MM: f64 = 90.0;
const LEGEND_LINE_MM: f64 = 6.0;
/// Width of a letter over its height, generously: programs choose their own fonts.
const LETTER_WIDTH: f64 = 0.65;
const WINCH_RADIUS_MM: f64 = 5.0;

/// A name for each network that a table's header can hold: letters, digits, spaces and `-_.()`, each name once.
pub fn winch_labels(design: &Design) -> Vec<String> {
    let mut taken = HashSet::new();
    let plain = |c: char| if c.is_alphanumeric() || " -_.()".contains(c) { c } else { '_' };
    let label = |(i, name): (usize, &str)| {
        let name: String = name.chars().map(plain).collect();
        // A leading dash would make a formula of the cell in a spreadsheet.
        let name = name.trim().trim_start_matches('-').trim_start();
        let name = if name.is_empty() { format!("winch {}", i + 1) } else { name.to_string() };
        let mut unique = name.clone();
        let mut copy = 2;
        while !taken.insert(unique.clone()) {
            unique = format!("{name} ({copy})");
            copy += 1;
        }
        unique
    };
    design.networks.iter().map(|n| n.name.as_str()).enumerate().map(label).collect()
}

/// The mesh nodes at which cables pass the felt, each once, in the order in which routings reach them. The hole of
/// `holes[i]` has the number `i + 1` on every sheet.
pub fn holes(design: &Design) -> Vec<usize> {
    let mut seen = HashSet::new();
    let tendons = design.networks.iter().flat_map(|n| &n.tendons);
    tendons.flat_map(|t| &t.routing).copied().filter(|&node| seen.insert(node)).collect()
}

/// Length of a tendon at assembly, mm: the polyline of its routing and its slack, from the winch to its end.
pub fn tendon_length_mm(design: &Design, tendon: &Tendon) -> f64 {
    let points = points(design, tendon);
    points.windows(2).map(|s| polygon::length(s[0], s[1])).sum::<f64>() + tendon.slack_mm
}

/// `winch,tendon,length_mm,points`: tendons counted from 1 within each winch, points from the winch outward.
pub fn routing_csv(design: &Design) -> String {
    let mut csv = String::from("winch,tendon,length_mm,points\n");
    for (network, label) in design.networks.iter().zip(winch_labels(design)) {
        for (i, tendon) in network.tendons.iter().enumerate() {
            let points: Vec<String> =
                points(design, tendon).iter().map(|p| format!("{:.6} {:.6}", p[0], p[1])).collect();
            csv += &format!("{label},{},{:.6},{}\n", i + 1, tendon_length_mm(design, tendon), points.join(";"));
        }
    }
    csv
}

/// The routing on the front of the body, seen from the front; the back is rigged the same way.
pub fn routing_sheet(design: &Design) -> Drawing {
    let (low, high) = design.outline.bounding_box();
    let tendons: usize = design.networks.iter().map(|n| n.tendons.len()).sum();
    let legend_height = LEGEND_LINE_MM * (tendons + design.networks.len() + 2) as f64;
    let base = 2.0 * MARGIN_MM;
    let place = |p: Point| [p[0] - low[0] + MARGIN_MM, p[1] - low[1] + base];
    let legend_x = high[0] - low[0] + 2.0 * MARGIN_MM;
    let height_mm = base + (high[1] - low[1]).max(legend_height) + MARGIN_MM;

    let mut body = Group::new("body", Style::line(GREY, 0.3));
    for polygon in design.outline.polygons() {
        body.items.push(Item::Polygon(polygon.iter().map(|&p| place(p)).collect()));
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
            line.items.push(Item::Polyline(points(design, tendon).into_iter().map(place).collect()));
            line.items.push(Item::Polyline(vec![[legend_x + 2.0, row + 1.2], [legend_x + 10.0, row + 1.2]]));
            lines.push(line);
            note.text([legend_x + 12.0, row], 3.5, Anchor::Start, legend(design, t, tendon));
        }
        if let Some(node) = network.winch_node() {
            let center = place(design.mesh.nodes[node]);
            winches.items.push(Item::Circle { center, radius: WINCH_RADIUS_MM });
            note.text([center[0], center[1] + WINCH_RADIUS_MM + 1.5], 4.0, Anchor::Middle, label);
        }
    }
    let mut marks =
        Group::new("holes", Style { stroke: Some(BLACK), stroke_mm: 0.2, fill: Some(Color(255, 255, 255)) });
    for (i, &node) in holes(design).iter().enumerate() {
        let center = place(design.mesh.nodes[node]);
        marks.items.push(Item::Circle { center, radius: 0.5 * design.fabrication.tendon_hole_mm });
        note.text([center[0] + 1.5, center[1] + 1.5], 3.0, Anchor::Start, (i + 1).to_string());
    }
    let right = note.items.iter().map(right_end).fold(legend_x + LEGEND_MM, f64::max);
    let width_mm = (right + MARGIN_MM).max(REFERENCE_MM + 2.0 * MARGIN_MM);
    let mut groups = vec![body, winches];
    groups.extend(lines);
    groups.extend([marks, note, reference([MARGIN_MM, MARGIN_MM])]);
    Drawing { title: format!("{}: routing of the cables", design.name), width_mm, height_mm, groups }
}

/// One line of the list: number, length, holes from the winch outward, and what departs from the plain cable.
fn legend(design: &Design, index: usize, tendon: &Tendon) -> String {
    let holes = holes(design);
    let number = |node: &usize| holes.iter().position(|h| h == node).map_or(0, |i| i + 1).to_string();
    let through: Vec<String> = tendon.routing.iter().map(number).collect();
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
fn right_end(item: &Item) -> f64 {
    match item {
        Item::Text { at, size_mm, anchor, text } => {
            let width = LETTER_WIDTH * size_mm * text.chars().count() as f64;
            at[0] + if *anchor == Anchor::Middle { 0.5 * width } else { width }
        }
        _ => f64::NEG_INFINITY,
    }
}

fn points(design: &Design, tendon: &Tendon) -> Vec<Point> {
    tendon.routing.iter().map(|&node| design.mesh.nodes[node]).collect()
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
