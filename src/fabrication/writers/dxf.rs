//! Sheets to be cut as DXF of release 12 (ASCII), which every cutter and pattern program reads: a block a piece, layers by number as pattern
//! files have them (AAMA, ASTM D6673-10), mm.

use crate::fabrication::product::Content;
use crate::fabrication::sheet::{Anchor, Entity, Group, Layer, Sheet};
use crate::outline::Point;
use std::fmt::Write as _;

/// Layers, their colour numbers (1 red, 3 green, 5 blue, 7 black or white) and line types, in the order of the file.
const LAYERS: [(Layer, &str, i32, &str); 9] = [
    (Layer::Plain, "0", 7, "CONTINUOUS"),
    (Layer::Cut, "1", 1, "CONTINUOUS"),
    (Layer::Notch, "4", 3, "CONTINUOUS"),
    (Layer::Grain, "7", 3, "CONTINUOUS"),
    (Layer::Internal, "8", 3, "DASHED"),
    (Layer::CutOut, "11", 1, "CONTINUOUS"),
    (Layer::Hole, "13", 1, "CONTINUOUS"),
    (Layer::Stitch, "14", 5, "DASHED"),
    (Layer::Note, "15", 3, "CONTINUOUS"),
];

/// The bytes of a DXF file.
pub(super) fn write(content: &Content) -> Option<Vec<u8>> {
    match content {
        Content::Cut(sheet) => Some(dxf(sheet).into_bytes()),
        _ => None,
    }
}

fn dxf(sheet: &Sheet) -> String {
    let mut out = Pairs::default();
    header(&mut out, sheet);
    tables(&mut out);
    let pieces: Vec<&[Group]> = sheet
        .groups
        .chunk_by(|a, b| a.piece.is_some() && a.piece == b.piece)
        .filter(|g| g[0].piece.is_some())
        .collect();
    out.section("BLOCKS");
    for groups in &pieces {
        let name = block_name(groups[0].piece.as_deref().unwrap_or_default());
        out.text(0, "BLOCK").text(8, "0").text(2, &name).count(70, 0).point(10, [0.0, 0.0]).text(3, &name);
        groups.iter().for_each(|group| write_group(&mut out, group));
        out.text(0, "ENDBLK").text(8, "0");
    }
    out.end();
    out.section("ENTITIES");
    for groups in &pieces {
        let name = block_name(groups[0].piece.as_deref().unwrap_or_default());
        out.text(0, "INSERT").text(8, "1").text(2, &name).point(10, [0.0, 0.0]);
    }
    sheet.groups.iter().filter(|group| group.piece.is_none()).for_each(|group| write_group(&mut out, group));
    out.end();
    out.text(0, "EOF");
    out.0
}

fn header(out: &mut Pairs, sheet: &Sheet) {
    out.section("HEADER");
    out.text(9, "$ACADVER").text(1, "AC1009");
    // 4: millimetres.
    out.text(9, "$INSUNITS").count(70, 4).text(9, "$MEASUREMENT").count(70, 1);
    out.text(9, "$EXTMIN").point(10, [0.0, 0.0]).text(9, "$EXTMAX").point(10, [sheet.width_mm, sheet.height_mm]);
    out.end();
}

fn tables(out: &mut Pairs) {
    out.section("TABLES");
    out.text(0, "TABLE").text(2, "LTYPE").count(70, 2);
    out.text(0, "LTYPE").text(2, "CONTINUOUS").count(70, 0).text(3, "Solid").count(72, 65).count(73, 0).figure(40, 0.0);
    out.text(0, "LTYPE").text(2, "DASHED").count(70, 0).text(3, "Dashed").count(72, 65).count(73, 2).figure(40, 4.0);
    out.figure(49, 2.5).figure(49, -1.5);
    out.text(0, "ENDTAB");
    out.text(0, "TABLE").text(2, "LAYER").count(70, LAYERS.len() as i32);
    for (_, name, color, line) in LAYERS {
        out.text(0, "LAYER").text(2, name).count(70, 0).count(62, color).text(6, line);
    }
    out.text(0, "ENDTAB");
    out.text(0, "TABLE").text(2, "STYLE").count(70, 1);
    out.text(0, "STYLE").text(2, "STANDARD").count(70, 0).figure(40, 0.0).figure(41, 1.0).figure(50, 0.0);
    out.count(71, 0).figure(42, 3.0).text(3, "txt").text(4, "");
    out.text(0, "ENDTAB");
    out.end();
}

