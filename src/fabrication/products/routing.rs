//! The routing: for each face a sheet with numbered holes and a line a tendon, and tables.

use super::lanes::lanes;
use super::threading::{Thread, threads};
use crate::design::Design;
use crate::fabrication::cables::{holes, points, tendon_length_mm};
use crate::fabrication::error::ExportError;
use crate::fabrication::piece::{Labels, Piece};
use crate::fabrication::prisms::circle;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::sheet::{
    Anchor, BLACK, Color, Entity, GREY, Group, REFERENCE_MM, Sheet, Style, WHITE, YELLOW, reference,
};
use crate::fabrication::table::{Column, Table, Values};
use crate::fabrication::{buildable, font, judge, winch};
use crate::motion::winch_labels;
use crate::outline::Point;

/// Space around the body and between the blocks of a sheet, mm.
const MARGIN_MM: f64 = 15.0;
const LINE_MM: f64 = 5.5;
const WORDS_MM: f64 = 3.4;
/// Widths of cables over and under the felt, mm: they are told apart without colours.
const OVER_MM: f64 = 1.1;
const UNDER_MM: f64 = 0.45;
/// Radius of the dot at a knot, and of a hole's ring at least, mm.
const KNOT_MM: f64 = 1.5;
const HOLE_MM: f64 = 0.9;
/// Heights of the numbers of holes, mm.
const NUMBER_MM: [f64; 3] = [3.6, 3.0, 2.4];
/// Most holes that are numbered: what bounds the work of finding places for numbers.
const MOST_NUMBERS: usize = 300;
/// Dashes of tendons, mm: copies without colours are read by them.
const DASHES: [&[f64]; 6] = [&[], &[6.0, 1.6], &[1.6, 1.4], &[8.0, 1.6, 1.6, 1.6], &[3.2, 1.4], &[12.0, 3.0]];

const GUIDE: &str =
    "  A sheet a face, as that face is seen from outside. Lead each thread from its winch out of the opening, over the felt to the first
  hole, in and under it to the next, out again, and so on; tie it at the last hole, where the dot is. Without tension and without slack, unless a
  slack is noted. Thick lines run over the felt, thin ones under it. Rig front and back alike: two threads a tendon, both on the winch's spool.
  threading.csv has the length to cut of each thread: the tendon, the turns on the spool, two knots and a hand's breadth.
  Lengths are those at rest; pulling the ends by hand works as well.
";

/// The sheets `routing-front` and `routing-back`, and the tables `routing` and `threading`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let design = source.skin;
    let piece = source.piece();
    let products = vec![
        Product::new("routing-front", Content::Sheet(sheet(design, piece, false))),
        Product::new("routing-back", Content::Sheet(sheet(design, piece, true))),
        Product::new("routing", Content::Table(table(design))),
        Product::new("threading", Content::Table(threading(design))),
    ];
    let mut remarks = judge::remarks(source.design);
    remarks.extend(buildable::remarks(design, &source.design.breaches(), &piece.seam));
    Ok(Part { products, guide: GUIDE.into(), remarks })
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

/// A line a thread: what to cut, and its way.
fn threading(design: &Design) -> Table {
    let threads = threads(design);
    let faces = || threads.iter().flat_map(|t| ["front", "back"].map(|face| (t, face)));
    let words = |f: &dyn Fn(&Thread, &str) -> String| Values::Words(faces().map(|(t, face)| f(t, face)).collect());
    let columns = vec![
        Column::new("winch", words(&|t, _| t.winch.clone())),
        Column::new("tendon", Values::Counts(faces().map(|(t, _)| t.tendon as i64).collect())),
        Column::new("face", words(&|_, face| face.into())),
        Column::new("groove", Values::Counts(faces().map(|(t, face)| t.groove(face == "back") as i64).collect())),
        Column::new("length_mm", Values::Figures(faces().map(|(t, _)| t.length_mm).collect())),
        Column::new("cut_mm", Values::Figures(faces().map(|(t, _)| t.cut_mm).collect())),
        Column::new("slack_mm", Values::Figures(faces().map(|(t, _)| t.slack_mm).collect())),
        Column::new("way", words(&|t, _| t.way())),
    ];
    Table { columns, ..Table::default() }
}