fn write_group(out: &mut Pairs, group: &Group) {
    let layer = LAYERS.iter().find(|row| row.0 == group.layer).map_or("0", |row| row.1);
    for entity in &group.entities {
        match entity {
            Entity::Polygon(points) => polyline(out, layer, points, true),
            Entity::Polyline(points) => polyline(out, layer, points, false),
            Entity::Circle { center, radius } => {
                out.text(0, "CIRCLE").text(8, layer).point(10, *center).figure(40, *radius);
            }
            Entity::Text { at, size_mm, anchor, text } => {
                let middle = i32::from(*anchor == Anchor::Middle);
                out.text(0, "TEXT").text(8, layer).point(10, *at).figure(40, *size_mm).text(1, &plain(text));
                out.count(72, middle).point(11, *at);
            }
        }
    }
}

fn polyline(out: &mut Pairs, layer: &str, points: &[Point], closed: bool) {
    out.text(0, "POLYLINE").text(8, layer).count(66, 1).point(10, [0.0, 0.0]).count(70, i32::from(closed));
    for &p in points {
        out.text(0, "VERTEX").text(8, layer).point(10, p);
    }
    out.text(0, "SEQEND").text(8, layer);
}

/// Names of blocks in release 12: capitals, digits and dashes, 31 at most.
fn block_name(piece: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '-' };
    piece.chars().map(plain).take(31).collect()
}

/// Text on one line of ASCII; other characters by their number.
fn plain(text: &str) -> String {
    let escaped = |c: char| match c {
        ' '..='~' => c.to_string(),
        c if c.is_control() || u32::from(c) > 0xffff => "?".into(),
        c => format!("\\U+{:04X}", u32::from(c)),
    };
    text.chars().map(escaped).collect()
}

/// Pairs of a group code and a value, a line each.
#[derive(Default)]
struct Pairs(String);

impl Pairs {
    fn text(&mut self, code: i32, value: &str) -> &mut Self {
        // Writing to a string cannot fail.
        let _ = write!(self.0, "{code:>3}\n{value}\n");
        self
    }

    fn count(&mut self, code: i32, value: i32) -> &mut Self {
        let _ = write!(self.0, "{code:>3}\n{value}\n");
        self
    }

    /// With seven decimals: a ten-thousandth of a micrometre.
    fn figure(&mut self, code: i32, value: f64) -> &mut Self {
        let _ = write!(self.0, "{code:>3}\n{value:.7}\n");
        self
    }

    fn point(&mut self, code: i32, [x, y]: Point) -> &mut Self {
        self.figure(code, x).figure(code + 10, y).figure(code + 20, 0.0)
    }

    fn section(&mut self, name: &str) {
        self.text(0, "SECTION").text(2, name);
    }

    fn end(&mut self) {
        self.text(0, "ENDSEC");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::sheet::{RED, Style};

    #[test]
    fn pieces_are_blocks_and_layers_have_their_numbers() {
        let mut cut = Group::of_piece("front", "cut", Layer::Cut, Style::hairline(RED));
        cut.entities.push(Entity::Polygon(vec![[0.0, 0.0], [30.0, 0.0], [0.0, 20.0]]));
        let mut note = Group::of_piece("front", "note", Layer::Note, Style::hairline(RED));
        note.text([1.0, 2.0], 4.0, Anchor::Middle, "f\u{e9}\n");
        let sheet = Sheet { title: String::new(), width_mm: 30.0, height_mm: 20.0, groups: vec![cut, note] };
        let text = dxf(&sheet);
        let lines: Vec<&str> = text.lines().collect();
        let pairs: Vec<(i32, &str)> = lines.chunks(2).map(|p| (p[0].trim().parse().unwrap(), p[1])).collect();
        let with = |code: i32, value: &str| pairs.iter().filter(|p| **p == (code, value)).count();
        assert_eq!((with(0, "SECTION"), with(0, "ENDSEC"), with(0, "EOF")), (4, 4, 1));
        assert_eq!((with(0, "BLOCK"), with(2, "FRONT"), with(0, "INSERT")), (1, 2, 1));
        assert_eq!((with(0, "POLYLINE"), with(0, "VERTEX"), with(0, "SEQEND")), (1, 3, 1));
        assert!(text.is_ascii() && with(1, "f\\U+00E9?") == 1 && with(8, "15") == 1, "{text}");
    }
}