/// One face, seen from outside, and the list of its threads.
pub fn sheet(design: &Design, piece: &Piece, back: bool) -> Sheet {
    let (low, high) = design.outline.bounding_box();
    let size = [high[0] - low[0], high[1] - low[1]];
    let base = 2.0 * MARGIN_MM;
    let place = |p: Point| {
        let x = if back { high[0] - p[0] } else { p[0] - low[0] };
        [x + MARGIN_MM, p[1] - low[1] + base]
    };
    let places = |points: &[Point]| -> Vec<Point> { points.iter().map(|&p| place(p)).collect() };
    let threads = threads(design);
    let rows = threads.len() + 2 * design.networks.len() + 6;
    let height_mm = base + size[1].max(LINE_MM * rows as f64) + MARGIN_MM;

    let mut body = Group::new("body", Style::line(GREY, 0.4));
    body.entities.push(Entity::Polyline(places(&piece.seam.stitches)));
    body.entities.extend(piece.inner_seams.iter().map(|ring| Entity::Polygon(places(ring))));
    let mut gap = Group::new("gap", Style::line(GREY, 0.4).dashed(&[1.0, 2.0]));
    gap.entities.push(Entity::Polyline(places(&piece.seam.gap)));
    let (winches, mut marks, mut note) = (openings(piece, &place), rings(piece, &place), words());
    let mut labels = Labels::default();
    labels.polyline(&places(&piece.seam.stitches));
    labels.polyline(&places(&piece.seam.gap));
    piece.inner_seams.iter().for_each(|ring| labels.polygon(&places(ring)));
    let housings = housings(design, piece, &place);
    for entity in &housings.entities {
        if let Entity::Polygon(ring) = entity {
            labels.polygon(ring);
        }
    }
    let lines = tendons(&threads, &place, &mut labels, &mut marks);
    for passage in &piece.passages {
        labels.disc(place(passage.at), passage.radius_mm.max(HOLE_MM) + 0.4);
    }
    number(piece, &place, &mut labels, &mut note);

    let legend_x = size[0] + 2.0 * MARGIN_MM;
    let title = if back { "back, seen from the back" } else { "front, seen from the front" };
    let (samples, right) = legend(design, title, &threads, [legend_x, height_mm - MARGIN_MM], &mut note);
    let width_mm = (right + MARGIN_MM).max(REFERENCE_MM + 2.0 * MARGIN_MM);
    let mut groups = vec![body, gap, winches, housings];
    for (mut line, sample) in lines.into_iter().zip(samples) {
        line[0].entities.push(sample);
        groups.extend(line.into_iter().filter(|group| !group.entities.is_empty()));
    }
    groups.extend([marks, note, reference([MARGIN_MM, MARGIN_MM])]);
    Sheet { title: format!("{}: routing of the cables, {title}", design.name), width_mm, height_mm, groups }
}

fn words() -> Group {
    Group::new("note", Style::filled(BLACK))
}

/// The openings of winches.
fn openings(piece: &Piece, place: &impl Fn(Point) -> Point) -> Group {
    let mut winches = Group::new("winch", Style { fill: Some(YELLOW), ..Style::line(BLACK, 0.3) });
    for passage in piece.passages.iter().filter(|p| !p.winches.is_empty()) {
        winches.entities.push(Entity::Circle { center: place(passage.at), radius: passage.radius_mm });
    }
    winches
}

/// The housings around the openings.
fn housings(design: &Design, piece: &Piece, place: &impl Fn(Point) -> Point) -> Group {
    let mut housings = Group::new("housing", Style::line(BLACK, 0.3).dashed(&[2.0, 1.0]));
    let radius = winch::housing(design).outer_radius_mm;
    let winches = piece.passages.iter().filter(|p| !p.winches.is_empty());
    housings.entities.extend(winches.map(|p| Entity::Polygon(circle(place(p.at), radius))));
    housings
}

fn rings(piece: &Piece, place: &impl Fn(Point) -> Point) -> Group {
    let mut marks = Group::new("holes", Style { fill: Some(WHITE), ..Style::line(BLACK, 0.3) });
    for passage in piece.passages.iter().filter(|p| p.winches.is_empty()) {
        marks.entities.push(Entity::Circle { center: place(passage.at), radius: passage.radius_mm.max(HOLE_MM) });
    }
    marks
}

/// For each thread the group of what runs over the felt, and that of what runs under it; knots are marked.
fn tendons(
    threads: &[Thread],
    place: &impl Fn(Point) -> Point,
    labels: &mut Labels,
    marks: &mut Group,
) -> Vec<[Group; 2]> {
    let ways: Vec<Vec<Point>> = threads.iter().map(|t| t.points.iter().map(|&p| place(p)).collect()).collect();
    let beside = lanes(&ways);
    let mut drawn = Vec::new();
    for (i, thread) in threads.iter().enumerate() {
        let name = format!("tendon-{}-{}", thread.network + 1, thread.tendon);
        let style = |width| Style::line(color(i), width).dashed(DASHES[i % DASHES.len()]);
        let mut pair = [Group::new(name.clone(), style(OVER_MM)), Group::new(format!("{name}-under"), style(UNDER_MM))];
        for (k, line) in beside[i].iter().enumerate() {
            labels.polyline(line);
            pair[k % 2].entities.push(Entity::Polyline(line.clone()));
        }
        drawn.push(pair);
        if let Some(&end) = ways[i].last() {
            marks.entities.push(Entity::Circle { center: end, radius: KNOT_MM });
            // A dot in the ring: the knot.
            marks.entities.push(Entity::Circle { center: end, radius: 0.5 * KNOT_MM });
            labels.disc(end, KNOT_MM + 0.3);
        }
    }
    drawn
}

fn number(piece: &Piece, place: &impl Fn(Point) -> Point, labels: &mut Labels, note: &mut Group) {
    for passage in piece.passages.iter().take(MOST_NUMBERS) {
        let texts = std::iter::once(passage.number.to_string()).chain(passage.winches.iter().cloned());
        for text in texts {
            let free =
                NUMBER_MM.into_iter().find_map(|size| Some((size, labels.place(&text, size, place(passage.at))?)));
            if let Some((size, at)) = free {
                note.text(at, size, Anchor::Start, text);
            }
        }
    }
}

/// The list beside the body from its upper left corner down; a line's sample for each thread, and how far to the right it reaches.
fn legend(design: &Design, title: &str, threads: &[Thread], at: Point, note: &mut Group) -> (Vec<Entity>, f64) {
    let [x, mut row] = at;
    let mut right = x;
    let mut line = |row: f64, x: f64, size: f64, text: String| {
        right = right.max(x + font::room_mm(&text, size));
        note.text([x, row], size, Anchor::Start, text);
    };
    line(row, x, 5.0, format!("{}: {title}", design.name));
    let how = [
        "Thick lines run over the felt, thin ones under it. The dot is the knot.",
        "Yellow: opening of a winch, and its housing around it.",
        "Rig both faces alike: two threads a tendon, one a face.",
    ];
    for text in how {
        row -= LINE_MM;
        line(row, x, WORDS_MM, text.into());
    }
    let mut samples = Vec::new();
    for thread in threads {
        if thread.tendon == 1 {
            row -= 1.6 * LINE_MM;
            line(row, x, 4.2, thread.winch.clone());
        }
        row -= LINE_MM;
        samples.push(Entity::Polyline(vec![[x, row + 1.2], [x + 14.0, row + 1.2]]));
        line(row, x + 17.0, WORDS_MM, thread.words());
    }
    row -= 1.6 * LINE_MM;
    line(
        row,
        x,
        WORDS_MM,
        format!("{} holes of {} mm in each face", holes(design).len(), design.fabrication.tendon_hole_mm),
    );
    (samples, right)
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
